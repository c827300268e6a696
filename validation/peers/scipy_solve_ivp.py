"""SciPy: solve_ivp with events, one call a flight."""

import math
import sys

import scipy
from scipy.integrate import solve_ivp

from scene import HEADER, measure


def flights(method, rtol):
    def of(scene):
        alpha, pp, dt = scene.alpha, scene.p ** 2, scene.dt
        f, slope, last = scene.f, scene.slope, len(scene.slope)
        count = [0]
        sin, cos = math.sin, math.cos

        def flight(t0, side, w):
            def rhs(t, x):
                k = int(t / dt)
                force = f[k] + slope[k] * (t - k * dt) if k < last else 0.0
                y = alpha - x[0]
                return (x[1], -pp * (sin(y) + side * force * cos(y)))

            def base(t, x):
                return x[0]

            def tip(t, x):
                return x[0] - alpha

            def turn(t, x):
                return x[1]

            base.terminal, base.direction = True, -1
            tip.terminal, tip.direction = True, 1
            turn.direction = -1
            top, x = 0.0, (0.0, w)
            step = scene.first_step(w)
            # The forcing jumps at the record's end: stop there.
            for end in (scene.end, scene.end + 60.0):
                if not t0 < end:
                    continue
                got = solve_ivp(rhs, (t0, end), x, method, rtol=rtol,
                                atol=rtol * alpha, first_step=min(step, end - t0),
                                max_step=dt if end == scene.end else math.inf,
                                events=(base, tip, turn))
                count[0] += got.nfev
                if len(got.y_events[2]):
                    top = max(top, max(y[0] for y in got.y_events[2]))
                if len(got.t_events[1]):
                    return "overturned", got.t_events[1][0], 0.0, top
                if len(got.t_events[0]):
                    return "impact", got.t_events[0][0], got.y_events[0][0][1], top
                if got.status != 0:
                    return got.message, got.t[-1], 0.0, top
                t0, x, step = end, got.y[:, -1], dt
            return "still", t0, 0.0, top

        return flight, lambda: count[0]

    return of


if __name__ == "__main__":
    print(HEADER)
    for method in ("RK45", "DOP853"):
        for rtol in (1e-6, 1e-9, 1e-12):
            label = ("SciPy", scipy.__version__, f"solve_ivp {method}", f"rtol {rtol:.0e}")
            measure(label, sys.argv[1], flights(method, rtol))

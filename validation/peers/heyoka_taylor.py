"""heyoka: Taylor integrator compiled just in time, one propagation a sample
(the forcing is a polynomial there), events found on its own polynomial: the
base and the tip end a flight, turning points give the peak."""

import sys

import heyoka as hy
import numpy as np

from scene import HEADER, measure

TURNS = []


def integrator(tolerance):
    u, w = hy.make_vars("u", "w")
    pp, alpha, f0, slope, t0 = (hy.par[i] for i in range(5))
    y = alpha - u
    force = f0 + slope * (hy.time - t0)
    system = [(u, w), (w, -pp * (hy.sin(y) + force * hy.cos(y)))]
    down = hy.event_direction.negative
    ended = [
        hy.t_event(u, direction=down),
        hy.t_event(u - alpha, direction=hy.event_direction.positive),
    ]

    def turned(ta, time, sign):
        ta.update_d_output(time)
        TURNS.append(ta.d_output[0])

    seen = [hy.nt_event(w, callback=turned, direction=down)]
    more = {} if tolerance is None else {"tol": tolerance}
    return hy.taylor_adaptive(system, [0.0, 0.0], t_events=ended,
                              nt_events=seen, **more)


def flights(ta):
    def of(scene):
        alpha, dt, last = scene.alpha, scene.dt, len(scene.slope)
        f, slope = scene.f, scene.slope
        count = [0]

        def flight(t, side, w):
            # At u = 0 exactly heyoka loses the next event.
            ta.state[:] = (1e-16 * alpha, w)
            ta.pars[0], ta.pars[1] = scene.p ** 2, alpha
            ta.time = t
            ta.reset_cooldowns()
            TURNS.clear()
            k, top = int(t / dt), 0.0
            if k < last and (k + 1) * dt - t < 1e-13:
                k += 1
            while True:
                if k < last:
                    stop = (k + 1) * dt
                    ta.pars[2:5] = (side * f[k], side * slope[k], k * dt)
                else:
                    stop = scene.end + 60.0
                    ta.pars[2:5] = (0.0, 0.0, 0.0)
                got = ta.propagate_until(stop)
                outcome, steps = got[0], got[3]
                count[0] += steps
                top = max([top, *TURNS])
                if int(outcome) == -1:
                    return "impact", ta.time, ta.state[1], top
                if int(outcome) == -2:
                    return "overturned", ta.time, 0.0, top
                if outcome != hy.taylor_outcome.time_limit or k >= last:
                    return str(outcome), ta.time, 0.0, top
                k += 1

        return flight, lambda: count[0]

    return of


if __name__ == "__main__":
    print(HEADER)
    for tolerance in (1e-9, None):
        ta = integrator(tolerance)
        setting = "as shipped" if tolerance is None else f"tol {tolerance:.0e}"
        label = ("heyoka", hy.__version__, "Taylor sample by sample", setting)
        measure(label, sys.argv[1], flights(ta))

"""SciPy: solve_ivp with events, one call a flight.
    scipy_solve_ivp.py FOLDER     speed on the cases of `rocking speed --export`
    scipy_solve_ivp.py answers    answers to fixtures/benchmark/scenes.json
"""

import math
import sys

import scipy
from scipy.integrate import solve_ivp

import benchmark
from scene import HEADER, Landing, measure


def fly(scene, side, piece, t, u, w, stops, method, options):
    """From (t, u, w) to an impact, to overturning or to the last stop;
    `options` are those of solve_ivp up to each stop."""

    def base(_, x):
        return x[0]

    def tip(_, x):
        return x[0] - scene.limit

    def turn(_, x):
        return x[1]

    base.terminal, base.direction = True, -1
    tip.terminal, tip.direction = True, 1
    turn.direction = -1
    rhs, x, top, work = scene.rhs(side, piece), (u, w), (0.0, t), 0
    for stop in stops:
        if not t < stop:
            continue
        got = solve_ivp(rhs, (t, stop), x, method, events=(base, tip, turn),
                        **options(t, stop))
        work += got.nfev
        top = max([top, *((y[0], at) for at, y in
                          zip(got.t_events[2], got.y_events[2]))])
        for kind, at, y in zip(("impact", "overturned"), got.t_events,
                               got.y_events):
            if len(at):
                return Landing(kind, at[0], y[0][1], top[0], y[0][0], top[1]), work
        if got.status != 0:
            return Landing(got.message, got.t[-1], 0.0, *top), work
        t, x = stop, got.y[:, -1]
    return Landing("stop", t, x[1], top[0], x[0], top[1]), work


def flights(method, rtol):
    def of(scene):
        count = [0]

        def flight(t0, side, w):
            first = [scene.first_step(w)]

            def options(t, stop):
                step = min(first.pop() if first else scene.dt, stop - t)
                return {"rtol": rtol, "atol": rtol * scene.alpha,
                        "first_step": step,
                        "max_step": scene.dt if stop == scene.end else math.inf}

            # The forcing jumps at the record's end: stop there.
            stops = (scene.end, scene.end + 60.0)
            got, work = fly(scene, side, None, t0, 0.0, w, stops, method, options)
            count[0] += work
            return got

        return flight, lambda: count[0]

    return of


def default(scene, piece, t, side, u, w, stop):
    return fly(scene, side, piece, t, u, w, [stop], "RK45", lambda *_: {})[0]


def best(scene, piece, t, side, u, w, stop):
    def options(t, stop):
        return {"rtol": 3e-14, "atol": 1e-16 * scene.alpha,
                "first_step": min(scene.first_step(w), stop - t)}

    return fly(scene, side, piece, t, u, w, [stop], "DOP853", options)[0]


if __name__ == "__main__" and sys.argv[1] == "answers":
    for flight in (default, best):
        benchmark.answer(f"scipy-{flight.__name__}", lambda scene: benchmark.run(
            scene, flight, careful=flight is best))
elif __name__ == "__main__":
    print(HEADER)
    for method in ("RK45", "DOP853"):
        for rtol in (1e-6, 1e-9, 1e-12):
            label = ("SciPy", scipy.__version__, f"solve_ivp {method}", f"rtol {rtol:.0e}")
            measure(label, sys.argv[1], flights(method, rtol))

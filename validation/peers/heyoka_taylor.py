"""heyoka: Taylor integrator compiled just in time, one propagation a sample
(the forcing is a polynomial there), events found on its own polynomial: the
base and the tip end a flight, turning points give the peak.

    heyoka_taylor.py FOLDER     speed on the cases of `rocking speed --export`
    heyoka_taylor.py answers    answers to fixtures/benchmark/scenes.json, four
                                scenes at once by the batch integrator
"""

import sys

import heyoka as hy
import numpy as np

import benchmark
from scene import HEADER, Landing, measure

TURNS = []


def integrator(tolerance):
    u, w = hy.make_vars("u", "w")
    pp, alpha, f0, slope = (hy.par[i] for i in range(4))
    y = alpha - u
    force = f0 + slope * hy.time
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
            # Time from the beginning of the flight or of its sample: a hop of
            # a hundred-millionth of a second needs its digits.
            ta.state[:] = (0.0, w)
            ta.pars[0], ta.pars[1] = scene.p ** 2, alpha
            ta.reset_cooldowns()
            TURNS.clear()
            k, top = int(t / dt), 0.0
            if k < last and (k + 1) * dt - t < 1e-13:
                k += 1
            # A step that leaves u = 0 and is well inside the next hop: from
            # u = 0 exactly heyoka loses the next event of the same step.
            first = [scene.first_step(w)]
            while True:
                if k < last:
                    left = (k + 1) * dt - t
                    now = side * (f[k] + slope[k] * (t - k * dt))
                    ta.pars[2:4] = (now, side * slope[k])
                else:
                    left = scene.end + 60.0 - t
                    ta.pars[2:4] = (0.0, 0.0)
                ta.time = 0.0
                for stop in [*(x for x in first if x < left), left]:
                    outcome, _, _, steps, *_ = ta.propagate_until(stop)
                    count[0] += steps
                    if outcome != hy.taylor_outcome.time_limit:
                        break
                first = []
                top = max([top, *TURNS])
                if int(outcome) == -1:
                    return "impact", t + ta.time, ta.state[1], top
                if int(outcome) == -2:
                    return "overturned", t + ta.time, 0.0, top
                if outcome != hy.taylor_outcome.time_limit or k >= last:
                    return str(outcome), t + ta.time, 0.0, top
                k += 1
                t = k * dt

        return flight, lambda: count[0]

    return of


LANES = 4


def batch(linear, careful):
    """Any piece of acceleration by its parameters, a scene a lane."""
    u, w = hy.make_vars("u", "w")
    pp, alpha, limit, side, t0, a, b, sine, rate, phase, ricker, k, c = (
        hy.par[i] for i in range(13))
    square = (k * (hy.time - c)) ** 2
    force = side * (a + b * (hy.time - t0) + sine * hy.sin(rate * hy.time + phase)
                    + ricker * (1 - square) * hy.exp(-square / 2))
    y = alpha - u
    pull = y + force if linear else hy.sin(y) + force * hy.cos(y)
    down, up = hy.event_direction.negative, hy.event_direction.positive

    def turned(ta, time, _, lane):
        ta.update_d_output([time] * LANES)
        TURNS.append((lane, ta.d_output[0, lane], time))

    return hy.taylor_adaptive_batch(
        [(u, w), (w, -pp * pull)], np.zeros((2, LANES)), pars=np.zeros((13, LANES)),
        t_events=[hy.t_event_batch(u, direction=down),
                  hy.t_event_batch(u - limit, direction=up)],
        nt_events=[hy.nt_event_batch(w, callback=turned, direction=down)],
        high_accuracy=careful)


def parameters(scene, piece, side):
    kind, a, b, c = piece.kind, piece.a, piece.b, piece.c
    line = (piece.t0, a, b) if kind == "line" else (0.0, 0.0, 0.0)
    wave = (a, b, np.pi / 2 if kind == "cosine" else 0.0)
    wave = wave if kind in ("sine", "cosine") else (0.0, 0.0, 0.0)
    ricker = (a, b, c) if kind == "ricker" else (0.0, 0.0, 0.0)
    return (scene.p ** 2, scene.alpha, scene.limit, side, *line, *wave, *ricker)


def answers(todo, linear, careful):
    """The motions of scenes of one equation, `LANES` of them at a time."""
    ta, done, lanes = batch(linear, careful), {}, [None] * LANES
    stops, times, tops = np.zeros(LANES), np.zeros(LANES), [(0.0, 0.0)] * LANES

    def ask(i, landing):
        """The next flight of a lane, or of its next scene."""
        while True:
            if lanes[i] is None:
                if not todo:
                    ta.pars[:, i], ta.state[:, i], stops[i] = 0.0, (1.0, 0.0), times[i]
                    return
                scene = todo.pop()
                least = 1e-6 if careful else 1e-3
                lanes[i] = scene, benchmark.motion(scene, True, least)
                landing = None
            scene, steps = lanes[i]
            try:
                piece, times[i], side, u, w, stops[i] = steps.send(landing)
            except StopIteration as end:
                done[scene.name], lanes[i] = end.value, None
                continue
            # At u = 0 exactly heyoka loses the next event.
            ta.state[:, i] = max(u, 1e-16 * scene.alpha), w
            ta.pars[:, i] = parameters(scene, piece, side)
            ta.reset_cooldowns(i)
            tops[i] = (0.0, times[i])
            return

    for i in range(LANES):
        ask(i, None)
    while any(lanes):
        ta.set_time(times)
        TURNS.clear()
        ta.propagate_until(stops)
        times[:] = ta.time
        for i, top, at in TURNS:
            tops[i] = max(tops[i], (top, at))
        for i in range(LANES):
            outcome = int(ta.propagate_res[i][0])
            kind = {-1: "impact", -2: "overturned"}.get(outcome)
            if lanes[i] and (kind or times[i] == stops[i]):
                u, w = ta.state[:, i]
                ask(i, Landing(kind or "stop", times[i], w, tops[i][0], u, tops[i][1]))
    return done


if __name__ == "__main__" and sys.argv[1] == "answers":
    for setting in ("default", "best"):
        done = {}
        for linear in (False, True):
            todo = [x for x in benchmark.scenes() if x.linear == linear]
            done |= answers(todo, linear, setting == "best")
        benchmark.answer(f"heyoka-{setting}", lambda scene: done[scene.name])
elif __name__ == "__main__":
    print(HEADER)
    for tolerance in (1e-9, None):
        ta = integrator(tolerance)
        setting = "as shipped" if tolerance is None else f"tol {tolerance:.0e}"
        label = ("heyoka", hy.__version__, "Taylor sample by sample", setting)
        measure(label, sys.argv[1], flights(ta))

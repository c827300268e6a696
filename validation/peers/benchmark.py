"""The scenes of fixtures/benchmark/scenes.json, and answers to them.

A tool answers in one of two ways. An ODE solver integrates one smooth stretch
of the motion after another, and `run` does the rest: uplift, impacts, rest. A
physics engine, a finite element code or a penalty model computes the whole
motion, and `from_path` reads the answers off its rotation.
"""

import json
import math
import subprocess
import sys
from bisect import bisect_right
from pathlib import Path

from scipy.optimize import brentq

from scene import Landing

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "fixtures" / "benchmark"
IMPACTS = (1, 2, 3, 5, 10, 20)


class Piece:
    """A stretch of the ground's acceleration over g, without kinks inside:
    line: a + b (t - t0), sine: a sin(b t), cosine: a cos(b t),
    ricker: a (1 - x^2) exp(-x^2/2), x = b (t - c)."""

    def __init__(self, t0, t1, kind, a=0.0, b=0.0, c=0.0):
        self.t0, self.t1, self.kind = t0, t1, kind
        self.a, self.b, self.c = a, b, c

    def force(self, t):
        if self.kind == "line":
            return self.a + self.b * (t - self.t0)
        if self.kind == "sine":
            return self.a * math.sin(self.b * t)
        if self.kind == "cosine":
            return self.a * math.cos(self.b * t)
        square = (self.b * (t - self.c)) ** 2
        return self.a * (1 - square) * math.exp(-square / 2)

    def row(self):
        t1 = min(self.t1, 1e9)
        return f"{self.t0!r} {t1!r} {self.kind} {self.a!r} {self.b!r} {self.c!r}"


def pieces(excitation, g):
    kind = excitation["kind"]
    a = excitation.get("amplitude_m_s2", 0.0) / g
    if kind == "free":
        return []
    if kind == "samples":
        dt = excitation["dt_s"]
        f = [x / g for x in excitation["samples_m_s2"]]
        return [Piece(i * dt, (i + 1) * dt, "line", f[i], (f[i + 1] - f[i]) / dt)
                for i in range(len(f) - 1)]
    if kind == "rectangle":
        return [Piece(0.0, excitation["duration_s"], "line", a)]
    if kind == "triangle":
        half = excitation["duration_s"] / 2
        return [Piece(0.0, half, "line", 0.0, a / half),
                Piece(half, 2 * half, "line", a, -a / half)]
    if kind == "ricker-symmetric":
        T, n = excitation["period_s"], excitation["cycles"]
        return [Piece(0.0, n * T, "ricker", a, math.sqrt(2) * math.pi / T, n * T / 2)]
    w = excitation["omega_rad_s"]
    last = (1 if kind == "half-sine" else 2) * math.pi / w
    return [Piece(0.0, last, "cosine" if kind == "one-cosine" else "sine", a, w)]


class Scene:
    """The same names as in scene.py's `Scene`, for the same drivers."""

    def __init__(self, scene):
        self.name, self.asked = scene["name"], scene["quantities"]
        self.alpha, self.p = scene["alpha_rad"], scene["p_rad_s"]
        self.eta = scene["eta"]
        self.g, self.start = scene["g_m_s2"], scene["initial_theta_rad"]
        self.linear = scene["equation"] == "linearized"
        self.limit = self.alpha if scene["overturning"] == "alpha" else math.pi / 2
        self.times, self.last = scene.get("theta_times_s", []), scene["end_s"]
        self.until = scene.get("impacts_until_s", math.inf)
        shaking = pieces(scene["excitation"], self.g)
        self.end = shaking[-1].t1 if shaking else 0.0
        self.pieces = shaking + [Piece(self.end, math.inf, "line")]
        self.begins = [piece.t0 for piece in self.pieces]
        self.threshold = self.alpha if self.linear else math.tan(self.alpha)

    def piece(self, t):
        return self.pieces[max(bisect_right(self.begins, t) - 1, 0)]

    def force(self, t):
        return self.piece(t).force(t)

    def rhs(self, side, piece=None):
        """Of u = |theta| and its rate; under one piece, or under all."""
        alpha, pp, force = self.alpha, self.p ** 2, (piece or self).force
        if self.linear:
            return lambda t, x: (x[1], -pp * (alpha - x[0] + side * force(t)))

        def rhs(t, x):
            y = alpha - x[0]
            return x[1], -pp * (math.sin(y) + side * force(t) * math.cos(y))

        return rhs

    def exceedance(self, t):
        """First instant from t on with |f| above the threshold, and sgn f."""
        for piece in self.pieces[:-1]:
            if not piece.t1 > t:
                continue
            a = max(t, piece.t0)
            n = 1 if piece.kind == "line" else 4000
            over = lambda x: abs(piece.force(x)) - self.threshold
            for i in range(n):
                b = min(a + (piece.t1 - max(t, piece.t0)) / n, piece.t1)
                # A block that has just come to rest starts no earlier.
                if over(a) > 0:
                    return a, math.copysign(1.0, piece.force(a))
                if over(b) > 0:
                    at = brentq(over, a, b, xtol=1e-300, rtol=1e-15)
                    return at, math.copysign(1.0, piece.force(b))
                a = b
        return None

    def hops(self, t, side, speed):
        """How long the hops after an impact last, were the force constant;
        without end where it is above the threshold."""
        f, k = side * self.force(t), 1.0 if self.linear else math.cos(self.alpha)
        if not abs(f) < self.threshold:
            return math.inf
        ahead, back = (k * (self.threshold + x) for x in (f, -f))
        return (2 * speed / self.p ** 2 * (1 / ahead + self.eta / back)
                / (1 - self.eta ** 2)) if self.eta < 1 else math.inf

    def first_step(self, w):
        """A step well inside the next hop: a longer one skips an impact."""
        if w == 0:
            return 1e-3
        return min(0.2 * abs(w) / (self.p ** 2 * self.alpha), 1e-2)


def scenes():
    text = (FOLDER / "scenes.json").read_text()
    return [Scene(scene) for scene in json.loads(text)["scenes"]]


class Motion:
    """What happened in a scene."""

    def __init__(self):
        self.fate, self.impacts, self.theta = "no-uplift", [], {}
        self.uplift = self.speed = self.rest = self.overturning = None
        self.peak, self.peak_time = 0.0, None

    def rows(self, scene):
        value = {"fate": self.fate, "uplift_time_s": self.uplift,
                 "impacts": len([t for t in self.impacts if t <= scene.until]),
                 "impact_1_speed_rad_s": self.speed,
                 "rest_time_s": self.rest, "overturning_time_s": self.overturning}
        if self.fate != "overturned":
            value |= {"peak_ratio": self.peak / scene.alpha,
                      "peak_time_s": self.peak_time}
        value |= {f"impact_{k}_time_s": self.impacts[k - 1]
                  for k in IMPACTS if k <= len(self.impacts)}
        value |= {f"theta_{k + 1}_rad": self.theta.get(t)
                  for k, t in enumerate(scene.times)}
        for quantity in scene.asked:
            got = value.get(quantity)
            if got is not None:
                got = got if isinstance(got, (str, int)) else float(got)
                yield f"{scene.name},{quantity},{got}"


def motion(scene, kinks, least):
    """Yields what is to be integrated: (piece, t, side, u, w, stop), to an
    impact, to overturning or to `stop`; is sent the `scene.Landing`; returns
    the `Motion`. With `kinks` it stops at each kink of the acceleration, and
    `piece` is the smooth stretch, else None. A block whose speed is below
    `least` p alpha after an impact comes to rest."""
    seen = Motion()
    small = least * scene.p * scene.alpha
    stops = set(scene.times) | {scene.last} | {scene.end}
    if kinks:
        stops |= set(scene.begins)
    stops = sorted(stops)
    t, u, w, side = 0.0, abs(scene.start), 0.0, math.copysign(1.0, scene.start)
    moving = u > 0
    seen.peak, seen.peak_time = u, 0.0
    while True:
        if not moving:
            lifted = scene.exceedance(t)
            until = scene.last if lifted is None else lifted[0]
            seen.theta |= {x: 0.0 for x in scene.times if t <= x <= until}
            if lifted is None:
                break
            t, u, w, side = lifted[0], 0.0, 0.0, -lifted[1]
            seen.rest = None
            if seen.uplift is None:
                seen.uplift = t
        seen.fate, moving = "rocked", True
        stop = next((x for x in stops if x > t), None)
        if stop is None:
            break
        got = yield scene.piece(t) if kinks else None, t, side, u, w, stop
        if got.top > seen.peak:
            seen.peak, seen.peak_time = got.top, got.top_t
        t, u, w = got.t, got.u, got.w
        if got.kind == "overturned":
            seen.fate, seen.overturning = "overturned", t
            break
        if got.kind == "stop":
            if t in scene.times:
                seen.theta[t] = side * u
            continue
        if got.kind != "impact":
            raise RuntimeError(f"{scene.name}: flight ended {got.kind} at {t}")
        seen.impacts.append(t)
        if len(seen.impacts) > 20000:
            raise RuntimeError(f"{scene.name}: impacts without end at {t}")
        if seen.speed is None:
            seen.speed = -w
        side, u, w = -side, 0.0, -scene.eta * w
        if w < small and (left := scene.hops(t, side, max(w, 0.0))) < 1.0:
            t += left if kinks else 0.0
            seen.rest, moving = t, False
    return seen


def run(scene, flight, careful):
    """Answers by an ODE solver's `flight(scene, piece, t, side, u, w, stop)`:
    careful, or as one does without thought."""
    steps = motion(scene, careful, 1e-6 if careful else 1e-3)
    try:
        asked = next(steps)
        while True:
            asked = steps.send(flight(scene, *asked))
    except StopIteration as end:
        return end.value


def served(command):
    """Flights by another program, a line asked and a line answered."""
    program = subprocess.Popen(command, stdin=subprocess.PIPE,
                               stdout=subprocess.PIPE, text=True)

    def flight(scene, piece, t, side, u, w, stop):
        shaking = [piece] if piece else scene.pieces
        asked = [scene.alpha, scene.p, int(scene.linear), scene.limit, side,
                 t, u, w, stop, len(shaking)]
        asked = [repr(float(x)) if isinstance(x, float) else x for x in asked]
        print(*asked, *(x.row() for x in shaking), file=program.stdin, flush=True)
        kind, *numbers = program.stdout.readline().split() or ["ended"]
        if kind not in ("impact", "overturned", "stop"):
            raise RuntimeError(f"{scene.name}: flight {kind} at {t}")
        t, u, w, top, top_t = map(float, numbers)
        return Landing(kind, t, w, top, u, top_t)

    return flight


def from_path(scene, t, theta, dead):
    """Answers from a computed rotation, sample by sample. Rotations of at
    most `dead` count as standing: there a soft contact only settles."""
    seen = Motion()
    n, side, last = len(t), 0.0, 0

    def at(i, value):
        part = (value - theta[i - 1]) / (theta[i] - theta[i - 1])
        return t[i - 1] + (t[i] - t[i - 1]) * part

    for i in range(n):
        size = abs(theta[i])
        if not size > dead:
            continue
        if size >= scene.limit:
            seen.fate = "overturned"
            seen.overturning = at(i, math.copysign(scene.limit, theta[i]))
            n = i + 1
            break
        seen.fate = "rocked"
        now = math.copysign(1.0, theta[i])
        if side == 0.0 and not scene.start:
            seen.uplift = t[i]
        if side and now != side:
            j = i
            while theta[j - 1] * now > 0:
                j -= 1
            seen.impacts.append(at(j, 0.0))
            if seen.speed is None:
                seen.speed = abs((theta[j - 1] - theta[j - 2]) / (t[j - 1] - t[j - 2]))
        side, last = now, i
        if size > seen.peak:
            seen.peak, seen.peak_time = size, t[i]
    if seen.fate == "rocked" and t[-1] - t[last] > 0.2:
        seen.rest = t[last]
    for time in scene.times:
        i = bisect_right(t, time, 0, n)
        if 0 < i < n:
            part = (time - t[i - 1]) / (t[i] - t[i - 1])
            seen.theta[time] = theta[i - 1] + part * (theta[i] - theta[i - 1])
    return seen


def answer(name, solve):
    """Writes answers/NAME.csv. `solve(scene)` gives a `Motion`, or a text:
    why this tool does not do this scene."""
    rows, left_out = ["scene,quantity,value"], {}
    for scene in scenes():
        try:
            got = solve(scene)
        except (RuntimeError, ValueError, ArithmeticError) as error:
            got = str(error)
        if isinstance(got, str):
            left_out.setdefault(got, []).append(scene.name)
        else:
            rows += got.rows(scene)
    out = FOLDER / "answers"
    out.mkdir(exist_ok=True)
    (out / f"{name}.csv").write_text("\n".join(rows) + "\n")
    for reason, names in left_out.items():
        print(f"{name}: left out {len(names)}: {reason}", file=sys.stderr)
    return left_out


if __name__ == "__main__":
    # benchmark.py NAME PROGRAM...: a program that `served` can ask, in both
    # settings.
    for setting in ("default", "best"):
        flight = served([*sys.argv[2:], setting])
        answer(f"{sys.argv[1]}-{setting}",
               lambda scene: run(scene, flight, setting == "best"))

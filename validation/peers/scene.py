"""A case as `rocking speed --export` writes it, and what every driver shares:
rest, uplift, impacts. The tool integrates flights; this does the rest.

    u'' = -p^2 [sin(alpha - u) + s f(t) cos(alpha - u)],  u = |theta|,

with s the sign of theta and f = a/g, linear between samples. A flight ends
at u = 0 (impact: s flips, the velocity times eta), at u = alpha (overturned),
or with the record. The block goes to rest after an impact if the series of
hops provably ends within the sampling interval (`Scene.chatter`); there is no
velocity tolerance.
"""

import glob
import math
import os
import sys
import time
from typing import NamedTuple


class Landing(NamedTuple):
    """How a flight ended: kind is impact, overturned or stop; else it failed.
    `top` is the largest u on the way, at `top_t`."""

    kind: str
    t: float
    w: float
    top: float
    u: float = 0.0
    top_t: float = 0.0


class Scene:
    def __init__(self, path):
        lines = open(path).read().split("\n")
        head = dict(line.split() for line in lines[:7])
        self.name = head["name"]
        self.alpha = float(head["alpha_rad"])
        self.p = float(head["p_rad_s"])
        self.eta = float(head["eta"])
        self.dt = float(head["dt_s"])
        n = int(head["samples"])
        level = float(head["levels_g"])
        self.f = [float(x) * level for x in lines[7:7 + n]]
        self.slope = [(b - a) / self.dt for a, b in zip(self.f, self.f[1:])]
        self.end = (n - 1) * self.dt
        self.limit = self.alpha
        self.threshold = math.tan(self.alpha)
        self.cosine = math.cos(self.alpha)

    def piece(self, t):
        return min(int(t / self.dt), len(self.slope) - 1)

    def exceedance(self, t):
        """First instant from t on with |f| above the threshold, and sgn f."""
        k0 = int(t / self.dt)
        for k in range(k0, len(self.slope)):
            start = t if k == k0 else k * self.dt
            now = self.f[k] + self.slope[k] * (start - k * self.dt)
            if abs(now) > self.threshold:
                return start, math.copysign(1.0, now)
            last = self.f[k + 1]
            if abs(last) > self.threshold:
                sign = math.copysign(1.0, last)
                level = sign * self.threshold
                return start + (level - now) / self.slope[k], sign
        return None

    def rhs(self, side, _piece):
        """Of u and its rate."""
        f, slope, dt, last = self.f, self.slope, self.dt, len(self.slope)
        pp, alpha, sin, cos = self.p ** 2, self.alpha, math.sin, math.cos

        def rhs(t, x):
            k = int(t / dt)
            force = f[k] + slope[k] * (t - k * dt) if k < last else 0.0
            y = alpha - x[0]
            return (x[1], -pp * (sin(y) + side * force * cos(y)))

        return rhs

    def restoring(self, f):
        return (self.threshold + f) * self.cosine

    def chatter(self, t, side, speed):
        """Time within which the hops after an impact provably end."""
        k = int(t / self.dt)
        if k >= len(self.slope):
            return None
        f = side * (self.f[k] + self.slope[k] * (t - k * self.dt))
        w, eta = speed / self.p, self.eta
        left = ((k + 1) * self.dt - t) * self.p
        if not self.threshold - abs(f) > 0:
            return None
        guess = 2 * w / (self.restoring(-abs(f)) * (1 - eta))
        if not guess < left:
            return None
        window = min(2 * guess, left)
        drift = abs(self.slope[k] / self.p) * window
        least = self.restoring(-(abs(f) + drift))
        if not least > 0:
            return None
        push = (1 + self.threshold) * 2 * w * w / least
        least -= push
        if not least > 0:
            return None
        worst = max((self.restoring(x + drift) + push)
                    / (self.restoring(x - drift) - push) for x in (f, -f))
        if not eta * math.sqrt(worst) < 1:
            return None
        bound = 2 * w * math.sqrt(worst) / (least * (1 - eta * math.sqrt(worst)))
        if not bound < window:
            return None
        hops = 1 / self.restoring(f) + eta / self.restoring(-f)
        return 2 * w * hops / (1 - eta * eta) / self.p

    def first_step(self, w):
        """A step well inside the next hop: a longer one skips an impact."""
        if w == 0:
            return 0.1 * self.dt
        return min(0.2 * abs(w) / (self.p ** 2 * self.alpha), self.dt)


MOST_IMPACTS = 10_000


def run(scene, flight):
    """Peak u/alpha (inf: overturned) and times of the impacts. `flight(t,
    side, w)` gives a `Landing`; after the record it goes on to the first
    impact. A flight with errors may bounce without end."""
    peak, impacts, t = 0.0, [], 0.0
    while True:
        lifted = scene.exceedance(t)
        if lifted is None:
            return peak / scene.alpha, impacts
        t, sign = lifted
        side, w = -sign, 0.0
        while True:
            kind, t, w, top, *_ = flight(t, side, w)
            peak = max(peak, top)
            if kind == "overturned":
                return math.inf, impacts
            if kind != "impact":
                raise RuntimeError(f"{scene.name}: flight ended {kind} at {t}")
            if t > scene.end:
                return peak / scene.alpha, impacts
            impacts.append(t)
            if len(impacts) > MOST_IMPACTS:
                raise RuntimeError(f"{scene.name}: impacts without end at {t}")
            side, w = -side, -scene.eta * w
            rest = scene.chatter(t, side, w)
            if rest is not None:
                t += rest
                break


HEADER = ("tool,version,method,setting,case,cpu_s,work,peak_ratio,impacts,"
          "first_impacts_s")


def measure(label, folder, flights, cases=None, repeat_s=0.3):
    """Runs all cases (or every so-manieth) and prints a line for each; the
    time is the least of three runs where one takes less than `repeat_s`."""
    paths = sorted(glob.glob(os.path.join(folder, "*.txt")))
    for path in paths[::cases or 1]:
        scene = Scene(path)
        flight, work = flights(scene)
        least, runs = math.inf, 0
        while runs < (3 if least < repeat_s else 1):
            before, begin = work(), time.process_time()
            try:
                peak, impacts = run(scene, flight)
            except RuntimeError as error:
                print(error, file=sys.stderr)
                peak, impacts = math.nan, []
            least = min(least, time.process_time() - begin)
            done = work() - before
            runs += 1
        first = " ".join(repr(float(t)) for t in impacts[:10])
        print(*label, scene.name, repr(least), done, repr(float(peak)),
              len(impacts), first, sep=",", flush=True)

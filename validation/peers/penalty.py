"""A plain penalty model, as in discrete element codes: a rigid body in the
plane, at each lower corner a spring and a dashpot upright, without tension,
and across from where the corner has come down; semi-implicit Euler steps.

    penalty.py

default: steps of 0.1 ms, a tenth of critical damping. best: 20 microseconds,
critical damping, so that a corner does not bounce. A corner vibrates with a
fifth of a radian a step, which sets the stiffness. Restitution is as in
engines.py.
"""

import math

from benchmark import answer
from engines import Body, play


class Penalty:
    """Given to `play` as an engine."""

    default, best = (1e-4, 1e-3), (2e-5, 1e-6)

    def __init__(self, scene, dt, careful):
        body = self.body = Body(scene)
        self.g, self.dt = scene.g, dt
        # Compliance of the body at a corner, upright.
        soft = 1 + body.b ** 2 / body.inertia
        self.k = (0.2 / dt) ** 2 / soft
        self.c = 2 * (1.0 if careful else 0.1) * math.sqrt(self.k / soft)
        # To the right, up, and the turn to the left; then their rates.
        self.state = [body.x, body.z, -scene.start, 0.0, 0.0, 0.0]
        self.down = {}

    def step(self, across):
        x, z, turn, vx, vz, w = self.state
        k, c, h, dt = self.k, self.c, self.body.h, self.dt
        cos, sin = math.cos(turn), math.sin(turn)
        ax, az, moment = across, -self.g, 0.0
        for b in (-self.body.b, self.body.b):
            dx, dz = b * cos + h * sin, b * sin - h * cos
            if z + dz >= 0:
                self.down.pop(b, None)
                continue
            at = self.down.setdefault(b, x + dx)
            up = -k * (z + dz) - c * (vz + w * dx)
            if up > 0:
                side = -k * (x + dx - at) - c * (vx - w * dz)
                ax, az, moment = ax + side, az + up, moment + dx * up - dz * side
        vx, vz, w = vx + dt * ax, vz + dt * az, w + dt * moment / self.body.inertia
        self.state = [x + dt * vx, z + dt * vz, turn + dt * w, vx, vz, w]
        return -self.state[2]

    def slow(self, factor):
        self.state[3:] = [factor * rate for rate in self.state[3:]]


if __name__ == "__main__":
    for setting in ("default", "best"):
        answer(f"penalty-{setting}",
               lambda scene: play(Penalty, scene, setting == "best"))

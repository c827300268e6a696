"""OpenSees (OpenSeesPy) with its element RockingBC of E. Avgenakis and I. N.
Psycharis: "An integrated macroelement formulation for the dynamic response of
inelastic deformable rocking bodies", Earthquake Engineering and Structural
Dynamics 49 (2020), 1072-1094. The block is elastic and very stiff; the energy
of an impact goes into its vibration, which stiffness-proportional damping
takes out. Model and steps follow the example of its authors; restitution is
as in engines.py.

    opensees.py
"""

import math

import openseespy.opensees as ops

from benchmark import answer
from engines import Body, play


class OpenSees:
    """Newmark's average acceleration, steps of 1 ms, halved where Newton's
    method fails; a strain of 5e-6 under own weight. default: 5 % of damping in
    the first mode, as in the example; at this step a block released from half
    of alpha gains at impacts. best: 50 %, with which that block's impacts take
    Housner's share; over all scenes it is no better. Steps of 0.1 ms with 5 %
    do the same for that block, but take ten times as long."""

    default, best, strain, shortest = (1e-3, 1e-3), (1e-3, 1e-3), 5e-6, 1e-6

    def __init__(self, scene, dt, careful):
        body, self.dt, zeta = Body(scene), dt, 0.5 if careful else 0.05
        width, height = 2 * body.b, 2 * body.h
        modulus = scene.g * height / self.strain
        self.mass = mass = width * height
        ops.wipe()
        ops.model("basic", "-ndm", 2, "-ndf", 3)
        ops.node(1, 0.0, 0.0)
        ops.node(2, 0.0, body.h)
        ops.fix(1, 1, 1, 1)
        ops.mass(2, mass, mass, mass * body.inertia)
        ops.element("RockingBC", 1, 2, 1, 15, modulus, 0.0, -1e3 * modulus,
                    width, 1.0, 0.0, "-convlim", 1e-15)
        ops.timeSeries("Linear", 1)
        ops.pattern("Plain", 1, 1)
        ops.load(2, 0.0, -mass * scene.g, 0.0)
        ops.constraints("Plain")
        ops.numberer("RCM")
        ops.system("UmfPack")
        ops.test("EnergyIncr", 1e-10, 100)
        ops.algorithm("Newton")
        self.static(("LoadControl", 0.1), 10)
        ops.loadConst("-time", 0.0)
        beta = 2 * zeta / math.sqrt(ops.eigen("-fullGenLapack", 1)[0])
        if scene.start:
            ops.pattern("Plain", 2, 1)
            ops.load(2, 1.0, 0.0, 0.0)
            self.static(("DisplacementControl", 2, 3, -scene.start / 400), 400)
            ops.remove("loadPattern", 2)
            ops.setTime(0.0)
        ops.rayleigh(0.0, beta, 0.0, 0.0)
        self.begin()
        ops.timeSeries("Constant", 2)
        self.now = dt

    def begin(self):
        """Anew after each change of velocities, else the integrator keeps its
        own."""
        ops.wipeAnalysis()
        ops.constraints("Plain")
        ops.numberer("RCM")
        ops.system("UmfPack")
        ops.test("EnergyIncr", 1e-10, 100)
        ops.algorithm("Newton")
        ops.integrator("Newmark", 0.5, 0.25)
        ops.analysis("Transient")

    def static(self, integrator, steps):
        ops.integrator(*integrator)
        ops.analysis("Static")
        if ops.analyze(steps) != 0:
            raise RuntimeError("the static analysis does not converge")

    def step(self, across):
        ops.remove("loadPattern", 3)
        ops.pattern("Plain", 3, 2)
        ops.load(2, self.mass * across, 0.0, 0.0)
        left = self.dt
        while left > 1e-9 * self.dt:
            now = min(self.now, left)
            if ops.analyze(1, now) == 0:
                left, self.now = left - now, min(1.5 * now, self.dt)
            elif now > self.shortest:
                self.now = now / 2
            else:
                raise RuntimeError("Newton's method does not converge")
        return -ops.nodeDisp(2, 3)

    def slow(self, factor):
        for dof in (1, 2, 3):
            ops.setNodeVel(2, dof, factor * ops.nodeVel(2, dof), "-commit")
        self.begin()


if __name__ == "__main__":
    for setting in ("default", "best"):
        answer(f"opensees-{setting}",
               lambda scene: play(OpenSees, scene, setting == "best"))

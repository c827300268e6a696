"""Physics engines: MuJoCo, PyBullet, Pymunk and Box2D.

    engines.py NAME...

A block stands on a plane, seen from the moving ground: its acceleration turns
gravity. The block has the scene's alpha and p; friction is high, so that it
does not slide. Contacts are inelastic: the new corner sticks and the old one
leaves, so the engine's ratio of rates is that of the body's inertia, for a
rectangle 1 - 1.5 sin(alpha)^2 (Housner). A scene asks for another ratio:

- a larger one: by inertia. With m R^2 = k I about the corner, the ratio is
  1 - 2 k sin(alpha)^2, and R = k g/p^2 keeps p. A rectangle has k = 3/4;
- a smaller one: a rectangle, and at each change of side all its velocities
  times eta over Housner's ratio. No inertia does it: k = 1 has all mass in
  one point.
"""

# Each engine has the step in seconds and, over alpha, the rotation up to which
# the block counts as standing, for each setting.

import math
import sys

from benchmark import answer, from_path


class Body:
    """Mass 1: half width b, height h of its centre, inertia about it."""

    def __init__(self, scene):
        alpha, most = scene.alpha, 0.75
        k = min((1 - scene.eta) / (2 * math.sin(alpha) ** 2), most)
        R = k * scene.g / scene.p ** 2
        self.b, self.h = R * math.sin(alpha), R * math.cos(alpha)
        self.inertia = R * R * (1 / k - 1)
        self.factor = scene.eta / (1 - 2 * k * math.sin(alpha) ** 2)
        # Tilted to the right about the right corner: theta > 0.
        side, u = math.copysign(1.0, scene.start), abs(scene.start)
        self.x = side * (self.b - R * math.sin(alpha - u))
        self.z = R * math.cos(alpha - u)
        # The lowest fifth alone touches, so that it can fall beyond pi/2.
        self.low, self.high = -self.h, -0.8 * self.h


class MuJoCo:
    """default: steps of 2 ms, Euler, pyramidal cone, soft contacts.
    best: 2e-5 s, elliptic cone, contacts as hard as the step bears."""

    default, best = (2e-3, 1e-3), (2e-5, 1e-7)

    def __init__(self, scene, dt, careful):
        import mujoco
        body, self.mujoco = Body(scene), mujoco
        contact, option = f'friction="{10 if careful else 1}"', f'timestep="{dt}"'
        if careful:
            contact += f' solref="{2 * dt} 1" solimp="0.99 0.9999 1e-6"'
            option += ' cone="elliptic" impratio="100" tolerance="1e-14"'
        half = (body.high - body.low) / 2
        self.model = mujoco.MjModel.from_xml_string(f"""<mujoco>
            <option {option}/><worldbody>
            <geom type="plane" size="0 0 1" {contact}/>
            <body pos="0 0 {body.h}">
              <joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/>
              <joint type="hinge" axis="0 1 0"/>
              <inertial pos="0 0 0" mass="1" diaginertia="{body.inertia}
                {body.inertia} {body.inertia}"/>
              <geom type="box" pos="0 0 {body.low + half}"
                size="{body.b} {body.b} {half}" {contact}/>
            </body></worldbody></mujoco>""")
        self.data = mujoco.MjData(self.model)
        self.data.qpos[:] = body.x, body.z - body.h, scene.start
        self.model.opt.gravity[2] = -scene.g

    def step(self, across):
        self.model.opt.gravity[0] = across
        self.mujoco.mj_step(self.model, self.data)
        return self.data.qpos[2]

    def slow(self, factor):
        self.data.qvel *= factor


class PyBullet:
    """default: steps of 1/240 s, damping 0.04.
    best: 1e-4 s, 200 iterations, no damping, no slop."""

    default, best = (1 / 240, 1e-3), (1e-4, 1e-6)

    def __init__(self, scene, dt, careful):
        import pybullet as bullet
        body, self.bullet, self.g = Body(scene), bullet, scene.g
        if not bullet.isConnected():
            bullet.connect(bullet.DIRECT)
        bullet.resetSimulation()
        bullet.setTimeStep(dt)
        if careful:
            bullet.setPhysicsEngineParameter(
                numSolverIterations=200, contactBreakingThreshold=1e-4,
                contactSlop=0, erp=0.1, contactERP=0.1, frictionERP=0.1,
                restitutionVelocityThreshold=0, solverResidualThreshold=0)
        half = (body.high - body.low) / 2
        ground = bullet.createMultiBody(
            0, bullet.createCollisionShape(bullet.GEOM_PLANE))
        shape = bullet.createCollisionShape(
            bullet.GEOM_BOX, halfExtents=[body.b, body.h, half],
            collisionFramePosition=[0, 0, body.low + half])
        turn = bullet.getQuaternionFromEuler([0, scene.start, 0])
        self.block = bullet.createMultiBody(1, shape, basePosition=[body.x, 0, body.z],
                                            baseOrientation=turn)
        bullet.changeDynamics(ground, -1, lateralFriction=10)
        bullet.changeDynamics(self.block, -1, lateralFriction=10,
                              localInertiaDiagonal=[body.inertia] * 3)
        if careful:
            bullet.changeDynamics(self.block, -1, linearDamping=0, angularDamping=0)

    def step(self, across):
        self.bullet.setGravity(across, 0, -self.g)
        self.bullet.stepSimulation()
        _, y, _, w = self.bullet.getBasePositionAndOrientation(self.block)[1]
        return 2 * math.atan2(y, w)

    def slow(self, factor):
        linear, angular = self.bullet.getBaseVelocity(self.block)
        self.bullet.resetBaseVelocity(self.block, [x * factor for x in linear],
                                      [x * factor for x in angular])


class Pymunk:
    """default: steps of 1/60 s, 10 iterations, slop 0.1 (metres here).
    best: 2e-5 s, 50 iterations, slop 1e-7."""

    default, best = (1 / 60, 1e-3), (2e-5, 1e-6)

    def __init__(self, scene, dt, careful):
        import pymunk
        body, self.dt, self.g = Body(scene), dt, scene.g
        self.space = pymunk.Space()
        if careful:
            self.space.collision_slop, self.space.iterations = 1e-7, 50
            self.space.collision_bias = 0.9
        ground = pymunk.Segment(self.space.static_body, (-1e3, 0), (1e3, 0), 0)
        self.block = pymunk.Body(1, body.inertia)
        self.block.position, self.block.angle = (body.x, body.z), -scene.start
        b, low, high = body.b, body.low, body.high
        shape = pymunk.Poly(self.block, [(-b, low), (b, low), (b, high), (-b, high)])
        ground.friction = shape.friction = 10
        self.space.add(ground, self.block, shape)

    def step(self, across):
        self.space.gravity = across, -self.g
        self.space.step(self.dt)
        return -self.block.angle

    def slow(self, factor):
        self.block.velocity *= factor
        self.block.angular_velocity *= factor


class Box2D:
    """default: steps of 1/60 s, 8 and 3 iterations, metres; a block that has
    stood for half a second falls asleep, and a turned gravity does not wake
    it. best: 0.3 ms, 50 and 50 iterations, never asleep, lengths times 1000,
    since slop (5 mm) and skin stay. It computes in single precision: shorter
    steps gain nothing."""

    default, best = (1 / 60, 1e-3), (3e-4, 1e-4)

    def __init__(self, scene, dt, careful):
        import Box2D as box2d
        body, self.dt, self.scale = Body(scene), dt, 1000 if careful else 1
        self.turns = (50, 50) if careful else (8, 3)
        self.g, s = scene.g * self.scale, self.scale
        self.world = box2d.b2World()
        self.world.CreateStaticBody(shapes=box2d.b2EdgeShape(
            vertices=[(-1e3 * s, 0), (1e3 * s, 0)]))
        self.block = self.world.CreateDynamicBody(
            position=(body.x * s, body.z * s), angle=-scene.start,
            allowSleep=not careful)
        b, low, high = body.b * s, body.low * s, body.high * s
        self.block.CreatePolygonFixture(
            vertices=[(-b, low), (b, low), (b, high), (-b, high)],
            density=1, friction=10, restitution=0)
        self.block.massData = box2d.b2MassData(
            mass=1, center=(0, 0), I=body.inertia * s * s)

    def step(self, across):
        self.world.gravity = across * self.scale, -self.g
        self.world.Step(self.dt, *self.turns)
        return -self.block.angle

    def slow(self, factor):
        self.block.linearVelocity *= factor
        self.block.angularVelocity *= factor


def play(engine, scene, careful):
    if scene.linear:
        return "the linearized equation; an engine has the exact one"
    dt, dead = engine.best if careful else engine.default
    dead *= scene.alpha
    factor = Body(scene).factor
    world = engine(scene, dt, careful)
    t, theta = [0.0], [scene.start]
    side, quiet = math.copysign(1.0, scene.start) if scene.start else 0.0, 0.0
    for i in range(round(scene.last / dt)):
        now = world.step(-scene.g * scene.force(i * dt))
        t.append((i + 1) * dt)
        theta.append(now)
        # A change of side; again only after a hop above `dead`.
        if side and now * side < 0:
            world.slow(factor)
            side = 0.0
        if abs(now) > dead:
            side, quiet = math.copysign(1.0, now), t[-1]
        if abs(now) > scene.limit or t[-1] > max(quiet, scene.end) + 1.0:
            break
    return from_path(scene, t, theta, dead)


if __name__ == "__main__":
    for engine in (MuJoCo, PyBullet, Pymunk, Box2D):
        if engine.__name__.lower() in sys.argv[1:]:
            for setting in ("default", "best"):
                answer(f"{engine.__name__.lower()}-{setting}",
                       lambda scene: play(engine, scene, setting == "best"))

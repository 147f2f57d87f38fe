"""The yardstick's world written by hand, without any abstraction: a lower bound of a step's cost.

Four forms of one loop: with pymunk's public API alone; with the rays cast through its cffi layer
into preallocated memory; with everything at each tick through that layer, which is the limit of
Python without a compiler; and that with the loop over the rays in C.
"""

import ctypes
import math
import shutil
import subprocess
import tempfile
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pymunk
from pymunk._chipmunk_cffi import ffi, lib

from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.world.physics import COLLISION_BIAS, COLLISION_SLOP_M

RAYS, REACH, TICKS, DT = 32, 10.0, 4, 1 / 60
FORCE, TURN, PRIZE, LIMIT = 12.0, 3.0, 10.0, 300
ROBOT, TARGET = 1, 2

Step = tuple[npt.NDArray[np.float32], float, bool, bool, dict[str, Any]]


class PublicFloor:
    """A loop over pymunk's public API.

    Args:
        sim: the yardstick at an episode's beginning; its bodies are copied.
    """

    def __init__(self, sim: ControlRequestor) -> None:
        space = self.space = pymunk.Space()
        space.damping = sim.world.settings.damping
        space.collision_slop, space.collision_bias = COLLISION_SLOP_M, COLLISION_BIAS
        kinds = {"static": pymunk.Body.STATIC, "dynamic": pymunk.Body.DYNAMIC}
        bodies = {}
        for theirs in sim.world.bodies.values():
            told = theirs.description
            body = bodies[told.name] = pymunk.Body(body_type=kinds[told.kind])
            body.position, body.angle = theirs.position, theirs._pm.angle
            shape: pymunk.Shape
            if told.shape.type == "circle":
                shape = pymunk.Circle(body, told.shape.radius)
            else:
                shape = pymunk.Poly(body, told.shape.outline())
            shape.friction = told.friction
            if told.kind == "dynamic":
                shape.mass = told.mass
            if told.name == "robot":
                shape.collision_type, shape.filter = ROBOT, pymunk.ShapeFilter(group=1)
                self.others = pymunk.ShapeFilter(group=1)
            elif told.name == "target":
                shape.collision_type = TARGET
            space.add(body, shape)
        self.robot, self.target = bodies["robot"], bodies["target"]
        self.goal = tuple(self.target.position)
        self.touched = False
        space.on_collision(ROBOT, TARGET, begin=self._touch)
        self.angles = np.radians(360.0 * (np.arange(1, RAYS + 1) / (RAYS + 1) - 0.5))
        self.steps, self.distance = 0, math.nan

    def step(self, action: Any) -> Step:
        """Run one decision: four ticks, then the observation and the reward."""
        forward, turn = action.tolist()
        forward, turn = max(-1.0, min(1.0, forward)), max(-1.0, min(1.0, turn))
        robot, space = self.robot, self.space
        for _ in range(TICKS):
            robot.apply_force_at_local_point((forward * FORCE, 0.0))
            robot.angular_velocity = -turn * TURN
            space.step(DT)
        self.steps += 1
        observation = self.observe()
        reward = 0.0 if self.steps == 1 else self.before - self.distance
        if self.touched:
            reward += PRIZE
        return observation, reward, self.touched, self.steps >= LIMIT, {}

    def observe(self) -> npt.NDArray[np.float32]:
        """Return the observation: rays, bearing, distance."""
        x, y = self.robot.position
        angle = self.robot.angle
        observation = np.zeros(RAYS + 3, np.float32)
        self.cast(x, y, angle, observation)
        self.orient(x, y, angle, observation)
        return observation

    def cast(self, x: float, y: float, angle: float, out: npt.NDArray[np.float32]) -> None:
        """Write the fraction of its reach at which each ray hits; 0 without a hit."""
        turned = self.angles + angle
        xs, ys = (x + REACH * np.cos(turned)).tolist(), (y + REACH * np.sin(turned)).tolist()
        query, others, start = self.space.segment_query_first, self.others, (x, y)
        for i in range(RAYS):
            hit = query(start, (xs[i], ys[i]), 0.0, others)
            if hit is not None:
                out[i] = hit.alpha

    def orient(self, x: float, y: float, angle: float, out: npt.NDArray[np.float32]) -> None:
        """Write bearing and distance of the target."""
        dx, dy = self.goal[0] - x, self.goal[1] - y
        bearing = math.atan2(dy, dx) - angle
        self.before, self.distance = self.distance, math.hypot(dx, dy)
        out[RAYS:] = math.sin(bearing), math.cos(bearing), self.distance / DIAGONAL_M

    def _touch(self, *_: Any) -> None:
        self.touched = True


DIAGONAL_M = math.hypot(10.4, 10.4)
"""Diagonal of the arena with its walls (metres): distances are divided by it."""

HIT = np.dtype(
    [("shape", "u8"), ("px", "f8"), ("py", "f8"), ("nx", "f8"), ("ny", "f8"), ("alpha", "f8")]
)


class CffiFloor(PublicFloor):
    """The same, with the rays cast through the cffi layer."""

    def __init__(self, sim: ControlRequestor) -> None:
        super().__init__(sim)
        ends, hits = ffi.new("cpVect[]", RAYS), ffi.new("cpSegmentQueryInfo[]", RAYS)
        self.kept = ends, hits
        self.ends = np.frombuffer(ffi.buffer(ends), np.float64).reshape(RAYS, 2)
        self.alpha = np.frombuffer(ffi.buffer(hits), HIT)["alpha"]
        self.rays = [(ends[i], hits + i) for i in range(RAYS)]
        self.start = ffi.new("cpVect *")[0]
        self.filter = ffi.new("cpShapeFilter *")
        self.filter[0] = tuple(self.others)
        self.chosen = self.filter[0]
        self.turned = np.zeros(RAYS)

    def cast(self, x: float, y: float, angle: float, out: npt.NDArray[np.float32]) -> None:
        """Write the fraction of its reach at which each ray hits; 0 without a hit."""
        ends, turned = self.ends, self.turned
        np.add(self.angles, angle, out=turned)
        np.cos(turned, out=ends[:, 0])
        np.sin(turned, out=ends[:, 1])
        ends *= REACH
        ends += x, y
        self.query(self.space._space, x, y)
        out[:RAYS] = self.alpha
        out[out == 1.0] = 0.0

    def query(self, space: Any, x: float, y: float) -> None:
        """Cast all rays."""
        start, chosen, first = self.start, self.chosen, lib.cpSpaceSegmentQueryFirst
        start.x, start.y = x, y
        for end, hit in self.rays:
            first(space, start, end, 0.0, chosen, hit)


class BareFloor(CffiFloor):
    """The same, with nothing of pymunk's Python in the loop at all."""

    def __init__(self, sim: ControlRequestor) -> None:
        super().__init__(sim)
        self.space.step(1e-9)  # lets pymunk check the objects that were added
        self.push, self.nowhere = ffi.new("cpVect *")[0], ffi.new("cpVect *")[0]

    def step(self, action: Any) -> Step:
        """Run one decision: four ticks, then the observation and the reward."""
        forward, turn = action.tolist()
        forward, turn = max(-1.0, min(1.0, forward)), max(-1.0, min(1.0, turn))
        robot, space, push, nowhere = self.robot._body, self.space._space, self.push, self.nowhere
        push.x, omega = forward * FORCE, -turn * TURN
        shove, spin = lib.cpBodyApplyForceAtLocalPoint, lib.cpBodySetAngularVelocity
        tick = lib.cpSpaceStep
        for _ in range(TICKS):
            shove(robot, push, nowhere)
            spin(robot, omega)
            tick(space, DT)
        self.steps += 1
        observation = self.observe()
        reward = 0.0 if self.steps == 1 else self.before - self.distance
        if self.touched:
            reward += PRIZE
        return observation, reward, self.touched, self.steps >= LIMIT, {}

    def observe(self) -> npt.NDArray[np.float32]:
        """Return the observation: rays, bearing, distance."""
        place, angle = lib.cpBodyGetPosition(self.robot._body), lib.cpBodyGetAngle(self.robot._body)
        x, y = place.x, place.y
        observation = np.empty(RAYS + 3, np.float32)
        self.cast(x, y, angle, observation)
        self.orient(x, y, angle, observation)
        return observation


class CompiledFloor(BareFloor):
    """The same, with the loop over the rays in C; only where there is a compiler."""

    def __init__(self, sim: ControlRequestor) -> None:
        super().__init__(sim)
        self.cast_all = compiled()
        self.first = ffi.addressof(lib, "cpSpaceSegmentQueryFirst")

    def query(self, space: Any, x: float, y: float) -> None:
        """Cast all rays."""
        ends, hits = self.kept
        self.cast_all(self.first, space, x, y, ends, self.filter, hits, RAYS)


@cache
def compiled() -> Any:
    """Return the loop of floor.c as a cffi function; None where there is no compiler."""
    compiler = shutil.which("cc")
    if compiler is None:
        return None
    source = Path(__file__).with_name("floor.c")
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder) / "floor.so"
        command = [compiler, "-std=c11", "-O2", "-shared", "-fPIC", "-o", str(made), str(source)]
        subprocess.run(command, check=True)
        address = ctypes.cast(ctypes.CDLL(str(made)).cast, ctypes.c_void_p).value
    form = "void (*)(void *, void *, double, double, void *, void *, void *, int)"
    return ffi.cast(form, address)

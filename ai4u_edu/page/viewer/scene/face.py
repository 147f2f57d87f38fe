"""The solids of a robot and how they move on it, and a target's rings. Body frame, metres."""

import math

import numpy as np
from viser import BatchedMeshHandle

from ai4u_edu.page.viewer.scene.geometry import (
    Mesh,
    cap,
    circle,
    cylinder,
    cylinder_bars,
    dome,
    flat_mesh,
    join_meshes,
    prism,
)
from ai4u_edu.page.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.snapshot.marks import (
    DARK,
    EYES,
    NOSE,
    PUPIL,
    PUPIL_SHIFT,
    RING,
    RING_CENTRE,
    TREAD,
    TREAD_BAR_RAD,
    TREAD_BARS,
    RobotParts,
    Wheel,
)

_BASE_HEIGHT = 0.22
"""Height of a robot's base, as a share of the robot's."""
_SHELL_TOP = 0.6
"""Size of the flat part of the shell's top, as a share of the shell's."""
_EYE_DEPTH = 0.3
"""Height of the part of an eye that is visible, in its body's radii."""
_NOSE_DEPTH = 0.3
"""Thickness of the nose, in its body's radii."""

EYE_RISE = 0.1
"""Height of the eyes above a robot's top, in its radii."""
MAX_TREAD_STEP = 0.4
"""Largest turn of a wheel in a picture, as a share of the angle between two of its bars."""


def shell(parts: RobotParts, height: float) -> Mesh:
    """Return a robot's coloured part: rounded, and narrower than its base where its wheels are."""
    return dome(parts.shell, _BASE_HEIGHT * height, height, _SHELL_TOP)


def chassis(parts: RobotParts, height: float) -> Mesh:
    """Return a robot's base, which has the outline of its body, and its tyres."""
    base = prism(parts.outline, _BASE_HEIGHT * height, 0.0)
    tyres = [
        cylinder(wheel.radius, wheel.width).moved(wheel.x, wheel.y, wheel.radius)
        for wheel in parts.wheels
    ]
    return join_meshes([base, *tyres])


def treads(wheel: Wheel) -> Mesh:
    """Return the bars on a tyre, around the middle of the wheel."""
    return cylinder_bars(1.02 * wheel.radius, wheel.width, TREAD_BARS, TREAD_BAR_RAD)


def face(radius: float, z: float) -> Mesh:
    """Return the light parts of an agent's face: a nose that points ahead (+x), whites of the eyes.

    Args:
        radius: radius of the disc on which the face is drawn.
        z: height of that disc.
    """
    low = max(z - _EYE_DEPTH * radius, 0.0)
    eyes = [
        dome(circle(r * radius, corners=20), low, z, 0.6).moved(x * radius, y * radius)
        for x, y, r in EYES
    ]
    depth = min(_NOSE_DEPTH * radius, z)
    nose = prism(radius * np.array(NOSE), depth, 0.0).moved(0, 0, z - depth)
    return join_meshes([nose, *eyes])


def pupils(radius: float, top: float) -> Mesh:
    """Return the dark parts of an agent's face, on a body with a top (m): pupils in their eyes."""
    z = top + (EYE_RISE + 0.01) * radius
    eyes = [circle(PUPIL * radius, x * radius, y * radius, 16) for x, y, _ in EYES]
    return join_meshes([cap(outline, z) for outline in eyes])


def rings(radius: float, z: float) -> Mesh:
    """Return a target's mark, a ring around a disc, which tells targets apart without colour."""
    outer, inner = RING
    ring = flat_mesh(circle(outer * radius), circle(inner * radius)).moved(0, 0, z)
    return join_meshes([ring, cap(circle(RING_CENTRE * radius), z)])


class MovingParts:
    """The parts that move on a robot whose body is a node: wheels that roll, pupils that look.

    Args:
        drawer: adds the parts below the body's node.
        parts: the robot's parts.
        radius: half the robot's width (m).
        top: height of its top (m).
    """

    def __init__(self, drawer: MeshDrawer, parts: RobotParts, radius: float, top: float) -> None:
        self._shift = PUPIL_SHIFT * radius
        self._pupils = drawer.batch("pupils", pupils(radius, top), [DARK])
        self._pupils.batched_scales = np.ones(1, np.float32)
        self._direction: float | None = None
        self._wheels = parts.wheels
        self._rolled = [0.0] * len(parts.wheels)
        """Angle of each wheel (rad)."""
        self._pose: tuple[float, float, float] | None = None
        """x, y (m) and heading (rad) in the last call."""
        self._treads: BatchedMeshHandle | None = None
        if parts.wheels:
            colours = [TREAD] * len(parts.wheels)
            self._treads = drawer.batch("treads", treads(parts.wheels[0]), colours)
            self.resize(1.0)

    def resize(self, scale: float) -> None:
        """Draw the parts at a share of their size, as the body that they are on: it may fall."""
        self._pupils.batched_scales = np.full(1, scale, np.float32)
        if self._treads is not None:
            places = [(wheel.x, wheel.y, wheel.radius) for wheel in self._wheels]
            self._treads.batched_positions = scale * np.array(places, np.float32)
            self._treads.batched_scales = np.full(len(places), scale, np.float32)

    def move(self, pose: tuple[float, float, float], direction: float) -> None:
        """Roll the wheels by the way since the last call, and turn the pupils.

        Args:
            pose: x, y (m) and heading (rad) of the body.
            direction: in which its eyes look, in the body's frame (rad).
        """
        if direction != self._direction:
            self._direction = direction
            x, y = self._shift * math.cos(direction), self._shift * math.sin(direction)
            self._pupils.position = (x, y, 0.0)
        before, self._pose = self._pose, pose
        if before is None or before == pose or self._treads is None:
            return
        (x, y, heading), (old_x, old_y, old_heading) = pose, before
        ahead = (x - old_x) * math.cos(heading) + (y - old_y) * math.sin(heading)
        turned = math.remainder(heading - old_heading, math.tau)
        # a wheel that turns by half the angle between two bars seems to turn back
        most = MAX_TREAD_STEP * math.tau / TREAD_BARS
        for number, wheel in enumerate(self._wheels):
            angle = (ahead - turned * wheel.y) / wheel.radius
            self._rolled[number] += max(-most, min(most, angle))
        self._treads.batched_wxyzs = np.array(
            [(math.cos(angle / 2), 0.0, math.sin(angle / 2), 0.0) for angle in self._rolled],
            np.float32,
        )

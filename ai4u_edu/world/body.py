"""A body that lives in a world: what can be asked of it, and how it is moved."""

import math
from typing import TYPE_CHECKING, Any

import pymunk

from ai4u_edu.errors import WorldError
from ai4u_edu.world.descriptions import BodyDescription
from ai4u_edu.world.grip import held_by, hold, let_go

if TYPE_CHECKING:
    from ai4u_edu.world.world import World

TAU = 2 * math.pi


class BodyView:
    """A body as a sensor or a reward sees it: to be asked, not to be moved.

    World frame: x right, y up on the screen, z towards the viewer; metres, seconds, radians;
    heading 0 looks along +x and grows counter-clockwise.
    """

    def __init__(self, world: "World", description: BodyDescription) -> None:
        self._world = world
        self.description = description
        self.name = description.name
        self.tags = description.tags
        self.height = description.height
        self.z = 0.0
        """Height of the underside above 0, metres."""
        self.vz = 0.0
        """Upward speed, m/s."""
        self.on_ground = True
        """Whether it stands on a floor or on another body."""
        self.fallen = False
        """Whether it fell below the world's fall threshold and is out."""
        self._pm = pymunk.Body()
        self._shapes: tuple[pymunk.Shape, ...] = ()

    @property
    def moves(self) -> bool:
        """Whether forces, and falling, can move it."""
        return self.description.kind == "dynamic"

    @property
    def position(self) -> tuple[float, float]:
        """Centre (x, y) in metres."""
        return self._pm.position

    @property
    def heading(self) -> float:
        """Radians, in [-pi, pi)."""
        return (self._pm.angle + math.pi) % TAU - math.pi

    @property
    def velocity(self) -> tuple[float, float]:
        """(vx, vy) in the world's frame, m/s."""
        return self._pm.velocity

    @property
    def angular_velocity(self) -> float:
        """Radians per second, counter-clockwise positive."""
        return self._pm.angular_velocity

    @property
    def pose(self) -> tuple[float, float, float, float]:
        """(x, y, z, heading)."""
        x, y = self._pm.position
        return x, y, self.z, self.heading

    @property
    def held(self) -> "BodyView | None":
        """The body that this one holds."""
        return held_by(self._world, self)

    def distance(self, other: "BodyView") -> float:
        """Metres between the two centres, height included."""
        x, y = self._pm.position
        ox, oy = other._pm.position
        return math.hypot(ox - x, oy - y, other.z - self.z)

    def bearing(self, other: "BodyView") -> float:
        """Where the other one is, seen from here: 0 ahead, positive to the left, radians."""
        x, y = self._pm.position
        ox, oy = other._pm.position
        return (math.atan2(oy - y, ox - x) - self._pm.angle + math.pi) % TAU - math.pi

    def to_local(self, x: float, y: float) -> tuple[float, float]:
        """A point of the world in this body's frame: (forward, left) in metres."""
        cx, cy = self._pm.position
        cos, sin = math.cos(self._pm.angle), math.sin(self._pm.angle)
        dx, dy = x - cx, y - cy
        return cos * dx + sin * dy, cos * dy - sin * dx

    def __repr__(self) -> str:
        x, y = self._pm.position
        return f"<{type(self).__name__} {self.name!r} at ({x:.2f}, {y:.2f}, {self.z:.2f})>"


class Body(BodyView):
    """A body that can be moved; actuators get it in this form."""

    def set_velocity(self, vx: float, vy: float) -> None:
        """Sets the velocity in the world's frame, m/s."""
        self._check("velocity", (vx, vy))
        self._pm.velocity = vx, vy

    def set_angular_velocity(self, omega: float) -> None:
        """Sets the turning speed, radians per second, counter-clockwise positive."""
        self._check("angular velocity", (omega,))
        self._pm.angular_velocity = omega

    def apply_force(self, forward: float, left: float) -> None:
        """Pushes at the centre for one tick; newtons, in the body's own frame."""
        self._check("force", (forward, left))
        self._pm.apply_force_at_local_point((forward, left))

    def jump(self, speed: float) -> None:
        """Sets an upward speed in m/s and leaves the ground."""
        self._check("jump speed", (speed,))
        self._world._height.launch(self, speed)

    def hold(self, other: BodyView) -> None:
        """Fixes another body to this one, where it is now, until :meth:`release`.

        A fall, a new place for one of the two or a reset ends it too.

        Raises:
            WorldError: this one holds something already, or the other one can't move.
        """
        hold(self._world, self, other)

    def release(self) -> None:
        """Lets go of what this body holds."""
        let_go(self._world, self)

    def move_to(
        self, x: float, y: float, *, heading: float | None = None, z: float | None = None
    ) -> None:
        """Puts the body somewhere else, at rest.

        Args:
            x: metres.
            y: metres.
            heading: radians; left out: as it was.
            z: metres; left out: on the highest floor there.
        """
        angle = self._pm.angle if heading is None else heading
        self._check("place", (x, y, angle, z or 0.0))
        self._world._place(self, x, y, angle, z)

    def _check(self, what: str, numbers: tuple[Any, ...]) -> None:
        # one number that is not finite would silently turn every body it touches into NaN
        if not math.isfinite(sum(numbers)):
            raise WorldError(
                f"{what} of body {self.name!r}: expected finite numbers, got {numbers}"
            )

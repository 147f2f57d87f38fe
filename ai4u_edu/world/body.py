"""Bodies of a world: read access for sensors and rewards, and the methods that move them."""

import math
from typing import Any, NoReturn, Protocol

import pymunk

from ai4u_edu.base.errors import WorldError
from ai4u_edu.locale import gettext as _
from ai4u_edu.world.descriptions import BodyDescription
from ai4u_edu.world.native import apply_force, motion_of

_TAU = 2 * math.pi


_Place = tuple[float, float]


class _Physics(Protocol):
    """Protocol of what moves and joins bodies (Physics does)."""

    def launch(self, body: "Body", speed: float) -> None:
        """Give a body an upward speed, m/s; it leaves the ground."""

    def place(self, body: "Body", x: float, y: float, angle: float, z: float | None) -> None:
        """Put a body somewhere, at rest."""

    def drop(self, body: "Body") -> None:
        """Take a body out of the space until it is placed again."""

    def hold(self, holder: "BodyView", other: "BodyView") -> None:
        """Fix a body to a holder."""

    def held_by(self, holder: "BodyView") -> "BodyView | None":
        """Return the body that a holder holds."""

    def release(self, holder: "BodyView") -> None:
        """Release the body that a holder holds."""


class _Ink(Protocol):
    """Protocol of the ink on the floors (Ink is one)."""

    def draw(self, start: _Place, end: _Place, z: float, width: float, code: int) -> None:
        """Draw a straight stroke."""


class _Messages(Protocol):
    """Protocol of what bodies say to each other (Messages is one)."""

    def say(self, speaker: "BodyView", numbers: tuple[float, ...], reach: float) -> None:
        """Say something."""


class _World(Protocol):
    """Protocol of the world that a body is in (World is one)."""

    @property
    def _physics(self) -> _Physics: ...

    @property
    def ink(self) -> _Ink: ...

    @property
    def messages(self) -> _Messages: ...

    def put_back(self, name: str) -> None:
        """Put a body back to its described place."""


class BodyView:
    """A body as sensors and reward functions see it: read-only.

    World frame: x right, y up on the screen, z towards the viewer; metres, seconds, radians;
    heading 0 looks along +x and grows counter-clockwise.
    """

    def __init__(self, world: _World, description: BodyDescription) -> None:
        self._world = world
        self.description = description
        """The body as described by a scene file or when it was added."""
        self.sampled = description
        """The description with its random values sampled for this episode."""
        self.name = description.name
        self.tags = description.tags
        self.height = description.height
        self.z = 0.0
        """Height of the underside above 0, metres."""
        self.vz = 0.0
        """Upward speed, m/s."""
        self.on_ground = True
        """True if it stands on a floor or on another body."""
        self.fallen = False
        """True if it is out of the world: it fell below the fall threshold, or was taken out."""
        self._pm = pymunk.Body()
        self._shapes: tuple[pymunk.Shape, ...] = ()

    @property
    def _pm(self) -> pymunk.Body:
        return self._pymunk

    @_pm.setter
    def _pm(self, pm: pymunk.Body) -> None:
        self._pymunk = pm
        self._centre, self._angle, self._velocity, self._spin = motion_of(pm)

    @property
    def moves(self) -> bool:
        """True if forces and falling can move it."""
        return self.description.kind == "dynamic"

    @property
    def position(self) -> tuple[float, float]:
        """Centre (x, y) in metres."""
        centre = self._centre
        return centre.x, centre.y

    @property
    def heading(self) -> float:
        """Heading in radians, in [-pi, pi)."""
        angle: float = self._angle[0]
        return (angle + math.pi) % _TAU - math.pi

    @property
    def velocity(self) -> tuple[float, float]:
        """Velocity (vx, vy) in the world's frame, m/s."""
        velocity = self._velocity
        return velocity.x, velocity.y

    @property
    def angular_velocity(self) -> float:
        """Turning speed in radians per second, counter-clockwise positive."""
        spin: float = self._spin[0]
        return spin

    @property
    def pose(self) -> tuple[float, float, float, float]:
        """Pose (x, y, z, heading) in metres and radians."""
        centre = self._centre
        return centre.x, centre.y, self.z, self.heading

    @property
    def is_finite(self) -> bool:
        """False once the physics went out of range: place or angle is infinite or no number."""
        centre = self._centre
        return math.isfinite(centre.x + centre.y + self._angle[0])

    @property
    def held(self) -> "BodyView | None":
        """The body that this one holds; None if it holds none."""
        return self._world._physics.held_by(self)

    def distance(self, other: "BodyView") -> float:
        """Return the metres between the two centres, height included."""
        here, there = self._centre, other._centre
        return math.hypot(there.x - here.x, there.y - here.y, other.z - self.z)

    def bearing(self, other: "BodyView") -> float:
        """Return the direction of another body: radians, 0 ahead, positive to the left."""
        here, there = self._centre, other._centre
        turn: float = math.atan2(there.y - here.y, there.x - here.x) - self._angle[0]
        return (turn + math.pi) % _TAU - math.pi

    def to_local(self, x: float, y: float) -> tuple[float, float]:
        """Return a point of the world in this body's frame: (forward, left) in metres."""
        centre, angle = self._centre, self._angle[0]
        cos, sin = math.cos(angle), math.sin(angle)
        dx, dy = x - centre.x, y - centre.y
        return cos * dx + sin * dy, cos * dy - sin * dx

    def __repr__(self) -> str:
        x, y = self.position
        return f"<{type(self).__name__} {self.name!r} at ({x:.2f}, {y:.2f}, {self.z:.2f})>"


class Body(BodyView):
    """A body with the methods that move it; actuators get it in this form."""

    def set_velocity(self, vx: float, vy: float) -> None:
        """Set the velocity in the world's frame, m/s."""
        if not math.isfinite(vx + vy):
            self._refuse(_("velocity"), (vx, vy))
        velocity = self._velocity
        velocity.x, velocity.y = vx, vy

    def set_angular_velocity(self, omega: float) -> None:
        """Set the turning speed, radians per second, counter-clockwise positive."""
        if not math.isfinite(omega):
            self._refuse(_("angular velocity"), (omega,))
        self._spin[0] = omega

    def apply_force(self, forward: float, left: float) -> None:
        """Push at the centre for one tick; newtons, in the body's own frame."""
        if not math.isfinite(forward + left):
            self._refuse(_("force"), (forward, left))
        apply_force(self._pymunk, forward, left)

    def jump(self, speed: float) -> None:
        """Leave the ground with an upward speed in m/s; there a downward one has no effect."""
        if not math.isfinite(speed):
            self._refuse(_("jump speed"), (speed,))
        if speed > 0.0 or not self.on_ground:  # many actuators call this at each tick
            self._world._physics.launch(self, speed)

    def hold(self, other: BodyView) -> None:
        """Fix another body to this one at its present place, until :meth:`release`.

        A fall, a new place for one of the two and a reset release it too.

        Raises:
            WorldError: this body holds one already, or the other one can't move.
        """
        self._world._physics.hold(self, other)

    def release(self) -> None:
        """Release the body that this one holds."""
        self._world._physics.release(self)

    def move_to(
        self, x: float, y: float, *, heading: float | None = None, z: float | None = None
    ) -> None:
        """Put the body somewhere else, at rest.

        Args:
            x: metres.
            y: metres.
            heading: radians; by default unchanged.
            z: metres; by default on the highest floor there.
        """
        angle = self._pm.angle if heading is None else heading
        if not math.isfinite(x + y + angle + (z or 0.0)):
            self._refuse("place", (x, y, angle, z or 0.0))
        self._world._physics.place(self, x, y, angle, z)

    def draw(self, start: _Place, end: _Place, *, width: float, code: int) -> None:
        """Draw a stroke of ink from one point to another, on the floor that the body stands on.

        Args:
            start: metres.
            end: metres.
            width: metres.
            code: of the colour (:func:`~ai4u_edu.world.ink.ink_code`); 0 wipes ink away.
        """
        if self.on_ground and not self.fallen:
            self._world.ink.draw(start, end, self.z, width, code)

    def say(self, numbers: tuple[float, ...], reach: float) -> None:
        """Say some numbers to all bodies within reach (metres)."""
        self._world.messages.say(self, numbers, reach)

    def leave(self) -> None:
        """Take the body out of the world, as if it had fallen out, until it is put somewhere."""
        if not self.fallen:
            self._world._physics.drop(self)

    def come_back(self) -> None:
        """Put the body back to its described place; random values are sampled again.

        Raises:
            WorldError: there is no room for it; then nothing changes.
        """
        self._world.put_back(self.name)

    def _refuse(self, what: str, numbers: tuple[Any, ...]) -> NoReturn:
        # a number that is not finite would silently spread to every body in contact
        raise WorldError(
            _(
                "{what} of body {name!r}: expected finite numbers, got {numbers}",
                what=what,
                name=self.name,
                numbers=str(numbers),
            )
        )

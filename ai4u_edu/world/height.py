"""Vertical motion: floors, falling, jumping, landing, passing over and under.

pymunk's space is flat; z is computed here. A body on the ground stands on the floor or the body
under its centre. Over nothing it falls; between take-off and landing it follows the exact parabola,
tick by tick, and keeps its speed in the plane.
"""

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import pymunk

from ai4u_edu.world.descriptions import FloorDescription
from ai4u_edu.world.ground import SAME_HEIGHT_M, Ground
from ai4u_edu.world.native import MOTION

if TYPE_CHECKING:
    from ai4u_edu.world.body import Body
    from ai4u_edu.world.physics import Physics
    from ai4u_edu.world.region import Region

_position = MOTION.position  # looked up once: it is called for each mover at each tick


class Height:
    """The vertical motion of a world's bodies.

    Attributes:
        ground: function that returns the highest floor at a place; see :meth:`Ground.at`.
        movers: bodies to check at each tick: all that can move where there are floors to fall
            off, else only those in the air or on top of another body. Where it is empty, the
            world's tick does not call :meth:`step`.
    """

    def __init__(self, physics: "Physics") -> None:
        self._physics = physics
        self._ground = Ground()
        self.ground = self._ground.at
        self.movers: dict[Body, None] = {}

    def rebuild(self, floors: "Iterable[tuple[FloorDescription, Region]]") -> None:
        """Start over with these floors and no movers."""
        self._ground = Ground((floor.top, region) for floor, region in floors)
        self.ground = self._ground.at
        self.movers.clear()

    def set_height(self, body: "Body", z: float | None) -> None:
        """Set the height of a body that was put somewhere; None stands for the floor there."""
        x, y = body.position
        body.z = (self.ground(x, y) or 0.0) if z is None else z
        body.vz = 0.0

    def update_support(self, body: "Body") -> None:
        """Find out whether a body that was put somewhere stands there or is in the air."""
        self._set_on_ground(body, not body.moves or self._is_supported(body))

    def forget(self, body: "Body") -> None:
        """Stop moving a body that was taken out of the space."""
        self.movers.pop(body, None)

    def launch(self, body: "Body", speed: float) -> None:
        """Give a body an upward speed; on the ground, a downward one has no effect."""
        if body.fallen or not body.moves:
            return
        if body.on_ground:
            if speed <= 0.0:
                return
            self._set_on_ground(body, False)
        body.vz = speed

    def step(self, dt: float) -> None:
        """Move all movers vertically by one tick, after the step of the space."""
        for body in tuple(self.movers):
            if body.on_ground:
                if self._is_supported(body):
                    continue
                self._set_on_ground(body, False)
            self._fly(body, dt)

    def _set_on_ground(self, body: "Body", on_ground: bool) -> None:
        """Put a body on the ground or into the air, and among the movers if necessary."""
        body.on_ground = on_ground
        moved_by = pymunk.Body.update_velocity if on_ground else _update_velocity_in_air
        if body._pm.velocity_func is not moved_by:
            body._pm.velocity_func = moved_by
        if body.moves and (self._ground.floors or body.z != 0.0 or not on_ground):
            self.movers[body] = None
        else:
            self.movers.pop(body, None)
        self._physics.contacts.classify(body)

    def _fly(self, body: "Body", dt: float) -> None:
        settings = self._physics.settings
        gravity = settings.gravity
        before, z = body.z, body.z + body.vz * dt - 0.5 * gravity * dt * dt
        body.vz -= gravity * dt
        if z > before:
            body.z = self._below_ceiling(body, before, z)
            return
        support = self._highest_support(body, before)
        if support is not None and z <= support:
            body.z, body.vz = support, 0.0
            self._set_on_ground(body, True)
            return
        body.z = z
        if z < settings.fall_threshold:
            self._physics.drop(body)

    def _is_supported(self, body: "Body") -> bool:
        """Return True if a floor or another body is right below a body's centre."""
        z, place = body.z, _position(body._handle)
        return self.ground(place.x, place.y, z) == z or self._highest_support(body, z) == z

    def _highest_support(self, body: "Body", below: float) -> float | None:
        """Return the highest floor or body top under a centre that is not above ``below``."""
        place = body.position
        best = self.ground(*place, below)
        for hit in self._physics.space.point_query(place, 0.0, body._shapes[0].filter):
            other = self._physics.owners[hit.shape]
            top = other.z + other.height
            if top <= below + SAME_HEIGHT_M and (best is None or top > best):
                best = top
        return best

    def _below_ceiling(self, body: "Body", before: float, z: float) -> float:
        """Return the height at which a rising body is stopped by a body above it."""
        for other in self._physics.contacts.passes(body):
            room = other.z - body.height
            if before <= room + SAME_HEIGHT_M and z > room:
                z, body.vz = room, 0.0
        return z


def _update_velocity_in_air(body: pymunk.Body, gravity: Any, _damping: float, dt: float) -> None:
    # damping stands for friction with the ground, which there is none of in the air
    pymunk.Body.update_velocity(body, gravity, 1.0, dt)

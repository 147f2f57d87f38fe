"""Height in a plane: floors, falling, jumping, landing, passing over and under.

The physics is flat; z is kept here. A body on the ground stands on what is under its centre: a
floor, or the top of another body. Over nothing it falls; between take-off and landing it follows
the exact parabola, tick by tick, and keeps its speed in the plane.
"""

from typing import TYPE_CHECKING, Any

import pymunk

from ai4u_edu.world.ground import SAME, Ground
from ai4u_edu.world.native import MOTION

if TYPE_CHECKING:
    from ai4u_edu.world.body import Body
    from ai4u_edu.world.world import World

_position = MOTION.position  # each mover is asked at each tick


class Height:
    """The vertical part of a world.

    ``movers`` holds the bodies that need a look each tick: all that can move where there are
    floors to fall off, else only those in the air or on top of something. Where it is empty, the
    world's tick does not come here at all.
    """

    def __init__(self, world: "World") -> None:
        self._world = world
        self._ground = Ground()
        self.ground = self._ground.at
        """The highest floor at a place; see :meth:`Ground.at`."""
        self.movers: dict[Body, None] = {}

    def rebuild(self) -> None:
        """Starts over with the world's floors as they are now."""
        self._ground = Ground((floor.top, region) for floor, region in self._world._floor_regions())
        self.ground = self._ground.at
        self.movers.clear()

    def settle(self, body: "Body", z: float | None) -> None:
        """Gives a body that was put somewhere its height: on the floor there, or the given one."""
        x, y = body.position
        body.z = (self.ground(x, y) or 0.0) if z is None else z
        body.vz = 0.0

    def rest(self, body: "Body") -> None:
        """Finds out whether a body that was put somewhere stands there, or is in the air."""
        self._mark(body, not body.moves or self._stands(body))

    def forget(self, body: "Body") -> None:
        """Looks no more at a body that is not in the physics."""
        self.movers.pop(body, None)

    def launch(self, body: "Body", speed: float) -> None:
        """Gives a body an upward speed; on the ground one that points down does nothing."""
        if body.fallen or not body.moves:
            return
        if body.on_ground:
            if speed <= 0.0:
                return
            self._mark(body, False)
        body.vz = speed

    def step(self, dt: float) -> None:
        """Moves everything vertically by one tick; called after the plane's own step."""
        for body in tuple(self.movers):
            if body.on_ground:
                if self._stands(body):
                    continue
                self._mark(body, False)
            self._fly_on(body, dt)

    def _mark(self, body: "Body", on_ground: bool) -> None:
        """Puts a body on the ground or into the air, and among those to look at if need be."""
        body.on_ground = on_ground
        moved_by = pymunk.Body.update_velocity if on_ground else _fly
        if body._pm.velocity_func is not moved_by:
            body._pm.velocity_func = moved_by
        if body.moves and (self._ground.floors or body.z != 0.0 or not on_ground):
            self.movers[body] = None
        else:
            self.movers.pop(body, None)
        self._world.contacts.classify(body)

    def _fly_on(self, body: "Body", dt: float) -> None:
        gravity = self._world.settings.gravity
        before, z = body.z, body.z + body.vz * dt - 0.5 * gravity * dt * dt
        body.vz -= gravity * dt
        if z > before:
            body.z = self._below_ceiling(body, before, z)
            return
        support = self._support(body, before)
        if support is not None and z <= support:
            body.z, body.vz = support, 0.0
            self._mark(body, True)
            return
        body.z = z
        if z < self._world.settings.fall_threshold:
            self._world._drop(body)

    def _stands(self, body: "Body") -> bool:
        """Whether something bears a body right below its centre; the floor is asked first."""
        z, place = body.z, _position(body._handle)
        return self.ground(place.x, place.y, z) == z or self._support(body, z) == z

    def _support(self, body: "Body", below: float) -> float | None:
        """The highest top under a centre, of floors and bodies, that is not above ``below``."""
        place = body.position
        best = self.ground(*place, below)
        for hit in self._world.space.point_query(place, 0.0, body._shapes[0].filter):
            other = self._world.owners[hit.shape]
            top = other.z + other.height
            if top <= below + SAME and (best is None or top > best):
                best = top
        return best

    def _below_ceiling(self, body: "Body", before: float, z: float) -> float:
        """Where a rising body stops under what hangs above it."""
        for other in self._world.contacts.passes(body):
            room = other.z - body.height
            if before <= room + SAME and z > room:
                z, body.vz = room, 0.0
        return z


def _fly(body: pymunk.Body, gravity: Any, _damping: float, dt: float) -> None:
    # damping is the ground's friction: in the air there is none
    pymunk.Body.update_velocity(body, gravity, 1.0, dt)

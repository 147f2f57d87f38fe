"""The bodies of a world in pymunk's space, and their vertical motion.

pymunk's space is flat; z is computed here. A body on the ground stands on the floor or the body
under its centre. Over nothing it falls; between take-off and landing it follows the exact parabola,
tick by tick, and keeps its speed in the plane.
"""

from collections.abc import Iterable
from typing import Any

import pymunk

from ai4u_edu.base.errors import WorldError
from ai4u_edu.locale import gettext as _
from ai4u_edu.world.body import Body, BodyView
from ai4u_edu.world.build import build
from ai4u_edu.world.contacts import Contacts
from ai4u_edu.world.descriptions import FloorDescription, WorldSettings
from ai4u_edu.world.native import release_space, step_function
from ai4u_edu.world.region import SAME_HEIGHT_M, Ground, Inside, Region

COLLISION_SLOP_M = 0.01
"""Depth (metres) to which bodies may overlap at rest; some of it keeps contacts steady."""

COLLISION_BIAS = 0.2**60
"""Share of a deeper overlap that is left after a second; after 1/60 s it is a fifth.

A velocity that is set at each tick drives a body into a wall for one tick, before the wall can
answer; with pymunk's own bias that adds up to half a metre at 3 m/s.
"""


class Physics:
    """The space of an episode and what belongs to it.

    Attributes:
        space: pymunk's space, a new one for each episode.
        owners: the body of each of its shapes.
        contacts: contacts between bodies.
        height: vertical motion.
        step: function that moves the space by one tick, in the plane only.
        generation: grows whenever the space is replaced or its contents change.
    """

    def __init__(self, settings: WorldSettings) -> None:
        self.settings = settings
        self.dt = 1.0 / settings.ticks_per_second
        self.space = pymunk.Space()
        self.owners: dict[pymunk.Shape, Body] = {}
        self.contacts = Contacts()
        self.height = Height(self)
        self.generation = 0
        self._groups = 0
        self.start_over()

    def start_over(self) -> None:
        """Replace the space by an empty one: a space that is only cleared keeps old contacts."""
        release_space(self.space)
        self.space = pymunk.Space()
        self.space.damping = self.settings.damping
        self.space.collision_slop, self.space.collision_bias = COLLISION_SLOP_M, COLLISION_BIAS
        self.owners = {}
        self.step = step_function(self.space, self.dt)
        self.contacts.attach(self.space, self.owners)
        self._groups = 0

    def add(self, body: Body) -> None:
        """Build a body's parts as sampled for this episode and add them to the space."""
        self._groups += 1
        build(body, self.space, self._groups)
        body.fallen = False
        for shape in body._shapes:
            self.owners[shape] = body
        self.generation += 1

    def remove(self, body: Body) -> None:
        """Take a body's parts out of the space for good."""
        self._detach(body)
        if not body.fallen:
            self.space.remove(body._pm, *body._shapes)
        self.contacts.forget(body)
        for shape in body._shapes:
            del self.owners[shape]
        self.height.forget(body)
        self.generation += 1

    def place(self, body: Body, x: float, y: float, angle: float, z: float | None) -> None:
        """Put a body somewhere, at rest; also one that has fallen out of the world.

        Args:
            body: the body to move.
            x: metres.
            y: metres.
            angle: radians.
            z: height of the underside, metres; None for the highest floor there.
        """
        if body.fallen:
            self.space.add(body._pm, *body._shapes)
            body.fallen = False
        self._detach(body)
        body._pm.position, body._pm.angle = (x, y), angle
        body._pm.velocity, body._pm.angular_velocity = (0.0, 0.0), 0.0
        body._pm.force, body._pm.torque = (0.0, 0.0), 0.0
        self.space.reindex_shapes_for_body(body._pm)
        before = body.z
        self.height.set_height(body, z)
        self.height.update_support(body)
        if body.z != before and not body.moves:
            self.generation += 1  # rays look up the height of a body that can't fall only once

    def drop(self, body: Body) -> None:
        """Take a body out of the space until it is placed again; its name stays known."""
        body.fallen = True
        self._detach(body)
        self.space.remove(body._pm, *body._shapes)
        self.contacts.forget(body)
        body._pm.velocity, body._pm.angular_velocity, body.vz = (0.0, 0.0), 0.0, 0.0
        self.height.forget(body)

    def launch(self, body: Body, speed: float) -> None:
        """Give a body an upward speed (m/s); it leaves the ground."""
        self.height.launch(body, speed)

    def hold(self, holder: BodyView, other: BodyView) -> None:
        """Fix a body to a holder at its present place and angle, by two joints.

        Raises:
            WorldError: the holder holds a body already, or the other one can't be held.
        """
        held = self.held_by(holder)
        if held is not None:
            raise WorldError(
                _(
                    "body {name!r} can't hold {wanted!r}: it holds {held!r}; release that first",
                    name=holder.name,
                    wanted=other.name,
                    held=held.name,
                )
            )
        if other is holder or not other.moves or other.fallen or holder.fallen:
            raise WorldError(
                _(
                    "body {name!r} can't hold {wanted!r}: expected another body, one that can move "
                    "and has not fallen",
                    name=holder.name,
                    wanted=other.name,
                )
            )
        a, b = holder._pm, other._pm
        joints = (
            pymunk.PivotJoint(a, b, b.position),
            pymunk.GearJoint(a, b, b.angle - a.angle, 1.0),
        )
        for joint in joints:
            joint.error_bias = self.space.collision_bias  # as stiff as a contact with a wall
        self.space.add(*joints)

    def held_by(self, holder: BodyView) -> Body | None:
        """Return the body that a body holds; None if it holds none."""
        for joint in self.space.constraints:
            if joint.a is holder._pm:
                return self.owners[next(iter(joint.b.shapes))]
        return None

    def release(self, holder: BodyView) -> None:
        """Release the body that a body holds."""
        self._remove_joints([each for each in self.space.constraints if each.a is holder._pm])

    def _detach(self, body: BodyView) -> None:
        """Release what a body holds, and the body from whatever holds it."""
        joints = self.space.constraints
        self._remove_joints([each for each in joints if body._pm in (each.a, each.b)])

    def _remove_joints(self, joints: list[pymunk.Constraint]) -> None:
        if joints:
            self.space.remove(*joints)


class Height:
    """The vertical motion of a world's bodies.

    Attributes:
        ground: function that returns the highest floor at a place; see :meth:`Ground.at`.
        movers: bodies to check at each tick: all that can move where there are floors to fall
            off, else only those in the air or on top of another body. Where it is empty, the
            world's tick does not call :meth:`step`. Each has the rectangle of floor in which it
            surely stands as long as it does not leave the ground; None if that is not known.
    """

    def __init__(self, physics: Physics) -> None:
        self._physics = physics
        self._ground = Ground()
        self.ground = self._ground.at
        self.movers: dict[Body, Inside | None] = {}

    def rebuild(self, floors: Iterable[tuple[FloorDescription, Region]]) -> None:
        """Start over with these floors and no movers."""
        self._ground = Ground((floor.top, region) for floor, region in floors)
        self.ground = self._ground.at
        self.movers.clear()

    def set_height(self, body: Body, z: float | None) -> None:
        """Set the height of a body that was put somewhere; None stands for the floor there."""
        x, y = body.position
        body.z = (self.ground(x, y) or 0.0) if z is None else z
        body.vz = 0.0

    def update_support(self, body: Body) -> None:
        """Find out whether a body that was put somewhere stands there or is in the air."""
        self.set_on_ground(body, not body.moves or self._is_supported(body))

    def forget(self, body: Body) -> None:
        """Stop moving a body that was taken out of the space."""
        self.movers.pop(body, None)

    def launch(self, body: Body, speed: float) -> None:
        """Give a body an upward speed; it leaves the ground."""
        if body.fallen or not body.moves:
            return
        if body.on_ground:
            self.set_on_ground(body, False)
        body.vz = speed

    def step(self, dt: float) -> None:
        """Move all movers vertically by one tick, after the step of the space."""
        for body, inside in tuple(self.movers.items()):
            if body.on_ground:
                centre = body._centre
                x, y = centre.x, centre.y
                if inside is not None:
                    left, right, lower, upper = inside
                    if left < x < right and lower < y < upper:
                        continue
                if self._is_supported(body):
                    self.movers[body] = self._ground.inside(x, y, body.z)
                    continue
                self.set_on_ground(body, False)
            self._fly(body, dt)

    def set_on_ground(self, body: Body, on_ground: bool) -> None:
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

    def _fly(self, body: Body, dt: float) -> None:
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
            self.set_on_ground(body, True)
            return
        body.z = z
        if z < settings.fall_threshold:
            self._physics.drop(body)

    def _is_supported(self, body: Body) -> bool:
        """Return True if a floor or another body is right below a body's centre."""
        z, centre = body.z, body._centre
        return self.ground(centre.x, centre.y, z) == z or self._highest_support(body, z) == z

    def _highest_support(self, body: Body, below: float) -> float | None:
        """Return the highest floor or body top under a centre that is not above ``below``."""
        place = body.position
        best = self.ground(*place, below)
        for hit in self._physics.space.point_query(place, 0.0, body._shapes[0].filter):
            other = self._physics.owners[hit.shape]
            top = other.z + other.height
            if top <= below + SAME_HEIGHT_M and (best is None or top > best):
                best = top
        return best

    def _below_ceiling(self, body: Body, before: float, z: float) -> float:
        """Return the height at which a rising body is stopped by a body above it."""
        for other in self._physics.contacts.passes(body):
            room = other.z - body.height
            if before <= room + SAME_HEIGHT_M and z > room:
                z, body.vz = room, 0.0
        return z


def _update_velocity_in_air(body: pymunk.Body, gravity: Any, _damping: float, dt: float) -> None:
    # damping stands for friction with the ground, which there is none of in the air
    pymunk.Body.update_velocity(body, gravity, 1.0, dt)

"""The bodies of a world in pymunk's space: built, placed, dropped and removed."""

from typing import TYPE_CHECKING

import pymunk

from ai4u_edu.world.build import build
from ai4u_edu.world.contacts import Contacts
from ai4u_edu.world.descriptions import WorldSettings
from ai4u_edu.world.grasp import detach
from ai4u_edu.world.height import Height
from ai4u_edu.world.native import release_space, step_function

if TYPE_CHECKING:
    from ai4u_edu.world.body import Body

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
        space: pymunk's space, built anew for each episode.
        owners: the body of each of its shapes.
        contacts: contacts between bodies.
        height: vertical motion.
        step: function that moves the space by one tick, in the plane only.
        generation: grows whenever the space is built anew or its contents change.
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

    def add(self, body: "Body") -> None:
        """Build a body's parts as sampled for this episode and add them to the space."""
        self._groups += 1
        build(body, self.space, self._groups)
        body.fallen = False
        for shape in body._shapes:
            self.owners[shape] = body
        self.generation += 1

    def remove(self, body: "Body") -> None:
        """Take a body's parts out of the space for good."""
        detach(self, body)
        if not body.fallen:
            self.space.remove(body._pm, *body._shapes)
        self.contacts.forget(body)
        for shape in body._shapes:
            del self.owners[shape]
        self.height.forget(body)
        self.generation += 1

    def place(self, body: "Body", x: float, y: float, angle: float, z: float | None) -> None:
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
        detach(self, body)
        body._pm.position, body._pm.angle = (x, y), angle
        body._pm.velocity, body._pm.angular_velocity = (0.0, 0.0), 0.0
        body._pm.force, body._pm.torque = (0.0, 0.0), 0.0
        self.space.reindex_shapes_for_body(body._pm)
        before = body.z
        self.height.set_height(body, z)
        self.height.update_support(body)
        if body.z != before and not body.moves:
            self.generation += 1  # rays look up the height of a body that can't fall only once

    def drop(self, body: "Body") -> None:
        """Take a body out of the space until it is placed again; its name stays known."""
        body.fallen = True
        detach(self, body)
        self.space.remove(body._pm, *body._shapes)
        self.contacts.forget(body)
        body._pm.velocity, body._pm.angular_velocity, body.vz = (0.0, 0.0), 0.0, 0.0
        self.height.forget(body)

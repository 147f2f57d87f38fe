"""Read-only access to a world for blocks."""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Literal

import numpy as np

from ai4u_edu.base.errors import NameNotFoundError, suggest
from ai4u_edu.locale import gettext as _
from ai4u_edu.world.body import BodyView
from ai4u_edu.world.descriptions import FloorDescription
from ai4u_edu.world.ink import Ink
from ai4u_edu.world.messages import Messages
from ai4u_edu.world.rays import GROUND_TAGS, CodeOf, RayFan, RayGrid
from ai4u_edu.world.region import Region
from ai4u_edu.world.world import World


class WorldView:
    """A world as sensors and reward functions see it.

    >>> from ai4u_edu.world import CircleShape, World
    >>> world = World()
    >>> _ = world.add_body("robot", CircleShape())
    >>> _ = world.add_body("box", CircleShape(), position=(3, 4), tags=("target",))
    >>> view = WorldView(world)
    >>> view["robot"].distance(view["box"])
    5.0
    >>> view.named("target")
    ('box',)
    """

    def __init__(self, world: World) -> None:
        self._world = world

    def __getitem__(self, name: str) -> BodyView:
        """Return the body of a name.

        Raises:
            NameNotFoundError: no body has it; the message suggests the nearest name.
        """
        body = self._world._registry.bodies.get(name)
        return self._world[name] if body is None else body

    def __contains__(self, name: str) -> bool:
        return name in self._world.bodies or name in self._world.areas

    def __iter__(self) -> Iterator[str]:
        return iter(self._world.bodies)

    @property
    def ticks(self) -> int:
        """Ticks since the reset."""
        return self._world.ticks

    @property
    def dt(self) -> float:
        """Length of a tick in seconds."""
        return self._world.dt

    @property
    def time(self) -> float:
        """Seconds since the reset."""
        return self._world.time

    @property
    def generation(self) -> int:
        """A number that grows whenever bodies, floors or areas come or go, to invalidate caches."""
        return self._world.generation

    @property
    def floors(self) -> tuple[FloorDescription, ...]:
        """All floors; none means endless ground at height 0."""
        return self._world.floors

    @property
    def areas(self) -> Mapping[str, Region]:
        """All areas by name."""
        return self._world.areas

    def named(self, tag: str) -> tuple[str, ...]:
        """Return the names of all bodies that carry a tag."""
        return tuple(name for name, body in self._world.bodies.items() if tag in body.tags)

    def tags(self, *kinds: Literal["bodies", "floors", "areas"]) -> set[str]:
        """Return the tags of all things of these kinds; of all kinds if none is given.

        Endless ground counts as a floor with the tag "floor".
        """
        world = self._world
        things: dict[str, list[Sequence[str]]] = {
            "bodies": [body.tags for body in world.bodies.values()],
            "floors": [floor.tags for floor in world.floors] or [GROUND_TAGS],
            "areas": [area.tags for area in world.areas.values()],
        }
        return {tag for kind in kinds or things for tags in things[kind] for tag in tags}

    def check_target(self, name: str) -> None:
        """Raise NameNotFoundError, with a suggestion, unless a body or an area has that name."""
        if name not in self:
            known = [*self._world.bodies, *self._world.areas]
            raise NameNotFoundError(
                _("no body or area is named {name!r}; {hint}", name=name, hint=suggest(name, known))
            )

    def check_group(self, tag: str) -> None:
        """Raise NameNotFoundError, with a suggestion, unless some body carries that tag."""
        known = self.tags("bodies")
        if tag not in known:
            raise NameNotFoundError(
                _("no body carries the tag {tag!r}; {hint}", tag=tag, hint=suggest(tag, known))
            )

    def ground(self, x: float, y: float) -> float | None:
        """Return the height of the highest floor at a place (metres); None over the void."""
        return self._world.ground(x, y)

    @property
    def ink(self) -> Ink:
        """The ink that pens have drawn on the floors."""
        return self._world.ink

    @property
    def messages(self) -> Messages:
        """The messages that agents say to each other."""
        return self._world.messages

    def touching(self, body: BodyView, target: str) -> bool:
        """Return True if an agent's body touches another body, or its centre is in an area."""
        area = self._world._registry.areas.get(target)
        if area is not None:
            return area.contains(*body.position)
        return target in self._world.contacts.of(body.name)

    def touched_after(self, body: BodyView, target: str, tick: int) -> bool:
        """Return True if they touch now, or touched at any tick after the given one."""
        if target in self._world._registry.areas:
            return self.touching(body, target)
        return self._world.contacts.touched_after(body.name, target, tick)

    def contacts(self, body: BodyView) -> tuple[str, ...]:
        """Return the names of all bodies that an agent's body touches."""
        return self._world.contacts.of(body.name)

    def bounds(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Return a rectangle ((x0, y0), (x1, y1)) around all floors and bodies, in any episode."""
        return self._world.bounds()

    def diagonal(self) -> float:
        """Return the diagonal of :meth:`bounds`, metres."""
        (left, low), (right, high) = self._world.bounds()
        return math.hypot(right - left, high - low)

    def sees(self, looker: BodyView, target: BodyView, up: float = 0.5) -> bool:
        """Return True if no third body stands between two bodies.

        Args:
            looker: one of the two.
            target: the other one.
            up: height of each one's eye above its underside, metres.
        """
        world = self._world
        start, rise = looker.z + up, target.z - looker.z
        accept = world.filter_for(looker, 0xFFFFFFFF)
        for hit in world.space.segment_query(looker.position, target.position, 0.0, accept):
            other, height = world.owners[hit.shape], start + hit.alpha * rise
            if other is not target and other.z <= height <= other.z + other.height:
                return False
        return True

    def random(self, name: str) -> np.random.Generator:
        """Return the random generator of a block's name, made from the world's seed."""
        return self._world.seeds.child(name)

    def ray_fan(
        self, angles: Sequence[float], reach: float, code_of: CodeOf, **options: Any
    ) -> RayFan:
        """Return a fan of level rays; angles in radians from the heading, counter-clockwise."""
        return RayFan(self._world, angles, reach, code_of, **options)

    def ray_grid(
        self,
        angles: Sequence[float],
        pitches: Sequence[float],
        reach: float,
        code_of: CodeOf,
        **options: Any,
    ) -> RayGrid:
        """Return a perspective grid of rays; pitches in radians, upwards positive."""
        return RayGrid(self._world, angles, pitches, reach, code_of, **options)

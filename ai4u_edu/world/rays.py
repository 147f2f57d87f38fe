"""Rays: what lies in which direction, and how far.

Two forms, both cast from an eye on a body: a flat fan (one ray a direction, level with the eye)
and a grid in perspective (rows at different pitches), which asks the plane once for each column
and finds out the rows from heights.
"""

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import numpy.typing as npt
import pymunk

from ai4u_edu.world._chipmunk import Segments, shape_key
from ai4u_edu.world.body import BodyView

if TYPE_CHECKING:
    from ai4u_edu.world.world import World

Floats = npt.NDArray[np.float64]
CodeOf = Callable[[Sequence[str]], float]
"""Gives the code of something from its tags."""


GROUND_TAGS = ("floor",)
"""The tags of the endless ground of a world without floors."""


class Obstacle(NamedTuple):
    """What a vertical sheet through the eye cuts: from ``near`` to ``far``, ``low`` to ``high``."""

    near: float
    far: float
    low: float
    high: float
    code: float


class _Caster:
    """What the fan and the grid share: directions, codes, and the first hit of each direction."""

    def __init__(
        self,
        world: "World",
        angles: Sequence[float],
        reach: float,
        code_of: CodeOf,
        eye: tuple[float, float, float],
        mask: int,
        exclude_self: bool,
    ) -> None:
        self._world = world
        self.angles = np.asarray(angles, np.float64)
        self.reach = reach
        self.eye = eye
        self._mask, self._exclude_self = mask, exclude_self
        self._code_of = code_of
        self._miss = code_of(())
        self._segments = Segments(len(self.angles))
        self._generation = -1
        self._codes: dict[int, float] = {}
        self._shapes: dict[int, pymunk.Shape] = {}
        self._grounds: list[tuple[float, Callable[[float, float], bool], float]] = []
        self._level = True
        self._filter = pymunk.ShapeFilter()
        self.origin = (0.0, 0.0, 0.0)
        """Where the eye was at the last cast: world frame, metres."""
        self.directions = np.zeros((len(self.angles), 2))
        """Where each column looked at the last cast: unit vectors, world frame."""

    def _aim(self, body: BodyView, reach: float) -> None:
        """Turns the directions with the body and finds what each meets first in the plane."""
        if self._generation != self._world.generation:
            self._learn(body)
        forward, left, up = self.eye
        x, y = body.position
        heading = body._pm.angle
        if forward or left:
            cos, sin = math.cos(heading), math.sin(heading)
            x, y = x + cos * forward - sin * left, y + sin * forward + cos * left
        self.origin = x, y, body.z + up
        turned = self.angles + heading
        np.cos(turned, out=self.directions[:, 0])
        np.sin(turned, out=self.directions[:, 1])
        ends = self._segments.ends
        np.multiply(self.directions, reach, out=ends)
        ends += (x, y)
        self._segments.cast(self._world.space, x, y, self._filter)

    def _learn(self, body: BodyView) -> None:
        """Looks up the codes of everything, once for each build of the world."""
        world = self._world
        self._generation = world.generation
        self._codes = {0: self._miss}
        self._shapes.clear()
        for shape, owner in world.owners.items():
            key = shape_key(shape)
            self._codes[key] = self._code_of(owner.tags)
            self._shapes[key] = shape
        self._grounds = [
            (floor.top, region.contains, self._code_of(floor.tags))
            for floor, region in world._floor_regions()
        ] or [(0.0, _everywhere, self._code_of(GROUND_TAGS))]
        up = self.eye[2]
        self._level = all(
            owner.description.z in (None, 0.0) and up <= owner.height
            for owner in world.bodies.values()
        )
        self._filter = world.filter_for(body if self._exclude_self else None, self._mask)

    def _simple(self) -> bool:
        """Whether whatever a level ray meets is as high as the eye: no need to look at heights."""
        return self._level and not any(
            mover.z or not mover.on_ground for mover in self._world._height.movers
        )

    def _around(self) -> list[pymunk.Shape]:
        """The shapes that the eye is right above or below of."""
        x, y, _ = self.origin
        hits = self._world.space.point_query((x, y), 0.0, self._filter)
        return [hit.shape for hit in hits]

    def _cut(self, column: int, reach: float, around: Sequence[pymunk.Shape]) -> list[Obstacle]:
        """Everything in one column within reach, whatever its height, nearest first."""
        x, y, _ = self.origin
        end_x, end_y = self._segments.ends[column].tolist()
        space, owners = self._world.space, self._world.owners
        found: list[tuple[float, pymunk.Shape]] = [
            (hit.alpha * reach, hit.shape)
            for hit in space.segment_query((x, y), (end_x, end_y), 0.0, self._filter)
        ]
        # a segment that starts inside a shape does not report it
        seen = {shape for _, shape in found}
        found += [(0.0, shape) for shape in around if shape not in seen]
        found.sort(key=lambda pair: pair[0])
        obstacles = []
        for near, shape in found:
            owner = owners[shape]
            back = shape.segment_query((end_x, end_y), (x, y))
            far = reach if back is None else reach * (1.0 - back.alpha)
            code = self._codes[shape_key(shape)]
            obstacles.append(Obstacle(near, far, owner.z, owner.z + owner.height, code))
        return obstacles


class RayFan(_Caster):
    """A flat fan: one level ray in each direction.

    Attributes:
        codes: (n,) what each ray met, as ``code_of`` its tags.
        distances: (n,) metres to it; 0 where nothing was met.
    """

    def __init__(
        self,
        world: "World",
        angles: Sequence[float],
        reach: float,
        code_of: CodeOf,
        *,
        eye: tuple[float, float, float] = (0.0, 0.0, 0.5),
        mask: int = 0xFFFFFFFF,
        exclude_self: bool = True,
    ) -> None:
        super().__init__(world, angles, reach, code_of, eye, mask, exclude_self)
        self.codes: Floats = np.zeros(len(self.angles))
        self.distances: Floats = np.zeros(len(self.angles))

    def cast(self, body: BodyView) -> None:
        """Fills ``codes`` and ``distances``.

        Args:
            body: where the eye sits; it turns with it.
        """
        self._aim(body, self.reach)
        keys = self._segments.shapes
        codes = self._codes
        self.codes[:] = [codes[key] for key in keys]
        np.multiply(self._segments.alpha, self.reach, out=self.distances)
        self.distances[self._segments.alpha >= 1.0] = 0.0
        if not self._simple():
            self._look_at_heights(keys)

    def _look_at_heights(self, keys: Sequence[int]) -> None:
        level, around = self.origin[2], self._around()
        owners = self._world.owners
        for column, key in enumerate(keys):
            if not key and not around:
                continue
            owner = owners[self._shapes[key]] if key else None
            if owner and not around and owner.z <= level <= owner.z + owner.height:
                continue
            self.codes[column], self.distances[column] = self._miss, 0.0
            for obstacle in self._cut(column, self.reach, around):
                if obstacle.low <= level <= obstacle.high:
                    self.codes[column], self.distances[column] = obstacle.code, obstacle.near
                    break


class RayGrid(_Caster):
    """A grid in perspective: m rows at different pitches, n columns at different angles.

    Attributes:
        codes: (m, n) what each ray met; a floor has its own code, the void the code of nothing.
        distances: (m, n) metres along the ray; 0 where nothing was met.
    """

    def __init__(
        self,
        world: "World",
        angles: Sequence[float],
        pitches: Sequence[float],
        reach: float,
        code_of: CodeOf,
        *,
        eye: tuple[float, float, float] = (0.0, 0.0, 0.5),
        mask: int = 0xFFFFFFFF,
        exclude_self: bool = True,
    ) -> None:
        super().__init__(world, angles, reach, code_of, eye, mask, exclude_self)
        self.pitches = np.asarray(pitches, np.float64)
        self._rows = [(math.tan(pitch), math.cos(pitch)) for pitch in pitches]
        self._flat_reach = reach * max(cos for _, cos in self._rows)
        self.codes: Floats = np.zeros((len(self._rows), len(self.angles)))
        self.distances: Floats = np.zeros_like(self.codes)

    def cast(self, body: BodyView) -> None:
        """Fills ``codes`` and ``distances``.

        Args:
            body: where the eye sits; it turns with it.
        """
        self._aim(body, self._flat_reach)
        around = self._around()
        for column, key in enumerate(self._segments.shapes):
            first = self._first(column, key)
            all_of_it: list[Obstacle] | None = None if first or around else []
            for row, (slope, cos) in enumerate(self._rows):
                nearest, code = self._ground_hit(column, slope)
                if first and not around and self._ends_at(first, slope, nearest):
                    met: Sequence[Obstacle] = (first,)
                elif all_of_it is None:
                    met = all_of_it = self._cut(column, self._flat_reach, around)
                else:
                    met = all_of_it
                for obstacle in met:
                    at = _meet(obstacle, self.origin[2], slope)
                    if at < nearest:
                        nearest, code = at, obstacle.code
                within = nearest <= self.reach * cos
                self.codes[row, column] = code if within else self._miss
                self.distances[row, column] = nearest / cos if within else 0.0

    def _first(self, column: int, key: int) -> Obstacle | None:
        """What stands first in a column; where it ends behind is not asked yet."""
        if not key:
            return None
        owner = self._world.owners[self._shapes[key]]
        near = float(self._segments.alpha[column]) * self._flat_reach
        return Obstacle(near, near, owner.z, owner.z + owner.height, self._codes[key])

    def _ends_at(self, first: Obstacle, slope: float, ground: float) -> bool:
        """Whether a row ends at the first obstacle's side, or on the ground in front of it."""
        return ground <= first.near or (
            first.low <= self.origin[2] + slope * first.near <= first.high
        )

    def _ground_hit(self, column: int, slope: float) -> tuple[float, float]:
        """How far away in the plane a ray meets a floor (infinite: never), and its code."""
        nearest, code = math.inf, self._miss
        if slope == 0.0:
            return nearest, code
        x, y, up = self.origin
        dx, dy = self.directions[column].tolist()
        for top, contains, floor_code in self._grounds:
            at = (top - up) / slope
            if 0.0 < at < nearest and contains(x + at * dx, y + at * dy):
                nearest, code = at, floor_code
        return nearest, code


def _everywhere(_x: float, _y: float) -> bool:
    return True


def _meet(obstacle: Obstacle, up: float, slope: float) -> float:
    """How far away in the plane a ray enters an obstacle; infinite if it does not."""
    near, far, low, high, _ = obstacle
    if slope == 0.0:
        return near if low <= up <= high else math.inf
    a, b = (low - up) / slope, (high - up) / slope
    enter, leave = max(near, min(a, b)), min(far, max(a, b))
    return enter if enter <= leave else math.inf

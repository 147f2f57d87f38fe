"""Rays: code and distance of the first thing in each direction.

Two forms are cast from an eye on a body: a flat fan (one level ray in each direction) and a
perspective grid (one cast in the plane for each column; rows follow from heights).
"""

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
import pymunk
from numpy import multiply

from ai4u_edu.world.body import BodyView
from ai4u_edu.world.native import GridArrays, compile_grid, make_segments, shape_key
from ai4u_edu.world.region import Region
from ai4u_edu.world.world import World

Floats = npt.NDArray[np.float64]
CodeOf = Callable[[Sequence[str]], float]
"""Function that returns a code for the tags of a body or a floor."""


GROUND_TAGS = ("floor",)
"""Tags of the endless ground of a world without floors."""

_MIN_SLOPE = 1e-9  # a ray of a smaller slope meets no floor within any reach
_NO_HEIGHTS = math.inf, -math.inf  # of a missing body: no height is between them


class _Obstacle(NamedTuple):
    """Section of a body by a vertical plane through the eye, metres: distances and heights."""

    near: float
    far: float
    low: float
    high: float
    code: float


class Cast(NamedTuple):
    """A copy of one cast's results."""

    origin: tuple[float, float, float]
    """Position of the eye: world frame, metres."""
    directions: Floats
    """Unit vector of each column, world frame."""
    distances: Floats
    codes: Floats


class _RayCaster:
    """Common part of fan and grid: directions, codes, and the first hit in each direction."""

    def __init__(
        self,
        world: World,
        angles: Sequence[float],
        reach: float,
        code_of: CodeOf,
        eye: tuple[float, float, float],
        mask: int,
        exclude_self: bool,
    ) -> None:
        self._world, self._physics = world, world._physics
        self.angles = np.asarray(angles, np.float64)
        self.reach = reach
        self.eye = eye
        self._mask, self._exclude_self = mask, exclude_self
        self._code_of = code_of
        self._miss = code_of(())
        self._segments = make_segments(len(self.angles))
        self._generation = -1
        self._carrier: BodyView | None = None
        self._codes: dict[int, float] = {}
        self._bodies: dict[int, BodyView] = {}
        self._body_codes: dict[BodyView, float] = {}
        self._grounds: list[tuple[float, Region | None, float]] = []
        self._flat = True
        self._lowest_top = self._highest_top = 0.0
        self._filter = pymunk.ShapeFilter()
        self.origin = (0.0, 0.0, 0.0)
        """Position of the eye at the last cast: world frame, metres."""
        # a pair (x, y) is viewed as a complex number, so that turning is multiplying; for numpy, an
        # array of one number is half the work of a Python number
        self._own_directions = np.cos(self.angles) + 1j * np.sin(self.angles)
        self._turn = np.zeros((), np.complex128)
        self.directions = self._segments.directions
        """Unit vector of each column at the last cast, world frame."""
        self._turned = self.directions.view(np.complex128)[:, 0]
        self._turned[:] = self._own_directions

    def _aim(self, body: BodyView, reach: float) -> None:
        """Turn the directions with the body and find the first hit of each in the plane."""
        if self._generation != self._physics.generation or self._carrier is not body:
            self._update(body)
        forward, left, up = self.eye
        centre, heading = body._centre, body._angle[0]
        x, y, cos, sin = centre.x, centre.y, math.cos(heading), math.sin(heading)
        if forward or left:
            x, y = x + cos * forward - sin * left, y + sin * forward + cos * left
        self.origin = x, y, body.z + up
        self._turn[()] = complex(cos, sin)
        multiply(self._own_directions, self._turn, self._turned)
        self._segments.cast(self._physics.space, x, y, reach, self._filter)

    def _update(self, body: BodyView) -> None:
        """Look up the codes of everything, after each change of the world's contents."""
        world = self._world
        self._generation, self._carrier = world.generation, body
        self._bodies = {shape_key(shape): owner for shape, owner in world.owners.items()}
        self._body_codes = {owner: self._code_of(owner.tags) for owner in self._bodies.values()}
        self._codes = {key: self._body_codes[owner] for key, owner in self._bodies.items()}
        self._codes[0] = self._miss
        self._grounds = [
            (floor.top, region, self._code_of(floor.tags))
            for floor, region in world._registry.floors.values()
        ] or [(0.0, None, self._code_of(GROUND_TAGS))]
        seen = [
            other for other in world.bodies.values() if other is not body or not self._exclude_self
        ]
        tops = [other.height for other in seen] or [math.inf]
        self._lowest_top, self._highest_top = min(tops), max(tops)
        # bodies that move can leave the ground at any time, and are checked at each cast
        self._flat = all(other.moves or other.z == 0.0 for other in seen)
        self._filter = world.filter_for(body if self._exclude_self else None, self._mask)

    def _is_flat_scene(self) -> bool:
        """Return True if everything stands at height 0 and is at least as high as the eye."""
        movers = self._physics.height.movers
        return (
            self._flat
            and 0.0 <= self.origin[2] <= self._lowest_top
            and not (movers and any(mover.z for mover in movers))
        )

    def _cut(self, column: int, reach: float) -> list[_Obstacle]:
        """Return everything in one column within reach, at any height, nearest first."""
        x, y, _ = self.origin
        dx, dy = self.directions[column].tolist()
        end_x, end_y = dx * reach + x, dy * reach + y
        obstacles = []
        for hit in self._world.space.segment_query((x, y), (end_x, end_y), 0.0, self._filter):
            owner = self._world.owners[hit.shape]
            back = hit.shape.segment_query((end_x, end_y), (x, y))
            share = hit.alpha if back is None else 1.0 - back.alpha
            obstacles.append(
                _Obstacle(
                    near=hit.alpha * reach,
                    far=share * reach,
                    low=owner.z,
                    high=owner.z + owner.height,
                    code=self._body_codes[owner],
                )
            )
        return sorted(obstacles)


class RayFan(_RayCaster):
    """A flat fan: one level ray in each direction.

    Attributes:
        distances: (n,) metres to each ray's hit; 0 without a hit.
    """

    def __init__(
        self,
        world: World,
        angles: Sequence[float],
        reach: float,
        code_of: CodeOf,
        *,
        eye: tuple[float, float, float] = (0.0, 0.0, 0.5),
        mask: int = 0xFFFFFFFF,
        exclude_self: bool = True,
    ) -> None:
        super().__init__(world, angles, reach, code_of, eye, mask, exclude_self)
        self.distances: Floats = self._segments.distances
        self._codes_met: Floats = np.zeros(len(self.angles))
        self._codes_known = True

    def cast(self, body: BodyView) -> None:
        """Cast the rays: fill ``distances`` and ``codes``.

        Args:
            body: the body that carries the eye.
        """
        self._aim(body, self.reach)
        self._codes_known = False
        if not self._is_flat_scene():
            self._correct_for_heights()

    def last_cast(self) -> Cast:
        """Return a copy of the last cast."""
        return Cast(self.origin, self.directions.copy(), self.distances.copy(), self.codes.copy())

    @property
    def codes(self) -> Floats:
        """(n,) code of each ray's hit; looked up when it is asked for."""
        if not self._codes_known:
            self._codes_known = True
            self._codes_met[:] = [*map(self._codes.__getitem__, self._segments.shapes())]
        return self._codes_met

    def _correct_for_heights(self) -> None:
        level = self.origin[2]
        for column, key in enumerate(self._segments.shapes()):
            if not key:
                continue
            first = self._bodies[key]
            if first.z <= level <= first.z + first.height:
                continue
            self.codes[column], self.distances[column] = self._miss, 0.0
            for obstacle in self._cut(column, self.reach):
                if obstacle.low <= level <= obstacle.high:
                    self.codes[column], self.distances[column] = obstacle.code, obstacle.near
                    break


class RayGrid(_RayCaster):
    """A perspective grid: m rows at different pitches, n columns at different angles.

    Attributes:
        codes: (m, n) code of each ray's hit; a floor has its own code.
        distances: (m, n) metres along the ray; 0 without a hit.
    """

    def __init__(
        self,
        world: World,
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
        self._slopes = np.tan(self.pitches)
        steep = np.where(np.abs(self._slopes) > _MIN_SLOPE, self._slopes, math.nan)
        self._runs = 1.0 / steep
        self._cos = np.cos(self.pitches)[:, None]
        self._reaches = reach * self._cos[:, 0]
        self._flat_reach = float(self._reaches.max())
        self.codes: Floats = np.zeros((len(self.pitches), len(self.angles)))
        self.distances: Floats = np.zeros_like(self.codes)
        arrays = GridArrays(
            self._slopes, self._runs, self._reaches, self._cos, self.codes, self.distances
        )
        self._compiled = compile_grid(arrays, self._segments, self._flat_reach, self._miss)

    def last_cast(self) -> Cast:
        """Return a copy of the last cast."""
        return Cast(self.origin, self.directions.copy(), self.distances.copy(), self.codes.copy())

    def cast(self, body: BodyView) -> None:
        """Cast the rays: fill ``codes`` and ``distances``.

        Args:
            body: the body that carries the eye.
        """
        self._aim(body, self._flat_reach)
        if self._compiled:
            self._compiled.cast(self._physics.space, self.origin, *self._open_heights())
            return
        # until the end, distances are those in the plane, and infinite without a hit
        codes, flat = self.codes, self.distances
        codes.fill(self._miss)
        flat.fill(math.inf)
        self._enter_grounds()
        undecided = self._enter_first_hits()
        for column in np.flatnonzero(undecided.any(axis=0)).tolist():
            obstacles = self._cut(column, self._flat_reach)
            for row in np.flatnonzero(undecided[:, column]).tolist():
                slope = float(self._slopes[row])
                for obstacle in obstacles:
                    at = _meet(obstacle, self.origin[2], slope)
                    if at < flat[row, column]:
                        codes[row, column], flat[row, column] = obstacle.code, at
        beyond = flat > self._reaches[:, None]
        codes[beyond], flat[beyond] = self._miss, 0.0
        flat /= self._cos

    def _update(self, body: BodyView) -> None:
        super()._update(body)
        if self._compiled:
            self._compiled.update(self._bodies, self._codes, self._grounds)

    def _open_heights(self) -> tuple[float, float]:
        """Return the heights between which a ray may hit more than its column's first body."""
        # nothing is below the ground or above the highest top
        return (0.0, self._highest_top) if self._is_flat_scene() else (-math.inf, math.inf)

    def _enter_grounds(self) -> None:
        """Enter the hits of floors."""
        x, y, up = self.origin
        codes, flat, directions = self.codes, self.distances, self.directions
        for top, region, code in self._grounds:
            far = ((top - up) * self._runs)[:, None]
            met = (far > 0.0) & (far <= self._reaches[:, None]) & (far < flat)
            if region is not None:
                met &= region.contains_each(x + far * directions[:, 0], y + far * directions[:, 1])
            np.copyto(flat, far, where=met)
            codes[met] = code

    def _enter_first_hits(self) -> npt.NDArray[np.bool_]:
        """Enter the rays that end on the side of their column's first body.

        Returns:
            (m, n) True for rays that may hit something else: a top, or a body behind.
        """
        alpha, near, keys = self._segments.alpha, self._segments.distances, self._segments.shapes()
        firsts = [self._bodies.get(key) for key in keys]
        low, high = np.array(
            [(first.z, first.z + first.height) if first else _NO_HEIGHTS for first in firsts]
        ).T
        at_near = self.origin[2] + self._slopes[:, None] * near
        reached = (near < self.distances) & (alpha < 1.0)
        on_side = reached & (low <= at_near) & (at_near <= high)
        np.copyto(self.distances, near, where=on_side)
        np.copyto(self.codes, [self._codes[key] for key in keys], where=on_side)
        undecided: npt.NDArray[np.bool_] = reached ^ on_side
        bottom, ceiling = self._open_heights()
        undecided &= (at_near > bottom) & (at_near <= ceiling)
        return undecided


def _meet(obstacle: _Obstacle, up: float, slope: float) -> float:
    """Return the distance in the plane at which a ray enters an obstacle, or infinity."""
    near, far, low, high, _ = obstacle
    if slope == 0.0:
        return near if low <= up <= high else math.inf
    a, b = (low - up) / slope, (high - up) / slope
    enter, leave = max(near, min(a, b)), min(far, max(a, b))
    return enter if enter <= leave else math.inf

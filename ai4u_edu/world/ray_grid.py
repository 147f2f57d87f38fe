"""Perspective grid of rays: one cast in the plane for each column; rows follow from heights."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from ai4u_edu.world.body import BodyView
from ai4u_edu.world.native import GridArrays, compile_grid
from ai4u_edu.world.rays import Cast, CodeOf, Floats, Obstacle, RayCaster

if TYPE_CHECKING:
    from ai4u_edu.world.world import World

MIN_SLOPE = 1e-9
"""A ray of a smaller slope meets no floor within any reach."""

NO_HEIGHTS = math.inf, -math.inf
"""Lowest and highest point of a missing body: no height is between them."""


class RayGrid(RayCaster):
    """A perspective grid: m rows at different pitches, n columns at different angles.

    Attributes:
        codes: (m, n) code of each ray's hit; a floor has its own code.
        distances: (m, n) metres along the ray; 0 without a hit.
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
        self._slopes = np.tan(self.pitches)
        steep = np.where(np.abs(self._slopes) > MIN_SLOPE, self._slopes, math.nan)
        self._runs = 1.0 / steep
        self._cos = np.cos(self.pitches)[:, None]
        self._reaches = reach * self._cos[:, 0]
        self._flat_reach = float(self._reaches.max())
        self.codes: Floats = np.zeros((len(self.pitches), len(self.angles)))
        self.distances: Floats = np.zeros_like(self.codes)
        arrays = GridArrays(
            self._slopes, self._runs, self._reaches, self._cos, self.codes, self.distances
        )
        self._compiled = compile_grid(arrays, self._segments, self._miss)

    def last_cast(self) -> Cast:
        """Return a copy of the last cast."""
        return Cast(self.origin, self.directions.copy(), self.distances.copy(), self.codes.copy())

    def cast(self, body: BodyView) -> None:
        """Cast the rays: fill ``codes`` and ``distances``.

        Args:
            body: the body that carries the eye.
        """
        self._aim(body, self._flat_reach)
        # until the end, distances are those in the plane, and infinite without a hit
        codes, flat = self.codes, self.distances
        if self._compiled:
            if self._compiled.cast(self.origin, *self._open_heights()):
                return
            undecided = self._compiled.undecided
        else:
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
            [(first.z, first.z + first.height) if first else NO_HEIGHTS for first in firsts]
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


def _meet(obstacle: Obstacle, up: float, slope: float) -> float:
    """Return the distance in the plane at which a ray enters an obstacle, or infinity."""
    near, far, low, high, _ = obstacle
    if slope == 0.0:
        return near if low <= up <= high else math.inf
    a, b = (low - up) / slope, (high - up) / slope
    enter, leave = max(near, min(a, b)), min(far, max(a, b))
    return enter if enter <= leave else math.inf

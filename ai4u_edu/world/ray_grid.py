"""Rays in perspective: the plane is asked once for each column; the rows follow from heights."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from ai4u_edu.world.body import BodyView
from ai4u_edu.world.native import GridArrays, compile_grid
from ai4u_edu.world.rays import Cast, Caster, CodeOf, Floats, Obstacle

if TYPE_CHECKING:
    from ai4u_edu.world.world import World

LEVEL = 1e-9
"""A slope less than this meets no floor within any reach."""

NOWHERE = math.inf, -math.inf
"""From where to where nothing reaches upwards."""


class RayGrid(Caster):
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
        self._slopes = np.tan(self.pitches)
        steep = np.where(np.abs(self._slopes) > LEVEL, self._slopes, math.nan)
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

    def kept(self) -> Cast:
        """The last cast."""
        return Cast(self.origin, self.directions.copy(), self.distances.copy(), self.codes.copy())

    def cast(self, body: BodyView) -> None:
        """Fills ``codes`` and ``distances``.

        Args:
            body: where the eye sits; it turns with it.
        """
        self._aim(body, self._flat_reach)
        # until the end, the distances are those in the plane, and infinite for nothing
        codes, flat = self.codes, self.distances
        if self._compiled:
            if self._compiled.cast(self.origin, *self._open_heights()):
                return
            undecided = self._compiled.undecided
        else:
            codes.fill(self._miss)
            flat.fill(math.inf)
            self._look_at_grounds()
            undecided = self._look_at_firsts()
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

    def _learn(self, body: BodyView) -> None:
        super()._learn(body)
        if self._compiled:
            self._compiled.update(self._bodies, self._codes, self._grounds)

    def _open_heights(self) -> tuple[float, float]:
        """Between which heights a ray may meet more than what stands first in its column."""
        # below the ground there is nothing, and nothing above the highest top
        return (0.0, self._highest_top) if self._simple() else (-math.inf, math.inf)

    def _look_at_grounds(self) -> None:
        """Enters the floors that the rays meet."""
        x, y, up = self.origin
        codes, flat, directions = self.codes, self.distances, self.directions
        for top, region, code in self._grounds:
            far = ((top - up) * self._runs)[:, None]
            met = (far > 0.0) & (far <= self._reaches[:, None]) & (far < flat)
            if region is not None:
                met &= region.contains_each(x + far * directions[:, 0], y + far * directions[:, 1])
            np.copyto(flat, far, where=met)
            codes[met] = code

    def _look_at_firsts(self) -> npt.NDArray[np.bool_]:
        """Enters the rays that end on the side of what stands first in their column.

        Returns:
            Which rays may meet something else: a top, or what stands behind.
        """
        alpha, near, keys = self._segments.alpha, self._segments.distances, self._segments.shapes()
        firsts = [self._bodies.get(key) for key in keys]
        low, high = np.array(
            [(first.z, first.z + first.height) if first else NOWHERE for first in firsts]
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
    """How far away in the plane a ray enters an obstacle; infinite if it does not."""
    near, far, low, high, _ = obstacle
    if slope == 0.0:
        return near if low <= up <= high else math.inf
    a, b = (low - up) / slope, (high - up) / slope
    enter, leave = max(near, min(a, b)), min(far, max(a, b))
    return enter if enter <= leave else math.inf

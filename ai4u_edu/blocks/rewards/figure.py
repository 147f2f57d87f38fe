"""A reward for drawing a figure."""

from typing import Annotated, ClassVar

import numpy as np
from pydantic import Field

from ai4u_edu.base.errors import NameNotFoundError, suggest
from ai4u_edu.base.parameters import Name, Number
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import BodyView, WorldView
from ai4u_edu.world.ink import CELL_M, TILE_CELLS, TileKey


class FigureReward(RewardFunc):
    """A reward for drawing a figure with ink: the more they overlap, the more is paid.

    The figure is the areas with the tag ``group``. The overlap is the number of cells (5 cm wide)
    that are in the figure and have ink, divided by the number of cells that are in the figure or
    have ink: 1 for a perfect drawing, 0 for none. Ink beside the figure lowers it.

    Each decision pays ``reward`` times the growth of the overlap; if it falls, that is negative.
    With ``at_least``, the whole ``reward`` is paid once, when the overlap reaches it.

    Source: ours.
    """

    group: Name = "figure"
    """The tag of the areas that are the figure."""
    reward: Number = 100.0
    """Amount for a perfect drawing; with at_least: for an overlap of that much."""
    at_least: Annotated[float, Field(gt=0, le=1)] | None = None
    """Overlap at which the reward is paid, once; left out: the growth of the overlap is paid."""

    carried: ClassVar[tuple[str, ...]] = ("overlap", "_digest", "_is_paid")

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the figure."""
        tags = {tag: None for area in view.areas.values() for tag in area.tags}
        if self.group not in tags:
            raise NameNotFoundError(
                _(
                    "no area carries the tag {group}; {hint}",
                    group=repr(self.group),
                    hint=suggest(self.group, tags),
                )
            )
        self._built_for = -1

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Begin with the ink that is there."""
        self._is_paid = False
        self._digest = -1
        self.overlap = 0.0
        """Share of the drawing and the figure that is in both, 0..1."""
        self._measure(view)

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """Return the amount."""
        before = self.overlap
        self._measure(view)
        if self.at_least is None:
            return self.reward * (self.overlap - before)
        if self._is_paid or self.overlap < self.at_least:
            return 0.0
        self._is_paid = True
        return self.reward

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        """Return True if the overlap is ``at_least`` so large, or grew."""
        return paid > 0 if self.at_least is None else self.overlap >= self.at_least

    def _measure(self, view: WorldView) -> None:
        """Measure the overlap, if ink or world have changed since."""
        if self._built_for != view.generation:
            self._build(view)
        elif self._digest == view.ink.digest:
            return
        self._digest = view.ink.digest
        tiles = view.ink.image().tiles
        both = drawn = 0
        for key, tile in tiles.items():
            has_ink = tile != 0
            drawn += int(has_ink.sum())
            if key in self._figure:
                both += int((has_ink & self._figure[key]).sum())
        either = drawn + self._cells - both
        self.overlap = both / either if either else 0.0

    def _build(self, view: WorldView) -> None:
        """Draw the figure into tiles as those of ink."""
        self._built_for = view.generation
        self._figure: dict[TileKey, np.ndarray[tuple[int, int], np.dtype[np.bool_]]] = {}
        pieces = [area for area in view.areas.values() if self.group in area.tags]
        for piece in pieces:
            reach = piece.description.shape.reach
            low = np.floor((np.array([piece.x, piece.y]) - reach) / CELL_M).astype(int)
            high = np.floor((np.array([piece.x, piece.y]) + reach) / CELL_M).astype(int)
            floor = view.ink.floor_at(piece.x, piece.y)
            if floor is None:
                continue
            for column in range(low[0] // TILE_CELLS, high[0] // TILE_CELLS + 1):
                for row in range(low[1] // TILE_CELLS, high[1] // TILE_CELLS + 1):
                    cells = np.arange(TILE_CELLS) + 0.5
                    xs = (column * TILE_CELLS + cells) * CELL_M + np.zeros((TILE_CELLS, 1))
                    ys = (row * TILE_CELLS + cells)[:, None] * CELL_M + np.zeros(TILE_CELLS)
                    inside = piece.contains_each(xs, ys)
                    if inside.any():
                        key = TileKey(floor, int(column), int(row))
                        self._figure[key] = self._figure.get(key, False) | inside
        self._cells = sum(int(inside.sum()) for inside in self._figure.values())

"""A map made of codes."""

from typing import Annotated

import numpy as np
from gymnasium.spaces import Box
from pydantic import Field

from ai4u_edu.base.parameters import Name
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.groups import check_groups
from ai4u_edu.blocks.sensors.cells import Cells, OnGrid
from ai4u_edu.blocks.sensors.pictures import CodeLegend
from ai4u_edu.blocks.sensors.ray_sensor import Code
from ai4u_edu.blocks.sensors.sensor import Array, Sensor
from ai4u_edu.world import BodyView, Region, WorldView

ENDLESS_GROUND_TAGS = ("floor",)
"""Tags of the endless ground of a world without floors."""


class GridSensor(OnGrid, Sensor):
    """The world as a map of square cells, each with the code of what is in it; north is up.

    A body is in the cells whose centre it covers (thinner bodies count as one cell thick, so that
    no wall has gaps); a floor or an area is in the cells whose centre lies in it. Its code is the
    one of its tag in ``group_code`` (of several tags, the first that has a code). Where several
    things share a cell, the largest code shows; 0 means nothing. The agent shows only if its tag
    has a code and ``self_exclude`` is off: a CellSensor reads where it is. A body that left the
    world is not on the map.

    With ``around=n`` the map shows the agent's surroundings: n cells to each side, the agent's cell
    in the middle, 0 beyond the grid. North stays up, however the agent turns.

    A corner of a map, with the default codes::

        row 0    50  50  50  50      50 wall
        row 1    50   1   1   1       1 floor
        row 2    50   1 200   1     200 dirty
                 column 0  1  2  3

    Reading: (rows, columns) whole numbers, or (2 n + 1, 2 n + 1). Source: the view of AI4U's grid
    world; its codes are the default.
    """

    group_code: Annotated[dict[Name, Code], Field(min_length=1)] = Field(
        default_factory=lambda: {"floor": 1, "wall": 50, "enemy": 100, "npc": 150, "dirty": 200}
    )
    """Code, 0..255, of each group (tag)."""
    around: Annotated[int, Field(ge=0, le=256)] = 0
    """Number of cells to each side of the agent that are shown; 0 for the whole grid."""
    self_exclude: bool = True
    """True leaves out the agent's own body."""

    def space(self) -> Box:
        """Return the range of codes."""
        across = 2 * self.around + 1
        shape = (across, across) if self.around else (self.rows, self.columns)
        return Box(0, max(self.group_code.values()), shape, np.int32)

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the groups and lay out the grid."""
        check_groups(self, "group_code", view)
        self._grid = self.grid()
        self._map = np.zeros(self.rows * self.columns, np.int32)
        self._ground = np.zeros_like(self._map)
        self._built_for: tuple[int, BodyView] | None = None

    def write(self, out: Array, body: BodyView, view: WorldView) -> None:
        """Draw the map."""
        if self._built_for != (view.generation, body):
            self._build(body, view)
        self._map[:] = 0
        for code, other in self._bodies:  # the largest code is drawn last, over all others
            if not other.fallen:
                self._map[self._grid.cells_of(other)] = code
        np.maximum(self._map, self._ground, out=self._map)
        whole = self._map.reshape(self.rows, self.columns)
        out[...] = self._cut(whole, body) if self.around else whole

    def legend(self) -> CodeLegend:
        """Return the group of each code."""
        scale = max(self.group_code.values()) if self.normalized else 1
        codes = tuple(code / scale for code in self.group_code.values())
        across = 2 * self.around + 1
        shape = (across, across) if self.around else (self.rows, self.columns)
        return CodeLegend(shape, codes, tuple(self.group_code))

    def _build(self, body: BodyView, view: WorldView) -> None:
        """Look up the bodies' codes and draw floors and areas, once for each build of the world."""
        self._built_for = view.generation, body
        bodies = [view[name] for name in view if not (view[name] is body and self.self_exclude)]
        coded = [(self._code_of(other.tags), other) for other in bodies]
        self._bodies = sorted((each for each in coded if each[0]), key=lambda each: each[0])
        self._ground[:] = 0 if view.floors else self._code_of(ENDLESS_GROUND_TAGS)
        for region in [*map(Region, view.floors), *view.areas.values()]:
            cells = self._grid.cells_in(region)
            self._ground[cells] = np.maximum(self._ground[cells], self._code_of(region.tags))

    def _cut(self, whole: Array, body: BodyView) -> Array:
        n = self.around
        row, column = self._grid.cell_at(*body.position)
        rows, columns = np.arange(row - n, row + n + 1), np.arange(column - n, column + n + 1)
        on = self._on(rows, self.rows)[:, None] & self._on(columns, self.columns)
        seen = whole[rows.clip(0, self.rows - 1)[:, None], columns.clip(0, self.columns - 1)]
        return np.where(on, seen, 0)

    @staticmethod
    def _on(numbers: Cells, count: int) -> Array:
        return (numbers >= 0) & (numbers < count)

    def _code_of(self, tags: tuple[str, ...]) -> int:
        return next((self.group_code[tag] for tag in tags if tag in self.group_code), 0)

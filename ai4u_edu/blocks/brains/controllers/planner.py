"""The base of controllers that search a path on a map and follow it."""

from collections.abc import Iterable, Mapping
from typing import Annotated, NamedTuple

import numpy as np
import numpy.typing as npt
from pydantic import Field

from ai4u_edu.base.errors import BlockError, suggest
from ai4u_edu.base.parameters import Name
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.brains.controllers.controller import Controller
from ai4u_edu.blocks.percept import Percept
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import WorldView

Cell = tuple[int, int]
"""(row, column); row 0 is on top."""
Map = npt.NDArray[np.bool_]
"""(rows, columns): True for cells that can be entered."""
Codes = Annotated[list[float], Field(min_length=1)]

MOVES: tuple[Cell, ...] = ((0, 1), (0, -1), (-1, 0), (1, 0))
"""(rows, columns) to the right, left, up and down."""


class Found(NamedTuple):
    """The result of a search."""

    way: list[Cell]
    """Path from the start to the goal, both included; empty if there is none."""
    visited: list[Cell]
    """Cells that the search visited, in order: fewer cells mean less work."""


def neighbours(free: Map, cell: Cell) -> list[Cell]:
    """Return the free cells one step away: right, left, up, down.

    >>> neighbours(np.array([[1, 1], [1, 0]], bool), (0, 0))
    [(0, 1), (1, 0)]
    """
    rows, columns = free.shape
    near = [(cell[0] + down, cell[1] + right) for down, right in MOVES]
    return [(r, c) for r, c in near if 0 <= r < rows and 0 <= c < columns and free[r, c]]


def path_to(cell: Cell, before: Mapping[Cell, Cell]) -> list[Cell]:
    """Return the path to a cell from each cell's predecessor; the start is its own predecessor."""
    way = [cell]
    while before[cell] != cell:
        cell = before[cell]
        way.append(cell)
    return way[::-1]


class PlanController(Controller):
    """The base of controllers that follow a path on the map, cell by cell.

    They search again at each decision, since the map may have changed.
    """

    abstract = True

    grid: Name = "grid"
    """Perception key of the map, a GridSensor's."""
    cell: Name = "cell"
    """Perception key of the agent's cell in it, a CellSensor's."""
    actuator_name: Name = "move"
    """Action name of its GridMoveActuator."""
    free: Codes = Field(default_factory=lambda: [1.0, 200.0])
    """Codes in the map of the cells that it may enter."""
    goal: Codes = Field(default_factory=lambda: [200.0])
    """Codes in the map of its goals."""

    def search(self, free: Map, start: Cell, goals: Iterable[Cell]) -> Found:
        """Return a path from the start to the nearest goal."""
        raise BlockError(
            _("{type} has no search(self, free, start, goals)", type=type(self).__name__)
        )

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Start without a path."""
        self._found = Found([], [])

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Forget the path."""
        self._found = Found([], [])

    @property
    def found(self) -> Found:
        """The result of its last search."""
        return self._found

    def get_action(self, percept: Percept) -> dict[str, int]:
        """Return the first step of the path; 0 (stay) if there is none."""
        for key in (self.grid, self.cell):
            if key not in percept:
                raise BlockError(
                    _(
                        "{type} needs a GridSensor and a CellSensor, and no sensor has the key "
                        "{key!r}; {hint}",
                        type=type(self).__name__,
                        key=key,
                        hint=suggest(key, percept),
                    )
                )
        grid = np.asarray(percept[self.grid])
        row, column = map(int, percept[self.cell])
        goals = [(int(r), int(c)) for r, c in np.argwhere(np.isin(grid, self.goal))]
        self._found = self.search(np.isin(grid, self.free), (row, column), goals)
        if len(self._found.way) < 2:
            return {self.actuator_name: 0}
        down, right = self._found.way[1]
        return {self.actuator_name: 1 + MOVES.index((down - row, right - column))}

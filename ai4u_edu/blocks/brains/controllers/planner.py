"""What controllers that search their way share: a map, a way on it, one step after the other."""

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
from ai4u_edu.world import WorldView

Cell = tuple[int, int]
"""(row, column); row 0 is on top."""
Map = npt.NDArray[np.bool_]
"""(rows, columns): where one can go."""
Codes = Annotated[list[float], Field(min_length=1)]

STEPS: tuple[Cell, ...] = ((0, 1), (0, -1), (-1, 0), (1, 0))
"""(rows, columns) to the right, left, up and down."""


class Found(NamedTuple):
    """What a search found."""

    way: list[Cell]
    """From the start to the goal, both included; empty if there is none."""
    visited: list[Cell]
    """The cells that it looked at on the way, in that order: the fewer, the less work."""


def neighbours(free: Map, cell: Cell) -> list[Cell]:
    """The cells to which one step leads: right, left, up, down.

    >>> neighbours(np.array([[1, 1], [1, 0]], bool), (0, 0))
    [(0, 1), (1, 0)]
    """
    rows, columns = free.shape
    near = [(cell[0] + down, cell[1] + right) for down, right in STEPS]
    return [(r, c) for r, c in near if 0 <= r < rows and 0 <= c < columns and free[r, c]]


def way_to(cell: Cell, before: Mapping[Cell, Cell]) -> list[Cell]:
    """The way to a cell, of the notes from where each one was reached; the first, from itself."""
    way = [cell]
    while before[cell] != cell:
        cell = before[cell]
        way.append(cell)
    return way[::-1]


class PlanController(Controller):
    """The base of controllers that go, cell by cell, a way that they searched.

    They plan anew at each decision: the map may have changed, and to think is quicker than to walk.
    """

    abstract = True

    grid: Name = "grid"
    """The perception key of the map, a GridSensor's."""
    cell: Name = "cell"
    """The perception key of the agent's place in it, a CellSensor's."""
    actuator_name: Name = "move"
    """Action name of its GridMoveActuator."""
    free: Codes = Field(default_factory=lambda: [1.0, 200.0])
    """Codes, as in the map, of what it may walk on."""
    goal: Codes = Field(default_factory=lambda: [200.0])
    """Codes, as in the map, of what it looks for."""

    def search(self, free: Map, start: Cell, goals: Iterable[Cell]) -> Found:
        """A way from the start to the nearest goal."""
        raise BlockError(f"{type(self).__name__} has no search(self, free, start, goals)")

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Begins without a plan."""
        self._found = Found([], [])

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Forgets the plan."""
        self._found = Found([], [])

    @property
    def found(self) -> Found:
        """What its last search found."""
        return self._found

    def get_action(self, percept: Percept) -> dict[str, int]:
        """The first step of the way; 0 (stay) where there is none."""
        for key in (self.grid, self.cell):
            if key not in percept:
                raise BlockError(
                    f"{type(self).__name__} needs a GridSensor and a CellSensor, and no sensor has "
                    f"the key {key!r}; {suggest(key, percept)}"
                )
        grid = np.asarray(percept[self.grid])
        row, column = map(int, percept[self.cell])
        goals = [(int(r), int(c)) for r, c in np.argwhere(np.isin(grid, self.goal))]
        self._found = self.search(np.isin(grid, self.free), (row, column), goals)
        if len(self._found.way) < 2:
            return {self.actuator_name: 0}
        down, right = self._found.way[1]
        return {self.actuator_name: 1 + STEPS.index((down - row, right - column))}

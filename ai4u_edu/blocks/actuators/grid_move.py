"""An actuator that moves from cell to cell."""

import math
from typing import Annotated, ClassVar

from gymnasium.spaces import Discrete
from pydantic import Field

from ai4u_edu.base.parameters import Name, Point
from ai4u_edu.blocks.actuators.choice import ChoiceActuator
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.groups import check_groups
from ai4u_edu.blocks.sensors.cells import Cell, OnGrid
from ai4u_edu.world import Body, WorldView

STEPS: tuple[Cell, ...] = ((0, 0), (0, 1), (0, -1), (-1, 0), (1, 0))
"""(rows, columns) of each choice: none, right, left, up, down."""


class GridMoveActuator(OnGrid, ChoiceActuator):
    """Moves the agent to a neighbouring cell of a grid: exactly one cell per decision.

    - 0: stay.
    - 1: right (column + 1), 2: left, 3: up (row - 1), 4: down; as in DiscreteArrowController.

    The agent turns to where it goes, moves there at an even speed during the decision, and ends
    exactly in the centre of the cell, whatever it bumped into. It can't leave the grid or enter a
    cell with a body of a group in ``blocked_by``: then it only turns. It touches or pushes any
    other body. Without floor below it falls, and in the air nothing moves it.

    Action: Discrete(5), as an int. Source: ours, for the lessons on search and Q-learning of AI4U's
    grid world.
    """

    action_name: str = "move"
    blocked_by: Annotated[list[Name], Field(max_length=32)] = Field(
        default_factory=lambda: ["wall"]
    )
    """Tags of the bodies that block the way."""

    looks_at: ClassVar[tuple[str, ...]] = ("bodies",)

    carried: ClassVar[tuple[str, ...]] = ("_way",)

    def space(self) -> Discrete:
        """Return the five choices: stay, right, left, up, down."""
        return Discrete(len(STEPS))

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the groups and lay out the grid."""
        check_groups(self, "blocked_by", view)
        self._agent, self._view, self._grid = agent, view, self.grid()
        self._way: list[Point] = []
        self._built_for = -1

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Forget the path."""
        self._way = []

    def act(self, body: Body, action: tuple[float, ...]) -> None:
        """Plan the path, in the first tick of a decision."""
        if self._way or not body.on_ground:
            return
        down, right = STEPS[int(action[0])]
        start = body.position
        row, column = self._grid.cell_at(*start)
        cell = row + down, column + right
        end = self._grid.centre_of((row, column) if self._blocked(cell) else cell)
        ticks = self._agent.brain.skip_frame + 1
        shares = [tick / ticks for tick in range(1, ticks + 1)]
        # the end comes twice: once more after the last tick, in which something may push the body
        self._way = [_between(start, end, share) for share in shares] + [end]
        self._go(body, math.atan2(-down, right) if down or right else None)

    def on_tick(self, body: Body, view: WorldView) -> None:
        """Take the next step of the path."""
        if self._way:
            self._go(body)

    def _go(self, body: Body, heading: float | None = None) -> None:
        body.move_to(*self._way.pop(0), heading=body.heading if heading is None else heading)

    def _blocked(self, cell: Cell) -> bool:
        if not self._grid.holds(cell):
            return True
        if self._built_for != self._view.generation:
            self._build()
        x, y = self._grid.centre_of(cell)
        number = self._grid.number(cell)
        return any(
            math.hypot(x - at_x, y - at_y) <= reach + self.cell_size
            and number in self._grid.cells_of(wall)
            for wall, reach in self._walls
            if not wall.fallen
            for at_x, at_y in [wall.position]
        )

    def _build(self) -> None:
        """Look up the bodies that block the way, once for each build of the world."""
        self._built_for = self._view.generation
        names = [name for tag in self.blocked_by for name in self._view.named(tag)]
        walls = [self._view[name] for name in dict.fromkeys(names)]
        self._walls = [
            (wall, wall.sampled.shape.reach) for wall in walls if wall is not self._agent.body
        ]


def _between(start: Point, end: Point, share: float) -> Point:
    (x, y), (to_x, to_y) = start, end
    return (1 - share) * x + share * to_x, (1 - share) * y + share * to_y

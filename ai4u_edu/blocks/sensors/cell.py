"""A sensor of the grid cell that the agent is in."""

import numpy as np
from gymnasium.spaces import Box

from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.sensors.cells import OnGrid
from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.world import BodyView, WorldView


class CellSensor(OnGrid, Sensor):
    """[row, column] of the cell in which the agent's centre is.

    Row 0 is on top, column 0 on the left, as in the map of a GridSensor: with both sensors,
    ``percept["grid"][row, column]`` is the code of the agent's own cell. ``tuple(percept["cell"])``
    can be the state in a Q-table. Outside the grid it reads the nearest cell.

    Reading: (2,) whole numbers. Source: ours.
    """

    def space(self) -> Box:
        """Return the range of rows and columns."""
        last = np.array([self.rows - 1, self.columns - 1], np.int32)
        return Box(np.zeros_like(last), last, dtype=np.int32)

    def slots(self) -> tuple[str, ...]:
        """Return the names of the two numbers."""
        return "row", "column"

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Lay out the grid."""
        self._grid = self.grid()

    def read(self, body: BodyView, view: WorldView) -> tuple[int, int]:
        """Return the reading."""
        row, column = self._grid.cell_at(*body.position)
        return max(0, min(self.rows - 1, row)), max(0, min(self.columns - 1, column))

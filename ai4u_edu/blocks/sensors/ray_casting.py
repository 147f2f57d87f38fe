"""A grid of rays in perspective."""

from collections.abc import Callable
from functools import partial
from typing import Annotated, Any

import numpy as np
import numpy.typing as npt
from gymnasium.spaces import Box
from pydantic import Field

from ai4u_edu.base.parameters import Degrees, quantity
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.groups import check_groups
from ai4u_edu.blocks.sensors.pictures import CodeLegend
from ai4u_edu.blocks.sensors.ray_sensor import RayPicture, RaySensor, picture_of, spread
from ai4u_edu.blocks.sensors.sensor import Array
from ai4u_edu.world import BodyView, WorldView


class RayCastingSensor(RaySensor):
    """Codes and distances of what a grid of rays hits: a small picture, row 0 on top.

    Each ray reads the code of what it hits. A ray that points down hits the floor, or the void
    beyond its edge, so an agent can see a cliff. Column 0 is the leftmost; the angle of column i
    from the middle is ``fov * ((i + 1) / (n + 1) - 1/2)``, clockwise.

    Reading: (rows, columns) codes; with ``return_distance`` (2, rows, columns), codes first, then
    distances along the rays; without ``return_code`` (rows, columns) distances alone. Codes are
    0..1, a share of the largest code in use (whole codes with ``normalized=False``). Distances are
    0..1, a share of ``vision_max_distance`` (metres with ``normalize_distance=False``); 0 if the
    ray hits nothing. ``flattened`` gives one row.

    Source: AI4U's RayCastingSensor.

    Differs from AI4U: ``field_of_view`` is the whole angle; there fieldOfView is the angle to each
    side (45 there is 90 here). ``vertical_field_of_view`` is a separate parameter.
    ``no_object_code`` is 0 and ``normalize_distance`` on.
    """

    rows: Annotated[int, Field(ge=1, le=256)] = 10
    """Rows of rays."""
    columns: Annotated[int, Field(ge=1, le=256)] = 10
    """Columns of rays."""
    vertical_field_of_view: Annotated[float, quantity("deg", gt=0, lt=180)] = 45.0
    """The whole vertical angle."""
    vertical_shift: Degrees = 30.0
    """Angle by which the middle row points down."""
    flattened: bool = False
    """True reads one row of numbers instead of a grid."""

    def space(self) -> Box:
        """Return the ranges of codes and distances (metres, or 0..1 with normalize_distance)."""
        high = self._by_plane(self.largest_code, self.farthest).astype(np.float32)
        return Box(np.zeros_like(high), high)

    def scale(self) -> Any:
        """Return the divisors: the largest code, and 1 for distances (see normalize_distance)."""
        return self._by_plane(self.largest_code, 1.0)

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the groups and prepare the rays."""
        check_groups(self, "group_code", view)
        shift = np.radians(self.horizontal_shift)
        angles = -spread(self.columns, self.field_of_view) - shift
        pitches = -spread(self.rows, self.vertical_field_of_view)
        pitches -= np.radians(self.vertical_shift)
        self._grid = view.ray_grid(
            angles.tolist(),
            pitches.tolist(),
            self.vision_max_distance,
            self.code_of,
            **self._options(),
        )

    def write(self, out: Array, body: BodyView, view: WorldView) -> None:
        """Cast the rays."""
        grid = self._grid
        grid.cast(body)
        planes = out.reshape(-1, self.rows, self.columns)
        if self.return_code:
            planes[0] = grid.codes
        if self.return_distance:
            far = self.vision_max_distance / self.farthest
            np.divide(grid.distances, far, out=planes[-1], casting="unsafe")

    def capture(self) -> Callable[[], RayPicture]:
        """Return a function that makes the picture of the last reading, its rays row by row."""
        grid = self._grid
        return partial(
            picture_of, grid.last_cast(), grid.pitches, self.vision_max_distance, self._names()
        )

    def legend(self) -> CodeLegend:
        """Return the group of each code."""
        scale = self.largest_code if self.normalized else 1.0
        codes = tuple(code / scale for code in self.group_code.values())
        planes = self.return_code + self.return_distance
        groups, nothing = tuple(self.group_code), self.no_object_code / scale
        shape = self.rows, self.columns
        return CodeLegend(shape, codes, groups, planes, nothing, has_codes=self.return_code)

    def _by_plane(self, code: float, distance: float) -> npt.NDArray[np.float64]:
        """Return one number for codes and one for distances, in the shape of the reading."""
        numbers = [code] * self.return_code + [distance] * self.return_distance
        planes = [np.full((self.rows, self.columns), number) for number in numbers]
        whole = np.stack(planes) if len(planes) > 1 else planes[0]
        return whole.ravel() if self.flattened else whole

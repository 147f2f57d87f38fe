"""A fan of rays."""

from collections.abc import Callable
from functools import partial
from typing import Annotated, Any

import numpy as np
import numpy.typing as npt
from gymnasium.spaces import Box
from pydantic import Field

from ai4u_edu.base.parameters import quantity
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.groups import check_groups
from ai4u_edu.blocks.sensors.ray_sensor import RayPicture, RaySensor, picture_of, spread
from ai4u_edu.blocks.sensors.sensor import Array
from ai4u_edu.world import BodyView, RayFan, RayGrid, WorldView


class LinearRayCastingSensor(RaySensor):
    """Codes and distances of what a fan of rays hits: a laser scanner.

    The angle of ray i from the heading is ``(i + 1) * fov / (n + 1) - fov / 2 - shift``, positive
    to the left: as in a laser scan, ray 0 is the rightmost and the last one the leftmost. The rays
    are level; with ``vertical_shift`` all point down by that angle, and hit the floor as well.

    Reading: (n,) codes; with ``return_distance`` (2 n,): code, then distance, ray by ray; without
    ``return_code`` (n,) distances alone. Codes are 0..1, a share of the largest code in use (whole
    codes with ``normalized=False``). Distances are 0..1, a share of ``vision_max_distance`` (metres
    with ``normalize_distance=False``); 0 if the ray hits nothing.

    Source: AI4U's LinearRayCastingSensor.

    Differs from AI4U: ``no_object_code`` is 0, there 1. ``normalize_distance`` is on, there off.
    ``vertical_shift`` is 0 and points down; there verticalShift is 30 and points up, so that what
    is -15 there is 15 here. All rays point down alike; there the whole fan is tilted, so that rays
    at its sides point down less. A code's range ends at the largest code; there it is 0..255.
    """

    number_of_rays: Annotated[int, Field(ge=1, le=1024)] = 10
    """Number of rays."""
    vertical_shift: Annotated[float, quantity("deg", gt=-90, lt=90)] = 0.0
    """Angle by which all rays point down; below 0 up."""

    def space(self) -> Box:
        """Return the ranges of codes and distances (metres, or 0..1 with normalize_distance)."""
        high = self._by_ray(self.largest_code, self.farthest).astype(np.float32)
        return Box(np.zeros_like(high), high)

    def scale(self) -> Any:
        """Return the divisors: the largest code, and 1 for distances (see normalize_distance)."""
        return self._by_ray(self.largest_code, 1.0)

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the groups and prepare the rays."""
        check_groups(self, "group_code", view)
        angles = spread(self.number_of_rays, self.field_of_view)
        angles -= np.radians(self.horizontal_shift)
        reach, options = self.vision_max_distance, self._options()
        self._pitches = np.radians([-self.vertical_shift])
        self._fan: RayFan | RayGrid
        if self.vertical_shift:
            pitches = self._pitches.tolist()
            self._fan = view.ray_grid(angles.tolist(), pitches, reach, self.code_of, **options)
        else:  # level rays meet no floor, so that they need no heights
            self._fan = view.ray_fan(angles.tolist(), reach, self.code_of, **options)
        self._far = np.array(self.vision_max_distance)
        self._shares = np.zeros_like(self._fan.distances)

    def write(self, out: Array, body: BodyView, view: WorldView) -> None:
        """Cast the rays."""
        fan = self._fan
        fan.cast(body)
        if not self.return_code:
            out[:] = self._measured()
        elif not self.return_distance:
            out[:] = fan.codes
        else:
            out[0::2], out[1::2] = fan.codes, self._measured()

    def _measured(self) -> Array:
        """Return the distances in the unit of the reading."""
        distances = self._fan.distances
        if not self.normalize_distance:
            return distances
        np.divide(distances, self._far, self._shares)
        return self._shares

    def capture(self) -> Callable[[], RayPicture]:
        """Return a function that makes the picture of the last reading."""
        cast, reach = self._fan.last_cast(), self.vision_max_distance
        return partial(picture_of, cast, self._pitches, reach, self._names())

    def _by_ray(self, code: float, distance: float) -> npt.NDArray[np.float64]:
        """Return one number for codes and one for distances, in the order of the reading."""
        parts = [code] * self.return_code + [distance] * self.return_distance
        return np.tile(np.array(parts), self.number_of_rays)

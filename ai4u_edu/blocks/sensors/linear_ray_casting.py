"""A flat fan of rays."""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Annotated, Any

import numpy as np
import numpy.typing as npt
from gymnasium.spaces import Box
from pydantic import Field

from ai4u_edu.base.errors import BlockError
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.groups import check_groups
from ai4u_edu.blocks.sensors.ray_sensor import RayPicture, RaySensor, groups_met, spread
from ai4u_edu.blocks.sensors.sensor import Array
from ai4u_edu.world import BodyView, Cast, WorldView


class LinearRayCastingSensor(RaySensor):
    """Codes and distances of what a level fan of rays hits: a laser scanner.

    The angle of ray i from the heading is ``(i + 1) * fov / (n + 1) - fov / 2 - shift``, positive
    to the left: as in a laser scan, ray 0 is the rightmost and the last one the leftmost.

    Reading: (n,) codes; with ``return_distance`` (2 n,): code, then distance, ray by ray; without
    ``return_code`` (n,) distances alone. Codes are 0..1, a share of the largest code in use (whole
    codes with ``normalized=False``). Distances are 0..1, a share of ``vision_max_distance`` (metres
    with ``normalize_distance=False``); 0 if the ray hits nothing.

    Source: AI4U's LinearRayCastingSensor.

    Differs from AI4U: ``no_object_code`` is 0, there 1. ``normalize_distance`` is on, there off.
    The fan is level, there verticalShift (30 degrees) tilts it.
    """

    number_of_rays: Annotated[int, Field(ge=1, le=1024)] = 10
    """Number of rays."""
    return_code: bool = True
    """True reads the code of what each ray hits; False needs ``return_distance``."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if not (self.return_code or self.return_distance):
            raise BlockError(
                f"{type(self).__name__} {self.perception_key!r}: expected return_code or "
                "return_distance, got neither"
            )

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
        self._fan = view.ray_fan(
            angles.tolist(), self.vision_max_distance, self.code_of, **self._options()
        )
        self._far = np.array(self.vision_max_distance)
        self._shares = np.zeros(self.number_of_rays)

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
        return partial(_picture, self._fan.last_cast(), self.vision_max_distance, self._names())

    def _by_ray(self, code: float, distance: float) -> npt.NDArray[np.float64]:
        """Return one number for codes and one for distances, in the order of the reading."""
        parts = [code] * self.return_code + [distance] * self.return_distance
        return np.tile(np.array(parts), self.number_of_rays)


def _picture(cast: Cast, reach: float, names: Mapping[float, str]) -> RayPicture:
    hit = cast.distances > 0
    length = np.where(hit, cast.distances, reach)[:, None]
    x, y, z = cast.origin
    flat = length * cast.directions + (x, y)
    ends = np.column_stack([flat, np.full(len(flat), z)])
    return RayPicture(cast.origin, ends, groups_met(names, cast.codes, hit))

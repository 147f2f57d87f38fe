"""A flat fan of rays."""

from typing import Annotated, Any

import numpy as np
from gymnasium.spaces import Box
from pydantic import Field

from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.sensors.ray_sensor import RayPicture, RaySensor, spread
from ai4u_edu.blocks.sensors.sensor import Array
from ai4u_edu.world import BodyView, WorldView


class LinearRayCastingSensor(RaySensor):
    """What lies in each direction, level with the eye: like a laser scanner.

    Ray i looks at ``(i + 1) * fov / (n + 1) - fov / 2 - shift`` from the heading, positive to the
    left: as in a laser scan, ray 0 is the rightmost and the last one the leftmost.

    Reading: (n,) codes; with ``return_distance`` (2 n,): code, then distance, ray by ray; distance
    0 where nothing was met.

    Source: AI4U's LinearRayCastingSensor.
    """

    number_of_rays: Annotated[int, Field(ge=1, le=1024)] = 10

    def space(self) -> Box:
        """Codes, and distances in metres (or 0..1 with normalize_distance)."""
        high = np.full(self.number_of_rays, self.largest_code, np.float32)
        if self.return_distance:
            high = np.stack([high, np.full_like(high, self.farthest)], axis=1).ravel()
        return Box(np.zeros_like(high), high)

    def scale(self) -> Any:
        """Codes by the largest one; distances have normalize_distance."""
        by = np.full(self.number_of_rays, self.largest_code)
        return np.stack([by, np.ones_like(by)], axis=1).ravel() if self.return_distance else by

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Prepares the rays."""
        angles = spread(self.number_of_rays, self.field_of_view)
        angles -= np.radians(self.horizontal_shift)
        self._fan = view.ray_fan(
            angles.tolist(), self.vision_max_distance, self.code_of, **self._options()
        )

    def write(self, out: Array, body: BodyView, view: WorldView) -> None:
        """Casts the fan."""
        fan = self._fan
        fan.cast(body)
        if not self.return_distance:
            out[:] = fan.codes
            return
        out[0::2] = fan.codes
        far = self.vision_max_distance / self.farthest
        np.divide(fan.distances, far, out=out[1::2], casting="unsafe")

    def picture(self) -> RayPicture:
        """The rays of the last reading."""
        fan = self._fan
        hit = fan.distances > 0
        length = np.where(hit, fan.distances, self.vision_max_distance)[:, None]
        x, y, z = fan.origin
        flat = length * fan.directions + (x, y)
        ends = np.column_stack([flat, np.full(len(flat), z)])
        return RayPicture(fan.origin, ends, self._groups(fan.codes, hit))

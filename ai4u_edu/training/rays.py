"""What rays met, in numbers that a network understands at once. Loads torch."""

from typing import TypeGuard

import numpy as np
import torch
from torch import Tensor, nn

from ai4u_edu.agent import BasicAgent
from ai4u_edu.blocks import LinearRayCastingSensor
from ai4u_edu.blocks.sensors.ray_sensor import RaySensor
from ai4u_edu.blocks.sensors.sensor import Sensor

CLOSE = 0.5
"""What is at arm's length counts for 1, what is as far as a ray reaches for 1 - CLOSE."""


class Rays(nn.Module):  # type: ignore[misc]  # seen without its types
    """How close each ray saw each kind of thing; 0 where it saw none.

    A code is a name: that water has a larger one than food says nothing, and a network would spend
    most of its neurons on telling one from the other. What has no code of its own stays unseen.

    Args:
        sensor: with codes and distances.
        first: where its readings begin in an observation.
    """

    def __init__(self, sensor: RaySensor, first: int) -> None:
        super().__init__()
        self.codes: Tensor
        self.distances: Tensor
        self.kinds: Tensor
        places = first + np.arange(np.prod(sensor.space().shape or ()))
        by_ray = isinstance(sensor, LinearRayCastingSensor)
        codes, distances = places.reshape(-1, 2).T if by_ray else places.reshape(2, -1)
        kinds = sorted(set(sensor.group_code.values()) - {sensor.no_object_code})
        self.register_buffer("codes", torch.as_tensor(codes.copy()))
        self.register_buffer("distances", torch.as_tensor(distances.copy()))
        self.register_buffer("kinds", torch.as_tensor(kinds, dtype=torch.float32))
        self.largest = sensor.largest_code if sensor.normalized else 1.0
        self.farthest = sensor.farthest
        self.width = len(codes) * len(kinds)

    def forward(self, seen: Tensor) -> Tensor:
        """(n, rays * kinds) of (n, r) readings."""
        codes = torch.round(seen[:, self.codes] * self.largest)
        close = 1.0 - CLOSE / self.farthest * seen[:, self.distances]
        met = codes.unsqueeze(2) == self.kinds
        return (met.to(torch.float32) * close.unsqueeze(2)).flatten(1)


def rays_of(agent: BasicAgent) -> list[Rays]:
    """Those of an agent's sensors that tell both what their rays met and how far it is."""
    found: list[Rays] = []
    first = 0
    for sensor in agent.bound_blocks.sensors:
        if sensor.is_input:
            if _tells_both(sensor):
                found.append(Rays(sensor, first))
            first += int(np.prod(sensor.observation_space().shape or (1,)))
    return found


def _tells_both(sensor: Sensor) -> TypeGuard[RaySensor]:
    both = isinstance(sensor, RaySensor) and sensor.return_distance
    return both and getattr(sensor, "return_code", True) and sensor.stacked_observations == 1

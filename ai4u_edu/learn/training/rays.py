"""Encoding of ray readings as nearness by kind, for networks. Loads torch."""

from typing import TypeGuard

import numpy as np
import torch
from torch import Tensor, nn

from ai4u_edu.agent import BasicAgent
from ai4u_edu.blocks import LinearRayCastingSensor
from ai4u_edu.blocks.sensors.ray_sensor import RaySensor
from ai4u_edu.blocks.sensors.sensor import Sensor

CLOSE = 0.5
"""Range of the nearness: 1 at distance 0, 1 - CLOSE at the end of a ray."""


class RayNearness(nn.Module):  # type: ignore[misc]  # seen without its types
    """Nearness of each kind of thing on each ray; 0 where there is none.

    A code is only a name: water's being larger than food's means nothing, and a network would spend
    most of its neurons on telling them apart. Things without a code stay unseen.

    Args:
        sensor: with codes and distances.
        first: index of its first reading in an observation.
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
        """Return (n, rays * kinds) from (n, r) readings."""
        codes = torch.round(seen[:, self.codes] * self.largest)
        close = 1.0 - CLOSE / self.farthest * seen[:, self.distances]
        met = codes.unsqueeze(2) == self.kinds
        return (met.to(torch.float32) * close.unsqueeze(2)).flatten(1)


def rays_of(agent: BasicAgent) -> list[RayNearness]:
    """Return encoders for an agent's sensors that give both codes and distances."""
    found: list[RayNearness] = []
    first = 0
    for sensor in agent.bound_blocks.sensors:
        if sensor.is_input:
            if _tells_both(sensor):
                found.append(RayNearness(sensor, first))
            first += int(np.prod(sensor.observation_space().shape or (1,)))
    return found


def _tells_both(sensor: Sensor) -> TypeGuard[RaySensor]:
    both = isinstance(sensor, RaySensor) and sensor.return_code and sensor.return_distance
    return both and sensor.stacked_observations == 1

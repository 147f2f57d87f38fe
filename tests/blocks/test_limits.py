"""Parameters that would need too much memory, or break the physics, are refused."""

from typing import Any

import pytest

from ai4u_edu import (
    BasicAgent,
    BoxShape,
    CapsuleShape,
    CircleShape,
    GridSensor,
    LinearRayCastingSensor,
    LocalGridSensor,
    RayCastingSensor,
    StepSensor,
    TouchRewardFunc,
)
from ai4u_edu.base.errors import BlockError, ParameterError
from ai4u_edu.world import BodyDescription, PolygonShape, SegmentShape, Variation


@pytest.mark.parametrize(
    ("make", "told"),
    [
        (lambda: BasicAgent(body="x", reward_scale=1e308), "reward_scale: expected at most 1e"),
        (lambda: BasicAgent(body="x", priority=10**400), "priority: expected at most 2.14748e"),
        (lambda: BasicAgent(body="x", max_steps_per_episode=10**20), "expected at most 2.14748e"),
        (lambda: TouchRewardFunc(target="x", reward=-1e20), "reward: expected at least -1e"),
        (lambda: TouchRewardFunc(target="x", cool_down=1e300), "cool_down: expected at most 1e"),
        (lambda: StepSensor(max_size=10**400), "max_size: expected at most"),
        (lambda: CircleShape(radius=1e-9), "radius: expected at least 0.0001, got 1e-09"),
        (lambda: BoxShape(size=(1, 1e-200)), r"size\[1\]: expected at least 0.0001"),
        (lambda: CapsuleShape(length=1e-300), "length: expected at least 0.0001"),
        (lambda: SegmentShape(a=(0, 0), b=(1e-6, 0)), "expected ends at least 0.0001 m apart"),
        (
            lambda: PolygonShape(vertices=((1, 1), (1.00001, 1), (1, 1.00001))),
            r"expected an area of at least 1e-08 m\^2",
        ),
        (lambda: BodyDescription(name="x", mass=1e-30), "mass: expected at least 1e-06"),
        (
            lambda: BodyDescription(name="x", random=Variation(scale=(1e-9, 1))),
            r"scale\[0\]: expected at least 0.001",
        ),
    ],
)
def test_numbers_that_nothing_can_be_done_with(make: Any, told: str) -> None:
    with pytest.raises(ParameterError, match=told):
        make()


@pytest.mark.parametrize(
    "make",
    [
        lambda: LocalGridSensor(width=512, height=512, channels=[f"c{i}" for i in range(64)]),
        lambda: LocalGridSensor(stacked_observations=1000),
        lambda: RayCastingSensor(rows=256, columns=256, stacked_observations=1000),
        lambda: RayCastingSensor(rows=256, columns=256, delay=1000),
        lambda: GridSensor(rows=512, columns=512, group_code={"x": 1}, stacked_observations=100),
    ],
)
def test_readings_that_would_take_up_all_memory(make: Any) -> None:
    with pytest.raises(BlockError, match="expected at most 8388608 numbers in the readings that"):
        make().observation_space()


def test_large_readings_that_fit() -> None:
    space = LinearRayCastingSensor(number_of_rays=1024, stacked_observations=1000)
    assert space.observation_space().shape is not None
    picture = LocalGridSensor(width=512, height=512, stacked_observations=4)
    assert picture.observation_space().shape == (512, 512, 20)

"""Information about an agent's blocks in a snapshot."""

import gc
from collections.abc import Callable
from weakref import ref

import numpy as np
import pytest

from ai4u_edu import (
    BasicAgent,
    BoxShape,
    CircleShape,
    ControlRequestor,
    LinearRayCastingSensor,
    LocalBrain,
    RayCastingSensor,
    RBMoveActuator,
    Sensor,
    World,
)
from ai4u_edu.snapshot import capture_snapshot

SENSORS: list[Callable[[], Sensor]] = [
    lambda: LinearRayCastingSensor(group_code={"box": 1}, number_of_rays=5, perception_key="eyes"),
    lambda: RayCastingSensor(
        group_code={"box": 1}, rows=3, columns=4, vertical_shift=0, perception_key="eyes"
    ),
]


def driver(sensor: Sensor) -> ControlRequestor:
    world = World()
    world.add_body("robot", CircleShape(radius=0.5))
    world.add_body("box", BoxShape(size=(2, 6)), position=(4.0, 0.3), height=2.0, tags=("box",))
    agent = BasicAgent(
        body="robot",
        sensors=[sensor],
        actuators=[RBMoveActuator()],
        brains=[LocalBrain(controller=lambda percept: {"move": [1.0, 0.5, 0.0, 0.0]})],
    )
    sim = ControlRequestor(world, [agent])
    sim.reset(1)
    return sim


@pytest.mark.parametrize("sensor", SENSORS)
def test_rays_that_are_looked_at_later_are_those_of_their_time(
    sensor: Callable[[], Sensor],
) -> None:
    sim = driver(sensor())
    at_once, later = [], []
    for _ in range(3):
        sim.step()
        seen = capture_snapshot(sim).agents[0].rays
        later.append(seen)
        at_once.append(sim.agents[0].sensors[0].picture())  # type: ignore[attr-defined]
    for early, late in zip(at_once, later, strict=True):
        assert "eyes" in late
        assert list(late) == ["eyes"]
        assert late["eyes"].origin == early.origin
        assert np.array_equal(late["eyes"].ends, early.ends)
        assert late["eyes"].groups == early.groups
        assert late["eyes"] is late["eyes"]
    assert "box" in at_once[0].groups
    assert not np.array_equal(at_once[0].ends, at_once[2].ends)


@pytest.mark.parametrize("sensor", SENSORS)
def test_a_picture_of_the_past_does_not_hold_on_to_the_world(sensor: Callable[[], Sensor]) -> None:
    sim = driver(sensor())
    seen, world = capture_snapshot(sim).agents[0].rays, ref(sim.world)
    del sim
    gc.collect()
    assert world() is None
    assert len(seen["eyes"].groups) == len(seen["eyes"].ends)

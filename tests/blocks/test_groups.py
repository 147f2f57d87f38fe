"""Groups that do not exist in the world: all missing is an error, some missing is not."""

from typing import Any

import pytest

from ai4u_edu import (
    AreaOrientationSensor,
    BoxShape,
    CircleShape,
    FloatArrayCompositeSensor,
    GridMoveActuator,
    GridSensor,
    LinearRayCastingSensor,
    LocalGridSensor,
    RayCastingSensor,
    World,
    WorldView,
)
from ai4u_edu.base.errors import BlockError
from tests.builders import small_sim

TYPO = {"tragt": 1}


def marked_world() -> World:
    """The small world with a tagged floor and a tagged area."""
    world = World()
    world.add_floor("plate", BoxShape(size=(20, 20)), tags=("ice",))
    world.add_area("bay", CircleShape(radius=1), tags=("goal",))
    world.add_body("robot", CircleShape(radius=0.5))
    world.add_body("box", BoxShape(size=(1, 1)), position=(4, 0), tags=("target",))
    return world


@pytest.mark.parametrize(
    "sensor",
    [
        LinearRayCastingSensor(group_code=TYPO),
        RayCastingSensor(group_code=TYPO),
        GridSensor(group_code=TYPO),
        AreaOrientationSensor(target_group="target", group_code=TYPO),
        LocalGridSensor(channels=list(TYPO)),
        FloatArrayCompositeSensor(sensors=[LinearRayCastingSensor(group_code=TYPO)]),
    ],
    ids=lambda sensor: type(sensor).__name__,
)
def test_a_sensor_whose_groups_nothing_carries(sensor: Any) -> None:
    with pytest.raises(BlockError, match="carries the tag 'tragt'; did you mean 'target'") as told:
        small_sim([sensor], world=marked_world())
    assert f"{type(sensor).__name__} {sensor.perception_key!r}: " in str(told.value)


def test_an_actuator_that_nothing_would_stop() -> None:
    with pytest.raises(BlockError, match=r"blocked_by: .* 'tragt'; did you mean 'target'"):
        small_sim(actuators=[GridMoveActuator(blocked_by=["tragt"])], world=marked_world())


def test_each_unknown_group_is_told() -> None:
    with pytest.raises(BlockError, match=r"'tragt'; did you mean 'target'\?; .*'ise'; did you"):
        small_sim([RayCastingSensor(group_code={"tragt": 1, "ise": 2})], world=marked_world())


@pytest.mark.parametrize("tag", ["goal", "bay"])
def test_a_ray_meets_no_area(tag: str) -> None:
    with pytest.raises(BlockError, match="known are 'ice', 'target'"):
        small_sim([LinearRayCastingSensor(group_code={tag: 1})], world=marked_world())


@pytest.mark.parametrize(
    "sensor",
    [
        LinearRayCastingSensor(),  # nothing is asked for
        LinearRayCastingSensor(group_code={"ice": 1}),
        RayCastingSensor(group_code={"target": 1, "fruit": 2}),  # fruit is in another world
        GridSensor(group_code={"goal": 1}),
        GridSensor(),
        LocalGridSensor(channels=["void"]),
        LocalGridSensor(channels=["goal"]),
        LocalGridSensor(),
    ],
)
def test_groups_that_are_there(sensor: Any) -> None:
    small_sim([sensor], world=marked_world())


def test_endless_ground_is_floor() -> None:
    small_sim([RayCastingSensor(group_code={"floor": 1})])
    with pytest.raises(BlockError, match="'floor'; known are 'ice', 'target'"):
        small_sim([RayCastingSensor(group_code={"floor": 1})], world=marked_world())


def test_a_view_tells_the_tags_by_kind() -> None:
    view = WorldView(marked_world())
    assert view.tags() == {"goal", "ice", "target"}
    assert view.tags("bodies") == {"target"}
    assert view.tags("floors", "areas") == {"goal", "ice"}
    assert WorldView(World()).tags() == {"floor"}

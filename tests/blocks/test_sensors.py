"""Readings of the built-in sensors."""

import math
from typing import Any

import numpy as np
import pytest
from gymnasium.spaces import Box

from ai4u_edu import (
    ActionSensor,
    BearingSensor,
    BoxShape,
    CircleShape,
    DoneSensor,
    FloatArrayCompositeSensor,
    LinearRayCastingSensor,
    OrientationSensor,
    PositionSensor,
    RayCastingSensor,
    RewardFunc,
    RewardSensor,
    SegmentShape,
    Sensor,
    StepSensor,
    VelocitySensor,
)
from ai4u_edu.base.errors import BlockError, NameNotFoundError, ReadingError
from tests.builders import small_sim, small_world


def turned(degrees: float) -> Any:
    """Return the small world with a turned robot."""
    from ai4u_edu import World

    world = World()
    world.add_body("robot", CircleShape(radius=0.5), heading_deg=degrees)
    world.add_body("box", BoxShape(size=(1, 1)), position=(4, 0), tags=("target",))
    return world


@pytest.mark.parametrize("degrees", [0, 30, -90, 180])
def test_orientation_is_cosine_and_distance(degrees: float) -> None:
    sensor = OrientationSensor(target="box", normalized=False)
    reading = small_sim([sensor], world=turned(degrees)).agents[0].percept["orientation"]
    assert reading.tolist() == pytest.approx([math.cos(math.radians(degrees)), 4.0], abs=1e-6)


def test_orientation_cannot_tell_left_from_right_but_bearing_can() -> None:
    left, right = (
        small_sim([OrientationSensor(target="box"), BearingSensor(target="box")], world=turned(d))
        .agents[0]
        .percept
        for d in (40, -40)
    )
    assert left["orientation"] == pytest.approx(right["orientation"])
    assert left["bearing"][0] < -0.6 < 0.6 < right["bearing"][0]


@pytest.mark.parametrize(
    ("info", "near", "far"),
    [("both", [1.0, 0.4], [-2.0, -1.0]), ("angle", [1.0], [-2.0]), ("distance", [0.4], [-1.0])],
)
def test_orientation_out_of_reach(info: Any, near: list[float], far: list[float]) -> None:
    for reach, expected in ((10.0, near), (3.0, far)):
        sensor = OrientationSensor(target="box", info=info, max_distance=reach)
        reading = small_sim([sensor]).agents[0].percept["orientation"]
        assert reading.tolist() == pytest.approx(expected)
        assert sensor.observation_space().contains(reading)


def test_orientation_hidden_behind_a_wall() -> None:
    for height, seen in ((1.0, False), (0.3, True)):
        world = small_world()
        wall = SegmentShape(a=(2, -1), b=(2, 1))
        world.add_body("wall", wall, kind="static", height=height)
        sensor = OrientationSensor(target="box", visibility_test=True)
        reading = small_sim([sensor], world=world).agents[0].percept["orientation"]
        assert (reading.tolist() != [-2.0, -1.0]) is seen


def test_position_global_local_and_of_a_target() -> None:
    percept = (
        small_sim(
            [
                PositionSensor(perception_key="own", normalized=False),
                PositionSensor(perception_key="there", target="box", normalized=False),
                PositionSensor(
                    perception_key="here", target="box", frame="local", normalized=False
                ),
                PositionSensor(perception_key="share", target="box"),
            ],
            world=turned(90),
        )
        .agents[0]
        .percept
    )
    assert percept["own"].tolist() == [0, 0, 0]
    assert percept["there"].tolist() == [4, 0, 0]
    assert percept["here"].tolist() == pytest.approx([0, -4, 0], abs=1e-6)
    assert percept["share"][0] == pytest.approx(4 / 9.5)  # the world reaches to 4.5 m, and 5 more


def test_a_local_position_needs_a_target() -> None:
    with pytest.raises(BlockError, match=r'frame="local" is the way to a target, .*: expected a'):
        small_sim([PositionSensor(frame="local")])


def test_orientation_looks_at_another_target_from_the_next_reading_on() -> None:
    sensor = OrientationSensor(target="box", normalized=False)
    sensor.set_target("ball")  # in no world yet: looked up at setup
    world = small_world()
    world.add_body("ball", CircleShape(radius=0.5), position=(-3, 0))
    sim = small_sim([sensor], world=world)
    agent = sim.agents[0]
    assert agent.percept["orientation"].tolist() == [-1.0, 3.0]
    sensor.set_target("box")
    sim.step()
    assert agent.percept["orientation"].tolist() == [1.0, 4.0]
    sim.reset()
    assert agent.percept["orientation"].tolist() == [1.0, 4.0]
    with pytest.raises(NameNotFoundError, match="did you mean 'ball'"):
        sensor.set_target("bal")
    assert sensor.target == "box"


def test_velocity_is_in_the_bodys_own_frame() -> None:
    def drive(_percept: Any) -> dict[str, Any]:
        return {"move": [0.5, -0.25, 0, 0]}

    sim = small_sim([VelocitySensor()], world=turned(90), controller=drive)
    assert sim.step()["velocity"].tolist() == pytest.approx([1.0, 0.0, 0.25], rel=0.1, abs=0.05)


def test_action_sensor_reads_the_last_action_and_zeros_before() -> None:
    sim = small_sim(
        [ActionSensor(stacked_observations=2)],
        controller=lambda percept: {"move": [0.5, 0, 0, 1]},
    )
    assert sim.agents[0].percept["action"].tolist() == [[0, 0, 0, 0]] * 2
    assert sim.step()["action"].tolist() == [[0, 0, 0, 0], [0.5, 0, 0, 1]]


class PayThree(RewardFunc):
    """Pays 3."""

    def on_update(self, body: Any, view: Any) -> float:
        return 3.0


def test_status_sensors() -> None:
    sim = small_sim(
        [StepSensor(), StepSensor(perception_key="share", normalized=True), RewardSensor()],
        rewards=[PayThree()],
        max_steps_per_episode=2,
        id="red",
    )
    percept = sim.agents[0].percept
    assert (percept["steps"], percept["reward"], percept["done"]) == (0, 0.0, False)
    percept = sim.step()
    assert (percept["steps"], percept["reward"], percept["done"]) == (1, 3.0, False)
    assert percept["share"] == pytest.approx(1 / 300)
    percept = sim.step()
    assert (percept["steps"], percept["done"], percept["id"]) == (2, True, "red")


def test_composite_joins_what_its_children_read() -> None:
    composite = FloatArrayCompositeSensor(
        sensors=[
            BearingSensor(target="box"),
            DoneSensor(),
            VelocitySensor(is_active=False),
            PositionSensor(target="box", normalized=True),
        ],
        stacked_observations=2,
    )
    reading = small_sim([composite]).agents[0].percept["array"]
    assert reading.shape == (2, 6)
    assert reading[0].tolist() == pytest.approx([0, 1, -1, 4 / 9.5, 0, 0])


def test_composite_normalises_on_request_and_refuses_what_is_out_of_range() -> None:
    def composite(**fields: Any) -> FloatArrayCompositeSensor:
        return FloatArrayCompositeSensor(
            sensors=[PositionSensor(target="box", normalized=False)], **fields
        )

    reading = small_sim([composite(normalize=True, min_value=-8, max_value=8)])
    assert reading.agents[0].percept["array"].tolist() == pytest.approx([0.75, 0.5, 0.5])
    with pytest.raises(ReadingError) as caught:
        small_sim([composite()])
    assert str(caught.value) == (
        "agent '0', FloatArrayCompositeSensor 'array': expected numbers from -1 to 1 "
        "(range_min and range_max), got 4 from its PositionSensor 'position'; widen the range, "
        "or set normalized=True on that sensor"
    )
    with pytest.raises(BlockError, match="expected a max above its min"):
        composite(range_min=1, range_max=0)


@pytest.mark.parametrize("stacked", [1, 3])
def test_composite_refuses_what_leaves_the_range_later(stacked: int) -> None:
    composite = FloatArrayCompositeSensor(
        sensors=[VelocitySensor(normalized=True), StepSensor(is_active=True)],
        stacked_observations=stacked,
    )
    sim = small_sim([composite])
    sim.step()
    with pytest.raises(
        ReadingError, match=r"expected numbers from -1 to 1 .* got 2 from its StepS"
    ):
        sim.step()


def test_composite_takes_what_only_rounding_put_beyond() -> None:
    class Edge(Sensor):
        """Reads slightly more than 1."""

        def space(self) -> Box:
            return Box(0.0, 2.0, (1,))

        def read(self, body: Any, view: Any) -> float:
            return 1.000001

    sim = small_sim([FloatArrayCompositeSensor(sensors=[Edge()])])
    sim.step()
    assert sim.agents[0].percept["array"].tolist() == [1.0]


def test_composite_takes_no_text() -> None:
    from ai4u_edu import IDSensor

    with pytest.raises(BlockError, match="IDSensor 'id' reads text; a composite takes numbers"):
        small_sim([FloatArrayCompositeSensor(sensors=[IDSensor()])])


CODES = {"floor": 1, "target": 2, "wall": 4}


def test_fan_reads_right_to_left_like_a_laser_scan() -> None:
    world = small_world()
    world.add_body("wall", BoxShape(size=(1, 1)), position=(0, 3), kind="static", tags=("wall",))
    fan = LinearRayCastingSensor(
        perception_key="fan",
        number_of_rays=3,
        field_of_view=360,
        group_code=CODES,
        return_distance=True,
        normalize_distance=False,
        normalized=False,
    )
    reading = small_sim([fan], world=world).agents[0].percept["fan"]
    # -90, 0 and +90 degrees: nothing on the right, the box ahead, the wall on the left
    assert reading.tolist() == pytest.approx([0, 0, 2, 3.5, 4, 2.5])


def test_fan_normalised_and_shifted() -> None:
    fan = LinearRayCastingSensor(
        perception_key="fan",
        number_of_rays=1,
        horizontal_shift=90,
        group_code=CODES,
        vision_max_distance=10,
        return_distance=True,
    )
    reading = small_sim([fan], world=turned(90)).agents[0].percept["fan"]
    assert reading.tolist() == pytest.approx(
        [0.5, 0.35]
    )  # it looks right of its heading: at the box


def test_grid_sees_floor_box_and_void() -> None:
    grid = RayCastingSensor(
        perception_key="eyes",
        rows=3,
        columns=3,
        field_of_view=120,
        vertical_field_of_view=80,
        vertical_shift=30,
        group_code=CODES,
        normalized=False,
        return_distance=True,
        normalize_distance=False,
    )
    sim = small_sim([grid], world=small_world(plate=6))
    codes, distances = sim.agents[0].percept["eyes"]
    # rows look 10, 30 and 50 degrees down from half a metre up; the plate ends 3 m away, and the
    # box stands beyond its edge, falling
    assert codes.tolist() == [[1, 1, 1], [1, 1, 1], [1, 1, 1]]
    expected = [0.5 / math.sin(math.radians(down)) for down in (10, 30, 50)]
    assert distances[:, 1].tolist() == pytest.approx(expected, rel=1e-5)
    flat = RayCastingSensor(**(grid.values() | {"vertical_shift": 0, "vertical_field_of_view": 8}))
    codes, distances = small_sim([flat]).agents[0].percept["eyes"]
    assert codes[:, 1].tolist() == [2, 2, 2]
    assert codes[:, 0].tolist() == [0, 0, 1]
    assert flat.picture().groups[1] == "target"
    assert flat.picture().ends[4].tolist() == pytest.approx([3.5, 0.0, 0.5])


def test_grid_columns_go_from_left_to_right() -> None:
    world = small_world()
    world.add_body("wall", BoxShape(size=(1, 1)), position=(3, 3), kind="static", tags=("wall",))
    grid = RayCastingSensor(
        perception_key="eyes",
        rows=1,
        columns=3,
        field_of_view=180,
        vertical_shift=0,
        group_code=CODES,
        normalized=False,
        flattened=True,
    )
    assert small_sim([grid], world=world).agents[0].percept["eyes"].tolist() == [4, 2, 0]


@pytest.mark.parametrize(
    "sensor",
    [
        RayCastingSensor(rows=2, columns=3, group_code=CODES, return_distance=True),
        RayCastingSensor(rows=2, columns=3, group_code=CODES, flattened=True),
        LinearRayCastingSensor(group_code=CODES, return_distance=True, normalized=False),
        OrientationSensor(target="box", stacked_observations=3),
        BearingSensor(target="box"),
        PositionSensor(target="box", frame="local"),
        VelocitySensor(normalized=True, noise=0.3),
        ActionSensor(stacked_observations=4),
        StepSensor(),
        RewardSensor(),
    ],
    ids=lambda sensor: type(sensor).__name__,
)
def test_readings_stay_in_their_space_over_a_random_drive(sensor: Any) -> None:
    rng = np.random.default_rng(1)

    def wander(_percept: Any) -> dict[str, Any]:
        return {"move": rng.uniform(-1, 1, 4)}

    sim = small_sim([sensor], controller=wander, skip_frame=4, world=small_world(plate=14))
    space = sensor.observation_space()
    seen = set()
    for _ in range(200):
        reading = np.asarray(sim.step()[sensor.perception_key], space.dtype)
        assert space.contains(reading), (reading, space)
        seen.add(reading.tobytes())
        if sim.agents[0].done:
            sim.reset()
    assert len(seen) > 1 or isinstance(sensor, RewardSensor)

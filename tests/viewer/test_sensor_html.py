"""Readings in the panel: each number with its name, unit and range."""

import re
from typing import Any

import numpy as np
import pytest

from ai4u_edu import (
    ActionSensor,
    AgentArraySensor,
    BearingSensor,
    CellSensor,
    GridSensor,
    HeadingSensor,
    LinearRayCastingSensor,
    LocalGridSensor,
    OrientationSensor,
    PositionSensor,
    PresenceSensor,
    Scene,
    Sensor,
    VelocitySensor,
)
from ai4u_edu.blocks import RayPicture
from ai4u_edu.snapshot.block_info import SensorInfo, Window, block_info_of, sensor_pictures_of
from ai4u_edu.snapshot.theme import RAY_MISS
from ai4u_edu.viewer.panel.sensor_html import sensor_html
from tests.builders import small_sim

EVIL = "<script>alert('&')</script>"


def sense_of(sensor: Sensor) -> tuple[SensorInfo, Any]:
    """Return a sensor's description and its reading."""
    sim = small_sim(sensors=[sensor])
    sim.reset(1)
    (agent,) = sim.agents
    found = {sense.key: sense for sense in block_info_of(agent).sensor_infos}[sensor.perception_key]
    return found, agent.percept[sensor.perception_key]


def lines(html: str) -> list[tuple[str, str]]:
    """(name, number) of each bar."""
    return re.findall('<span>(.*?)</span><div class="bar">.*?</div><b>(.*?)</b>', html)


@pytest.mark.parametrize(
    ("sensor", "names"),
    [
        (BearingSensor(target="box"), ("sine", "cosine")),
        (HeadingSensor(), ("sine", "cosine")),
        (OrientationSensor(target="box"), ("cosine", "distance")),
        (OrientationSensor(target="box", info="distance"), ("distance",)),
        (PositionSensor(), ("x", "y", "z")),
        (PositionSensor(target="box", frame="local"), ("forward", "left", "up")),
        (VelocitySensor(), ("forward", "left", "turning")),
        (PresenceSensor(group="target"), ("box",)),
        (CellSensor(), ("row", "column")),
        (ActionSensor(), ("forward", "turn", "jump", "forward jump")),
    ],
)
def test_each_number_has_its_name(sensor: Sensor, names: tuple[str, ...]) -> None:
    sense, value = sense_of(sensor)
    assert sense.slots == names
    assert tuple(name for name, _ in lines(sensor_html(sense, value, {}))) == names


def test_units_stand_beside_their_numbers() -> None:
    sense, value = sense_of(VelocitySensor())
    told = [number for _, number in lines(sensor_html(sense, value, {}))]
    assert told == [f"0.00 <small>{unit}</small>" for unit in ("m/s", "m/s", "rad/s")]


def test_a_normalised_reading_has_no_unit() -> None:
    assert sense_of(PositionSensor())[0].unit == ""
    assert sense_of(PositionSensor(normalized=False))[0].unit == "m"


def test_what_stands_for_nothing_is_no_end_of_the_range() -> None:
    sense, _ = sense_of(OrientationSensor(target="box"))
    assert (sense.low.tolist(), sense.high.tolist()) == ([-1, 0], [1, 1])
    html = sensor_html(sense, np.array([-2.0, -1.0], np.float32), {})
    assert [number for _, number in lines(html)] == [
        "<small>(-2.00)</small>",
        "<small>(-1.00)</small>",
    ]


def test_stacked_numbers_have_a_strip_of_their_past() -> None:
    sense, value = sense_of(HeadingSensor(stacked_observations=3))
    assert sense.stack == 3
    assert len(sense.low) == 2
    html = sensor_html(sense, value, {})
    assert lines(html) == [("sine", "0.00"), ("cosine", "1.00")]
    assert html.count('<svg class="strip old" viewBox="0 0 3 1"') == 2


def test_many_numbers_are_bars_side_by_side() -> None:
    sensor = AgentArraySensor(perception_key="much", size=20, range_min=-1.0)
    sense, _ = sense_of(sensor)
    html = sensor_html(sense, np.linspace(-1, 1, 20), {})
    assert 'viewBox="0 0 20 1"' in html
    assert "-1.00 to 1.00" in html
    assert html.count("M") == 20
    huge, _ = sense_of(AgentArraySensor(perception_key="huge", size=1000))
    assert "the first 256 of 1000" in sensor_html(huge, np.zeros(1000), {})


def test_stacked_rows_stand_above_the_latest() -> None:
    sensor = AgentArraySensor(perception_key="much", size=20, stacked_observations=3)
    sense, value = sense_of(sensor)
    assert re.findall('class="(strip[^"]*)"', sensor_html(sense, value, {})) == [
        "strip old",
        "strip old",
        "strip",
    ]


def test_rays_have_the_colours_of_what_they_met_and_their_distances_apart() -> None:
    sensor = LinearRayCastingSensor(
        perception_key="fan", number_of_rays=9, group_code={"target": 1}, return_distance=True
    )
    sense, value = sense_of(sensor)
    groups = ("target",) + ("",) * 8
    rays = RayPicture((0, 0, 0), np.zeros((9, 3)), groups)
    value = np.zeros(18)
    value[:2] = 1.0, 0.5
    html = sensor_html(sense, value, {"target": (1, 2, 3)}, rays)
    assert html.count("<svg") == 2
    assert html.count('fill="rgb(1, 2, 3)"') == 2
    assert html.count(f'fill="rgb{RAY_MISS}"') == 2
    assert "what each ray hit" in html
    assert "distance (left to right)" in html
    # the sensor reads its rightmost ray first
    hits = re.findall(r'd="M([0-9.]+) ([0-9.]+)h0.85v([0-9.]+)h-0.85z" fill="rgb\(1, 2, 3\)"', html)
    assert hits == [("8.07", "0.00", "1.00"), ("8.07", "0.50", "0.50")]


def test_pictures_replace_the_numbers() -> None:
    sense, value = sense_of(LocalGridSensor(width=4, height=2, channels=["target"]))
    html = sensor_html(sense, value, {"target": (1, 2, 3)})
    assert 'viewBox="0 0 4 2"' in html
    assert "LocalGridSensor 2 x 4 x 1" in html


def test_a_picture_from_above_knows_what_it_shows() -> None:
    grid, _ = sense_of(LocalGridSensor(width=8, height=4, cell_size=0.5, channels=["target"]))
    assert grid.window == Window((2.0, 4.0), None)
    whole, _ = sense_of(GridSensor(rows=3, columns=5, centre=(1.0, 2.0)))
    assert whole.window == Window((5.0, 3.0), (1.0, 2.0))
    assert sense_of(GridSensor(around=2))[0].window is None


def test_what_a_student_names_is_escaped_and_wrong_names_are_none() -> None:
    class Odd(AgentArraySensor):
        """Its names don't fit."""

        def slots(self) -> tuple[str, ...]:
            return (EVIL, "b")

    fits, value = sense_of(Odd(perception_key="a", size=2))
    html = sensor_html(fits, value, {})
    assert "<script" not in html
    assert "&lt;script&gt;" in html
    assert sense_of(Odd(perception_key="a", size=3))[0].slots == ()


@pytest.mark.parametrize("name", Scene.names())
def test_all_readings_of_all_scenes_can_be_shown(name: str) -> None:
    sim = Scene.load(name).build()
    sim.reset(1)
    for agent in sim.agents:
        rays = sensor_pictures_of(agent).rays
        for sense in block_info_of(agent).sensor_infos:
            reading = agent.percept[sense.key]
            assert sensor_html(sense, reading, {}, rays.get(sense.key))


def test_facts_and_pictures_are_worked_out_once() -> None:
    sim = small_sim(sensors=[LinearRayCastingSensor(perception_key="fan")])
    sim.reset(1)
    (agent,) = sim.agents
    facts, pictures = block_info_of(agent), sensor_pictures_of(agent)
    assert block_info_of(agent) is facts
    assert sensor_pictures_of(agent) is pictures
    sim.step()
    assert sensor_pictures_of(agent) is not pictures
    agent.setup(sim.world)
    sim.reset(1)
    assert block_info_of(agent) is not facts

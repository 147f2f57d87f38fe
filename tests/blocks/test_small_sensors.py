"""HeadingSensor, TruncatedSensor and AgentArraySensor."""

import math
from typing import Any

import numpy as np
import pytest

from ai4u_edu import AgentArraySensor, CircleShape, HeadingSensor, TruncatedSensor, World
from ai4u_edu.base.errors import BlockError, ReadingError
from tests.builders import small_sim, small_world


@pytest.mark.parametrize(
    ("degrees", "expected"),
    [(0, [0, 1]), (90, [1, 0]), (180, [0, -1]), (-90, [-1, 0]), (30, [0.5, math.sqrt(3) / 2])],
)
def test_heading_is_sine_and_cosine(degrees: float, expected: list[float]) -> None:
    world = World()
    world.add_body("robot", CircleShape(), heading_deg=degrees)
    percept = small_sim([HeadingSensor()], world=world).agents[0].percept
    assert percept["heading"].tolist() == pytest.approx(expected, abs=1e-6)


def test_truncated_tells_a_cut_from_an_end() -> None:
    sim = small_sim([TruncatedSensor()], max_steps_per_episode=2)
    assert [sim.step()["truncated"] for _ in range(2)] == [False, True]
    sim.reset()
    assert sim.agents[0].percept["truncated"] is False


def test_a_fall_is_done_but_not_truncated() -> None:
    sim = small_sim(
        [TruncatedSensor()],
        world=small_world(plate=2),
        controller=lambda percept: {"move": [1, 0, 0, 0]},
        max_steps_per_episode=1000,
    )
    while not sim.agents[0].done:
        percept = sim.step()
    assert (percept["done"], percept["truncated"]) == (True, False)


def test_a_script_tells_the_agent_something_until_the_reset() -> None:
    message = AgentArraySensor(size=3)
    sim = small_sim([message])
    key = "__initial_input__"
    assert sim.agents[0].percept[key].tolist() == [0, 0, 0]
    message.set_value(2, 0.5)
    assert sim.step()[key].tolist() == [0, 0, 0.5]
    assert sim.step()[key].tolist() == [0, 0, 0.5]
    message.set_values([1, 0.25, 0])
    assert sim.step()[key].tolist() == [1, 0.25, 0]
    sim.reset()
    assert sim.agents[0].percept[key].tolist() == [0, 0, 0]


def test_a_value_set_at_begin_of_update_state_is_in_the_percept_that_follows() -> None:
    message = AgentArraySensor(size=1, range_max=100)
    sim = small_sim([message])
    agent = sim.agents[0]
    agent.begin_of_update_state.connect(lambda agent: message.set_value(0, agent.steps))
    assert [sim.step()["__initial_input__"].tolist() for _ in range(3)] == [[1], [2], [3]]


@pytest.mark.parametrize(
    ("low", "high", "bounds"), [(0, 1, (0, 1)), (-2, 3, (-2, 3)), (2, 3, (0, 3)), (-3, -2, (-3, 0))]
)
def test_the_space_is_the_range_and_zero(low: float, high: float, bounds: Any) -> None:
    space = AgentArraySensor(size=2, range_min=low, range_max=high).space()
    assert (space.low.tolist(), space.high.tolist()) == ([bounds[0]] * 2, [bounds[1]] * 2)


TITLE = "AgentArraySensor '__initial_input__'"


@pytest.mark.parametrize(
    ("mistake", "text"),
    [
        (lambda s: s.set_value(2, 0), f"{TITLE}: expected an index from 0 to 1, got 2"),
        (lambda s: s.set_value(-1, 0), f"{TITLE}: expected an index from 0 to 1, got -1"),
        (lambda s: s.set_value(0, 1.5), f"{TITLE}: expected values from 0 to 1, got 1.5"),
        (lambda s: s.set_value(0, math.nan), f"{TITLE}: expected values from 0 to 1, got nan"),
        (lambda s: s.set_values([0]), f"{TITLE}: expected 2 values, got 1"),
        (lambda s: s.set_values([0, -1]), f"{TITLE}: expected values from 0 to 1, got -1"),
    ],
)
def test_what_a_script_cannot_say(mistake: Any, text: str) -> None:
    sensor = AgentArraySensor(size=2)
    with pytest.raises(ReadingError) as caught:
        mistake(sensor)
    assert str(caught.value) == text
    assert not np.any(sensor.numbers)  # nothing of it was taken over


def test_an_empty_range_is_refused() -> None:
    with pytest.raises(BlockError) as caught:
        AgentArraySensor(range_min=1, range_max=1)
    assert str(caught.value) == f"{TITLE}: expected range_max above range_min, got 1..1"

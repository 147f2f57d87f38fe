"""Checks of actions: accepted, clipped and refused values."""

from typing import Any

import numpy as np
import pytest

from ai4u_edu.base.errors import ActionError
from tests.builders import small_sim

EXAMPLE = "such as {'move': [0.0, 0.0, 0.0, 0.0]}"


def error_of(action: Any) -> str:
    sim = small_sim(controller=lambda _percept: action)
    before = sim.agents[0].body.position
    with pytest.raises(ActionError) as caught:
        sim.step()
    assert sim.agents[0].body.position == before
    return str(caught.value)


@pytest.mark.parametrize(
    ("action", "text"),
    [
        ({"mov": [1, 0, 0, 0]}, "agent '0' has no actuator 'mov'; did you mean 'move'?"),
        ({"move": [1, 0]}, "action 'move': expected 4 numbers, got 2: [1, 0]"),
        ({"move": 1}, "action 'move': expected 4 numbers, got 1: 1"),
        ({"move": "go"}, "action 'move': expected 4 numbers, got 'go'"),
        ({"move": ["a", 0, 0, 0]}, "action 'move': expected 4 numbers, got ['a', 0, 0, 0]"),
        ({"move": None}, "action 'move': expected 4 numbers, got None"),
        (None, f"agent '0': expected an action by actuator name, {EXAMPLE}, got None"),
        (
            [1, 0, 0, 0],
            f"agent '0': expected an action by actuator name, {EXAMPLE}, got [1, 0, 0, 0]",
        ),
    ],
)
def test_what_is_no_action_is_refused(action: Any, text: str) -> None:
    assert error_of(action) == text


@pytest.mark.parametrize("bad", [float("nan"), float("inf"), -float("inf")])
def test_numbers_that_are_not_finite_never_reach_the_physics(bad: float) -> None:
    assert error_of({"move": [bad, 0, 0, 0]}).startswith(
        f"action 'move': expected finite numbers, got [{bad}, 0, 0, 0]"
    )


def test_out_of_range_is_cut_and_counted() -> None:
    sim = small_sim(controller=lambda _percept: {"move": [9, 0, -3, 0]})
    sim.step()
    agent = sim.agents[0]
    assert agent.last_action == {"move": (1.0, 0.0, 0.0, 0.0)}
    assert agent.bound_blocks.actuators["move"].clipped == 2
    assert agent.body.velocity[0] == pytest.approx(2.0, rel=0.1)


@pytest.mark.parametrize(
    "values",
    [[1, 0, 0, 0], (1.0, 0, 0, 0), np.array([1, 0, 0, 0]), np.array([1, 0, 0, 0], np.float32)],
)
def test_any_sequence_of_numbers_will_do(values: Any) -> None:
    sim = small_sim(controller=lambda _percept: {"move": values})
    sim.step()
    assert sim.agents[0].last_action == {"move": (1.0, 0.0, 0.0, 0.0)}


def test_no_action_for_an_actuator_lets_it_be() -> None:
    sim = small_sim(controller=lambda _percept: {})
    sim.step()
    assert sim.agents[0].last_action == {}

"""Occlusion tells of planted networks exactly what was planted."""

from itertools import count
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as some

from ai4u_edu import ArrowController, Command, Controller, Percept, Scene
from ai4u_edu.base.errors import AI4UError, SetupError
from ai4u_edu.explain import (
    Group,
    NotExplainableError,
    groups_of_agent,
    mean_of,
    middle_of,
    occlusion,
)
from ai4u_edu.learn.training import QTable
from tests.explain.planted import linear_network
from tests.explain.worlds import robot_and_box

pytestmark = pytest.mark.needs("train")

NUMBERS = some.floats(-4, 4, width=32)
PERCEPT = {"eyes": np.array([0.3, -0.7, 1.0]), "speed": np.array([0.25, 0.5])}
ZEROS = {"eyes": np.zeros(3), "speed": np.zeros(2)}


@pytest.mark.parametrize("slot", range(5))
def test_only_one_slot_matters(tmp_path: Path, slot: int) -> None:
    weights = np.zeros((5, 2))
    weights[slot] = 2, -1
    path = linear_network(tmp_path / "a.onnx", {"eyes": weights[:3], "speed": weights[3:]})
    told = occlusion(path, PERCEPT, baseline=ZEROS)
    moved = np.flatnonzero(told.importance)
    assert moved.tolist() == [slot] == [told.strongest()]
    name = ["eyes 0", "eyes 1", "eyes 2", "speed 0", "speed 1"][slot]
    assert told.names[slot] == name
    reading = np.concatenate([*PERCEPT.values()])[slot]
    np.testing.assert_allclose(told.shift[slot], [2 * reading, -reading], rtol=1e-5)


@settings(max_examples=40, deadline=None)
@given(
    weights=some.lists(NUMBERS, min_size=6, max_size=6),
    reading=some.lists(NUMBERS, min_size=3, max_size=3),
    ground=some.lists(NUMBERS, min_size=3, max_size=3),
)
def test_a_linear_policy_moves_by_weight_times_difference(
    weights: list[float], reading: list[float], ground: list[float]
) -> None:
    table = np.array(weights).reshape(3, 2)
    told = occlusion(
        lambda percept: {"move": percept["eyes"] @ table},
        {"eyes": np.array(reading)},
        baseline={"eyes": np.array(ground)},
    )
    expected = table * (np.array(reading) - np.array(ground))[:, None]
    np.testing.assert_allclose(told.shift, expected, atol=1e-9)


def test_a_linear_network_with_known_weights(tmp_path: Path) -> None:
    rng = np.random.default_rng(5)
    weights = {"eyes": rng.normal(size=(3, 4)), "speed": rng.normal(size=(2, 4))}
    path = linear_network(tmp_path / "a.onnx", weights, offset=0.5)
    ground = {"eyes": np.array([0.5, 0.5, 0.5]), "speed": np.array([-1.0, 1.0])}
    told = occlusion(path, PERCEPT, baseline=ground)
    expected = [weights[key] * (PERCEPT[key] - ground[key])[:, None] for key in weights]
    np.testing.assert_allclose(told.shift, np.concatenate(expected), atol=1e-5)
    whole = occlusion(path, PERCEPT, baseline=ground, groups="sensor")
    assert whole.names == ("eyes", "speed")
    np.testing.assert_allclose(whole.shift, [each.sum(axis=0) for each in expected], atol=1e-5)


def test_a_network_that_ignores_its_input(tmp_path: Path) -> None:
    weights = {"eyes": np.zeros((3, 2)), "speed": np.zeros((2, 2))}
    told = occlusion(
        linear_network(tmp_path / "a.onnx", weights, offset=0.75), PERCEPT, baseline=ZEROS
    )
    assert told.action.tolist() == [0.75, 0.75]
    assert not told.shift.any()


def test_groups_of_ones_own() -> None:
    group = Group("the two outer ones", "eyes", np.array([True, False, True]))
    told = occlusion(
        lambda percept: [percept["eyes"].sum()], PERCEPT, baseline=ZEROS, groups=[group]
    )
    np.testing.assert_allclose(told.shift, [[1.3]])


def test_a_controller_of_an_agent_gets_the_same_kind_of_percept() -> None:
    def steer(percept: Any) -> Any:
        assert isinstance(percept, Percept)
        return {"move": [1, -percept["bearing"][0], 0, 0]}

    agent = robot_and_box(steer).agents[0]
    told = occlusion(
        agent.brain, agent.percept, baseline=middle_of(agent), groups=groups_of_agent(agent)
    )
    assert told.names[told.strongest()] == "bearing: left?"
    assert told.shift[told.strongest()].tolist() == pytest.approx(
        [0, -agent.percept["bearing"][0], 0, 0]
    )


def test_a_q_table_is_not_filled_by_asking() -> None:
    table = QTable(3, state=lambda seen: round(float(seen["eyes"][0]), 1))
    table.of(0.3)[:] = 0, 1, 0
    told = occlusion(table.drive, PERCEPT, baseline=ZEROS)
    assert told.shift.ravel().tolist() == [1, 0, 0, 0, 0]
    assert list(table.values) == [0.3]


def test_stateful_policies_are_refused() -> None:
    steps = count()
    numbers: list[int] = []
    rng = np.random.default_rng(0)

    class Alternates(Controller):
        def get_action(self, percept: Any) -> Any:
            self.turn = -getattr(self, "turn", 1)
            return {"move": [self.turn]}

    class Prepared(Controller):
        def on_reset(self, agent: Any, view: Any) -> None:
            self.turn = 1

        def get_action(self, percept: Any) -> Any:
            return {"move": [1]}

    def grows(percept: Any) -> Any:
        numbers.append(1)
        return [len(numbers)]

    for policy, told in (
        (grows, "keeps something from one decision to the next .it changes numbers."),
        (Alternates(), "keeps something from one decision to the next .it changes turn."),
        (lambda percept: [next(steps)], "keeps something|two different actions"),
        (lambda percept: [rng.normal()], "two different actions"),
        (Prepared(), "Prepared begins again at each reset.* does not apply to it"),
        (ArrowController(), "ArrowController prepares itself with the world.* does not apply"),
    ):
        with pytest.raises(NotExplainableError, match=told):
            occlusion(policy, PERCEPT, baseline=ZEROS)


def test_a_command_is_no_action() -> None:
    with pytest.raises(NotExplainableError, match="expected an action, got the command RESTART"):
        occlusion(lambda percept: Command.RESTART, PERCEPT, baseline=ZEROS)


def test_without_a_baseline_it_says_where_to_get_one() -> None:
    with pytest.raises(SetupError, match=r"baseline=middle_of\(agent\)"):
        occlusion(lambda percept: [1], PERCEPT)
    with pytest.raises(SetupError, match="'eyes': expected 3 numbers in the baseline"):
        occlusion(lambda percept: [1], PERCEPT, baseline={"eyes": np.zeros(2)})
    with pytest.raises(SetupError, match="at least one percept"):
        mean_of([])
    with pytest.raises(AI4UError, match="expected a function from percept to action"):
        occlusion(3, PERCEPT)


def test_a_network_of_the_zoo_has_the_baseline_of_its_scene() -> None:
    sim = Scene.load("maze").build()
    sim.reset(seed=1)
    agent = sim.agents[0]
    by_itself = occlusion("zoo:maze", agent.percept)
    by_agent = occlusion("zoo:maze", agent.percept, baseline=middle_of(agent))
    assert by_itself.shift.shape == (26 + 2 + 4, 4)
    assert np.array_equal(by_itself.shift, by_agent.shift)

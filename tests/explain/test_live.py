"""Explanations of a running world: the same figures, beside its ticks."""

import math
import threading
from typing import Any

import numpy as np
import pytest

from ai4u_edu import ControlRequestor, LocalBrain, Scene, trained_brain
from ai4u_edu.blocks import Percept
from ai4u_edu.explain import groups_of_agent, mean_of, middle_of, occlusion
from ai4u_edu.explain import live as live_explainer
from ai4u_edu.explain.live import MIN_MEAN_PERCEPTS, BrainExplainer, LiveExplainer, Why
from ai4u_edu.explain.occlusion import changed_percept
from ai4u_edu.snapshot import AgentState, capture_snapshot, capture_static_scene
from tests.explain.test_sentence import turns_for_ray
from tests.explain.worlds import robot_and_box
from tests.waiting import until


def state_of(sim: ControlRequestor) -> AgentState:
    return capture_snapshot(sim, capture_static_scene(sim)).agents[0]


def why_of(sim: ControlRequestor) -> Why:
    return BrainExplainer(sim.agents[0].brain, state_of(sim)).why(state_of(sim))


def test_it_says_the_same_as_in_python() -> None:
    sim = Scene.load("maze").build()
    agent = sim.agents[0]
    agent.use_brain(trained_brain("zoo:maze"))
    sim.reset(seed=1)
    found = why_of(sim)
    told = occlusion(
        agent.brain, agent.percept, baseline=middle_of(agent), groups=groups_of_agent(agent)
    )
    assert [group.name for group in found.groups] == list(told.names)
    np.testing.assert_allclose(np.array(found.shares)[:, :2], told.shift[:, :2] / 2, atol=1e-6)
    assert found.baseline == "the middle of its range"
    assert found.problem == ""


def test_the_planted_ray_is_the_one_that_is_coloured() -> None:
    sim = robot_and_box(turns_for_ray(3))
    found = why_of(sim)
    weights = found.ray_weights["eyes"]
    picture = state_of(sim).rays["eyes"]
    assert np.flatnonzero(weights).tolist() == [6]  # the third of nine from the left
    assert picture.groups[6] == "box"
    assert weights[6] == 1.0


def test_after_a_while_the_baseline_is_the_mean_of_what_was_sensed() -> None:
    sim = robot_and_box(lambda percept: {"move": [0.3, percept["bearing"][0], 0, 0]})
    driver, seen = BrainExplainer(sim.agents[0].brain, state_of(sim)), []
    for _ in range(50):
        state = state_of(sim)
        seen.append(state.percept)
        found = driver.why(state)
        sim.step()
        if sim.agents[0].done:
            sim.reset()
    assert found.baseline == "the mean of the last 50 percepts"
    (index,) = [i for i, group in enumerate(found.groups) if group.name == "bearing: left?"]
    moved = seen[-1]["bearing"][0] - mean_of(seen)["bearing"][0]
    assert found.shares[index][1] == pytest.approx(moved / 2, abs=1e-5)


def test_a_robot_that_stands_still_is_compared_with_the_middle_and_says_so() -> None:
    sim = robot_and_box(lambda percept: {"move": [0.3, percept["bearing"][1], 0, 0]})
    state = state_of(sim)
    driver = BrainExplainer(sim.agents[0].brain, state)
    found = driver.why(state)
    assert found.also == ""  # there is no mean yet
    for _ in range(MIN_MEAN_PERCEPTS):
        same = changed_percept(state.percept, {})
        assert isinstance(same, Percept)
        found = driver.why(state._replace(percept=same))
    assert found.baseline == "the middle of its range"
    assert "because the box is " in found.sentence
    assert found.also.startswith("Compared with the mean of the last 51 percepts instead: All that")
    assert found.explained == "Left out one by one, the slots explain 100% of what all do together."


def test_who_can_not_be_explained_is_told_why() -> None:
    calls: list[Any] = []

    def counts(percept: Any) -> Any:
        calls.append(1)
        return {"move": [1, 0, 0, 0]}

    def fails(percept: Any) -> Any:
        raise ValueError("no")

    assert "it changes calls" in why_of(robot_and_box(counts)).problem
    assert why_of(robot_and_box(fails)).problem == "ValueError: no"
    sim = Scene.load("box_chase").build()
    sim.reset(seed=1)
    assert why_of(sim).problem.startswith("You are driving.")


def test_a_large_picture_is_left_out_as_a_whole() -> None:
    sim = Scene.load("grid_world").build()
    sim.agents[0].use_brain(trained_brain("zoo:grid_world"))
    sim.reset(seed=1)
    found = why_of(sim)
    assert found.groups[0].name == "all of grid"
    assert found.groups[0].mask.all()
    assert len(found.groups) == 3


def test_its_thread_ends_when_nobody_asks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(live_explainer, "INTEREST_S", -1.0)
    before = set(threading.enumerate())
    sim = robot_and_box(turns_for_ray(3))
    snapshot = capture_snapshot(sim, capture_static_scene(sim))
    explainer = LiveExplainer(lambda: snapshot, lambda _agent: sim.agents[0].brain)

    def threads() -> list[threading.Thread]:
        running = set(threading.enumerate()) - before
        return [each for each in running if each.name == "explainer"]

    assert explainer.why("0") is None
    until(lambda: not threads())
    monkeypatch.setattr(live_explainer, "INTEREST_S", math.inf)
    until(lambda: explainer.why("0") is not None)
    explainer.stop()
    until(lambda: not threads())
    assert explainer.why("0") is not None  # the last one
    assert threads() == []


def test_another_brain_is_another_explanation() -> None:
    sim = robot_and_box(turns_for_ray(3))
    agent = sim.agents[0]
    driver = BrainExplainer(agent.brain, state_of(sim))
    assert driver.drives(agent.brain, state_of(sim))
    agent.use_brain(LocalBrain(controller=turns_for_ray(4)))
    assert not driver.drives(agent.brain, state_of(sim))

"""Two policies on one episode, and the reward terms of an episode."""

from typing import Any

import numpy as np
import pytest

from ai4u_edu.base.errors import SetupError
from ai4u_edu.explain import first_disagreement, percepts_of, reward_terms
from ai4u_edu.recording import Recorder
from ai4u_edu.scenes import Scene
from tests.explain.worlds import robot_and_box


def circles(percept: Any) -> Any:
    return {"move": [0.5, 0.3, 0, 0]}


def late(percept: Any) -> Any:
    """Drive as in a circle, until the box is behind."""
    behind = percept["bearing"][1] < 0
    return {"move": [0.5, -0.7 if behind else 0.3, 0, 0]}


def recorded(decisions: int = 30) -> Any:
    sim = robot_and_box(circles)
    recorder = Recorder(sim)
    sim.reset(seed=0)
    for _ in range(decisions):
        sim.step()
    recorder.finish()
    return recorder.episodes[-1]


def test_the_first_decision_in_which_they_differ() -> None:
    episode = recorded()
    percepts = percepts_of(episode)
    expected = next(step for step, percept in enumerate(percepts) if percept["bearing"][1] < 0)
    told = first_disagreement(circles, late, episode)
    assert 0 < expected == told.step
    assert told.percept == percepts[expected]
    assert told.distance[:expected].max() == 0
    assert told.distance[expected] == pytest.approx(1.0)
    assert told.because is not None
    first, second = told.because
    assert not first.shift.any()
    assert second.names[second.strongest()] == "bearing 1"


def test_the_same_policy_never_disagrees() -> None:
    told = first_disagreement(late, late, recorded())
    assert (told.step, told.percept, told.because) == (None, None, None)
    assert told.first.shape == told.second.shape == (30, 4)
    assert first_disagreement(circles, late, recorded(), tolerance=2.0).step is None


def test_policies_of_other_actuators() -> None:
    with pytest.raises(SetupError, match="actions of 4 and 1 numbers"):
        first_disagreement(circles, lambda percept: [1.0], recorded())
    with pytest.raises(SetupError, match="at least one decision"):
        first_disagreement(circles, late, [])


def test_reward_terms_of_an_episode_and_the_moments_that_paid_most() -> None:
    sim = Scene.load("box_chase").build()
    recorder = Recorder(sim, scene=Scene.load("box_chase").description)
    from ai4u_edu import trained_brain

    agent = sim.agents[0]
    agent.use_brain(trained_brain("zoo:box_chase"))
    sim.reset(seed=1)
    while not agent.done:
        sim.step()
    recorder.finish()
    told = reward_terms(recorder.episodes[-1])
    assert set(told.terms) >= {"touch"}
    assert told.amounts.shape == (len(told.seconds), len(told.terms))
    assert told.totals.sum() == pytest.approx(sum(agent.ledger.episode_terms.values()))
    best, *_ = told.moments()
    assert best == len(told.seconds) - 1
    assert told.amounts[best, told.terms.index("touch")] == 100
    assert np.all(np.diff(told.seconds) > 0)

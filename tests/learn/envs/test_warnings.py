"""Warnings that an environment gives once: of an agent nobody chose, of an action out of range."""

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import gymnasium
import numpy as np
import pytest

from ai4u_edu.learn.envs import SceneEnv, SceneVectorEnv, parallel_env

BEYOND = np.array([3.0, 0.0, 0.0, 0.0], np.float32)
INSIDE = np.array([1.0, 0.0, 0.0, 0.0], np.float32)


@contextmanager
def heard() -> Iterator[list[str]]:
    """Collect the texts of warnings, but of those that other tests' garbage gives."""
    texts: list[str] = []
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        yield texts
    ours = [each for each in caught if not issubclass(each.category, ResourceWarning)]
    texts += [str(each.message) for each in ours]


def test_an_environment_of_several_agents_says_which_one_it_took() -> None:
    with heard() as texts:
        env: Any = gymnasium.make("ai4u_edu/Soccer-v0")
    assert env.unwrapped.agent.id == "blue_striker"
    (text,) = texts
    assert "controls 'blue_striker'" in text
    assert "agent='orange_keeper'" in text
    assert "parallel_env('soccer')" in text


def test_it_says_so_once_for_all_worlds() -> None:
    with heard() as texts:
        env = SceneVectorEnv(3, "tag")
    assert len(texts) == 1
    assert [each.agent.id for each in env.envs] == ["chaser"] * 3


@pytest.mark.parametrize(("scene", "agent"), [("soccer", "orange_keeper"), ("box_chase", None)])
def test_it_says_nothing_where_nothing_was_left_open(scene: str, agent: str | None) -> None:
    with heard() as texts:
        SceneEnv(scene, agent=agent)
    assert texts == []


def test_an_action_out_of_range_is_clipped_with_one_warning() -> None:
    env, other = SceneEnv("box_chase"), SceneEnv("box_chase")
    env.reset(seed=1)
    other.reset(seed=1)
    with heard() as texts:
        for _ in range(3):
            env.step(BEYOND)
    (text,) = texts
    assert "action 'move': expected forward from -1 to 1, got 3, which was clipped to 1" in text
    for _ in range(3):
        other.step(INSIDE)  # warns of nothing, and does the same
    assert env.agent.percept == other.agent.percept
    assert env.agent.bound_blocks.actuators["move"].clipped == 3


def test_many_worlds_warn_once() -> None:
    worlds = SceneVectorEnv(3, "box_chase")
    worlds.reset(seed=1)
    with heard() as texts:
        worlds.step(np.stack([INSIDE, BEYOND, BEYOND]))
        worlds.step(np.stack([BEYOND, BEYOND, BEYOND]))
    assert len(texts) == 1
    all_agents = parallel_env("sumo")
    all_agents.reset(seed=1)
    with heard() as texts:
        for _ in range(2):
            all_agents.step(dict.fromkeys(all_agents.agents, BEYOND))
    assert len(texts) == 1


def test_the_warning_can_be_switched_off_as_gymnasiums_can(monkeypatch: Any) -> None:
    monkeypatch.setattr(gymnasium.logger, "min_level", gymnasium.logger.ERROR)
    env = SceneEnv("soccer")
    env.reset(seed=1)
    with heard() as texts:
        env.step(BEYOND)
    assert texts == []

"""render_mode="human": the page shows the world that the learner's steps move."""

import time

import gymnasium
import httpx
import numpy as np
import pytest

from ai4u_edu import AI4UError, Scene
from ai4u_edu.envs import SceneEnv


def test_the_page_shows_the_steps_at_the_pace_of_the_wall_clock() -> None:
    env = gymnasium.make("ai4u_edu/BoxChase-v0", render_mode="human", observation="flat")
    bare = env.unwrapped
    assert isinstance(bare, SceneEnv)
    plain = SceneEnv("box_chase", observation="flat")
    began = time.perf_counter()
    observation, _ = env.reset(seed=5)
    expected, _ = plain.reset(seed=5)
    for _ in range(12):
        action = np.array([0.1, 0.4, 0, 0], np.float32)
        assert np.array_equal(observation, expected)
        observation, *_ = env.step(action)
        expected, *_ = plain.step(action)
    assert (
        time.perf_counter() - began > 0.7
    )  # sixty ticks, of which it may hurry through some to catch up
    snapshot = httpx.get(f"{bare.page_url}api/snapshot").json()
    assert snapshot["tick"] == 60
    assert snapshot["agents"][0]["brain"] == "Gymnasium"
    page = bare.page_url
    env.close()
    with pytest.raises(httpx.ConnectError):
        httpx.get(page)


def test_an_error_in_a_block_reaches_the_learner() -> None:
    env = SceneEnv(Scene.load("box_chase"), render_mode="human")
    env.reset(seed=1)
    with pytest.raises(AI4UError, match="expected 4 numbers, got 2"):
        env.step([1, 2])
    env.close()

"""render_mode="human": the page shows the world that the learner's steps move."""

from functools import partial

import gymnasium
import httpx
import numpy as np
import pytest

from ai4u_edu import AI4UError, Scene
from ai4u_edu.learn.envs import SceneEnv
from ai4u_edu.room import env_page
from ai4u_edu.runtime.runner import Runner
from tests.runtime.clocks import ManualClock
from tests.waiting import LIMIT_S


def test_the_page_shows_the_steps_at_the_pace_of_its_clock(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    clock = ManualClock()
    monkeypatch.setattr(env_page, "Runner", partial(Runner, clock=clock))
    env = gymnasium.make("ai4u_edu/BoxChase-v0", render_mode="human", observation="flat")
    bare = env.unwrapped
    assert isinstance(bare, SceneEnv)
    plain = SceneEnv("box_chase", observation="flat")
    began = clock.now
    observation, _ = env.reset(seed=5)
    expected, _ = plain.reset(seed=5)
    for _ in range(12):
        action = np.array([0.1, 0.4, 0, 0], np.float32)
        assert np.array_equal(observation, expected)
        observation, *_ = env.step(action)
        expected, *_ = plain.step(action)
    assert clock.now - began == pytest.approx(1.0)  # sixty ticks
    snapshot = httpx.get(f"{bare.page_url}api/snapshot", timeout=LIMIT_S).json()
    assert snapshot["tick"] == 60
    assert snapshot["agents"][0]["brain"] == "Gymnasium"
    page = bare.page_url
    env.close()
    with pytest.raises(httpx.ConnectError):
        httpx.get(page, timeout=LIMIT_S)


def test_an_error_in_a_block_reaches_the_learner() -> None:
    env = SceneEnv(Scene.load("box_chase"), render_mode="human")
    env.reset(seed=1)
    with pytest.raises(AI4UError, match="expected 4 numbers, got 2"):
        env.step([1, 2])
    env.close()

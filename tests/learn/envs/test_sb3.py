"""Stable-Baselines3's environment checker, and its vectorized environment of several worlds."""

import warnings
from typing import Any

import gymnasium
import numpy as np
import pytest
from stable_baselines3 import PPO
from stable_baselines3.common.env_checker import check_env
from stable_baselines3.common.monitor import Monitor
from stable_baselines3.common.vec_env import DummyVecEnv

from ai4u_edu.learn.envs import SceneEnv
from ai4u_edu.learn.envs.sb3 import SceneVecEnv
from ai4u_edu.registration import env_id
from tests.learn.envs.scenes import SCENES, first_agent

pytestmark = pytest.mark.needs("train")

COUNT = 3


@pytest.mark.parametrize(
    ("scene", "form"),
    # each scene in one of the forms, and in the other one at night
    [
        (scene, form)
        if number % 2 == index
        else pytest.param(scene, form, marks=pytest.mark.nightly)
        for number, scene in enumerate(SCENES)
        for index, form in enumerate(("dict", "flat"))
    ],
)
def test_its_checker_is_content(scene: str, form: str) -> None:
    options: dict[str, Any] = {
        "observation": form,
        "render_mode": "rgb_array",
        "agent": first_agent(scene),
    }
    env = gymnasium.make(env_id(scene), **options).unwrapped
    with warnings.catch_warnings():
        # it advises on the form of spaces, which are the scene's own; what is wrong, it asserts
        checker = r"stable_baselines3\.common\.env_checker"
        warnings.filterwarnings("ignore", category=UserWarning, module=checker)
        check_env(env)


@pytest.mark.parametrize("form", ["dict", "flat"])
def test_it_gives_what_its_own_gives(form: str) -> None:
    ours = SceneVecEnv("box_chase", COUNT, observation=form)
    theirs = DummyVecEnv([lambda: Monitor(SceneEnv("box_chase", observation=form))] * COUNT)
    for env in (ours, theirs):
        env.seed(12)
    one, other = ours.reset(), theirs.reset()
    rng = np.random.default_rng(0)
    ends = 0
    for _ in range(300):
        _same(one, other)
        actions = rng.uniform([-1, -1, 0, 0], 1, (COUNT, 4)).astype(np.float32)
        actions[:, 0] = 1.0
        one, *mine = ours.step(actions)
        other, *yours = theirs.step(actions)
        assert mine[0].dtype == yours[0].dtype
        assert mine[0].tolist() == yours[0].tolist()
        assert mine[1].tolist() == yours[1].tolist()
        for told, expected, done in zip(mine[2], yours[2], mine[1], strict=True):
            assert told["reward_terms"] == expected["reward_terms"]
            assert ("terminal_observation" in told) is bool(done)
            if done:
                ends += 1
                _same(told["terminal_observation"], expected["terminal_observation"])
                assert told["TimeLimit.truncated"] == expected["TimeLimit.truncated"]
                assert told["is_success"] == expected["success"]
                assert told["episode"]["l"] == expected["episode"]["l"]
                assert told["episode"]["r"] == pytest.approx(expected["episode"]["r"], abs=1e-6)
    assert ends > 10


def _same(one: Any, other: Any) -> None:
    if isinstance(one, dict):
        assert one.keys() == other.keys()
        for key in one:
            _same(one[key], other[key])
    else:
        assert one.tolist() == other.tolist()


def test_a_cut_episode_is_told_as_cut() -> None:
    env = SceneVecEnv("yardstick", 2)
    env.seed(1)
    env.reset()
    for _ in range(299):
        _, _, dones, _ = env.step(np.zeros((2, 2), np.float32))
        assert not dones.any()
    _, _, dones, infos = env.step(np.zeros((2, 2), np.float32))
    assert dones.all()
    for info in infos:
        assert (info["TimeLimit.truncated"], info["is_success"]) == (True, False)


def test_a_seed_fixes_everything() -> None:
    def drive() -> Any:
        env = SceneVecEnv("box_chase", 2)
        env.seed(7)
        seen = [env.reset()]
        seen += [env.step(np.full((2, 4), 0.5, np.float32))[0] for _ in range(50)]
        return np.array(seen).tobytes()

    assert drive() == drive()


def test_worlds_can_be_asked_and_told() -> None:
    env = SceneVecEnv("box_chase", 3, render_mode="rgb_array")
    env.reset()
    assert env.get_attr("success", [0, 2]) == [False, False]
    env.set_attr("note", "hello", 1)
    assert [getattr(each, "note", None) for each in env.envs] == [None, "hello", None]
    assert len(env.env_method("render", indices=[0])) == 1
    assert env.env_is_wrapped(Monitor) == [False] * 3
    picture = env.render()
    assert picture is not None
    assert picture.shape[2] == 3


def test_it_learns() -> None:
    env = SceneVecEnv("yardstick", 4)
    model = PPO("MlpPolicy", env, n_steps=16, batch_size=64, n_epochs=1, seed=0, device="cpu")
    model.learn(128)
    assert model.num_timesteps == 128

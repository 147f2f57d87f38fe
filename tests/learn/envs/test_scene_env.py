"""Scenes as Gymnasium environments."""

import subprocess
import sys
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from gymnasium.wrappers import RecordEpisodeStatistics

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.base.errors import SetupError
from ai4u_edu.registration import env_id
from tests.learn.envs.scenes import SCENES, first_agent, without_blocks

FORMS = ["dict", "flat"]


@pytest.mark.parametrize(
    ("scene", "form"),
    # each scene in one of the forms, and in the other ones at night
    [
        (scene, form)
        if number % len(FORMS) == index
        else pytest.param(scene, form, marks=pytest.mark.nightly)
        for number, scene in enumerate(SCENES)
        for index, form in enumerate(FORMS)
    ],
)
def test_gymnasiums_checker_is_content(scene: str, form: str) -> None:
    options: dict[str, Any] = {
        "observation": form,
        "render_mode": "rgb_array",
        "agent": first_agent(scene),
    }
    env = gymnasium.make(env_id(scene), **options)
    check_env(env.unwrapped)
    env.close()


def test_the_name_is_known_without_a_word_more() -> None:
    code = "import gymnasium; print(gymnasium.make('ai4u_edu:ai4u_edu/BoxChase-v0').spec.id)"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "ai4u_edu/BoxChase-v0"


def rollout(env: Any, seed: int, steps: int = 60) -> list[Any]:
    env.action_space.seed(0)
    found = [env.reset(seed=seed)[0]]
    for _ in range(steps):
        observation, reward, terminated, truncated, _ = env.step(env.action_space.sample())
        found.append((observation, reward, terminated, truncated))
        if terminated or truncated:
            found.append(env.reset()[0])
    return found


def same(a: Any, b: Any) -> bool:
    if isinstance(a, dict):
        return all(same(a[key], b[key]) for key in a)
    if isinstance(a, tuple | list):
        return all(same(x, y) for x, y in zip(a, b, strict=True))
    return bool(np.array_equal(a, b))


@pytest.mark.parametrize("form", FORMS)
def test_a_seed_fixes_everything(form: str) -> None:
    one, other = (gymnasium.make("ai4u_edu/BoxChase-v0", observation=form) for _ in range(2))
    first = rollout(one, 5)
    assert same(first, rollout(other, 5))
    assert same(first, rollout(one, 5))
    assert not same(first, rollout(one, 6))


def test_flat_is_the_dict_in_one_row() -> None:
    envs = [gymnasium.make("ai4u_edu/SampleScene-v0", observation=form) for form in FORMS]
    (by_key, _), (flat, _) = (env.reset(seed=3) for env in envs)
    order = ["vision", "orientation", "bearing", "velocity", "last_action"]
    assert flat.tolist() == np.concatenate([by_key[key].ravel() for key in order]).tolist()
    assert flat.dtype == np.float32


def test_observations_share_nothing() -> None:
    env = gymnasium.make("ai4u_edu/BoxChase-v0")
    before, _ = env.reset(seed=0)
    kept = {key: value.copy() for key, value in before.items()}
    after, *_ = env.step(np.array([1, 1, 0, 0], np.float32))
    assert same(before, kept)
    for value in after.values():
        value[...] = 9  # and they may be written to
    assert not same(env.step(np.zeros(4, np.float32))[0], after)


def test_a_step_is_the_same_decision_as_the_sandboxs() -> None:
    env = gymnasium.make("ai4u_edu/BoxChase-v0", observation="dict")
    sim = Scene.load("box_chase").build()
    sim.agents[0].use_brain(LocalBrain(controller=lambda percept: {"move": (0.3, 0.5, 0, 0)}))
    sim.reset(4)
    env.reset(seed=4)
    for _ in range(50):
        observation, reward, *_ = env.step(np.array([0.3, 0.5, 0, 0]))
        percept = sim.step()
        assert same(observation, {key: percept[key] for key in observation})
        assert reward == sim.agents[0].reward


def test_info_names_the_terms_and_the_success() -> None:
    env = gymnasium.make("ai4u_edu/BoxChaseAi4u-v0")
    _, info = env.reset(seed=5)
    assert info == {"reward_terms": {}, "success": False}
    terminated = False
    while not terminated:
        *_, terminated, _, info = env.step(np.array([-1, 0, 0, 0], np.float32))
    assert info["success"] is True
    assert info["reward_terms"]["touch"] == 100.0


def test_falling_is_no_success_and_the_limit_truncates() -> None:
    env: Any = RecordEpisodeStatistics(gymnasium.make("ai4u_edu/BoxChase-v0"))
    env.reset(seed=5)
    terminated = False
    while not terminated:
        _, reward, terminated, truncated, info = env.step(np.array([1, 0, 0, 0], np.float32))
    assert (info["success"], truncated) == (False, False)
    assert reward == pytest.approx(-1.0, abs=0.02)
    env.reset(seed=5)
    for _ in range(3000):
        _, _, terminated, truncated, _ = env.step(np.zeros(4, np.float32))
    assert (terminated, truncated) == (False, True)


def test_any_episode_can_be_played_again_from_its_seed() -> None:
    env = gymnasium.make("ai4u_edu/BoxChase-v0", observation="flat")
    env.reset(seed=1)
    observation, _ = env.reset()
    again, _ = env.reset(seed=env.unwrapped.np_random_seed)
    assert same(observation, again)


def test_np_random_is_the_worlds_generator() -> None:
    env: Any = gymnasium.make("ai4u_edu/BoxChase-v0").unwrapped
    env.reset(seed=3)
    assert env.np_random is env.sim.world.seeds.generator


def test_a_picture() -> None:
    env = gymnasium.make("ai4u_edu/BoxChaseAi4u-v0", render_mode="rgb_array")
    env.reset(seed=5)
    picture: Any = env.render()
    assert picture.shape == (480, 480, 3)
    assert picture.dtype == np.uint8
    middle, void = picture[240, 236].tolist(), picture[3, 3].tolist()
    assert middle == [0, 114, 178]  # the robot's blue
    assert void != middle
    assert env.metadata["render_fps"] == 12


@pytest.mark.parametrize(
    ("options", "text"),
    [
        (
            {"observation": "flt"},
            "observation: expected one of dict, flat, image, got 'flt'; did you mean 'flat'?",
        ),
        ({"agent": "9"}, "no agent has the id '9'; known are '0'"),
    ],
)
def test_bad_options(options: dict[str, Any], text: str) -> None:
    with pytest.raises(Exception, match=r"expected|no agent") as caught:
        gymnasium.make("ai4u_edu/BoxChase-v0", **options)
    assert str(caught.value) == text


def test_nothing_to_learn_with() -> None:
    with pytest.raises(SetupError, match=r"has no sensor that a policy could observe"):
        gymnasium.make("ai4u_edu/BoxChase-v0", scene=without_blocks("sensors"))
    with pytest.raises(SetupError, match=r"has no actuator for a policy to drive"):
        gymnasium.make("ai4u_edu/BoxChase-v0", scene=without_blocks("actuators"))

"""Many worlds in one process, as Gymnasium's vector environments."""

from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.vector import AutoresetMode

from ai4u_edu.base.errors import SetupError
from ai4u_edu.learn.envs import SceneVectorEnv

COUNT = 3


def make(mode: str, form: str) -> Any:
    return gymnasium.make_vec(
        "ai4u_edu/BoxChase-v0", num_envs=COUNT, vectorization_mode=mode, observation=form
    )


@pytest.mark.parametrize("form", ["dict", "flat"])
def test_it_gives_what_gymnasiums_own_gives(form: str) -> None:
    ours, theirs = make("vector_entry_point", form), make("sync", form)
    assert isinstance(ours.unwrapped, SceneVectorEnv)
    for env in (ours, theirs):
        env.action_space.seed(0)
    one, other = ours.reset(seed=12)[0], theirs.reset(seed=12)[0]
    resets = 0
    for _ in range(400):
        _check(one, other)
        action = ours.action_space.sample()
        action[:, 0] = 1.0
        one, *mine = ours.step(action)
        other, *yours = theirs.step(action)
        for a, b in zip(mine[:3], yours[:3], strict=True):
            assert a.tolist() == b.tolist()
        _check(mine[3], yours[3])
        resets += int(mine[1].sum() + mine[2].sum())
    assert resets > 10
    assert ours.observation_space == theirs.observation_space
    assert ours.action_space == theirs.action_space


def _check(one: Any, other: Any) -> None:
    if isinstance(one, dict):
        assert one.keys() == other.keys()
        for key in one:
            _check(one[key], other[key])
    else:
        assert one.tolist() == other.tolist()


def test_observations_are_copies_unless_it_is_said() -> None:
    for copy in (True, False):
        env = SceneVectorEnv(2, "box_chase", observation="flat", copy=copy)
        first, _ = env.reset(seed=0)
        before = first.copy()
        env.step(np.ones((2, 4), np.float32))
        assert np.array_equal(first, before) is copy


def test_metadata_and_errors() -> None:
    env = SceneVectorEnv(2)
    assert env.metadata["autoreset_mode"] is AutoresetMode.NEXT_STEP
    with pytest.raises(SetupError, match="num_envs: expected at least 1, got 0"):
        SceneVectorEnv(0)
    with pytest.raises(SetupError, match="seed: expected 2 numbers, got 3"):
        env.reset(seed=[1, 2, 3])


def test_pictures() -> None:
    env = SceneVectorEnv(2, render_mode="rgb_array")
    env.reset(seed=1)
    pictures = env.render()
    assert pictures is not None
    assert [picture.shape for picture in pictures] == [(480, 480, 3)] * 2

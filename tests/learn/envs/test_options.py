"""Environments take options of a reset, and say which ones there are."""

from typing import Any

import numpy as np
import pytest

from ai4u_edu.base.errors import NameNotFoundError, SetupError
from ai4u_edu.learn.envs import SceneEnv, SceneVectorEnv, parallel_env


def gravity(env: Any) -> float:
    return float(env.sim.world.settings.gravity)


def test_options_hold_for_one_episode() -> None:
    env = SceneEnv("box_chase")
    env.reset(seed=1, options={"gravity": 1.5})
    assert gravity(env) == 1.5
    env.step(env.action_space.sample() * 0)
    env.reset()
    assert gravity(env) == 9.81
    with pytest.raises(NameNotFoundError, match="did you mean"):
        env.reset(options={"gravitty": 1})


def test_the_space_of_options_has_names_and_ranges_and_its_values_are_taken() -> None:
    env = SceneEnv("box_chase")
    space = env.options_space
    assert "0.brain.skip_frame" not in space.spaces  # the environment has a brain of its own
    assert space["bodies.box.position"].shape == (2,)
    assert space["0.max_steps_per_episode"].dtype == np.int64
    space.seed(1)
    for _ in range(20):
        value = space["world.damping"].sample()
        env.reset(options={"world.damping": value})
        assert env.sim.world.settings.damping == value


def test_actions_out_of_range_still_warn_with_a_changed_actuator() -> None:
    env = SceneEnv("box_chase")
    env.reset(seed=1, options={"move_amount": 2.0})
    with pytest.warns(UserWarning, match="forward from -1 to 1, got 5"):
        env.step(env.action_space.sample() * 0 + 5)


def test_a_vector_environment_takes_one_value_or_one_for_each_world() -> None:
    envs = SceneVectorEnv(3, "box_chase", observation="flat")
    envs.reset(seed=1, options={"gravity": np.array([1.0, 2.0, 3.0]), "box.position": [2, 2]})
    assert [gravity(each) for each in envs.envs] == [1.0, 2.0, 3.0]
    assert envs.envs[2].sim.world["box"].position == (2.0, 2.0)
    envs.reset(options={"reset_mask": np.array([True, False, True])})
    assert [gravity(each) for each in envs.envs] == [9.81, 2.0, 9.81]
    assert "world.gravity" in envs.options_space.spaces
    with pytest.raises(SetupError, match="a row for each of 3 worlds, got 2"):
        envs.reset(options={"gravity": np.array([1.0, 2.0])})


def test_all_agents_of_a_parallel_environment_get_them() -> None:
    env = parallel_env("sumo", observation="flat")
    env.reset(seed=1, options={"bodies.blue.mass": 5.0})
    assert env.sim.world["blue"].description.mass == 5.0
    assert "bodies.blue.mass" in env.options_space.spaces
    env.reset()
    assert env.sim.world["blue"].description.mass != 5.0


@pytest.mark.needs("train")
def test_options_of_stable_baselines_count_for_the_next_reset() -> None:
    from ai4u_edu.learn.envs.sb3 import SceneVecEnv

    envs = SceneVecEnv("box_chase", 2)
    envs.set_options([{"gravity": 1.0}, {}])
    envs.reset()
    assert [gravity(each) for each in envs.envs] == [1.0, 9.81]
    envs.reset()
    assert [gravity(each) for each in envs.envs] == [9.81, 9.81]

"""The environment: the checkers' rules, and the same world as on this machine."""

from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

from ai4u_edu import AI4UError
from ai4u_edu.base.errors import ParameterError
from ai4u_edu.base.seeding import MAX_SEED
from ai4u_edu.learn.envs import SceneEnv
from ai4u_edu.remote import RefusedError, RemoteEnv
from ai4u_edu.scenes import Scene
from tests.page.server.rooms import Room, served
from tests.remote.rooms import patient_rules
from tests.waiting import LIMIT_S


def scene_room(name: str) -> Any:
    sim = Scene.load(name).build()
    sim.default_time_scale = float("inf")
    return served(sim, rules=patient_rules())


def remote_env(room: Room, **options: Any) -> gymnasium.Env[Any, Any]:
    agent = room.sim.agents[0].id
    limits = {"patience": LIMIT_S}
    return gymnasium.make("ai4u_edu/Remote-v0", url=room.url, agent=agent, **(limits | options))


@pytest.mark.parametrize("observation", ["dict", "flat"])
def test_gymnasiums_checker_is_content(observation: str) -> None:
    with scene_room("box_chase") as room:
        env = remote_env(room, observation=observation)
        check_env(env.unwrapped)
        env.close()


@pytest.mark.parametrize("observation", ["dict", "flat"])
@pytest.mark.parametrize("scene", ["box_chase", "sample_scene", "platform"])
def test_it_is_the_same_environment_as_on_this_machine(scene: str, observation: str) -> None:
    here = SceneEnv(scene, observation=observation)
    with scene_room(scene) as room:
        there = remote_env(room, observation=observation)
        assert there.observation_space == here.observation_space
        assert there.action_space == here.action_space
        here.action_space.seed(3)
        for seed in (1, 2):
            same(there.reset(seed=seed)[0], here.reset(seed=seed)[0])
            for _ in range(40):
                action = here.action_space.sample()
                mine, yours = here.step(action), there.step(action)
                same(yours[0], mine[0])
                assert yours[1:4] == mine[1:4]
                assert yours[4]["reward_terms"] == mine[4]["reward_terms"]
                assert yours[4]["success"] is mine[4]["success"]
                if mine[2] or mine[3]:
                    break
        there.close()


def test_a_seed_that_no_recording_can_hold_is_refused_before_it_is_sent() -> None:
    with scene_room("box_chase") as room:
        env = remote_env(room)
        remote = env.unwrapped
        assert isinstance(remote, RemoteEnv)
        env.reset(seed=MAX_SEED)
        assert room.sim.world.seeds.seed == MAX_SEED
        episode = room.sim.episode
        for seed in (MAX_SEED + 1, 10**20, -1):
            with pytest.raises(ParameterError, match="seed: expected a whole number from 0 to "):
                env.reset(seed=seed)
            with pytest.raises(ParameterError, match="seed: expected a whole number from 0 to "):
                remote.robot.reset(seed)
        env.step(env.action_space.sample())
        assert room.sim.episode == episode
        env.close()


def test_it_says_whether_the_goal_was_reached() -> None:
    with scene_room("box_chase") as room:
        env = remote_env(room)
        observation, info = env.reset(seed=1)
        done = False
        while not done:
            assert info["success"] is False
            ahead = observation["orientation"][0] > 0.99
            action = np.array([1, 0, 0, 0] if ahead else [0, 0.2, 0, 0], np.float32)
            observation, _, done, _, info = env.step(action)
        assert info["success"] is True
        assert env.reset()[1]["success"] is False
        env.close()


def test_one_of_several_resets_alone_and_the_world_only_if_it_may() -> None:
    sim = Scene.load("sumo").build()
    sim.default_time_scale = float("inf")
    for may in (False, True):
        with served(sim, rules=patient_rules(seeded_resets=may, lockstep=True)) as room:
            env = remote_env(room)
            env.reset()
            if may:
                env.reset(seed=3)
                assert room.sim.world.seeds.seed == 3
            else:
                with pytest.raises(RefusedError, match="expected a reset without a seed"):
                    env.reset(seed=3)
                env.step(env.action_space.sample())
            env.close()


def test_a_wish_that_can_not_be_met_is_explained() -> None:
    with pytest.raises(AI4UError, match="observation: expected 'dict' or 'flat', got 'flatt'"):
        RemoteEnv(observation="flatt")
    with pytest.raises(AI4UError, match="render_mode: expected None"):
        RemoteEnv(render_mode="rgb_array")


@pytest.mark.filterwarnings("ignore")  # what Stable-Baselines3 complains of in itself
def test_stable_baselines_checks_and_learns() -> None:
    checker = pytest.importorskip("stable_baselines3.common.env_checker")
    from stable_baselines3 import PPO

    with scene_room("box_chase") as room:
        env = remote_env(room, observation="flat")
        checker.check_env(env.unwrapped)
        model = PPO("MlpPolicy", env, n_steps=64, batch_size=32, n_epochs=1, device="cpu")
        model.learn(128)
        assert model.num_timesteps == 128
        env.close()


def same(one: Any, other: Any) -> None:
    if isinstance(one, dict):
        assert one.keys() == other.keys()
        for key in one:
            np.testing.assert_array_equal(one[key], other[key])
    else:
        np.testing.assert_array_equal(one, other)

"""SceneEnv in a scene with several agents: one learns, the others do as their brains say."""

from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

from ai4u_edu import Scene
from ai4u_edu.learn.envs import SceneEnv
from ai4u_edu.registration import env_id
from tests.learn.envs.scenes import MULTI_AGENT

STAND = np.zeros(4, np.float32)


@pytest.mark.parametrize("scene", MULTI_AGENT)
def test_any_agent_can_be_the_one_that_learns(scene: str) -> None:
    *others, learner = Scene.load(scene).build().agents
    env: Any = gymnasium.make(env_id(scene), agent=learner.id, observation="flat").unwrapped
    check_env(env, skip_render_check=True)
    brains = [agent.brain.title() for agent in env.sim.agents]
    assert brains == [*(agent.brain.title() for agent in others), "Gymnasium"]
    assert brains[0] in ("LocalBrain(WASDRBMoveController)", "LocalBrain(WASDController)")
    assert "Gymnasium" not in brains[:-1]


def test_its_action_is_its_own_and_the_others_act_by_themselves() -> None:
    env = SceneEnv("soccer", agent="orange_keeper")
    env.reset(seed=1)
    for _ in range(20):
        env.step(np.array([0, 1, 0, 0], np.float32))
    actions: dict[str, Any] = {agent.id: agent.last_action["move"] for agent in env.sim.agents}
    assert actions["orange_keeper"] == (0, 1, 0, 0)
    assert actions["blue_striker"] == (0, 0, 0, 0)  # nobody holds its keys
    assert actions["orange_striker"][0] > 0
    assert actions["blue_keeper"] != (0, 0, 0, 0)


def test_the_episode_ends_with_that_agents() -> None:
    env = SceneEnv("tag", agent="runner_1")
    env.reset(seed=1)
    env.sim.world["chaser"].move_to(*env.sim.world["runner 1"].position)
    _, reward, terminated, _, info = env.step(STAND)
    assert (reward, terminated, env.sim.agent("chaser").done) == (-10.0, True, False)
    assert info == {"reward_terms": {"tagged": -10.0, "free": 0.0}, "success": False}
    env.reset(seed=1)
    env.sim.world["chaser"].move_to(*env.sim.world["runner 2"].position)
    _, reward, terminated, *_ = env.step(STAND)
    assert (reward, terminated, env.sim.agent("runner_2").done) == (0.01, False, True)

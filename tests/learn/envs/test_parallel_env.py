"""Scenes with several agents as PettingZoo environments."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from gymnasium import spaces
from gymnasium.utils.env_checker import data_equivalence
from pettingzoo.test import max_cycles_test, parallel_api_test, parallel_seed_test, seed_test
from pettingzoo.utils import parallel_to_aec

from ai4u_edu import Scene
from ai4u_edu.base.errors import ActionError, SetupError
from ai4u_edu.learn.envs import SceneEnv, parallel_env
from tests.learn.envs.scenes import MULTI_AGENT, first_agent

FORMS = ["dict", "flat"]
each_scene = pytest.mark.parametrize("scene", MULTI_AGENT)
each_form = pytest.mark.parametrize("form", FORMS)


def drawn(env: Any) -> dict[str, Any]:
    """An action for everybody who still takes part."""
    return {name: env.action_space(name).sample() for name in env.agents}


def standing(env: Any) -> dict[str, Any]:
    """Everybody stands still."""
    return {name: np.zeros(4, np.float32) for name in env.agents}


def moving(env: Any, name: str, turn: float) -> Any:
    """Return an action that goes ahead and turns."""
    space, move = env.action_space(name), np.array([1, turn, 0, 0], np.float32)
    if not isinstance(space, spaces.Dict):
        return move
    return {**{key: np.zeros(each.shape, np.float32) for key, each in space.items()}, "move": move}


def test_there_are_scenes_with_several_agents() -> None:
    assert {"soccer", "sumo", "tag"} <= set(MULTI_AGENT)


@each_form
@each_scene
def test_pettingzoos_api_test_is_content(scene: str, form: str) -> None:
    parallel_api_test(parallel_env(scene, observation=form), num_cycles=200)


@each_form
@each_scene
def test_pettingzoos_seed_tests_are_content(scene: str, form: str) -> None:
    parallel_seed_test(lambda: parallel_env(scene, observation=form))
    # that one looks at the first step only; this one goes on
    seed_test(lambda: parallel_to_aec(parallel_env(scene, observation=form)), num_cycles=40)


@each_form
@each_scene
def test_pettingzoos_max_cycles_test_is_content(scene: str, form: str) -> None:
    def make(max_cycles: int) -> Any:
        return parallel_env(scene, observation=form, max_cycles=max_cycles)

    max_cycles_test(
        SimpleNamespace(parallel_env=make, env=lambda max_cycles: parallel_to_aec(make(max_cycles)))
    )


def rollout(scene: str, seed: int | None) -> list[Any]:
    """One episode of drivers that drive at random, as far as 120 steps."""
    env = parallel_env(scene, observation="flat")
    for index, name in enumerate(env.possible_agents):
        env.action_space(name).seed(index)
    found: list[Any] = [env.reset(seed=seed)]
    while env.agents and len(found) < 120:
        found.append(env.step(drawn(env)))
    return found


@each_scene
def test_a_seed_fixes_a_whole_episode(scene: str) -> None:
    first = rollout(scene, 3)
    assert data_equivalence(first, rollout(scene, 3))
    assert not data_equivalence(first, rollout(scene, 4))


@each_scene
def test_flat_is_the_dict_in_one_row(scene: str) -> None:
    (by_key, _), (flat, _) = (parallel_env(scene, observation=form).reset(seed=2) for form in FORMS)
    assert by_key.keys() == flat.keys()
    for name, observation in by_key.items():
        row = np.concatenate([np.ravel(value) for value in observation.values()])
        assert flat[name].tolist() == row.tolist()


@each_scene
def test_pictures(scene: str) -> None:
    env = parallel_env(scene, render_mode="rgb_array")
    env.reset(seed=1)
    before = env.render()
    for _ in range(5):
        env.step({name: moving(env, name, 0.5) for name in env.agents})
    after = env.render()
    assert after.ndim == 3
    assert (after.shape[2], after.dtype) == (3, np.uint8)
    assert not np.array_equal(before, after)
    assert env.metadata["render_fps"] == 12
    assert parallel_env(scene).render() is None


@each_scene
def test_it_takes_the_same_decisions_as_the_learner_of_one_agent(scene: str) -> None:
    # everybody but the first does what their brains say in SceneEnv; here we do it for them
    one, all_of_them = SceneEnv(scene, agent=first_agent(scene)), parallel_env(scene)
    observation, _ = one.reset(seed=5)
    observations, _ = all_of_them.reset(seed=5)
    first, *others = all_of_them.possible_agents
    for _ in range(15):
        assert data_equivalence(observation, observations[first])
        action = moving(all_of_them, first, 0.2)
        observation, reward, *_ = one.step(action)
        actions = {name: one.sim.agent(name).last_action for name in others}
        told = {name: each["move"] if len(each) == 1 else each for name, each in actions.items()}
        observations, rewards, *_ = all_of_them.step({first: action, **told})
        assert rewards[first] == reward


def test_agents_end_at_different_times() -> None:
    env = parallel_env("tag", observation="flat")
    env.reset(seed=0)
    chaser, prey = env.sim.world["chaser"], env.sim.world["runner 2"]
    x, y = prey.position
    chaser.move_to(x - 0.95, y, heading=0.0)
    ahead = {"chaser": np.array([1, 0, 0, 0], np.float32)}
    while "runner_2" in env.agents:
        observations, rewards, terminated, truncated, infos = env.step(standing(env) | ahead)
    # it is told once that it is over, with the last reward
    assert terminated == {
        "chaser": False, "runner_1": False, "runner_2": True, "runner_3": False
    }  # fmt: skip
    assert not any(truncated.values())
    assert prey.fallen
    assert rewards["runner_2"] == -10
    assert rewards["chaser"] == 10
    assert infos["chaser"] == {"reward_terms": {"catch": 10.0, "all": 0.0}, "success": False}
    assert infos["runner_2"]["reward_terms"]["tagged"] == -10
    assert env.agents == ["chaser", "runner_1", "runner_3"]
    assert "runner_2" in observations
    # the others go on without it
    answers = env.step(standing(env))
    assert [sorted(each) for each in answers] == [sorted(env.agents)] * 5
    assert env.sim.agent("runner_2").steps < env.sim.agent("runner_1").steps


def test_success_is_each_ones_own() -> None:
    env = parallel_env("sumo")
    _, infos = env.reset(seed=1)
    nothing = {"reward_terms": {}, "success": False}
    assert infos == {"blue": nothing, "orange": nothing}
    env.sim.world["orange"].move_to(6, 0)
    while env.agents:
        _, rewards, terminated, _, infos = env.step(standing(env))
    assert terminated == {"blue": True, "orange": True}
    assert rewards == {"blue": 10.0, "orange": -10.0}
    assert [infos[name]["success"] for name in ("blue", "orange")] == [True, False]


def test_max_cycles_truncates_those_that_are_left() -> None:
    env = parallel_env("sumo", max_cycles=4)
    env.reset(seed=1)
    for _ in range(4):
        assert env.agents == ["blue", "orange"]
        _, _, terminated, truncated, _ = env.step(standing(env))
    assert env.agents == []
    assert (any(terminated.values()), all(truncated.values())) == (False, True)


def test_all_decide_as_seldom_as_the_slowest() -> None:
    plain = Scene.load("sumo").plain()
    plain["agents"] = [dict(agent, brains=list(agent["brains"])) for agent in plain["agents"]]
    plain["agents"][1]["brains"][0] = dict(plain["agents"][1]["brains"][0], skip_frame=11)
    env = parallel_env(Scene(type(Scene.load("sumo").description).model_validate(plain)))
    env.reset(seed=1)
    env.step(standing(env))
    assert env.sim.world.ticks == 12
    assert [agent.steps for agent in env.sim.agents] == [1, 1]
    assert env.metadata["render_fps"] == 5


@pytest.mark.parametrize(
    ("actions", "text"),
    [
        ({"blue": [0, 0, 0, 0]}, "expected an action for each of ['blue', 'orange'], got none for "
         "'orange'"),
        ({"blu": [0, 0, 0, 0]}, "no agent has the id 'blu'; did you mean 'blue'?"),
    ],
)  # fmt: skip
def test_actions_that_are_not_complete(actions: Any, text: str) -> None:
    env = parallel_env("sumo")
    env.reset(seed=1)
    with pytest.raises(ActionError) as caught:
        env.step(actions)
    assert str(caught.value) == text


def test_a_step_without_a_reset_and_an_unknown_mode() -> None:
    with pytest.raises(SetupError, match=r"^no agent takes part; expected a reset\(\) first$"):
        parallel_env("sumo").step({})
    with pytest.raises(SetupError, match=r"expected one of \['rgb_array'\], got 'human'$"):
        parallel_env("sumo", render_mode="human")

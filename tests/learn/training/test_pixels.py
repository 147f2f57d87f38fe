"""Policies that look at pictures: they train, in our commands and in plain Stable-Baselines3."""

from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from stable_baselines3 import DQN, PPO
from stable_baselines3.common.env_util import make_vec_env
from stable_baselines3.common.vec_env import VecFrameStack

from ai4u_edu import Scene
from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks.brains.network import Network
from ai4u_edu.learn.envs import SceneEnv
from ai4u_edu.learn.envs.sb3 import SceneVecEnv
from ai4u_edu.learn.training import evaluate, export, train
from ai4u_edu.learn.training.algorithms import load_model

pytestmark = pytest.mark.needs("train")

SEEN = "{type: LocalGridSensor, perception_key: picture, width: 36, height: 36, %s}"

PICTURES = """
name: pictures
success: touch
bodies:
  - {name: robot, shape: {type: circle, radius: 0.5}}
  - {name: box, shape: {type: box, size: [1, 1]}, position: [2, 0], tags: [target]}
agents:
  - body: robot
    max_steps_per_episode: 20
    sensors:
      - SENSOR
    actuators:
      - {type: RBMoveActuator, move_amount: 2, turn_amount: 2}
    rewards:
      - {type: TouchRewardFunc, target: box, reward: 1, cause_episode_to_end: true}
    brains:
      - {type: LocalBrain, controller: {type: WASDRBMoveController}}
"""

SMALL: dict[str, Any] = {
    "check_episodes": 2,
    "ppo": {"worlds": 2, "n_steps": 32, "batch_size": 32, "n_epochs": 1, "check_every": 64},
    "dqn": {"worlds": 1, "learning_starts": 50, "batch_size": 8, "check_every": 100},
    "sac": {"worlds": 1, "learning_starts": 50, "batch_size": 8, "check_every": 100},
}


def pictures(more: str = "channels: [wall, target]", other: str = "") -> Scene:
    return Scene.loads(PICTURES.replace("SENSOR", SEEN % more + other))


@pytest.mark.parametrize(
    ("algo", "steps"),
    [
        ("ppo", 128),
        pytest.param("dqn", 120, marks=pytest.mark.nightly),
        pytest.param("sac", 70, marks=pytest.mark.nightly),
    ],
)
def test_by_name(tmp_path: Path, algo: str, steps: int) -> None:
    scene = pictures("channels: [wall, target], stacked_observations: 2")
    done = train(
        scene,
        algo,
        steps=steps,
        out=tmp_path,
        policy="CnnPolicy",
        settings=SMALL,
        quiet=True,
    )
    model = load_model(done.run.config().algorithm, done.run.best)
    assert model.policy.features_extractor_class.__name__ == "NatureCNN"
    assert done.run.config().settings.observation == "image"
    file = export(done, tmp_path / "policy.onnx")
    model_told, network_told = (
        evaluate(who, scene, episodes=2, quiet=True) for who in (done, file)
    )
    assert model_told.lengths == network_told.lengths
    # the same picture, the same action
    env = SceneEnv(scene, observation="image")
    seen, _ = env.reset(seed=1)
    action, _ = model.predict(seen, deterministic=True)
    (answer,) = Network(file).decide({"picture": seen}).values()
    if algo != "dqn":
        np.testing.assert_allclose(answer, action, atol=1e-5)


@pytest.mark.parametrize("algorithm", [PPO, DQN])
def test_plain_stable_baselines(tmp_path: Path, algorithm: Any) -> None:
    """A student's own script, with Gymnasium's way to make a world and SB3's to stack pictures."""
    file = tmp_path / "pictures.yaml"
    file.write_text(
        pictures().dumps().replace("RBMoveActuator", "DiscreteActuator")
        if algorithm is DQN
        else pictures().dumps()
    )
    worlds = VecFrameStack(
        make_vec_env(
            lambda: gymnasium.make(
                "ai4u_edu:ai4u_edu/BoxChase-v0", scene=file, observation="image"
            ),
            n_envs=2,
        ),
        n_stack=4,
    )
    few: dict[str, Any] = {"n_steps": 32, "n_epochs": 1} if algorithm is PPO else {}
    few |= {"buffer_size": 200, "learning_starts": 50} if algorithm is DQN else {}
    model = algorithm("CnnPolicy", worlds, batch_size=16, **few)
    assert model.observation_space.shape == (8, 36, 36)  # two channels, four pictures
    before = [each.clone() for each in model.policy.parameters()]
    model.learn(128)
    assert any((a != b).any() for a, b in zip(before, model.policy.parameters(), strict=True))


def test_our_worlds_stack_too() -> None:
    worlds = VecFrameStack(SceneVecEnv(pictures(), 2, observation="image"), n_stack=3)
    assert worlds.observation_space.shape == (36, 36, 6)
    seen = worlds.reset()
    assert seen.dtype == np.uint8
    assert not seen[..., :4].any()  # nothing was seen before
    assert seen[..., 5].max() == 255  # the box
    for _ in range(3):
        seen, *_ = worlds.step(np.zeros((2, 4), np.float32))
    assert (seen[..., 1] == seen[..., 5]).all()


def test_one_world_and_many_see_the_same() -> None:
    env, worlds = (
        SceneEnv(pictures(), observation="image"),
        SceneVecEnv(pictures(), 1, observation="image"),
    )
    worlds.seed(5)
    assert (worlds.reset()[0] == env.reset(seed=5)[0]).all()
    push = np.array([1, 0.5, 0, 0], np.float32)
    assert (worlds.step(push[None])[0][0] == env.step(push)[0]).all()


BEARING = "\n      - {type: BearingSensor, target: box}"


@pytest.mark.parametrize(
    ("scene", "observe", "message"),
    [
        (pictures(other=BEARING), (), r"one sensor that is observed.*\['bearing', 'picture'\]"),
        (pictures(other=BEARING), ("bearing",), r"expected a picture \(height.*got 'bearing'"),
        (pictures("normalized: true"), (), "a LocalGridSensor with normalized False"),
        (pictures("cell_size: 1"), (), ""),
    ],
)
def test_what_can_not_be_looked_at(
    tmp_path: Path, scene: Scene, observe: tuple[str, ...], message: str
) -> None:
    def learn() -> None:
        train(
            scene,
            steps=64,
            out=tmp_path,
            policy="CnnPolicy",
            observe=observe,
            settings=SMALL,
            quiet=True,
        )

    if message:
        with pytest.raises(SetupError, match=message):
            learn()
    else:
        learn()


def test_a_picture_that_is_too_small(tmp_path: Path) -> None:
    small = Scene.loads(pictures().dumps().replace("width: 36", "width: 20"))
    with pytest.raises(SetupError, match="at least 36 x 36 cells, got 36 x 20"):
        train(small, out=tmp_path, policy="CnnPolicy", quiet=True)
    with pytest.raises(SetupError, match="policy: expected"):
        train(small, out=tmp_path, policy="CNN", quiet=True)

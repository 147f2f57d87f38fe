"""A network's file gives the numbers of its network, in all that takes such files."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ai4u_edu.base.errors import SetupError
from ai4u_edu.base.version import __version__
from ai4u_edu.blocks import trained_brain
from ai4u_edu.blocks.brains.network import (
    MAX_LOADED_NETWORK_BYTES,
    TRAINING_KEY,
    VALUE_OUTPUT,
    Network,
)
from ai4u_edu.explain.policy import Policy, has_critic, values_of
from ai4u_edu.games.tournament.drivers import load_network
from ai4u_edu.games.tournament.entry import file_driver
from ai4u_edu.learn.envs import SceneEnv
from ai4u_edu.learn.small.actor_critic import ActorCritic
from ai4u_edu.learn.small.onnx_file import network_bytes, read_network, write_network
from ai4u_edu.lessons.exercises.lesson_12 import layers_of

ABOUT = {"scene": "box_chase", "algorithm": "ppo", "seed": 5, "steps": 1000}
KEYS = "box_chase, by keys"
SCENES = ("box_chase", KEYS, "parking", "grid_world")
"""Rays and the last action, of any numbers and of four keys; numbers with units; a grid of whole
numbers, and choices."""


def made(scene: str) -> tuple[SceneEnv, ActorCritic]:
    """Return an environment, and a network with large weights, so that actions saturate too."""
    env = SceneEnv(scene.partition(",")[0], observation="flat")
    generator = np.random.default_rng(0)
    keys = np.array([[0, -0.4, 0, 0], [0, 0, 0, 0], [0, 0.4, 0, 0], [0.4, 0, 0, 0]])
    network = ActorCritic(
        env.observation_space, env.action_space, [16, 16], keys if scene == KEYS else None
    )
    network.draw(generator)
    network.parameters *= 3.0
    network.actor.weights[-1][:] *= 50.0
    network.middle[:] = generator.normal(size=network.middle.shape)
    network.size[:] *= generator.uniform(0.5, 2.0, network.size.shape)
    network.size[1] = np.inf  # as a clone leaves out what never changed
    return env, network


@pytest.mark.parametrize("scene", SCENES)
def test_the_file_gives_the_numbers_of_the_network(scene: str, tmp_path: Path) -> None:
    env, network = made(scene)
    file = Network(write_network(network, env.agent, ABOUT, tmp_path / "a.onnx"))
    seen, _ = env.reset(seed=1)
    for _ in range(100):
        answer = file.decide(env.agent.percept)
        (value,) = answer.pop(VALUE_OUTPUT)
        (action,) = answer.values()
        assert value == pytest.approx(network.values(seen[None])[0], abs=1e-4)
        np.testing.assert_allclose(action, network.act(seen[None])[0], atol=1e-5)
        seen, _, terminated, truncated, _ = env.step(env.action_space.sample())
        if terminated or truncated:
            seen, _ = env.reset()


@pytest.mark.needs("train")
@pytest.mark.parametrize("scene", SCENES)
def test_the_onnx_package_finds_nothing_wrong(scene: str) -> None:
    import onnx

    env, network = made(scene)
    model = onnx.load_from_string(network_bytes(network, env.agent, ABOUT))
    onnx.checker.check_model(model, full_check=True)
    ports = [each.name for each in model.graph.output]
    assert ports == ["move", VALUE_OUTPUT]
    numbers = {each.name: list(each.dims) for each in model.graph.initializer}
    inputs = env.observation_space.shape[0] if env.observation_space.shape else 0
    assert numbers["actor.0.weight"] == numbers["critic.0.weight"] == [16, inputs]


@pytest.mark.needs("train")
def test_lesson_12_finds_the_layers_of_the_actor_alone(tmp_path: Path) -> None:
    env, network = made("box_chase")
    path = write_network(network, env.agent, ABOUT, tmp_path / "a.onnx")
    *hidden, (weights, bias) = layers_of(str(path))
    signal = env.reset(seed=1)[0].astype(float)
    for table, offsets in hidden:
        signal = np.tanh(table @ signal + offsets)
    (action,) = (
        numbers
        for name, numbers in Network(path).decide(env.agent.percept).items()
        if name != VALUE_OUTPUT
    )
    clipped = np.clip(weights @ signal + bias, network.low, network.high)
    np.testing.assert_allclose(action, clipped, atol=1e-5)


def test_the_same_network_gives_the_same_bytes() -> None:
    env, network = made("box_chase")
    one, other = (network_bytes(each, env.agent, ABOUT) for each in (network, network.copy()))
    assert one == other
    network.parameters[0] += 1.0
    assert network_bytes(network, env.agent, ABOUT) != one


def test_the_file_says_where_it_comes_from(tmp_path: Path) -> None:
    env, network = made("box_chase")
    file = Network(write_network(network, env.agent, ABOUT, tmp_path / "a.onnx"))
    about = file.about
    assert about.items() >= ABOUT.items()
    assert about["version"] == __version__
    assert file.rhythm == {"skip_frame": 4, "repeat_action": True}
    assert about["sensors"]["orientation"] == {
        "type": "OrientationSensor",
        "perception_key": "orientation",
        "target": "box",
        "shape": [2],
    }
    assert about["actuators"]["move"]["move_amount"] == 5.0
    assert len(about["hash"]) == 64
    assert TRAINING_KEY not in json.dumps(about)


@pytest.mark.parametrize("scene", ["box_chase", KEYS, "grid_world"])
def test_a_brain_drives_with_it(scene: str, tmp_path: Path) -> None:
    env, network = made(scene)
    path = write_network(network, env.agent, ABOUT, tmp_path / "a.onnx")
    other = SceneEnv(scene.partition(",")[0], observation="flat")
    agent, observer = other.agent, other.observer
    agent.use_brain(trained_brain(str(path)))
    other.sim.reset(1)
    for _ in range(20):
        expected = network.act(observer.observe(agent.percept)[None])[0]
        other.sim.step(agent)
        np.testing.assert_allclose(agent.last_action["move"], np.ravel(expected), atol=1e-5)


def test_explanations_and_tournaments_take_it(tmp_path: Path) -> None:
    env, network = made("box_chase")
    path = write_network(network, env.agent, ABOUT, tmp_path / "a.onnx")
    seen, _ = env.reset(seed=1)
    file = Network(path)
    assert has_critic(file)
    value = network.values(seen[None])[0]
    assert values_of(file, env.agent.percept) == pytest.approx(value, abs=1e-4)
    policy = Policy(str(path))
    numbers = policy.decide(env.agent.percept)
    np.testing.assert_allclose(numbers, network.act(seen[None])[0], atol=1e-5)
    assert policy.components == ("move 0", "move 1", "move 2", "move 3")
    load_network(file_driver("network", path, MAX_LOADED_NETWORK_BYTES), tmp_path)


@pytest.mark.parametrize("scene", SCENES)
def test_a_network_is_read_back(scene: str) -> None:
    env, network = made(scene)
    found = read_network(network_bytes(network, env.agent, ABOUT), env.agent)
    seen = np.stack([env.reset(seed=seed)[0] for seed in range(10)])
    np.testing.assert_allclose(found.act(seen), network.act(seen), atol=1e-5)
    np.testing.assert_allclose(found.values(seen), network.values(seen), atol=1e-4)
    assert found.layers == (16, 16)


def test_a_network_of_another_agent_is_refused() -> None:
    env, network = made("box_chase")
    data = network_bytes(network, env.agent, ABOUT)
    with pytest.raises(SetupError, match="taught in the page for this agent, got: expected finite"):
        read_network(data, SceneEnv("parking").agent)


def test_bytes_of_another_kind_are_refused() -> None:
    env, network = made("box_chase")
    data = network_bytes(network, env.agent, ABOUT)
    generator = np.random.default_rng(0)
    bad: list[Any] = [b"", b"\xff" * 40, b"not a network", data[:1000], data[: len(data) // 2]]
    bad += [generator.bytes(200) for _ in range(50)]
    for each in bad:
        with pytest.raises(SetupError, match="expected a network"):
            read_network(each, env.agent)
    with pytest.raises(SetupError, match="at most 64 MB"):
        read_network(bytes(MAX_LOADED_NETWORK_BYTES + 1), env.agent)


def test_numbers_that_are_not_finite_are_refused() -> None:
    env, network = made("box_chase")
    network.actor.biases[0][0] = np.nan
    with pytest.raises(SetupError, match="expected finite numbers"):
        read_network(network_bytes(network, env.agent, ABOUT), env.agent)

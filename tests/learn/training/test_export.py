"""A network says what its model says: same readings, same action, 1,000 times."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import onnx
import pytest
from gymnasium import spaces
from stable_baselines3.common.vec_env import VecEnv

from ai4u_edu import Command, Scene
from ai4u_edu.base.version import __version__
from ai4u_edu.blocks.brains.network import TRAINING_KEY, VALUE_OUTPUT, Network, Port
from ai4u_edu.learn.training.algorithms import load_model, new_model
from ai4u_edu.learn.training.exporting import export
from ai4u_edu.learn.training.prepare import prepare
from ai4u_edu.learn.training.run import Config
from ai4u_edu.learn.training.settings import Algorithm, Settings
from ai4u_edu.learn.training.worlds import Choices, make_worlds
from tests.learn.training.small import CHOICES, copied_training, small_settings, small_training

pytestmark = pytest.mark.needs("train")


def config(algorithm: Algorithm, settings: Settings, scene: str = "box_chase") -> Config:
    return Config(scene=scene, algorithm=algorithm, seed=0, steps=1, settings=settings, versions={})


def untrained(scene: Scene, algorithm: Algorithm, settings: Settings) -> tuple[Any, VecEnv]:
    """A model with larger weights than a new one's, so that actions saturate too."""
    worlds = make_worlds(prepare(scene, settings), settings, algorithm)
    model = new_model(algorithm, settings.of(algorithm), worlds, seed=1)
    for weights in model.policy.parameters():
        weights.data.mul_(1.5)
    return model, worlds


def drawn(port: Port, rng: np.random.Generator) -> Any:
    """A reading at random."""
    if port.dtype.kind == "f":
        return rng.normal(0, 1, port.shape).astype(port.dtype)
    return rng.integers(0, 2, port.shape).astype(port.dtype)


def disagreement(model: Any, network: Network, worlds: VecEnv, keys: list[str]) -> float:
    """Return the largest difference of model and network on 1,000 random observations."""
    flat = not isinstance(worlds.observation_space, spaces.Dict)
    table = worlds.table if isinstance(worlds, Choices) else None
    rng = np.random.default_rng(0)
    ports = {port.name: port for port in network.inputs}
    worst = 0.0
    for _ in range(1000):
        percept = {key: drawn(ports[key], rng) for key in keys}
        seen: Any = percept
        if flat:
            seen = np.concatenate([percept[key].ravel().astype(np.float32) for key in keys])
        action, _ = model.predict(seen, deterministic=True)
        (answer,) = network.decide(percept).values()
        expected = action if table is None else table[action]
        worst = max(worst, float(np.abs(np.asarray(expected) - answer).max()))
    return worst


@pytest.mark.parametrize(
    "algorithm", ["ppo", "sac", pytest.param("dqn", marks=pytest.mark.nightly)]
)
def test_a_thousand_observations(tmp_path: Path, algorithm: Algorithm) -> None:
    scene, settings = Scene.load("box_chase"), small_settings()
    model, worlds = untrained(scene, algorithm, settings)
    file = export(model, scene, config(algorithm, settings), tmp_path / "policy.onnx")
    network = Network(file)
    keys = ["vision", "orientation", "last_action"]
    assert [port.name for port in network.inputs] == keys
    assert [port.name for port in network.outputs] == ["move"]
    assert disagreement(model, network, worlds, keys) < 1e-5


@pytest.mark.parametrize(
    ("observation", "algorithm"),
    [
        ("dict", "ppo"),
        ("flat", "dqn"),
        pytest.param("dict", "dqn", marks=pytest.mark.nightly),
        pytest.param("flat", "ppo", marks=pytest.mark.nightly),
    ],
)
def test_choices_and_pictures(tmp_path: Path, algorithm: Algorithm, observation: str) -> None:
    scene, settings = Scene.loads(CHOICES), small_settings(observation=observation)
    model, worlds = untrained(scene, algorithm, settings)
    file = export(model, scene, config(algorithm, settings), tmp_path / "policy.onnx")
    network = Network(file)
    keys = ["bearing", "local_grid", "ground_status"]
    assert [port.name for port in network.inputs] == keys
    assert [(port.name, port.shape) for port in network.outputs] == [("choice", ())]
    assert disagreement(model, network, worlds, keys) == 0


def test_ppo_with_gsde_squashes(tmp_path: Path) -> None:
    ppo = small_settings().ppo.model_dump() | {"use_sde": True}
    scene, settings = Scene.load("box_chase"), small_settings(ppo=ppo)
    model, worlds = untrained(scene, "ppo", settings)
    network = Network(export(model, scene, config("ppo", settings), tmp_path / "policy.onnx"))
    assert disagreement(model, network, worlds, ["vision", "orientation", "last_action"]) < 1e-5


def test_what_the_file_says_of_itself(tmp_path: Path) -> None:
    done = small_training(tmp_path / "run", "sac", seed=5, observe=("orientation", "last_action"))
    run = done.run
    model = load_model("sac", run.best)
    one = export(model, run.scene(), run.config(), tmp_path / "one.onnx")
    two = export(model, run.scene(), run.config(), tmp_path / "two.onnx")
    assert one.read_bytes() == two.read_bytes()
    assert one.stat().st_size < 200_000
    network = onnx.load(one)
    entries = {entry.key: entry.value for entry in network.metadata_props}
    assert set(entries) == {TRAINING_KEY}
    about = json.loads(entries[TRAINING_KEY])
    assert (about["scene"], about["version"], about["algorithm"]) == (
        "box_chase",
        __version__,
        "sac",
    )
    assert (about["seed"], about["steps"], about["skip_frame"]) == (5, model.num_timesteps, 9)
    assert about["sensors"]["orientation"] == {
        "type": "OrientationSensor",
        "perception_key": "orientation",
        "target": "box",
        "shape": [2],
    }
    assert list(about["sensors"]) == ["last_action", "orientation"]
    assert about["actuators"]["move"]["move_amount"] == 5.0
    assert len(about["hash"]) == 64
    # nothing of the machine on which it was made
    assert str(Path(__file__).parents[3]).encode() not in one.read_bytes()
    assert b".py" not in one.read_bytes()


def test_a_network_decides_as_its_model_does(tmp_path: Path) -> None:
    """On a real agent, on all that it senses in a drive."""
    from ai4u_edu.learn.training.policies import entrant

    done = copied_training(tmp_path / "run")
    run = done.run
    export(load_model("ppo", run.best), run.scene(), run.config(), tmp_path / "policy.onnx")
    who, other = (entrant(str(tmp_path / name)) for name in ("run", "policy.onnx"))
    sim = who.fitted(Scene.load("box_chase")).build()
    agent = sim.agents[0]
    brain, network = who.brain(agent), other.brain(agent)
    agent.use_brain(network)
    agent.use_brain(brain)
    assert (brain.skip_frame, network.skip_frame) == (9, 9)
    sim.reset(4)
    for _ in range(30):
        one, two = brain.decide(agent.percept), network.decide(agent.percept)
        assert not isinstance(one, Command)
        assert not isinstance(two, Command)
        np.testing.assert_allclose(one["move"], two["move"], atol=1e-5)
        sim.step()
        if agent.done:
            sim.reset()


@pytest.mark.nightly  # writes three networks
@pytest.mark.parametrize("algorithm", ["ppo", "sac", "dqn"])
def test_the_critic_is_exported_too(tmp_path: Path, algorithm: Algorithm) -> None:
    import torch

    scene, settings = Scene.load("box_chase"), small_settings()
    model, _ = untrained(scene, algorithm, settings)
    how = config(algorithm, settings)
    network = Network(export(model, scene, how, tmp_path / "a.onnx", with_critic=True))
    assert [port.name for port in network.outputs] == ["move", VALUE_OUTPUT]
    rng = np.random.default_rng(0)
    for _ in range(20):
        percept = {port.name: drawn(port, rng) for port in network.inputs}
        seen = np.concatenate([each.ravel().astype(np.float32) for each in percept.values()])
        found = network.decide(percept)
        if algorithm != "dqn":
            action, _ = model.predict(seen, deterministic=True)
            np.testing.assert_allclose(found["move"], action, atol=1e-5)
        row = torch.as_tensor(seen)[None]
        with torch.no_grad():
            if algorithm == "ppo":
                value = model.policy.predict_values(row)
            elif algorithm == "dqn":
                value = model.q_net(row).max()
            else:
                action = model.policy.actor(row, deterministic=True)
                value = torch.cat(model.critic(row, action)).min()
        assert float(found[VALUE_OUTPUT][0]) == pytest.approx(float(value), rel=1e-3, abs=1e-4)

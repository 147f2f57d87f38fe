"""Export of a model as an ONNX file: numbers and operations from a fixed list, no program."""

import hashlib
import json
import logging
import tempfile
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
import onnx
import torch
from gymnasium import spaces
from stable_baselines3.common.base_class import BaseAlgorithm
from stable_baselines3.common.preprocessing import is_image_space
from torch import Tensor, nn

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.errors import SetupError
from ai4u_edu.base.version import __version__
from ai4u_edu.blocks.brains.network import TRAINING_KEY, VALUE_OUTPUT
from ai4u_edu.learn.envs.spaces_of import described_blocks, inputs_of, outputs_of
from ai4u_edu.learn.training.algorithms import CLASSES
from ai4u_edu.learn.training.prepare import prepare
from ai4u_edu.learn.training.run import Config
from ai4u_edu.learn.training.worlds import table_for
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene

OPSET = 18


class Exported:
    """A model's network as ONNX, with the metadata to drive an agent.

    It has one input for each sensor, by its perception key, of the shape of its reading with a
    first axis of any length; and one output by the actuator's name. Its metadata (entry
    ``ai4u_edu``, JSON) say where it was trained.

    Args:
        model: trained by :func:`~ai4u_edu.learn.training.learning.train`.
        scene: the scene it was trained in.
        config: the training's set-up.
        with_critic: True adds an output for the value that the critic expects.
    """

    def __init__(
        self, model: BaseAlgorithm, scene: Scene, config: Config, *, with_critic: bool = False
    ) -> None:
        settings = config.settings
        sim = prepare(scene, settings, learning=False).build()
        agent = sim.agent(settings.agent) if settings.agent else sim.agents[0]
        ((output, actuator),) = outputs_of(agent).items()
        inputs = inputs_of(agent)
        space: Any = actuator.space()
        chooses = config.algorithm == "dqn" and isinstance(space, spaces.Box)
        table = table_for(space, settings.actions) if chooses else None
        self._model = model
        self._drive = _PolicyModule(model, list(inputs), table, with_critic=with_critic)
        outputs = [output, VALUE_OUTPUT] if with_critic else [output]
        training = model.policy.training
        self._network = graph_of(self._drive.eval(), inputs, *outputs)
        model.policy.set_training_mode(training)
        self._about = {
            "version": __version__,
            "scene": config.scene,
            "algorithm": config.algorithm,
            "seed": config.seed,
            "skip_frame": agent.brain.skip_frame,
            "repeat_action": agent.brain.repeat_action,
            **described_blocks(agent),
        }

    def write(self, path: Path) -> Path:
        """Write it to a file atomically."""
        network = onnx.ModelProto()
        network.CopyFrom(self._network)
        network.producer_name, network.producer_version = "ai4u-edu", __version__
        digest = hashlib.sha256(network.SerializeToString(deterministic=True)).hexdigest()
        about = self._about | {"steps": self._model.num_timesteps, "hash": digest}
        entry = network.metadata_props.add()
        entry.key, entry.value = TRAINING_KEY, json.dumps(about, sort_keys=True)
        write_atomically(path, network.SerializeToString(deterministic=True))
        return path


def export(
    model: BaseAlgorithm, scene: Scene, config: Config, path: Path, *, with_critic: bool = False
) -> Path:
    """Write a model as an ONNX file; see :class:`Exported`."""
    return Exported(model, scene, config, with_critic=with_critic).write(path)


def graph_of(
    drive: nn.Module, inputs: dict[str, tuple[tuple[int, ...], np.dtype[Any]]], *outputs: str
) -> onnx.ModelProto:
    """Return the ONNX graph of a module that turns readings into an action.

    Args:
        drive: takes one array for each input, the first axis being the batch.
        inputs: shape and type of each input, by perception key.
        outputs: names of what the module gives.
    """
    batch = torch.export.Dim("batch")
    with tempfile.TemporaryDirectory() as folder, _silence():
        file = Path(folder) / "network.onnx"
        torch.onnx.export(
            drive,
            tuple(  # two rows of zeros
                torch.from_numpy(np.zeros((2, *shape), dtype)) for shape, dtype in inputs.values()
            ),
            file,
            input_names=list(inputs),
            output_names=list(outputs),
            opset_version=OPSET,
            dynamo=True,
            dynamic_shapes={"readings": tuple({0: batch} for _ in inputs)},
            external_data=False,
            verbose=False,
        )
        network = onnx.load(file)
    # the exporter notes where each operation stands in whose source code
    for node in network.graph.node:
        del node.metadata_props[:]
        node.doc_string = ""
    for value in (*network.graph.value_info, *network.graph.input, *network.graph.output):
        del value.metadata_props[:]
    for weights in network.graph.initializer:
        del weights.metadata_props[:]
    del network.graph.metadata_props[:]
    del network.metadata_props[:]
    onnx.checker.check_model(network)
    return network


@contextmanager
def _silence() -> Iterator[None]:
    """Suppress the exporter's output, which is for its own developers."""
    exporter = logging.getLogger("torch.onnx")
    level = exporter.level
    exporter.setLevel(logging.ERROR)
    try:
        with warnings.catch_warnings(), redirect_stdout(StringIO()):
            warnings.simplefilter("ignore")
            yield
    finally:
        exporter.setLevel(level)


class _PolicyModule(nn.Module):  # type: ignore[misc]  # seen without its types
    """Torch module of a model's deterministic policy: readings in, an action out.

    Scaling of the readings, the choice and the scaling to the actuator's range all happen inside.

    Args:
        model: a Stable-Baselines3 model: SAC, PPO or DQN.
        keys: the perception keys, in the order in which the readings come.
        table: (choices, numbers) the actions, where the model chooses them by number.
        with_critic: True also gives the value that the model's critic expects from there on.
    """

    def __init__(
        self,
        model: BaseAlgorithm,
        keys: Sequence[str],
        table: npt.NDArray[np.float32] | None = None,
        *,
        with_critic: bool = False,
    ) -> None:
        super().__init__()
        self._with_critic = with_critic
        self.policy: Any = model.policy
        self._kind = _kind_of(model)
        self._keys = tuple(keys)
        self._spaces = _spaces_of(model.observation_space)
        seen = model.observation_space
        self._picture = _seen_of(seen) if is_image_space(seen) else None
        action_space: Any = model.action_space
        self._continuous = isinstance(action_space, spaces.Box)
        if self._continuous:
            self.low: Tensor
            self.high: Tensor
            self.register_buffer("low", torch.as_tensor(action_space.low))
            self.register_buffer("high", torch.as_tensor(action_space.high))
        self.table: Tensor | None
        self.register_buffer("table", None if table is None else torch.as_tensor(table))

    def forward(self, *readings: Tensor) -> Tensor | tuple[Tensor, Tensor]:
        """Return an action for each row of the readings; with a critic, also its value, (n, 1)."""
        seen = self._observation(readings)
        action = self._act(seen)
        return (action, self._value(seen)) if self._with_critic else action

    def _value(self, seen: Any) -> Tensor:
        """Return the discounted reward that the critic expects: of SAC and DQN, of the action."""
        policy = self.policy
        if self._kind == "dqn":
            net = policy.q_net
            values: Tensor = net.q_net(self._features(seen, net.features_extractor))
            return values.max(dim=1, keepdim=True).values
        if self._kind == "sac":
            actor, critic = policy.actor, policy.critic
            latent = actor.latent_pi(self._features(seen, actor.features_extractor))
            squashed = torch.tanh(actor.mu(latent))
            inputs = torch.cat([self._features(seen, critic.features_extractor), squashed], dim=1)
            each = torch.cat([net(inputs) for net in critic.q_networks], dim=1)
            return each.min(dim=1, keepdim=True).values
        extractor = (
            policy.features_extractor
            if policy.share_features_extractor
            else policy.vf_features_extractor
        )
        latent = policy.mlp_extractor.forward_critic(self._features(seen, extractor))
        expected: Tensor = policy.value_net(latent)
        return expected

    def _act(self, seen: Any) -> Tensor:
        if self._kind == "sac":
            actor = self.policy.actor
            latent = actor.latent_pi(self._features(seen, actor.features_extractor))
            return self._scaled(torch.tanh(actor.mu(latent)))
        if self._kind == "dqn":
            net = self.policy.q_net
            return self._looked_up(net.q_net(self._features(seen, net.features_extractor)))
        policy = self.policy
        extractor = (
            policy.features_extractor
            if policy.share_features_extractor
            else policy.pi_features_extractor
        )
        latent = policy.mlp_extractor.forward_actor(self._features(seen, extractor))
        numbers = policy.action_net(latent)
        if not self._continuous:
            return self._looked_up(numbers)
        if policy.squash_output:
            return self._scaled(torch.tanh(numbers))
        return torch.minimum(torch.maximum(numbers, self.low), self.high)

    def _observation(self, readings: Sequence[Tensor]) -> Any:
        if self._picture:
            return _as_seen(readings[0], self._picture)
        if not self._spaces:
            return torch.cat([each.to(torch.float32).flatten(1) for each in readings], dim=1)
        named = zip(self._keys, readings, strict=True)
        return {key: _as_seen(each, self._spaces[key]) for key, each in named}

    def _features(self, seen: Any, extractor: nn.Module) -> Tensor:
        features: Tensor = extractor(seen)
        return features

    def _scaled(self, squashed: Tensor) -> Tensor:
        return self.low + 0.5 * (squashed + 1.0) * (self.high - self.low)

    def _looked_up(self, values: Tensor) -> Tensor:
        best = values.argmax(dim=1)
        return best if self.table is None else self.table[best]


class _ReadingForm(NamedTuple):
    """Form of one reading as a network's input."""

    choices: int
    """Count of values of a whole number, which is one-hot encoded; 0 for anything else."""
    is_picture: bool
    shape: tuple[int, ...]


def _spaces_of(space: spaces.Space[Any]) -> dict[str, _ReadingForm]:
    """Return the space of each reading; empty where they all come in one array."""
    if not isinstance(space, spaces.Dict):
        return {}
    return {key: _seen_of(each) for key, each in space.spaces.items()}


def _seen_of(space: spaces.Space[Any]) -> _ReadingForm:
    choices = int(space.n) if isinstance(space, spaces.Discrete) else 0
    return _ReadingForm(choices, is_image_space(space), space.shape or ())


def _as_seen(reading: Tensor, seen: _ReadingForm) -> Tensor:
    """Preprocess a reading as Stable-Baselines3 does."""
    if seen.choices:
        return nn.functional.one_hot(reading.to(torch.int64), seen.choices).to(torch.float32)
    if not seen.is_picture:
        return reading.to(torch.float32)
    if tuple(reading.shape[1:]) != seen.shape:
        reading = reading.permute(0, 3, 1, 2)  # it takes the channels first
    return reading.to(torch.float32) / 255.0


def _kind_of(model: BaseAlgorithm) -> str:
    for kind, cls in CLASSES.items():
        if isinstance(model, cls):
            return kind
    raise SetupError(
        _("expected a model of SAC, PPO or DQN, got {kind}", kind=type(model).__name__)
    )

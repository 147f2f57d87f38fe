"""Export of a model as an ONNX file: numbers and operations from a fixed list, no program."""

import hashlib
import json
import logging
import tempfile
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import onnx
import torch
from gymnasium import spaces
from stable_baselines3.common.base_class import BaseAlgorithm

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.version import __version__
from ai4u_edu.blocks.brains.network import TRAINING_KEY, VALUE_OUTPUT
from ai4u_edu.learn.envs.spaces_of import described_blocks, inputs_of, outputs_of
from ai4u_edu.learn.training.network import PolicyModule
from ai4u_edu.learn.training.prepare import prepare
from ai4u_edu.learn.training.run import Config
from ai4u_edu.learn.training.worlds import table_for
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
        self._drive = PolicyModule(model, list(inputs), table, with_critic=with_critic)
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
    drive: PolicyModule, inputs: dict[str, tuple[tuple[int, ...], np.dtype[Any]]], *outputs: str
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

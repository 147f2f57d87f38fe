"""A controller that runs a trained network."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ai4u_edu.base.errors import BlockError, shorten, suggest, text_of
from ai4u_edu.blocks.agent_view import AgentView, SensorView
from ai4u_edu.blocks.brains.brain import Answer, Command
from ai4u_edu.blocks.brains.controllers.controller import Controller
from ai4u_edu.blocks.brains.network import (
    VALUE_OUTPUT,
    Network,
    Port,
    find_network,
    folder_of_files,
)
from ai4u_edu.blocks.percept import Percept
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join
from ai4u_edu.world import WorldView

TRAINED_IN = "it was trained in the scene "
"""Beginning of the words about a network that does not fit, before its scene's name in quotes."""
MAX_SCENE_NAME_CHARS = 60


class NeuralNetController(Controller):
    """Takes each action from a trained network (an ONNX file).

    It needs a file in the format of ``ai4u-edu export``. Each input of the network has the name and
    shape of a sensor's reading (its perception key). The output is the action, scaled and clipped
    to the actuator's range inside the network. A network from another source works too if its
    inputs fit; numbers outside an actuator's range are then clipped.

    ``model_path`` is a path (relative to the scene file, or to the current folder), or ``zoo:``
    and a scene's name for the network that comes with the package.

    A network works best with the ``skip_frame`` of the brain with which it was trained;
    ``trained_brain(model_path)`` makes a LocalBrain with it.

    Source: AI4U's NeuralNetController.
    """

    model_path: str
    """Path of the ONNX file, or ``zoo:`` and a scene's name."""
    main_output: str = "move"
    """Actuator that gets the action if the network's output doesn't have an actuator's name."""
    repeat: bool = True
    """True starts a new episode when one is over."""

    def __post_init__(self) -> None:
        self._folder: Path | None = folder_of_files()
        self._network: Network | None = None

    @property
    def network(self) -> Network:
        """The network; loaded at first access."""
        if self._network is None:
            with self._named():
                self._network = Network(find_network(self.model_path, self._folder))
        return self._network

    def reload(self) -> None:
        """Load the file again; its network must have the same inputs and outputs as before."""
        path = self.network.path
        with self._named():
            self._network = Network(path)

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Load the network, and check that it fits the agent's sensors and actuators."""
        network = self.network
        name = network.path.name
        sensors = {each.perception_key: each for each in agent.sensors if each.is_active}
        wrong = [_misfit(port, sensors, network.about) for port in network.inputs]
        found = join(list(filter(None, wrong)), "; ")
        trained_in = network.about.get("scene")
        if found:
            who: dict[str, str] = {"name": name, "id": agent.id, "found": found}
            if not (isinstance(trained_in, str) and trained_in):
                raise BlockError(_("the network {name} does not fit agent {id!r}: {found}", **who))
            raise BlockError(
                _(
                    "the network {name} does not fit agent {id!r} (it was trained in the scene "
                    "{scene!r}): {found}",
                    scene=shorten(trained_in, MAX_SCENE_NAME_CHARS),
                    **who,
                )
            )
        actuators = {each.action_name: each for each in agent.actuators if each.is_active}
        outputs = [port for port in network.outputs if port.name != VALUE_OUTPUT]
        only = len(outputs) == 1
        self._targets = [
            (port.name, self.main_output if only and port.name not in actuators else port.name)
            for port in outputs
        ]
        for port, (_name, target) in zip(outputs, self._targets, strict=True):
            if target not in actuators:
                raise BlockError(
                    _(
                        "the network {name} drives an actuator {target}, and agent {id!r} has "
                        "none of that name; {hint}",
                        name=name,
                        target=repr(target),
                        id=agent.id,
                        hint=suggest(target, actuators),
                    )
                )
            takes, gives = len(actuators[target].limits()[0]), math.prod(port.shape)
            if takes != gives:
                raise BlockError(
                    _(
                        "the network {name} gives {gives} numbers for {target}, and that actuator "
                        "of agent {id!r} takes {takes}",
                        name=name,
                        gives=gives,
                        target=repr(target),
                        id=agent.id,
                        takes=takes,
                    )
                )

    def get_action(self, percept: Percept) -> Answer:
        """Return the network's action."""
        if self.repeat and percept["done"]:
            return Command.RESTART
        network = self.network
        try:
            outputs = network.decide(percept)
        except BlockError as error:
            raise self._named_error(error) from None
        return {target: outputs[name] for name, target in self._targets}

    @contextmanager
    def _named(self) -> Iterator[None]:
        """Add this block's name to errors."""
        try:
            yield
        except BlockError as error:
            raise self._named_error(error) from None

    def _named_error(self, error: BlockError) -> BlockError:
        title, problem = f"{type(self).__name__} {self.model_path!r}", text_of(error)
        named = BlockError(_("{title}: {problem}", title=title, problem=problem))
        named.problem = problem
        return named


def _misfit(port: Port, sensors: dict[str, SensorView], about: dict[str, Any]) -> str:
    """Return why an input does not fit its sensor, as a clause; empty if it fits."""
    sensor = sensors.get(port.name)
    if sensor is None:
        made_by = _type_of(port.name, about)
        about_it = {"name": port.name, "shape": str(port.shape)}
        hint = suggest(port.name, sensors)
        if not made_by:
            return _("sensor {name!r} of shape {shape} is missing; {hint}", hint=hint, **about_it)
        return _(
            "sensor {name!r} of shape {shape} (a {type}, where it was trained) is missing; {hint}",
            type=made_by,
            hint=hint,
            **about_it,
        )
    shape = sensor.observation_space().shape or ()
    if shape != port.shape:
        return _(
            "sensor {name!r} has the shape {shape}, and the network was trained with {shape2}",
            name=port.name,
            shape=str(shape),
            shape2=str(port.shape),
        )
    return ""


def _type_of(key: str, about: dict[str, Any]) -> str:
    sensors = about.get("sensors")
    described = sensors.get(key) if isinstance(sensors, dict) else None
    return str(described.get("type", "")) if isinstance(described, dict) else ""

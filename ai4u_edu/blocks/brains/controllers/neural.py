"""A trained network drives."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ai4u_edu.base.errors import BlockError, suggest
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.brains.command import Answer, Command
from ai4u_edu.blocks.brains.controllers.controller import Controller
from ai4u_edu.blocks.brains.network import Network, Port, find_network, folder_of_files
from ai4u_edu.blocks.percept import Percept
from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.world import WorldView


class NeuralNetController(Controller):
    """Asks a trained network (an ONNX file) for each action.

    It needs ``pip install "ai4u-edu[onnx]"``, and a file as ``ai4u-edu export`` writes it. Each of
    the network's inputs is called like a sensor's perception key and has the shape of that sensor's
    reading; its output is the action, scaled and cut to the actuator's range inside the network. A
    network from elsewhere fits as well if its inputs do; numbers out of an actuator's range are cut
    then.

    ``model_path`` is a path (a relative one begins beside the scene file, or in the current
    folder), or ``zoo:`` and a scene's name for the network that comes with the package.

    A network decides best in the rhythm in which it learned (``skip_frame`` of its brain);
    ``trained_brain(model_path)`` makes a LocalBrain that has it.

    Source: AI4U's NeuralNetController.
    """

    model_path: str
    """Path of the ONNX file, or ``zoo:`` and a scene's name."""
    main_output: str = "move"
    """The actuator that the action is for, where the network's output has no actuator's name."""
    repeat: bool = True
    """True begins a new episode when one is over."""

    def __post_init__(self) -> None:
        self._folder: Path | None = folder_of_files()
        self._network: Network | None = None

    @property
    def network(self) -> Network:
        """The network; loaded when it is needed first."""
        if self._network is None:
            with self._named():
                self._network = Network(find_network(self.model_path, self._folder))
        return self._network

    def reload(self) -> None:
        """Reads the file anew; the network in it has the same inputs and outputs as before."""
        path = self.network.path
        with self._named():
            self._network = Network(path)

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Loads the network, and checks that it fits the agent's sensors and actuators."""
        network = self.network
        name = network.path.name
        sensors = {each.perception_key: each for each in agent.sensors if each.is_active}
        wrong = [_misfit(port, sensors, network.about) for port in network.inputs]
        found = "; ".join(filter(None, wrong))
        if found:
            raise BlockError(f"the network {name} does not fit agent {agent.id!r}: {found}")
        actuators = {each.action_name: each for each in agent.actuators if each.is_active}
        only = len(network.outputs) == 1
        self._targets = [
            (port.name, self.main_output if only and port.name not in actuators else port.name)
            for port in network.outputs
        ]
        for port, (_, target) in zip(network.outputs, self._targets, strict=True):
            if target not in actuators:
                raise BlockError(
                    f"the network {name} drives an actuator {target!r}, and agent {agent.id!r} "
                    f"has none of that name; {suggest(target, actuators)}"
                )
            takes, gives = len(actuators[target].limits()[0]), math.prod(port.shape)
            if takes != gives:
                raise BlockError(
                    f"the network {name} gives {gives} numbers for {target!r}, and that actuator "
                    f"of agent {agent.id!r} takes {takes}"
                )

    def get_action(self, percept: Percept) -> Answer:
        """What the network says."""
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
        """Say in errors which block they come from."""
        try:
            yield
        except BlockError as error:
            raise self._named_error(error) from None

    def _named_error(self, error: BlockError) -> BlockError:
        return BlockError(f"{type(self).__name__} {self.model_path!r}: {error}")


def _misfit(port: Port, sensors: dict[str, Sensor], about: dict[str, Any]) -> str:
    """What is wrong with the sensor that an input reads, in a clause."""
    sensor = sensors.get(port.name)
    if sensor is None:
        made_by = _type_of(port.name, about)
        named = f" (a {made_by}, where it was trained)" if made_by else ""
        return (
            f"sensor {port.name!r} of shape {port.shape}{named} is missing; "
            f"{suggest(port.name, sensors)}"
        )
    shape = sensor.observation_space().shape or ()
    if shape != port.shape:
        return (
            f"sensor {port.name!r} has the shape {shape}, and the network was trained with "
            f"{port.shape}"
        )
    return ""


def _type_of(key: str, about: dict[str, Any]) -> str:
    sensors = about.get("sensors")
    described = sensors.get(key) if isinstance(sensors, dict) else None
    return str(described.get("type", "")) if isinstance(described, dict) else ""

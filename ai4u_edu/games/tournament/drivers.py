"""Controllers for an entry's drivers, made for one game."""

import base64
import time
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

import numpy as np

from ai4u_edu.agent import BasicAgent, ControlRequestor
from ai4u_edu.base.errors import BlockError
from ai4u_edu.blocks import (
    Answer,
    Block,
    Brain,
    Controller,
    LocalBrain,
    NeuralNetController,
    Percept,
)
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.brains.brain import Action
from ai4u_edu.blocks.brains.controllers.key_defaults import listens_to_keys
from ai4u_edu.blocks.brains.controllers.replay import ReplayController
from ai4u_edu.games.tournament.entry import Driver
from ai4u_edu.games.tournament.limits import LOAD_CPU_S, OverTimeError, over_load_time
from ai4u_edu.games.tournament.python_controller import PythonController
from ai4u_edu.games.tournament.sides import Sides
from ai4u_edu.locale import gettext as _
from ai4u_edu.recording import Episode
from ai4u_edu.recording.episode import decode
from ai4u_edu.scenes import Scene
from ai4u_edu.world import WorldView

ANSWERS = "answers"
"""Kind of a driver with the answers of a recorded game; see :class:`RecordedAnswers`."""


@dataclass(frozen=True)
class Made:
    """A controller, and how often it decides."""

    controller: Controller
    skip_frame: int
    repeat_action: bool


class RandomController(Controller):
    """Draws actions from the world's generator."""

    abstract = True  # an entry of a tournament

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Keep what it draws from."""
        self._view, self._name = view, f"{agent.id}/random entry"
        self._spaces = {
            each.action_name: each.space() for each in agent.actuators if each.is_output
        }

    def get_action(self, percept: Percept) -> Answer:  # noqa: ARG002  # it looks at nothing
        """Return a random action."""
        rng = self._view.random(self._name)
        return {name: _drawn(space, rng) for name, space in self._spaces.items()}


class RecordedAnswers(Controller):
    """Gives the answers of a recorded game again, in place of what can't be asked a second time.

    Where it has no more of them, its program failed, or the end of the game cut off a decision.
    """

    abstract = True  # for a game that is verified

    def attach(self, actions: Sequence[Action], reason: str) -> None:
        """Set the answers, and the reason for which there are no more; empty if it did not fail."""
        self._actions, self._reason, self._turn = actions, reason, 0

    def get_action(self, percept: Percept) -> Answer:  # noqa: ARG002  # it looks at nothing
        """Return the next answer.

        Raises:
            BlockError: it failed at this decision.
        """
        self._turn += 1
        if self._turn > len(self._actions) and self._reason:
            raise BlockError(self._reason)
        return self._actions[min(self._turn, len(self._actions)) - 1]


def driver_for(drivers: Mapping[str, Driver], sides: Sides, agent_id: str) -> Driver:
    """Return an entry's driver for an agent.

    Raises:
        BlockError: the entry has none for it.
    """
    for part in (*sides.parts_of(agent_id), ""):
        if part in drivers:
            return drivers[part]
    raise BlockError(
        _(
            "it has no driver for agent {agent_id!r}; expected one of {parts_of} in "
            "NAME=PART:SPEC,PART:SPEC",
            agent_id=agent_id,
            parts_of=", ".join(sides.parts_of(agent_id)),
        )
    )


def make(
    driver: Driver, sim: ControlRequestor, sides: Sides, agent: BasicAgent, folder: Path, seed: int
) -> Made:
    """Return a driver's controller for an agent.

    Args:
        driver: the driver.
        sim: the world of the game, as its scene built it.
        sides: of the scene.
        agent: the agent.
        folder: a folder for files.
        seed: of the game.

    Raises:
        AI4UError: it can't be made; a sentence on the entry.
        OverTimeError: a network took too long to load.
    """
    own = agent.brain
    kind = driver["kind"]
    if kind == "network":
        return _network(driver, own, folder)
    if kind == "scene":
        return scripted(sim, sides, agent)
    if kind == "episode":
        return _recorded(driver, sides, agent, own)
    if kind == ANSWERS:
        return Made(_answers(driver, agent), own.skip_frame, own.repeat_action)
    controller: Controller
    if kind == "python":
        controller = PythonController()
        source = base64.b64decode(driver["data"]).decode("utf-8", "replace")
        controller.attach(source, driver["file"], driver["name"], f"{seed}/{agent.id}")
    elif kind == "controller":
        controller = cast(Controller, Block.types[driver["type"]]())
    else:
        controller = RandomController()
    return Made(controller, own.skip_frame, own.repeat_action)


def scripted_agents(scene: Scene, sides: Sides) -> frozenset[str]:
    """Return the ids of the agents that a scene's own scripted controllers can drive."""
    sim = scene.build()
    found = set()
    for agent in sim.agents:
        with suppress(BlockError):
            scripted(sim, sides, agent)
            found.add(agent.id)
    return frozenset(found)


def load_network(driver: Driver, folder: Path) -> NeuralNetController:
    """Return the controller of a network, which is loaded.

    Args:
        driver: the network.
        folder: gets its file.

    Raises:
        OverTimeError: that took too long.
        BlockError: it is no network.
    """
    place = folder / str(len([*folder.iterdir()]))
    place.mkdir()
    path = place / Path(driver["file"]).name[-100:]
    path.write_bytes(base64.b64decode(driver["data"]))
    controller = NeuralNetController(model_path=str(path), repeat=False)
    began = time.thread_time()
    _ = controller.network
    if time.thread_time() - began > LOAD_CPU_S:
        raise OverTimeError(over_load_time())
    return controller


def _network(driver: Driver, own: Brain, folder: Path) -> Made:
    controller = load_network(driver, folder)
    rhythm = controller.network.rhythm
    given = LocalBrain(controller=controller).changed(
        **{"skip_frame": own.skip_frame, "repeat_action": own.repeat_action} | rhythm
    )
    return Made(controller, given.skip_frame, given.repeat_action)


def scripted(sim: ControlRequestor, sides: Sides, agent: BasicAgent) -> Made:
    """Return the scene's scripted controller for an agent, or that of its counterpart.

    Raises:
        BlockError: neither has one.
    """
    for name in filter(None, (agent.id, sides.counterpart(agent.id))):
        for brain in sim.agent(name).brains:
            controller = getattr(brain, "controller", None)
            if isinstance(controller, Controller) and not listens_to_keys(type(controller)):
                fresh = type(controller)(**controller.given())
                return Made(fresh, brain.skip_frame, brain.repeat_action)
    raise BlockError(_("the scene has no scripted controller for agent {id!r}", id=agent.id))


def _answers(driver: Driver, agent: BasicAgent) -> RecordedAnswers:
    """Return the answers of an agent.

    Raises:
        BlockError: it failed before its first decision.
    """
    actions: list[Action] = []
    if driver["data"]:
        episode = decode(Episode, base64.b64decode(driver["data"]), "recording")
        actions = [each.action for each in episode.agent(agent.id)]
    if not actions:
        raise BlockError(
            driver["reason"] or _("agent {id!r} has no decision in its recording", id=agent.id)
        )
    controller = RecordedAnswers()
    controller.attach(actions, driver["reason"])
    return controller


def _recorded(driver: Driver, sides: Sides, agent: BasicAgent, own: Brain) -> Made:
    episode = decode(Episode, base64.b64decode(driver["data"]), driver["file"])
    names = (agent.id, sides.counterpart(agent.id))
    record = next((each for name in names for each in episode.agents if each.id == name), None)
    if record is None or not len(record):
        raise BlockError(
            _("{file}: it has no decision of agent {id!r}", file=driver["file"], id=agent.id)
        )
    actions = [{name: list(numbers) for name, numbers in each.action.items()} for each in record]
    skip = int(record.skip[0])
    return Made(ReplayController(actions=actions, ending="repeat"), skip, own.repeat_action)


def _drawn(space: Any, rng: np.random.Generator) -> Any:
    if hasattr(space, "n"):
        return int(space.start + rng.integers(space.n))
    return rng.uniform(space.low, space.high)

"""Keeps the last episodes of a world, whoever drives its agents."""

import logging
import sys
from collections.abc import Callable
from typing import Any, TypeVar

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.block_errors import message_of
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import Block
from ai4u_edu.recording.archive import Archive
from ai4u_edu.recording.checksum import everything
from ai4u_edu.recording.episode import Episode
from ai4u_edu.recording.episode_builder import EpisodeBuilder
from ai4u_edu.recording.errors import RecordingError
from ai4u_edu.recording.scene_export import export_scene
from ai4u_edu.scenes import SceneDescription

T = TypeVar("T")

logger = logging.getLogger(__name__)


class Recorder:
    """Listens to all agents of a world, and keeps its last episodes.

    It hears what the brains decided and does not ask them, so it does not matter who drives: a
    person, a script, a network, an environment's ``step``. Switched off, it listens to nothing.

    Args:
        sim: the world and its agents. An episode that is under way already is left out.
        scene: where it comes from; its name, title and goal go into the episodes.
        keep: how many episodes are kept.
        episodes: where they are kept; left out, in an archive for ``keep`` of them.
        on_episode: called with each one when it is over, in the thread that runs the world. What it
            raises stops nothing: it is logged, and told by :attr:`save_problem`.

    >>> from ai4u_edu import Scene
    >>> scene = Scene.load("box_chase")
    >>> sim = scene.build()
    >>> recorder = Recorder(sim, scene=scene.description)
    >>> sim.reset(seed=5)
    >>> for _ in range(3):
    ...     percept = sim.step()
    >>> sim.reset()
    >>> episode = recorder.episodes[-1]
    >>> episode.seed, len(episode.agent("0")), episode.seconds
    (5, 3, 0.25)
    """

    def __init__(
        self,
        sim: ControlRequestor,
        *,
        scene: SceneDescription | None = None,
        keep: int = 50,
        episodes: Archive | None = None,
        on_episode: Callable[[Episode], object] | None = None,
    ) -> None:
        self.sim = sim
        self.scene = scene
        self.episodes = Archive(keep, sys.maxsize) if episodes is None else episodes
        """Those that are over, the latest last."""
        self.problem = ""
        """Why the episode that is under way can't be recorded; empty if it can."""
        self.save_problem = ""
        """Why ``on_episode`` failed with the last episode, which is kept; empty if it did not."""
        self.on_episode = on_episode
        self._builder: EpisodeBuilder | None = None
        self._world_episode = sim.episode
        self._listening = False
        self._attend()

    def listen_to(self, sim: ControlRequestor) -> None:
        """Listens to another world from now on; what was heard of this one so far is kept."""
        listened = self._listening
        self.switch(False)
        self.sim, self._world_episode = sim, sim.episode
        if listened:
            self._attend()

    def switch(self, on: bool) -> None:
        """On: listens from the next reset on. Off: what was heard so far is kept as an episode."""
        if on == self._listening:
            return
        self._listening = on
        if not on:
            self.finish()
        for agent in self.sim.agents:
            for event, handler in (
                (agent.before_the_reset, self._leave),
                (agent.begin_of_episode, self._first),
                (agent.begin_of_step, self._decided),
                (agent.end_of_update_state, self._sensed),
            ):
                (event.connect if on else event.disconnect)(handler)

    def now(self) -> Episode | None:
        """The episode that is under way, as far as it got."""
        return None if self._builder is None else self._builder.episode()

    def finish(self) -> None:
        """The episode that is under way is over: nothing more of it is recorded."""
        builder, self._builder = self._builder, None
        if builder is None:
            return
        episode = builder.episode()
        if not any(map(len, episode.agents)):
            return
        self.episodes.append(episode)
        if self.on_episode is not None:
            self._hand_on(episode, self.on_episode)

    def guard(self, command: Callable[[], T]) -> T:
        """Carries out what somebody asked for, and notices whether the world was changed by that.

        An episode can be played again exactly up to such a change, and not beyond.
        """
        builder = self._builder
        if builder is None or builder.changed is not None:
            return command()
        ticks, restarts, before = self.sim.world.ticks, builder.restarts, self._all()
        try:
            return command()
        finally:
            same = self._builder is builder and builder.restarts == restarts
            if same and self.sim.world.ticks == ticks and self._all() != before:
                builder.changed = ticks

    def _hand_on(self, episode: Episode, on_episode: Callable[[Episode], object]) -> None:
        """Call ``on_episode``; a full disk must neither refuse the reset nor stop the world."""
        before, self.save_problem = self.save_problem, ""
        try:
            on_episode(episode)
        except Exception as error:
            self.save_problem = f"the last episode could not be saved: {message_of(error)}"
            if not before:  # once, and not with every episode
                logger.warning("%s; it is kept in memory", self.save_problem)

    def _attend(self) -> None:
        """Begins to listen; an episode that has only just begun is heard from its beginning."""
        self.switch(True)
        if self.sim.episode and self.sim.world.ticks == 0 and self.sim.between_decisions():
            self._begin()
            for agent in self.sim.agents:
                self._first(agent)

    # -- what it hears ---------------------------------------------------------------------------

    def _leave(self, _agent: BasicAgent) -> None:
        if self._builder is not None:
            self._builder.leave()

    def _first(self, agent: BasicAgent) -> None:
        if self.sim.episode != self._world_episode:
            self.finish()
            self._begin()
        if self._builder is not None:
            self._builder.first(agent)

    def _decided(self, agent: BasicAgent) -> None:
        if self._builder is not None:
            self._builder.decided(agent)

    def _sensed(self, agent: BasicAgent) -> None:
        if self._builder is not None:
            self._builder.sensed(agent)

    def _begin(self) -> None:
        self._world_episode = self.sim.episode
        self.problem = ""
        try:
            self._builder = EpisodeBuilder(self.sim, export_scene(self.sim, self.scene))
        except RecordingError as error:  # no reason for the world to stop
            self.problem = str(error)

    def _all(self) -> list[Any]:
        """All that a person may change by hand; who drives is no part of it."""
        blocks: list[Any] = [everything(self.sim.world)]
        for agent in self.sim.agents:
            blocks.append(agent.bound_blocks)
            blocks += [
                (block, _values(block))
                for block in (*agent.sensors, *agent.actuators, *agent.rewards)
            ]
        return blocks


def _values(block: Block) -> dict[str, Any]:
    return {name: repr(value) for name, value in block.values().items()}

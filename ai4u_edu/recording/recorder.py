"""Recorder of a world's episodes."""

import logging
import sys
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any, Self, TypeVar

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.block_errors import message_of
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.atomic_write import make_folder, write_atomically
from ai4u_edu.base.errors import text_of
from ai4u_edu.base.limits import DEFAULT_KEPT_EPISODES
from ai4u_edu.blocks import Block
from ai4u_edu.blocks.agent_view import AgentInput
from ai4u_edu.locale import gettext as _
from ai4u_edu.recording.archive import Archive, ArchiveEntry
from ai4u_edu.recording.checksum import editable_state
from ai4u_edu.recording.episode import Episode, encode
from ai4u_edu.recording.episode_builder import EpisodeBuilder
from ai4u_edu.recording.errors import RecordingError
from ai4u_edu.recording.scene_export import export_scene
from ai4u_edu.scenes import Scene, SceneDescription

T = TypeVar("T")

logger = logging.getLogger(__name__)

MAX_SCENE_NAME_BYTES = 150
"""Length of a scene's name in the name of a file."""


class Recorder:
    """Records the episodes of a world from its agents' events, and archives the last ones.

    It does not matter who drives: a person, a script, a network, an environment's ``step``.

    Args:
        sim: the world and its agents. An episode that has already begun is not recorded.
        scene: the scene of the world; its name, title and goal go into the episodes.
        keep: number of episodes to keep.
        episodes: archive for the episodes; by default a new one for ``keep`` of them.
        on_episode: first one of the :attr:`listeners`.

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
        """Finished episodes, the latest last."""
        self.problem = ""
        """Sentence about why the present episode can't be recorded; empty if it can."""
        self.save_problem = ""
        """Sentence about why a listener failed with the last episode; empty if none did."""
        self.listeners = [] if on_episode is None else [on_episode]
        """Called with each episode when it is over, in the thread that runs the world. Their
        exceptions are logged, and in :attr:`save_problem`."""
        self.done_listeners: list[Callable[[Episode], object]] = []
        """Called in the same way with the episode so far when all its agents are done; it is over
        when the next one begins, and some of them may restart before."""
        self._builder: EpisodeBuilder | None = None
        self._kept: ArchiveEntry | None = None
        """The present episode's entry, once all its agents were done; a person who has just won
        looks for it in the past before the next one begins."""
        self._early_inputs: list[tuple[BasicAgent, AgentInput]] = []
        self.world_episode = sim.episode
        """Number by which the world counts the present episode."""
        self._listening = False
        self._start()

    @classmethod
    def into(
        cls,
        folder: Path | None,
        sim: ControlRequestor,
        scene: Scene,
        keep: int = DEFAULT_KEPT_EPISODES,
    ) -> Self:
        """Return a recorder that also writes each episode to a folder when it ends.

        An episode that can't be written, for example since the disk is full, stays in memory.

        Args:
            folder: folder for episode files; None writes none.
            sim: the world and its agents.
            scene: the scene that the world was built from.
            keep: number of episodes that are kept in memory.

        Raises:
            SetupError: the folder can't be created.
        """
        write = None
        if folder is not None:
            make_folder(folder, _("recorded episodes"))
            write = partial(_write, folder)
        return cls(sim, scene=scene.description, episodes=Archive(keep), on_episode=write)

    def listen_to(self, sim: ControlRequestor) -> None:
        """Record another world from now on; the present episode is finished."""
        listened = self._listening
        self.set_enabled(False)
        self.sim, self.world_episode = sim, sim.episode
        if listened:
            self._start()

    def set_enabled(self, enabled: bool) -> None:
        """Start recording with the next reset, or stop it and finish the present episode."""
        if enabled == self._listening:
            return
        self._listening = enabled
        if not enabled:
            self.finish()
        for agent in self.sim.agents:
            for event, handler in (
                (agent.before_the_reset, self._on_reset),
                (agent.begin_of_episode, self._on_episode_begin),
                (agent.begin_of_step, self._on_decision),
                (agent.percept_ready, self._on_percept),
                (agent.input_given, self._on_input),
            ):
                (event.connect if enabled else event.disconnect)(handler)

    def current_episode(self) -> Episode | None:
        """Return the present episode so far; None if none is being recorded."""
        return None if self._builder is None else self._builder.episode()

    @property
    def current_scene(self) -> SceneDescription | None:
        """The scene of the present episode, as recorded; None if none is being recorded."""
        return None if self._builder is None else self._builder.scene

    def finish(self) -> None:
        """Finish the present episode; the rest of it is not recorded."""
        builder, self._builder = self._builder, None
        if builder is None:
            return
        episode = builder.episode()
        if not any(map(len, episode.agents)):
            return
        self._keep(episode)
        self._kept = None
        before, self.save_problem = self.save_problem, ""
        self._tell(episode, self.listeners)
        if self.save_problem and not before:  # warn once, not with every episode
            logger.warning("%s; it is kept in memory", self.save_problem)

    def guard(self, command: Callable[[], T]) -> T:
        """Run a command, and record the tick if it edited the world.

        The exact replay of an episode ends at such a change.
        """
        builder = self._builder
        if builder is None or builder.changed is not None:
            return command()
        ticks, restarts, before = self.sim.world.ticks, builder.restarts, self._editable_state()
        try:
            return command()
        finally:
            same = self._builder is builder and builder.restarts == restarts
            if same and self.sim.world.ticks == ticks and self._editable_state() != before:
                builder.changed = ticks

    def _tell(self, episode: Episode, listeners: Sequence[Callable[[Episode], object]]) -> None:
        """Call listeners; an error there, such as a full disk, must not stop the world."""
        for listener in listeners:
            try:
                listener(episode)
            except Exception as error:
                self.save_problem = _(
                    "the last episode could not be saved: {error}", error=message_of(error)
                )

    def _start(self) -> None:
        """Start recording; an episode that has just begun is recorded from its beginning."""
        self.set_enabled(True)
        if self.sim.episode and self.sim.world.ticks == 0 and self.sim.between_decisions():
            self._begin()
            for agent in self.sim.agents:
                self._on_episode_begin(agent)

    def _on_reset(self, agent: BasicAgent) -> None:
        self._early_inputs = [each for each in self._early_inputs if each[0] is not agent]
        for sensor in agent.bound_blocks.array_sensors():
            if not sensor.resetable and sensor.numbers.any():  # it keeps them through the reset
                kept = AgentInput(sensor.perception_key, 0, tuple(sensor.numbers.tolist()))
                self._early_inputs.append((agent, kept))
        if self._builder is not None:
            self._builder.end_restart()

    def _on_input(self, agent: BasicAgent) -> None:
        if agent.latest_input is None:
            return
        if self._builder is not None and self.sim.episode == self.world_episode:
            self._builder.add_input(agent, agent.latest_input)
        elif self.sim.world.ticks == 0:  # the reset is under way
            self._early_inputs.append((agent, agent.latest_input))

    def _on_episode_begin(self, agent: BasicAgent) -> None:
        if self.sim.episode != self.world_episode:
            self.finish()
            self._begin()
        if self._builder is not None:
            self._builder.begin_episode(agent)

    def _on_decision(self, agent: BasicAgent) -> None:
        if self._builder is not None:
            self._builder.begin_decision(agent)

    def _on_percept(self, agent: BasicAgent) -> None:
        if self._builder is None:
            return
        self._builder.end_decision(agent)
        # agents that end in the same tick get their last percepts one after another
        is_over = agent.done and all(each.done for each in self.sim.agents)
        if is_over and not self._builder.has_open_decision:
            episode = self._builder.episode()
            self._keep(episode)
            self._tell(episode, self.done_listeners)

    def _keep(self, episode: Episode) -> None:
        """Keep the present episode, or what it has become since it was kept."""
        if self._kept is None:
            self._kept = self.episodes.append(episode, world_episode=self.world_episode)
        else:
            self.episodes.update(self._kept.number, episode)

    def _begin(self) -> None:
        self.world_episode = self.sim.episode
        self.problem = ""
        try:
            self._builder = EpisodeBuilder(self.sim, export_scene(self.sim, self.scene))
            for early in self._early_inputs:
                self._builder.add_input(*early)
            self._early_inputs = []
        except RecordingError as error:  # must not stop the world
            self.problem = text_of(error)

    def _editable_state(self) -> list[Any]:
        """Return everything that a person can edit, except for brains."""
        blocks: list[Any] = [editable_state(self.sim.world)]
        for agent in self.sim.agents:
            blocks.append(agent.bound_blocks)
            blocks += [
                (block, _values(block))
                for block in (*agent.sensors, *agent.actuators, *agent.rewards)
            ]
        return blocks


def _values(block: Block) -> dict[str, Any]:
    return {name: repr(value) for name, value in block.values().items()}


def _write(folder: Path, episode: Episode) -> None:
    """Write an episode to a file of its own."""
    folder.mkdir(parents=True, exist_ok=True)  # somebody may have removed it meanwhile
    scene = episode.scene.name.encode()[:MAX_SCENE_NAME_BYTES].decode(errors="ignore")
    name, data, count = f"{scene}-{episode.seed}", encode(episode), 1
    path = folder / f"{name}.episode"
    while True:
        try:
            write_atomically(path, data, over=False)
        except FileExistsError:  # of an earlier episode, or of another server
            count += 1
            path = folder / f"{name}-{count}.episode"
        else:
            return

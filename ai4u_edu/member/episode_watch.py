"""Counts and results of a world's episodes, for its class."""

import logging
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.recording import Episode
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot import AgentState, capture_agent
from ai4u_edu.snapshot.agent_words import driver_title

logger = logging.getLogger(__name__)

PERSON = "A person"
MAX_WAITING = 100
"""Ended episodes that wait to be reported; the oldest are dropped."""


@dataclass(frozen=True)
class EndedEpisode:
    """An episode of the first agent that has ended."""

    world_episode: int
    seed: int
    agents: tuple[AgentState, ...]
    """All agents at that time; the first one's episode has ended."""
    success: str
    seconds: float
    driver: str
    recorded: Episode | None
    """The recorded episode, if it was asked for."""

    def outcome(self, latest: tuple[AgentState, ...], latest_episode: int) -> str:
        """Return the end in a word; agents that end in the same tick are known a moment later.

        Args:
            latest: the agents in the latest snapshot.
            latest_episode: the world's episode there.
        """
        agents = self.agents
        is_same = latest_episode == self.world_episode and [
            (each.id, each.episode) for each in latest
        ] == [(each.id, each.episode) for each in agents]
        if is_same and latest[0].terminated | latest[0].truncated:
            agents = latest
        return agents[0].outcome(agents, self.success)


class EpisodeWatch:
    """Watches the episodes of a runner's first agent.

    The agent's events call it in the world's thread; :meth:`take` and :meth:`follow` belong to
    another one.

    Args:
        runner: runs the world.
        scene_of: returns the scene that was opened last, whatever identifies it; called in the
            world's thread.
    """

    def __init__(self, runner: Runner, scene_of: Callable[[], object]) -> None:
        self._runner, self._scene_of = runner, scene_of
        self._sim: ControlRequestor | None = None
        self._agent_episode = 0
        self._began_at = 0.0
        self._is_over = False
        self._ended: deque[EndedEpisode] = deque(maxlen=MAX_WAITING)
        self.scene: object = None
        """The scene whose episodes are counted."""
        self.begun = 0
        """Episodes of this scene that have begun."""
        self.has_recordings = False
        """True if the recorded episodes are wanted too."""

    def follow(self) -> None:
        """Follow the runner to another world, if it runs another one."""
        if self._runner.sim is not self._sim:
            self._sim = self._runner.sim
            self._runner.submit(self._attach)

    def take(self) -> list[EndedEpisode]:
        """Remove and return the episodes that have ended, in order."""
        found = []
        while self._ended:
            found.append(self._ended.popleft())
        return found

    def stop(self) -> None:
        """Stop to watch."""
        sim, self._sim = self._sim, None
        if sim is not None:
            self._runner.submit(lambda: self._detach(sim))

    # -- in the world's thread -------------------------------------------------------------------

    def _attach(self) -> None:
        sim = self._sim
        if sim is None or sim is not self._runner.sim:
            return
        agent, scene = sim.agents[0], self._scene_of()
        if scene is not self.scene:
            self.scene, self.begun = scene, 0
        self._agent_episode = 0
        self._note_episode(agent)
        # connected after the recorder's handler, which has then recorded the same decision
        agent.percept_ready.connect(self._on_percept)

    def _detach(self, sim: ControlRequestor) -> None:
        event = sim.agents[0].percept_ready
        if self._on_percept in event.handlers:
            event.disconnect(self._on_percept)

    def _on_percept(self, agent: BasicAgent) -> None:
        try:
            self._note_episode(agent)
            if agent.done and not self._is_over:
                self._is_over = True
                self._ended.append(self._end_of(agent))
        except Exception:  # a class must not stop the world
            logger.warning("an episode could not be reported to the class", exc_info=True)

    def _note_episode(self, agent: BasicAgent) -> None:
        if agent.episode != self._agent_episode:
            self._agent_episode, self._is_over = agent.episode, agent.done
            self._began_at = self._runner.sim.world.time
            self.begun += 1

    def _end_of(self, agent: BasicAgent) -> EndedEpisode:
        sim, recorder = self._runner.sim, self._runner.recorder
        states = tuple(capture_agent(each, sim.success, sim.phase(each)) for each in sim.agents)
        wants_recording = self.has_recordings and recorder is not None
        return EndedEpisode(
            world_episode=sim.episode,
            seed=sim.world.seeds.seed,
            agents=states,
            success=sim.success,
            seconds=sim.world.time - self._began_at,
            driver=driver_of(agent, states[0]),
            recorded=recorder.current_episode() if recorder and wants_recording else None,
        )


def driver_of(agent: BasicAgent, state: AgentState) -> str:
    """Return the title of an agent's driver."""
    return PERSON if state.is_driven_by_keys else driver_title(agent.brain)

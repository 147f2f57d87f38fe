"""Exact replay of a recorded episode."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import AI4UError, suggest, text_of
from ai4u_edu.blocks import Brain, Percept
from ai4u_edu.locale import gettext as _
from ai4u_edu.recording.agent_record import RecordedDecision
from ai4u_edu.recording.episode import Episode
from ai4u_edu.recording.errors import RecordingError
from ai4u_edu.recording.player import Player
from ai4u_edu.recording.recorder import Recorder
from ai4u_edu.recording.scene_export import export_scene, without_brains, without_unknown_brains
from ai4u_edu.recording.verdict import Verdict, compare
from ai4u_edu.scenes import Scene
from ai4u_edu.snapshot import (
    Snapshot,
    StaticScene,
    capture_snapshot,
    capture_static_scene,
)

CACHED_MOMENTS = 100
"""Moments that are cached before one that was stepped back to."""


@dataclass(frozen=True)
class ReplayMoment:
    """The moment at which a decision was taken."""

    decision: RecordedDecision
    """The decision's action and reward."""
    percept: Percept
    """The percept that the agent's brain got."""
    snapshot: Snapshot
    """Everything else at that moment."""


class Replay:
    """Replays an episode, and gives any of its moments.

    It gives exact moments only: before the first one, the whole episode is replayed once, and every
    percept, reward and pose is compared with the recording.

    Args:
        episode: the recorded episode.
        on_step: called before each step of the replay; an exception that it raises ends the replay.

    >>> from ai4u_edu import LocalBrain, Scene
    >>> sim = Scene.load("box_chase").build()
    >>> sim.agents[0].use_brain(LocalBrain(controller=lambda percept: {"move": [1, 0.5, 0, 0]}))
    >>> recorder = Recorder(sim)
    >>> sim.reset(seed=5)
    >>> seen = [sim.agents[0].percept] + [sim.step() for _ in range(20)]
    >>> recorder.finish()
    >>> replay = Replay(recorder.episodes[-1])
    >>> replay.verdict.exact
    True
    >>> moment = replay.at(12)
    >>> moment.percept == seen[12], moment.decision.action, moment.snapshot.tick
    (True, {'move': (1.0, 0.5, 0.0, 0.0)}, 60)
    """

    def __init__(self, episode: Episode, *, on_step: Callable[[], object] | None = None) -> None:
        self.episode = episode
        self._player = Player(episode, on_step=on_step)
        self._static_scene: tuple[int, StaticScene] | None = None
        self._cache: dict[tuple[int, int], ReplayMoment] = {}
        self._last = (0, -1)

    @cached_property
    def verdict(self) -> Verdict:
        """The exactness of the replay, found by replaying the whole episode once."""
        recorder = Recorder(self._player.sim)
        self._player.rewind()
        limit = self.episode.ticks if self.episode.changed is None else self.episode.changed
        problem = ""
        try:
            while not self._player.is_over and self._player.sim.world.ticks < limit:
                self._player.advance()
        except AI4UError as error:
            problem = text_of(error)
        again = recorder.current_episode()
        recorder.listeners.clear()
        recorder.set_enabled(False)
        if again is None:
            return Verdict(False, 0, _("it can't be compared: {problem}", problem=recorder.problem))
        return compare(self.episode, again, problem)

    def at(self, step: int, agent: str | None = None) -> ReplayMoment:
        """Return the moment at which a decision was taken.

        Args:
            step: the agent's decision, from 0; a negative one counts from the end.
            agent: id of the agent; by default the one that acts first.

        Raises:
            RecordingError: there is no such decision, or it can't be replayed exactly.
        """
        index, step = self._find(step, agent)
        if (index, step) not in self._cache:
            # a step back replays from the start, and is often followed by another one
            back = CACHED_MOMENTS if self._last[0] == index and step < self._last[1] else 0
            self._cache = {}
            for each in range(max(0, step - back), step + 1):
                self._player.seek(index, each)
                self._cache[index, each] = self._moment(index, each)
        self._last = index, step
        return self._cache[index, step]

    def moments(self, agent: str | None = None) -> Iterator[ReplayMoment]:
        """Yield all moments that can be replayed exactly, in order."""
        index = self.episode.ids.index(self.episode.agent(agent).id)
        for step, begin in enumerate(self.episode.agents[index].begin.tolist()):
            if begin >= self.verdict.exact_until:
                return
            self._player.seek(index, step)
            yield self._moment(index, step)

    def snapshots(self, every: int = 1) -> Iterator[Snapshot]:
        """Yield snapshots from the beginning to the end, or as far as the replay is exact.

        Args:
            every: ticks between two snapshots. The last one is always included.
        """
        until = min(self.verdict.exact_until, self.episode.ticks)
        player = self._player
        player.rewind()
        yield self._snapshot()
        while player.sim.world.ticks < until and not player.is_over:
            before = player.sim.world.ticks
            player.advance(tick_by_tick=True)
            ticks = player.sim.world.ticks
            if ticks > before and (ticks % every == 0 or ticks == until):
                yield self._snapshot()

    def percepts(self, agent: str | None = None) -> list[list[Percept]]:
        """Return all percepts of an agent, by its own episodes.

        Args:
            agent: id of the agent; by default the one that acts first.

        Returns:
            For each episode its first percept, and the percept after each decision.

        Raises:
            RecordingError: the episode can't be replayed exactly.
        """
        index = self.episode.ids.index(self.episode.agent(agent).id)
        if not self.verdict.exact:
            raise RecordingError(self._inexact())
        player, found = self._player, list[list[Percept]]()

        def began(agent: BasicAgent) -> None:
            found.append([agent.percept])

        def sensed(agent: BasicAgent) -> None:
            if found and agent.steps == len(found[-1]):  # not at the begin of an episode
                found[-1].append(agent.percept)

        driver = player.sim.agents[index]
        driver.begin_of_episode.connect(began)
        driver.percept_ready.connect(sensed)
        player.rewind()
        while not player.is_over:
            player.advance()
        driver.begin_of_episode.disconnect(began)
        driver.percept_ready.disconnect(sensed)
        return found

    def continue_from(
        self,
        step: int,
        *,
        agent: str | None = None,
        brains: Mapping[str, Brain] | None = None,
        sim: ControlRequestor | None = None,
    ) -> ControlRequestor:
        """Return a world at a moment of the episode, to go on from there with other brains.

        Args:
            step: the agent's decision, from 0, which is replaced by another one.
            agent: id of the agent; by default the one that acts first.
            brains: brains by agent id. Other agents get a new brain as in the scene.
            sim: a world of the same scene to bring to that moment; agents not in ``brains`` keep
                their brains. By default a new world is made.

        Raises:
            RecordingError: there is no such decision, it can't be replayed exactly, or the world is
                of another scene.
        """
        index, step = self._find(step, agent)
        for name in brains or {}:
            if name not in self.episode.ids:
                raise RecordingError(
                    _(
                        "brains: no agent has the id {name!r}; {hint}",
                        name=name,
                        hint=suggest(name, self.episode.ids),
                    )
                )
        player = Player(self.episode, sim)
        try:
            player.seek(index, step)
        finally:
            player.replace_brains(brains or {})
        return player.sim

    def check(self, step: int, agent: str | None = None) -> None:
        """Check that a moment can be shown; the first check replays the whole episode.

        Raises:
            RecordingError: there is no such decision, or it can't be replayed exactly.
        """
        self._find(step, agent)

    def fits(self, sim: ControlRequestor) -> bool:
        """Return True if the episode can be continued in a world: it has the same scene."""
        try:
            return without_brains(export_scene(sim)) == without_brains(self.episode.scene)
        except RecordingError:  # a block that can't be serialized, so it is not in the episode
            return False

    def build(self) -> ControlRequestor:
        """Return a new world of the episode's scene, without brains of types unknown here."""
        return Scene(without_unknown_brains(self.episode.scene)).build()

    def _find(self, step: int, agent: str | None) -> tuple[int, int]:
        record = self.episode.agent(agent)
        count = len(record)
        if not -count <= step < count:
            raise RecordingError(
                _(
                    "agent {id!r} took {count} decisions; expected a step from 0 to {count2}, got "
                    "{step}",
                    id=record.id,
                    count=count,
                    count2=count - 1,
                    step=step,
                )
            )
        step %= count
        if record.begin[step] >= self.verdict.exact_until:
            raise RecordingError(self._inexact())
        return self.episode.ids.index(record.id), step

    def _inexact(self) -> str:
        seconds = self.verdict.exact_until / self.episode.scene.world.ticks_per_second
        return _(
            "the episode can be played again exactly up to {seconds:.2f} s (tick {tick}) and not "
            "beyond: {why}",
            seconds=seconds,
            tick=self.verdict.exact_until,
            why=self.verdict.why,
        )

    def _moment(self, index: int, step: int) -> ReplayMoment:
        percept = self._player.sim.agents[index].percept
        return ReplayMoment(self.episode.agents[index][step], percept, self._snapshot())

    def _snapshot(self) -> Snapshot:
        sim = self._player.sim
        if self._static_scene is None or self._static_scene[0] != sim.world.generation:
            self._static_scene = sim.world.generation, capture_static_scene(sim)
        return capture_snapshot(sim, self._static_scene[1])

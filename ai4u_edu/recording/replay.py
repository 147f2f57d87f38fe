"""Goes back in time: the moments of an episode, exactly as they were."""

import warnings
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import AI4UError, suggest
from ai4u_edu.blocks import Brain, Percept
from ai4u_edu.recording.episode import ENDED, AgentRecord, Decision, Episode
from ai4u_edu.recording.episode_builder import VERSIONS
from ai4u_edu.recording.errors import RecordingError
from ai4u_edu.recording.player import Player
from ai4u_edu.recording.recorder import Recorder
from ai4u_edu.recording.scene_export import export_scene, without_brains
from ai4u_edu.snapshot import Snapshot, StaticScene, capture_snapshot, capture_static_scene

NEAR = 100
"""So many moments before one that was gone back to are kept."""


@dataclass(frozen=True)
class Verdict:
    """Whether an episode plays again exactly."""

    exact: bool
    """Whether all of it does."""
    exact_until: int
    """The tick up to which it does; moments from it on can't be shown."""
    why: str
    """What is different there, in a sentence; empty if nothing is."""

    @property
    def until(self) -> int:
        """Deprecated name of :attr:`exact_until`."""
        warnings.warn("use Verdict.exact_until", DeprecationWarning, stacklevel=2)
        return self.exact_until


@dataclass(frozen=True)
class Moment:
    """A decision, when it was taken."""

    decision: Decision
    """What was done, and what was paid for that."""
    percept: Percept
    """What the agent sensed, and its brain got."""
    snapshot: Snapshot
    """Everything else, as it was then."""


class Replay:
    """Plays an episode again, and stops wherever one likes.

    Nothing is shown that is not exactly as it was: before the first look, all of the episode is
    played once, and every percept, reward and pose is compared with the recording.

    Args:
        episode: which.
        on_step: called at each step that is played; what it raises ends the playing.

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
        self._near: dict[tuple[int, int], Moment] = {}
        self._last = (0, -1)

    @cached_property
    def verdict(self) -> Verdict:
        """Whether it plays again exactly, and if not, how far."""
        recorder = Recorder(self._player.sim)
        self._player.rewind()
        limit = self.episode.ticks if self.episode.changed is None else self.episode.changed
        problem = ""
        try:
            while not self._player.over and self._player.sim.world.ticks < limit:
                self._player.go_on()
        except AI4UError as error:
            problem = str(error)
        again = recorder.now()
        recorder.on_episode = None
        recorder.switch(False)
        if again is None:
            return Verdict(False, 0, f"it can't be compared: {recorder.problem}")
        return _compare(self.episode, again, problem)

    def at(self, step: int, agent: str | None = None) -> Moment:
        """The moment at which a decision was taken.

        Args:
            step: the agent's decision, from 0 on; a negative one counts from the end.
            agent: its id; left out, the one that acts first.

        Raises:
            RecordingError: there was no such decision, or it can't be played again exactly.
        """
        index, step = self._find(step, agent)
        if (index, step) not in self._near:
            # the world can't go backwards: who steps back will do it again, so some are kept
            back = NEAR if self._last[0] == index and step < self._last[1] else 0
            self._near = {}
            for each in range(max(0, step - back), step + 1):
                self._player.go_to(index, each)
                self._near[index, each] = self._moment(index, each)
        self._last = index, step
        return self._near[index, step]

    def moments(self, agent: str | None = None) -> Iterator[Moment]:
        """All moments that can be played again exactly, in order."""
        index = self.episode.ids.index(self.episode.agent(agent).id)
        for step, begin in enumerate(self.episode.agents[index].begin.tolist()):
            if begin >= self.verdict.exact_until:
                return
            self._player.go_to(index, step)
            yield self._moment(index, step)

    def snapshots(self, every: int = 1) -> Iterator[Snapshot]:
        """Snapshots from the beginning to the end, or as far as it is exact.

        Args:
            every: ticks between two of them. The last one comes in any case.
        """
        until = min(self.verdict.exact_until, self.episode.ticks)
        player = self._player
        player.rewind()
        yield self._picture()
        while player.sim.world.ticks < until and not player.over:
            before = player.sim.world.ticks
            player.go_on(tick_by_tick=True)
            ticks = player.sim.world.ticks
            if ticks > before and (ticks % every == 0 or ticks == until):
                yield self._picture()

    def pictures(self, every: int = 1) -> Iterator[Snapshot]:
        """Deprecated name of :meth:`snapshots`."""
        warnings.warn("use Replay.snapshots", DeprecationWarning, stacklevel=2)
        return self.snapshots(every)

    def percepts(self, agent: str | None = None) -> list[list[Percept]]:
        """All that an agent sensed, by its own episodes.

        Args:
            agent: its id; left out, the one that acts first.

        Returns:
            For each episode what it began with, and what was sensed after each decision.

        Raises:
            RecordingError: the episode can't be played again exactly.
        """
        index = self.episode.ids.index(self.episode.agent(agent).id)
        if not self.verdict.exact:
            raise RecordingError(self._inexact())
        player, found = self._player, list[list[Percept]]()

        def began(agent: BasicAgent) -> None:
            found.append([agent.percept])

        def sensed(agent: BasicAgent) -> None:
            if found and agent.steps == len(found[-1]):  # at a beginning it took none yet
                found[-1].append(agent.percept)

        driver = player.sim.agents[index]
        driver.begin_of_episode.connect(began)
        driver.end_of_update_state.connect(sensed)
        player.rewind()
        while not player.over:
            player.go_on()
        driver.begin_of_episode.disconnect(began)
        driver.end_of_update_state.disconnect(sensed)
        return found

    def continue_from(
        self,
        step: int,
        *,
        agent: str | None = None,
        brains: Mapping[str, Brain] | None = None,
        sim: ControlRequestor | None = None,
    ) -> ControlRequestor:
        """A world at that moment, that goes on with other brains.

        Args:
            step: the agent's decision, from 0 on, in place of which something else is done.
            agent: its id; left out, the one that acts first.
            brains: by the agent's id. Who is not named gets the brain that the scene says, which
                begins anew there.
            sim: a world of the same scene that is brought to that moment; who is not named in
                ``brains`` keeps the brain that it had. Left out, a new one is made.

        Raises:
            RecordingError: there was no such decision, it can't be played again exactly, or the
                world is another one.
        """
        index, step = self._find(step, agent)
        for name in brains or {}:
            if name not in self.episode.ids:
                raise RecordingError(
                    f"brains: no agent has the id {name!r}; {suggest(name, self.episode.ids)}"
                )
        player = Player(self.episode, sim)
        try:
            player.go_to(index, step)
        finally:
            player.hand_over(brains or {})
        return player.sim

    def check(self, step: int, agent: str | None = None) -> None:
        """Checks that a moment can be gone to; the first time that takes as long as to play it all.

        Raises:
            RecordingError: there was no such decision, or it can't be played again exactly.
        """
        self._find(step, agent)

    def fits(self, sim: ControlRequestor) -> bool:
        """Whether a world is one in which the episode can be continued: its own, or its like."""
        try:
            return without_brains(export_scene(sim)) == without_brains(self.episode.scene)
        except RecordingError:  # a block that no file can hold: the episode has none of those
            return False

    # -- how -------------------------------------------------------------------------------------

    def _find(self, step: int, agent: str | None) -> tuple[int, int]:
        record = self.episode.agent(agent)
        count = len(record)
        if not -count <= step < count:
            raise RecordingError(
                f"agent {record.id!r} took {count} decisions; expected a step from 0 to "
                f"{count - 1}, got {step}"
            )
        step %= count
        if record.begin[step] >= self.verdict.exact_until:
            raise RecordingError(self._inexact())
        return self.episode.ids.index(record.id), step

    def _inexact(self) -> str:
        seconds = self.verdict.exact_until / self.episode.scene.world.ticks_per_second
        return (
            f"the episode can be played again exactly up to {seconds:.2f} s (tick "
            f"{self.verdict.exact_until}) and not beyond: {self.verdict.why}"
        )

    def _moment(self, index: int, step: int) -> Moment:
        percept = self._player.sim.agents[index].percept
        return Moment(self.episode.agents[index][step], percept, self._picture())

    def _picture(self) -> Snapshot:
        sim = self._player.sim
        if self._static_scene is None or self._static_scene[0] != sim.world.generation:
            self._static_scene = sim.world.generation, capture_static_scene(sim)
        return capture_snapshot(sim, self._static_scene[1])


def _compare(there: Episode, here: Episode, problem: str) -> Verdict:
    """What was recorded, and what happened when it was played again."""
    hint = _other_versions(there)
    steps = [0] * len(there.agents)
    changed = there.changed
    for number in there.order.tolist():
        if number < 0:
            continue
        step, steps[number] = steps[number], steps[number] + 1
        one, other = there.agents[number], here.agents[number]
        begin = int(one.begin[step])
        if changed is not None and begin >= changed:
            break
        if step >= len(other) or one.begin[step] != other.begin[step]:
            why = problem or "it took no decision there"
            return Verdict(False, begin, f"agent {one.id!r}, decision {step}: {why}{hint}")
        if changed is not None and (one.end[step] > changed or not one.flags[step] & ENDED):
            continue
        if one.worlds[step] != other.worlds[step]:
            why = "the bodies were in other places, or moved otherwise"
            return Verdict(False, begin, f"agent {one.id!r}, decision {step}: {why}{hint}")
        why = _difference(one, other, step)
        if why:
            return Verdict(False, begin + 1, f"agent {one.id!r}, decision {step}: {why}{hint}")
    if changed is not None:
        return Verdict(False, changed, "the world was changed by hand there")
    for one, other in zip(there.agents, here.agents, strict=True):
        if one.firsts.tolist() != other.firsts.tolist():
            return Verdict(False, 0, f"agent {one.id!r} began with another percept{hint}")
    return Verdict(True, there.ticks + 1, "")


def _difference(one: AgentRecord, other: AgentRecord, step: int) -> str:
    if one.percepts[step] != other.percepts[step]:
        return "what it sensed after it was something else"
    then, now = one[step], other[step]
    if then == now:
        return ""
    for name in dict.fromkeys((*then.reward_terms, *now.reward_terms)):
        paid, pays = then.reward_terms.get(name), now.reward_terms.get(name)
        if paid != pays:
            return f"reward term {name!r}: paid {_amount(paid)} then, and {_amount(pays)} now"
    return f"it ended at tick {then.end} then, and at {now.end} now"


def _amount(paid: float | None) -> str:
    return "nothing" if paid is None else repr(paid)


def _other_versions(episode: Episode) -> str:
    others = [
        f"{name} {then} (here {VERSIONS[name]})"
        for name, then in episode.versions.items()
        if name in VERSIONS and VERSIONS[name] != then
    ]
    return f"; it was recorded with {', '.join(others)}" if others else ""

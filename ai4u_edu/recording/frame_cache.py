"""An episode's moments as pictures, ready to be looked at one after the other in any order."""

import threading
from dataclasses import dataclass, replace
from typing import Any

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.errors import AI4UError
from ai4u_edu.recording.episode import Episode
from ai4u_edu.recording.player import Player
from ai4u_edu.recording.replay import Replay
from ai4u_edu.snapshot import (
    AgentState,
    BodyState,
    Snapshot,
    StaticScene,
    capture_agent,
    capture_snapshot,
    capture_static_scene,
)

LARGEST = 96 * 2**20
"""Bytes, about, that cached snapshots may take up."""
REMEMBERED = 240
"""Of so many decisions it is shown with each picture what they were paid."""
OF_A_DECISION = (
    "action",
    "clipped",
    "reward",
    "reward_terms",
    "episode_reward",
    "episode_terms",
    "phase",
    "history",
)
"""What of an agent's state is told when its decision is over, and belongs to that decision."""

_Result = dict[str, Any]


@dataclass(frozen=True, slots=True)
class _Frame:
    """What was when the agent took a decision, or at the end."""

    picture: Snapshot
    decisions: tuple[int, ...]
    """For each agent the decision that it takes then, or carries out; -1 for none."""


class FrameCache:
    """Plays an episode in a thread of its own, and keeps its pictures.

    Picture k is how everything was when the agent took decision k: where the bodies were, what the
    agents sensed. With it stands what they did then, and what was paid for that. The last picture,
    after all decisions, is how it ended.

    Where memory does not suffice for all of them only every second, fourth, ... one is kept; the
    others are made when they are asked for, which takes as long as to play the episode up to there.

    Args:
        episode: which.
        agent: whose decisions; left out, those of the agent that acts first.
        number: of the episode, for those who look.
        largest: bytes, about, that the pictures may take up.
    """

    def __init__(
        self,
        episode: Episode,
        *,
        agent: str | None = None,
        number: int = 1,
        largest: int = LARGEST,
    ) -> None:
        self.episode = episode
        self.replay: Replay | None = None
        """Plays the same episode; there as soon as its verdict is known."""
        self.record = episode.agent(agent)
        self.number = number
        self.problem = ""
        """Why there are no pictures, or not of all of the episode; empty if there are."""
        self.stride = 1
        """Every so many pictures one is kept."""
        self._index = episode.ids.index(self.record.id)
        self._largest = largest
        self._size = 0
        self._count: int | None = None
        self._frames: dict[int, _Frame] = {}
        self._static_scene: tuple[int, StaticScene] | None = None
        self._bodies: dict[str, BodyState] = {}
        self._made: set[int] = set()
        self._results: list[dict[int, _Result]] = [{} for _ in episode.agents]
        self._asked: int | None = None
        self._prepared = False
        self._stopping = False
        self._changed = threading.Condition()
        self._thread = threading.Thread(target=self._run, name="frame_cache", daemon=True)

    def start(self) -> "FrameCache":
        """Begins to play."""
        self._thread.start()
        return self

    def stop(self, *, wait: bool = True) -> None:
        """Ends the thread.

        Args:
            wait: whether to wait for its end; before its first picture that may take a while.
        """
        with self._changed:
            self._stopping = True
            self._changed.notify_all()
        if wait and self._thread.is_alive():
            self._thread.join()

    @property
    def last(self) -> int:
        """The number of the last picture."""
        return len(self.record) if self._count is None else self._count - 1

    @property
    def is_alive(self) -> bool:
        """Whether pictures may yet be made."""
        return self._thread.is_alive()

    @property
    def ended(self) -> bool:
        """Whether the last picture is how it ended, after all decisions."""
        return self.last == len(self.record)

    def snapshot(self, step: int, timeout: float | None = 0.0) -> Snapshot | None:
        """How everything was when the agent took a decision.

        Args:
            step: the decision, from 0 to ``last``.
            timeout: how long (s) to wait for it; None: as long as it takes.

        Returns:
            The picture; None if it is not ready yet. It is made then, and can be asked for again.
        """
        with self._changed:
            if not self._is_ready(step):
                self._asked = step
                self._changed.notify_all()
                self._changed.wait_for(lambda: self._is_ready(step) or self._over, timeout)
            frame = self._frames[step] if self._is_ready(step) else None
        return None if frame is None else self._shown(frame, step)

    def label(self, step: int) -> str:
        """What a picture is called, for those who look."""
        count = len(self.record)
        where = f"step {step + 1} of {count}" if step < count else "the end"
        who = "" if len(self.episode.agents) == 1 else f" of agent {self.record.id}"
        return f"episode {self.number}, {where}{who}"

    # -- the thread ------------------------------------------------------------------------------

    def _is_ready(self, step: int) -> bool:
        """Whether a picture is there, and it is known how what was done then ended."""
        frame = self._frames.get(step)
        return frame is not None and (
            self._prepared
            or all(
                decision < 0 or decision in results
                for decision, results in zip(frame.decisions, self._results, strict=True)
            )
        )

    @property
    def _over(self) -> bool:
        return self._stopping or not self._thread.is_alive()

    def _run(self) -> None:
        try:
            player = self._prepare()
            with self._changed:
                self._prepared = player is not None
                self._changed.notify_all()
            while player is not None:
                with self._changed:
                    self._changed.wait_for(lambda: self._asked is not None or self._stopping)
                    step, self._asked = self._asked, None
                if self._stopping:
                    return
                if step is not None and step not in self._frames and 0 <= step <= self.last:
                    self._fill(player, step)
        except AI4UError as error:
            self.problem = str(error)
        finally:
            with self._changed:
                self._count = 0 if self._count is None else self._count
                self._changed.notify_all()

    def _prepare(self) -> Player | None:
        """Makes all pictures, from the first one to the last."""
        replay = Replay(self.episode)
        verdict = replay.verdict
        self.replay = replay
        begins = self.record.begin
        count = len(begins) if verdict.exact else int((begins < verdict.exact_until).sum())
        self.problem = verdict.why
        with self._changed:
            self._count = count + 1 if verdict.exact else count
        player = Player(self.episode)
        for index in range(len(player.taken)):
            player.sim.agents[index].ledger.keep_history(REMEMBERED)
            _Results(player, index, self._results[index])
        for step in range(self._count):
            if self._stopping:
                return None
            frame = self._frame_at(player, step)
            if step % self.stride == 0 or step == self._count - 1:
                self._keep(step, frame)
        return player

    def _fill(self, player: Player, step: int) -> None:
        """Makes a picture that was not kept, and those before it, for who steps back."""
        gap = range(step - step % self.stride, step + 1)
        made = {each: self._frame_at(player, each) for each in gap}
        with self._changed:
            for each in self._made:
                self._frames.pop(each, None)
            self._made = {each for each in gap if each not in self._frames}
            self._frames |= made
            self._changed.notify_all()

    def _frame_at(self, player: Player, step: int) -> _Frame:
        if step < len(self.record):
            player.go_to(self._index, step)
        else:
            while not player.over:
                player.go_on()
        if self._static_scene is None or self._static_scene[0] != player.sim.world.generation:
            # what a player draws anew for the same seed is the same, and need not be built again
            new = capture_static_scene(player.sim)
            same = self._static_scene is not None and self._static_scene[1] == new
            kept = self._static_scene[1] if same and self._static_scene is not None else new
            self._static_scene = player.sim.world.generation, kept
        decisions = [_decision(player, index) for index in range(len(player.taken))]
        return _Frame(capture_snapshot(player.sim, self._static_scene[1]), tuple(decisions))

    def _keep(self, step: int, frame: _Frame) -> None:
        bodies = self._bodies  # most of them stand still: of those one is enough
        shared = tuple(
            bodies[each.name] if bodies.get(each.name) == each else each
            for each in frame.picture.bodies
        )
        moved = sum(one is not bodies.get(one.name) for one in shared)
        bodies.update((each.name, each) for each in shared)
        self._size += _size(frame.picture, moved)
        frame = replace(frame, picture=replace(frame.picture, bodies=shared))
        with self._changed:
            self._frames[step] = frame
            if self._size > self._largest:
                self._thin_out()
            self._changed.notify_all()

    def _thin_out(self) -> None:
        self.stride *= 2
        count = len(self._frames)
        self._frames = {
            step: frame for step, frame in self._frames.items() if step % self.stride == 0
        }
        self._size = self._size * len(self._frames) // count

    # -- what is seen ----------------------------------------------------------------------------

    def _shown(self, frame: _Frame, step: int) -> Snapshot:
        pairs = enumerate(zip(frame.picture.agents, frame.decisions, strict=True))
        agents = [self._with_decision(index, *pair) for index, pair in pairs]
        named = [
            state._replace(brain=record.driver or state.brain)
            for state, record in zip(agents, self.episode.agents, strict=True)
        ]
        return replace(
            frame.picture, episode=self.number, agents=tuple(named), past=self.label(step)
        )

    def _with_decision(self, index: int, state: AgentState, decision: int) -> AgentState:
        """What an agent sensed, with what it does then, and gets for that."""
        if decision < 0:
            return state
        done = self._results[index].get(decision)
        if done is None:  # it never came to its end
            taken = self.episode.agents[index][decision]
            return state._replace(action=taken.action, reward=0.0, reward_terms={})
        return state._replace(**done)


class _Results:
    """Notes how each decision of an agent ended."""

    def __init__(self, player: Player, index: int, into: dict[int, _Result]) -> None:
        self._player = player
        self._index = index
        self._into = into
        player.sim.agents[index].end_of_update_state.connect(self._note)

    def _note(self, agent: BasicAgent) -> None:
        decision = self._player.taken[self._index] - 1
        if not agent.steps or decision in self._into:  # it has only just begun, or is known
            return
        sim, began = self._player.sim, self._player.episode.agents[self._index].begin[decision]
        phase = sim.phase(agent)._replace(tick=sim.world.ticks - int(began))
        state = capture_agent(agent, phase=phase)
        self._into[decision] = {name: getattr(state, name) for name in OF_A_DECISION}


def _decision(player: Player, index: int) -> int:
    """What an agent is about to do at this tick, or is doing; -1 for nothing."""
    record, taken, tick = player.episode.agents[index], player.taken[index], player.sim.world.ticks
    if taken < len(record) and record.begin[taken] == tick:
        return taken
    has_one = taken and (player.sim.agents[index].steps or record.end[taken - 1] > tick)
    return taken - 1 if has_one else -1  # who has begun anew has done nothing yet


def _size(picture: Snapshot, moved: int) -> int:
    """The bytes, about, that a picture takes up where what stands still is shared."""
    size = 1000 + 8 * (len(picture.bodies) + REMEMBERED) + 400 * moved
    for agent in picture.agents:
        rays = sum(ray.ends.nbytes + 8 * len(ray.groups) + 300 for ray in agent.rays.values())
        size += 4000 + len(agent.percept.data) + rays
    return size

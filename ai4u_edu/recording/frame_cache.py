"""Cache of an episode's snapshots, for looking at them in any order."""

import sys
import threading
from collections import deque
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.errors import AI4UError, text_of
from ai4u_edu.locale import gettext as _
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
from ai4u_edu.world.ink import BLANK, Tile, TileKey

MAX_CACHE_BYTES = 96 * 2**20
"""Approximate memory of cached snapshots."""
MAX_HISTORY_DECISIONS = 240
"""Decisions whose rewards are shown with each snapshot."""
STATES_PER_MEASUREMENT = 16
"""Snapshots for which the size of a world's state is measured once: it changes little, and a
measurement takes as long as a tick."""
_DECISION_FIELDS = (
    "action",
    "clipped",
    "reward",
    "reward_terms",
    "episode_reward",
    "episode_terms",
    "phase",
    "history",
    "stages",
    "seconds_left",
)
"""Fields of an agent's state that belong to the decision that has just ended."""


@dataclass(frozen=True, slots=True)
class _Frame:
    """The moment at which the agent took a decision, or the end."""

    snapshot: Snapshot
    decisions: tuple[int, ...]
    """The decision that each agent takes or carries out then; -1 for none."""


class FrameCache:
    """Replays an episode in its own thread, and caches its snapshots. Any thread may call it.

    Snapshot k is the moment at which the agent took decision k: the poses and percepts of that
    moment, with the actions that were taken then and their rewards. The last snapshot, after all
    decisions, is the end.

    If the snapshots need too much memory, only every second, fourth, ... one is kept. The others
    are made on request, which takes as long as replaying the episode up to there.

    Args:
        episode: the recorded episode.
        agent: id of the agent whose decisions count; by default the one that acts first.
        number: of the episode, for labels.
        largest: approximate memory (bytes) for the snapshots.
    """

    def __init__(
        self,
        episode: Episode,
        *,
        agent: str | None = None,
        number: int = 1,
        largest: int = MAX_CACHE_BYTES,
    ) -> None:
        self.episode = episode
        self.replay: Replay | None = None
        """A replay of the same episode; None until its verdict is known."""
        self.record = episode.agent(agent)
        self.number = number
        self.problem = ""
        """Sentence about why the snapshots are missing or end early; empty if they are complete."""
        self.stride = 1
        """Distance between snapshots that are kept."""
        self._index = episode.ids.index(self.record.id)
        self._largest = largest
        self._size = self._state_size = 0
        self._count: int | None = None
        self._frames: dict[int, _Frame] = {}
        self._static_scene: tuple[int, StaticScene] | None = None
        self._bodies: dict[str, BodyState] = {}
        self._tiles: Mapping[TileKey, Tile] = {}
        self._on_request: set[int] = set()
        self._results: list[dict[int, dict[str, Any]]] = [{} for _ in episode.agents]
        self._asked: int | None = None
        self._prepared = False
        self._is_making = False
        self._stopping = False
        self._changed = threading.Condition()
        self._thread = threading.Thread(target=self._run, name="frame-cache", daemon=True)

    def start(self) -> "FrameCache":
        """Start the thread, and return the cache itself."""
        self._is_making = True
        self._thread.start()
        return self

    def stop(self, *, wait: bool = True) -> None:
        """Stop the thread.

        Args:
            wait: True to wait for its end, which takes a while before the first snapshot.
        """
        with self._changed:
            self._stopping = True
            self._changed.notify_all()
        if wait and self._thread.is_alive():
            self._thread.join()

    @property
    def last(self) -> int:
        """Index of the last snapshot."""
        return len(self.record) if self._count is None else self._count - 1

    @property
    def is_alive(self) -> bool:
        """True while the thread can make snapshots."""
        return self._is_making

    @property
    def ended(self) -> bool:
        """True if the last snapshot is the end, after all decisions."""
        return self.last == len(self.record)

    def snapshot(self, step: int, timeout: float | None = 0.0) -> Snapshot | None:
        """Return the snapshot of a decision.

        Args:
            step: the decision, from 0 to ``last``.
            timeout: time (s) to wait for it; None for no limit.

        Returns:
            The snapshot, or None if it is not ready; it is being made then.
        """
        with self._changed:
            if not self._is_ready(step):
                self._asked = step
                self._changed.notify_all()
                self._changed.wait_for(lambda: self._is_ready(step) or not self._can_make, timeout)
            frame = self._frames[step] if self._is_ready(step) else None
        return None if frame is None else self._shown(frame, step)

    def label(self, step: int) -> str:
        """Return a snapshot's label to show to a person."""
        count = len(self.record)
        where = _("the end")
        if step < count:
            where = _("step {step} of {count}", step=step + 1, count=count)
        if len(self.episode.agents) == 1:
            return _("episode {number}, {where}", number=self.number, where=where)
        return _(
            "episode {number}, {where} of agent {id}",
            number=self.number,
            where=where,
            id=self.record.id,
        )

    def _is_ready(self, step: int) -> bool:
        """Return True if a snapshot is cached, and its decisions' results are known."""
        frame = self._frames.get(step)
        return frame is not None and (
            self._prepared
            or all(
                decision < 0 or decision in results
                for decision, results in zip(frame.decisions, self._results, strict=True)
            )
        )

    @property
    def _can_make(self) -> bool:
        return self._is_making and not self._stopping

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
                    self._make_on_request(player, step)
        except AI4UError as error:
            self.problem = text_of(error)
        finally:
            with self._changed:
                self._count = 0 if self._count is None else self._count
                # whoever waits looks now, while the thread is still alive, and is not woken again
                self._is_making = False
                self._changed.notify_all()

    def _prepare(self) -> Player | None:
        """Make all snapshots; return the player, or None if the thread has to stop."""
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
            player.sim.agents[index].ledger.keep_history(MAX_HISTORY_DECISIONS)
            player.sim.agents[index].percept_ready.connect(
                partial(self._note_result, player, index)
            )
        for step in range(self._count):
            if self._stopping:
                return None
            frame = self._frame_at(player, step)
            if step % self.stride == 0 or step == self._count - 1:
                self._store(step, frame)
        return player

    def _note_result(self, player: Player, index: int, agent: BasicAgent) -> None:
        """Keep the result of the decision that has just ended, by its index."""
        decision, results = player.taken[index] - 1, self._results[index]
        if not agent.steps or decision in results:
            return  # the episode has just begun, or the result is known
        began = int(player.episode.agents[index].begin[decision])
        phase = player.sim.phase(agent)
        state = capture_agent(agent, phase=phase._replace(tick=player.sim.world.ticks - began))
        results[decision] = {name: getattr(state, name) for name in _DECISION_FIELDS}

    def _make_on_request(self, player: Player, step: int) -> None:
        """Make a snapshot that was not kept, and those before it, since a person may step back."""
        # from the last kept one on, but no more than a quarter of the memory holds
        fitting = max(1, self._largest // 4 * len(self._frames) // max(1, self._size))
        gap = range(max(step - step % self.stride, step - fitting + 1), step + 1)
        made = {each: self._frame_at(player, each) for each in gap}
        with self._changed:
            for each in self._on_request:
                self._frames.pop(each, None)
            self._on_request = {each for each in gap if each not in self._frames}
            self._frames |= made
            self._changed.notify_all()

    def _frame_at(self, player: Player, step: int) -> _Frame:
        if step < len(self.record):
            player.seek(self._index, step)
        else:
            while not player.is_over:
                player.advance()
        if self._static_scene is None or self._static_scene[0] != player.sim.world.generation:
            # equal scenes share one object, so that a page does not build it again
            new = capture_static_scene(player.sim)
            same = self._static_scene is not None and self._static_scene[1] == new
            kept = self._static_scene[1] if same and self._static_scene is not None else new
            self._static_scene = player.sim.world.generation, kept
        decisions = [_decision_at(player, index) for index in range(len(player.taken))]
        return _Frame(capture_snapshot(player.sim, self._static_scene[1]), tuple(decisions))

    def _store(self, step: int, frame: _Frame) -> None:
        bodies = self._bodies  # the states of bodies that stand still are shared
        shared = tuple(
            bodies[each.name] if bodies.get(each.name) == each else each
            for each in frame.snapshot.bodies
        )
        moved = sum(one is not bodies.get(one.name) for one in shared)
        bodies.update((each.name, each) for each in shared)
        if step // self.stride % STATES_PER_MEASUREMENT == 0:
            state = frame.snapshot.state
            world = state.world._replace(ink=BLANK)  # tiles that did not change are shared
            self._state_size = _memory_of(state._replace(world=world))
        self._size += _size(frame.snapshot, moved) + self._state_size
        self._size += self._new_ink(frame.snapshot)
        frame = replace(frame, snapshot=replace(frame.snapshot, bodies=shared))
        with self._changed:
            self._frames[step] = frame
            if self._size > self._largest:
                self._double_stride()
            self._changed.notify_all()

    def _new_ink(self, snapshot: Snapshot) -> int:
        """Return the memory (bytes) of tiles of ink that the snapshot before it does not have."""
        before, self._tiles = self._tiles, snapshot.state.world.ink.tiles
        return sum(tile.nbytes for key, tile in self._tiles.items() if before.get(key) is not tile)

    def _double_stride(self) -> None:
        self.stride *= 2
        count = len(self._frames)
        self._frames = {
            step: frame for step, frame in self._frames.items() if step % self.stride == 0
        }
        self._size = self._size * len(self._frames) // count

    def _shown(self, frame: _Frame, step: int) -> Snapshot:
        pairs = enumerate(zip(frame.snapshot.agents, frame.decisions, strict=True))
        agents = [self._with_decision(index, *pair) for index, pair in pairs]
        named = [
            state._replace(brain=record.driver or state.brain)
            for state, record in zip(agents, self.episode.agents, strict=True)
        ]
        return replace(
            frame.snapshot, episode=self.number, agents=tuple(named), past=self.label(step)
        )

    def _with_decision(self, index: int, state: AgentState, decision: int) -> AgentState:
        """Return an agent's state with the action that it takes then and its reward."""
        if decision < 0:
            return state
        done = self._results[index].get(decision)
        if done is None:  # the decision never ended
            taken = self.episode.agents[index][decision]
            return state._replace(action=taken.action, reward=0.0, reward_terms={})
        return state._replace(**done)


def _size(snapshot: Snapshot, moved: int) -> int:
    """Return the approximate memory (bytes) of a snapshot of which some bodies are shared.

    That of the world's state comes on top.
    """
    size = 1000 + 8 * (len(snapshot.bodies) + MAX_HISTORY_DECISIONS) + 400 * moved
    for agent in snapshot.agents:
        rays = sum(ray.ends.nbytes + 8 * len(ray.groups) + 300 for ray in agent.rays.values())
        size += 4000 + len(agent.percept.data) + rays
    return size


def _memory_of(value: object) -> int:
    """Return the approximate memory (bytes) of plain data, with all that it holds."""
    inner: Iterable[object] = ()
    if isinstance(value, Mapping):
        inner = value.values()
    elif isinstance(value, deque):  # its other items are those of the snapshot before
        inner = list(value)[-1:]
    elif isinstance(value, tuple | list | set | frozenset):
        inner = value
    return sys.getsizeof(value) + sum(_memory_of(each) for each in inner)


def _decision_at(player: Player, index: int) -> int:
    """Return the decision that an agent takes or carries out at this tick; -1 for none."""
    record, taken, tick = player.episode.agents[index], player.taken[index], player.sim.world.ticks
    if taken < len(record) and record.begin[taken] == tick:
        return taken
    has_one = taken and (player.sim.agents[index].steps or record.end[taken - 1] > tick)
    return taken - 1 if has_one else -1  # after a restart it has taken none yet

"""Archive of recent episodes, by number."""

import re
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from threading import Lock
from typing import overload

from ai4u_edu.blocks import Block, RemoteBrain
from ai4u_edu.blocks.brains.controllers.key_defaults import listens_to_keys
from ai4u_edu.locale import gettext as _
from ai4u_edu.recording.agent_record import AgentRecord
from ai4u_edu.recording.episode import Episode
from ai4u_edu.recording.errors import RecordingError

MAX_PINNED = 20
"""Most episodes that can be pinned."""
MAX_ARCHIVE_BYTES = 64 * 2**20
"""Memory that all archived episodes may use."""


@dataclass(frozen=True)
class ArchiveEntry:
    """An archived episode."""

    number: int
    """Number from 1, in order of arrival; never reused."""
    episode: Episode
    source: str = ""
    """The file that it was loaded from; empty if it was recorded here."""
    world_episode: int = 0
    """The world's own number of it, :attr:`ControlRequestor.episode`; 0 if it was loaded."""
    is_pinned: bool = False
    """True if it is kept however many others come."""

    @cached_property
    def success(self) -> bool | None:
        """True if an agent reached the scene's goal; None for a scene without a goal."""
        return self.episode.success

    @cached_property
    def is_person(self) -> bool:
        """True if a person took most decisions of the agent that acts first, by keys."""
        return drove_by_keys(self.first)

    @cached_property
    def task(self) -> tuple[str, str]:
        """Its scene's task, and the kind of its driver: ``keys``, ``program`` or ``network``."""
        is_program = RemoteBrain.__name__ in self.first.driver
        kind = "keys" if self.is_person else "program" if is_program else "network"
        return self.episode.scene.task_key(), kind

    @property
    def first(self) -> AgentRecord:
        """The record of the agent that acts first."""
        return self.episode.agents[0]

    @property
    def name(self) -> str:
        """Name for a file, without a suffix."""
        return f"{self.episode.scene.name}-{self.episode.seed}"


class Archive(Sequence[Episode]):
    """The last episodes, the latest last; the oldest are dropped when there are too many.

    Episodes that a person drove and all others are counted apart, so that a network's many short
    episodes don't displace a person's. It is thread-safe.

    Args:
        keep: maximum number of episodes of a person, and of all others.
        largest: maximum memory (bytes) of all episodes; the latest and pinned ones are kept.
    """

    def __init__(self, keep: int = 50, largest: int = MAX_ARCHIVE_BYTES) -> None:
        self.entries: tuple[ArchiveEntry, ...] = ()
        """All entries; the tuple is replaced with each change."""
        self._keep = keep
        self._largest = largest
        self._given = 0
        self._lock = Lock()

    @property
    def next_number(self) -> int:
        """Number that the next entry gets."""
        return self._given + 1

    def append(self, episode: Episode, source: str = "", *, world_episode: int = 0) -> ArchiveEntry:
        """Add an episode.

        Args:
            episode: the episode.
            source: the file that it was loaded from.
            world_episode: the world's own number of it.
        """
        with self._lock:
            self._given += 1
            entry = ArchiveEntry(self._given, episode, source, world_episode)
            self.entries = self._limited([*self.entries, entry]) if self._keep else ()
        return entry

    def update(self, number: int, episode: Episode) -> None:
        """Put an episode in place of its earlier state; nothing happens if that was dropped."""
        with self._lock:
            self.entries = tuple(
                replace(entry, episode=episode) if entry.number == number else entry
                for entry in self.entries
            )

    def pin(self, number: int, *, on: bool = True) -> None:
        """Keep an episode however many others come, or no longer.

        Raises:
            RecordingError: there is no such episode, or as many are pinned as may be.
        """
        with self._lock:
            if not any(entry.number == number for entry in self.entries):
                raise RecordingError(_("episode {number} is not kept any more", number=number))
            if on and sum(entry.is_pinned for entry in self.entries) >= MAX_PINNED:
                raise RecordingError(
                    _(
                        "expected at most {max_pinned} pinned episodes; unpin one",
                        max_pinned=MAX_PINNED,
                    )
                )
            # a new tuple: readers iterate over the old one without the lock
            self.entries = tuple(
                replace(entry, is_pinned=on) if entry.number == number else entry
                for entry in self.entries
            )

    def _limited(self, entries: list[ArchiveEntry]) -> tuple[ArchiveEntry, ...]:
        """Return the entries that are kept: pinned ones, and the latest others."""
        *earlier, latest = entries
        loose = [entry for entry in earlier if not entry.is_pinned]
        alike = [entry for entry in loose if entry.is_person == latest.is_person]
        # + 1 for the latest, which is not among `alike`
        dropped = {entry.number for entry in alike[: max(0, len(alike) + 1 - self._keep)]}
        size = sum(size_of(each.episode) for each in entries if each.number not in dropped)
        # memory is shared by both kinds, so the oldest goes first, whoever drove
        for entry in loose:
            if size > self._largest and entry.number not in dropped:
                dropped.add(entry.number)
                size -= size_of(entry.episode)
        return tuple(entry for entry in entries if entry.number not in dropped)

    def bests(self) -> frozenset[int]:
        """Return the numbers of the best entries of each task and kind of driver.

        The best one reached the goal soonest; in a scene without a goal it got the highest reward.
        A lost try is none, nor is one that has no other to compare with, and episodes that were
        loaded from files don't count.
        """
        alike: defaultdict[tuple[str, str], list[ArchiveEntry]] = defaultdict(list)
        for entry in self.entries:
            if not entry.source:
                alike[entry.task].append(entry)
        firsts = (max(entries, key=_rank) for entries in alike.values() if len(entries) > 1)
        return frozenset(entry.number for entry in firsts if entry.success is not False)

    def find(self, number: int) -> ArchiveEntry | None:
        """Return the entry of a number; None if it was dropped."""
        return next((entry for entry in self.entries if entry.number == number), None)

    def __len__(self) -> int:
        return len(self.entries)

    @overload
    def __getitem__(self, index: int) -> Episode: ...
    @overload
    def __getitem__(self, index: slice) -> list[Episode]: ...
    def __getitem__(self, index: int | slice) -> Episode | list[Episode]:
        """Return an episode by its position, or several."""
        episodes = [entry.episode for entry in self.entries]
        return episodes[index]

    def __iter__(self) -> Iterator[Episode]:
        return (entry.episode for entry in self.entries)


def drove_by_keys(record: AgentRecord) -> bool:
    """Return True if a person took most decisions of an agent, by keys."""
    names = re.findall(r"\w+", record.driver.partition(", ")[0])
    return any(name in Block.types and listens_to_keys(Block.types[name]) for name in names)


def _rank(entry: ArchiveEntry) -> tuple[bool, float]:
    return bool(entry.success), -entry.episode.seconds if entry.success else entry.first.total


def size_of(episode: Episode) -> int:
    """Return the approximate memory (bytes) of an episode."""
    columns = [episode.order.nbytes, 64 * len(episode.restarts), 2000]
    for record in episode.agents:
        columns += [
            each.nbytes
            for each in (
                record.begin,
                record.end,
                record.skip,
                record.flags,
                record.rewards,
                record.percepts,
                record.worlds,
                record.starts,
                record.firsts,
            )
        ]
        for table in (record.actions, record.terms):
            columns += [table.numbers.nbytes, table.form.nbytes, 8 * len(table)]
    return sum(columns)

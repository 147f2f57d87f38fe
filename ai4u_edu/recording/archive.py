"""The episodes that are kept, each under a number."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from threading import Lock
from typing import overload

from ai4u_edu.recording.episode import AgentRecord, Episode

LARGEST = 64 * 2**20
"""Bytes that all episodes together may take up in memory."""


@dataclass(frozen=True)
class ArchiveEntry:
    """A kept episode."""

    number: int
    """From 1 on, in the order in which they came; never given twice."""
    episode: Episode
    source: str = ""
    """The file that it came from; empty if it happened here."""

    @cached_property
    def success(self) -> bool | None:
        """Whether somebody reached the scene's goal; None for a scene without one."""
        return self.episode.success

    @property
    def first(self) -> AgentRecord:
        """The record of the agent that acts first."""
        return self.episode.agents[0]

    @property
    def name(self) -> str:
        """For a file, without an ending."""
        return f"{self.episode.scene.name}-{self.episode.seed}"


class Archive(Sequence[Episode]):
    """The last episodes, the latest last. When there are too many, the oldest go.

    Any thread may add to it and look at it.

    Args:
        keep: how many episodes are kept.
        largest: bytes that all of them may take up; the latest is kept in any case.
    """

    def __init__(self, keep: int = 50, largest: int = LARGEST) -> None:
        self.entries: tuple[ArchiveEntry, ...] = ()
        """What is kept; replaced, never changed."""
        self._keep = keep
        self._largest = largest
        self._given = 0
        self._lock = Lock()

    @property
    def next_number(self) -> int:
        """The number that the next one will get."""
        return self._given + 1

    def append(self, episode: Episode, source: str = "") -> ArchiveEntry:
        """Keeps an episode.

        Args:
            episode: which.
            source: the file that it came from.
        """
        with self._lock:
            self._given += 1
            entry = ArchiveEntry(self._given, episode, source)
            kept = [*self.entries, entry][-self._keep :] if self._keep else []
            size = sum(size_of(each.episode) for each in kept)
            while len(kept) > 1 and size > self._largest:
                size -= size_of(kept.pop(0).episode)
            self.entries = tuple(kept)
        return entry

    @property
    def best(self) -> ArchiveEntry | None:
        """The one with the highest reward among those that reached the goal, or else among all.

        What came from a file doesn't count.
        """
        own = [entry for entry in self.entries if not entry.source]
        return max(own, key=lambda entry: (entry.success is True, entry.first.total), default=None)

    def find(self, number: int) -> ArchiveEntry | None:
        """The entry of that number, if it is still there."""
        return next((entry for entry in self.entries if entry.number == number), None)

    def __len__(self) -> int:
        return len(self.entries)

    @overload
    def __getitem__(self, index: int) -> Episode: ...
    @overload
    def __getitem__(self, index: slice) -> list[Episode]: ...
    def __getitem__(self, index: int | slice) -> Episode | list[Episode]:
        """An episode by its place, or several."""
        episodes = [entry.episode for entry in self.entries]
        return episodes[index]

    def __iter__(self) -> Iterator[Episode]:
        return (entry.episode for entry in self.entries)


def size_of(episode: Episode) -> int:
    """The bytes, about, that an episode takes up in memory."""
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

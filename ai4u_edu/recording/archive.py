"""Archive of recent episodes, by number."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from threading import Lock
from typing import overload

from ai4u_edu.recording.episode import AgentRecord, Episode

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

    @cached_property
    def success(self) -> bool | None:
        """True if an agent reached the scene's goal; None for a scene without a goal."""
        return self.episode.success

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

    It is thread-safe.

    Args:
        keep: maximum number of episodes.
        largest: maximum memory (bytes) of all episodes; the latest is always kept.
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

    def append(self, episode: Episode, source: str = "") -> ArchiveEntry:
        """Add an episode.

        Args:
            episode: the episode.
            source: the file that it was loaded from.
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
        """The entry with the highest reward among those that reached the goal, or else among all.

        Episodes that were loaded from files don't count.
        """
        own = [entry for entry in self.entries if not entry.source]
        return max(own, key=lambda entry: (entry.success is True, entry.first.total), default=None)

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

"""What came of a change."""

from concurrent.futures import Future
from dataclasses import dataclass
from typing import Literal

When = Literal["now", "next decision", "next reset"]


@dataclass(frozen=True)
class ChangeResult:
    """When a change takes effect, and what else there is to know about it."""

    when: When
    label: str = ""
    """What was done, in a few words, as it stands on the undo button."""
    note: str = ""
    """A sentence for the person who asked; mostly empty."""

    def __str__(self) -> str:
        """As it is shown to a person."""
        words = {
            "now": "it applies at once",
            "next decision": "it applies at the next decision",
            "next reset": "it applies at the next reset",
        }
        return "; ".join(filter(None, (words[self.when], self.note)))


def failed(error: Exception) -> "Future[ChangeResult]":
    """Return a future of an outcome that there can't be."""
    future: Future[ChangeResult] = Future()
    future.set_exception(error)
    return future

"""The result of a change that was made."""

from concurrent.futures import Future
from dataclasses import dataclass
from typing import Literal

from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join

When = Literal["now", "next decision", "next reset"]

_SENTENCES: dict[When, str] = {
    "now": _("works at once"),
    "next decision": _("works from the next decision on"),
    "next reset": _("works from the next reset on"),
}


@dataclass(frozen=True)
class ChangeResult:
    """The time at which a change takes effect, and warnings about it."""

    when: When
    label: str = ""
    """A few words for the undo button."""
    note: str = ""
    """A warning for the person who asked; usually empty."""

    def __str__(self) -> str:
        """Return a sentence to show to a person."""
        return join([text for text in (_SENTENCES[self.when], self.note) if text], "; ")


def failed(error: Exception) -> "Future[ChangeResult]":
    """Return a future that has failed with an error."""
    future: Future[ChangeResult] = Future()
    future.set_exception(error)
    return future

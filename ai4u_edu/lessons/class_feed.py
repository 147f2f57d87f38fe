"""State of a class for the page of a world that joins and leaves it while it runs."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ai4u_edu.page.server.class_feed import ClassFeed


class NotebookFeed:
    """The feed of the class that the notebook is in; without one, pages show nothing of a class."""

    def __init__(self) -> None:
        self._feed: ClassFeed | None = None
        self._base = 0

    def follow(self, feed: "ClassFeed | None") -> None:
        """Show another feed from now on."""
        base = self.version + 1
        self._feed, self._base = feed, base

    @property
    def version(self) -> int:
        """A number that grows with every change."""
        return self._base + (self._feed.version if self._feed is not None else 0)

    def event(self, role: str, seat: int) -> dict[str, Any] | None:
        """Return the event for a page; None without a class."""
        return None if self._feed is None else self._feed.event(role, seat)

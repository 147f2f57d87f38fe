"""What was, and what was taken back."""

from dataclasses import dataclass

from ai4u_edu.editing.state import EditState
from ai4u_edu.world import Pose

DEPTH = 200
"""So many changes can be taken back."""


@dataclass(frozen=True)
class Step:
    """One change."""

    label: str
    before: EditState
    after: EditState
    was: dict[str, Pose]
    """Where the bodies stood that it moved."""
    now: dict[str, Pose]
    """Where it put them."""
    whole: bool = False
    """Whether another scene runs since then."""
    opened: EditState | None = None
    """What had been opened last before."""


class History:
    """Changes that were made, and those that were taken back and can be made again."""

    def __init__(self, depth: int = DEPTH) -> None:
        self._depth = depth
        self._done: list[Step] = []
        self._undone: list[Step] = []

    @property
    def last(self) -> Step | None:
        """What would be undone."""
        return self._done[-1] if self._done else None

    @property
    def next(self) -> Step | None:
        """What would be done again."""
        return self._undone[-1] if self._undone else None

    def add(self, step: Step) -> None:
        """A change was made; what was taken back before is gone."""
        self._done = [*self._done, step][-self._depth :]
        self._undone = []

    def back(self) -> None:
        """The last one was taken back."""
        self._undone.append(self._done.pop())

    def forth(self) -> None:
        """The last one that was taken back was made again."""
        self._done.append(self._undone.pop())

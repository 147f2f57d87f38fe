"""The undo and redo stacks."""

from collections.abc import Mapping
from dataclasses import dataclass

from ai4u_edu.editing.state import EditState
from ai4u_edu.world import Pose

MAX_STEPS = 200
"""Changes that can be undone."""


@dataclass(frozen=True)
class Step:
    """One change that was made."""

    label: str
    before: EditState
    after: EditState
    poses_before: Mapping[str, Pose]
    """Earlier poses of the bodies that the change moved, by name."""
    poses_after: Mapping[str, Pose]
    """Poses to which the change moved them."""
    replaces_world: bool = False
    """True if the change opened another scene, or other agents made a new world necessary."""
    opened_before: EditState | None = None
    """The state that had been opened last, if the change opened another scene."""

    @property
    def opens(self) -> bool:
        """True if the change opened another scene."""
        return self.opened_before is not None


class History:
    """Changes that can be undone, and undone changes that can be redone."""

    def __init__(self, max_steps: int = MAX_STEPS) -> None:
        self._max_steps = max_steps
        self._done: list[Step] = []
        self._undone: list[Step] = []

    @property
    def last(self) -> Step | None:
        """The change that undo takes back; None if there is none."""
        return self._done[-1] if self._done else None

    @property
    def next(self) -> Step | None:
        """The change that redo makes again; None if there is none."""
        return self._undone[-1] if self._undone else None

    def add(self, step: Step) -> None:
        """Add a new change, and forget all undone ones."""
        self._done = [*self._done, step][-self._max_steps :]
        self._undone = []

    def move_back(self) -> None:
        """Mark the last change as undone."""
        self._undone.append(self._done.pop())

    def move_forward(self) -> None:
        """Mark the change that was undone last as done again."""
        self._done.append(self._undone.pop())

"""The undo and redo stacks."""

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from ai4u_edu.page.editing.state import EditState
from ai4u_edu.world import Pose

MAX_STEPS = 200
"""Changes that can be undone."""


MERGE_S = 1.0
"""Time (s) within which a nudge is joined to the one before it."""


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
    merge_key: str = ""
    """Steps with the same key that follow each other within a second are one; empty for none."""

    @property
    def opens(self) -> bool:
        """True if the change opened another scene."""
        return self.opened_before is not None


class History:
    """Changes that can be undone, and undone changes that can be redone.

    Args:
        max_steps: number of changes that can be undone.
        clock: wall clock (s); replaced in tests.
    """

    def __init__(
        self, max_steps: int = MAX_STEPS, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._max_steps, self._clock = max_steps, clock
        self._merge_until = 0.0
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
        """Add a new change, or join it to the last one; forget all undone ones."""
        now, last = self._clock(), self.last
        is_same = last is not None and step.merge_key and step.merge_key == last.merge_key
        if last is not None and is_same and now < self._merge_until:
            step = replace(step, before=last.before, poses_before=last.poses_before)
            self._done.pop()
        self._done = [*self._done, step][-self._max_steps :]
        self._undone, self._merge_until = [], now + MERGE_S

    def move_back(self) -> None:
        """Mark the last change as undone."""
        self._merge_until = 0.0
        self._undone.append(self._done.pop())

    def move_forward(self) -> None:
        """Mark the change that was undone last as done again."""
        self._done.append(self._undone.pop())

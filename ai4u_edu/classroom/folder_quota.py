"""Quota of a class's folder: its programs, networks, scenes and recordings together."""

import os
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from ai4u_edu.classroom.errors import StoreError
from ai4u_edu.locale import gettext as _

GB = 10**9
MAX_GB = 5.0
"""Usual size of a class's folder."""
WARNING_SHARE = 0.8
"""Share of the quota from which the teacher is told."""
MEASURE_S = 15.0
"""Interval of measuring the folder."""


class FolderQuota:
    """Size of a folder, measured now and then, and what is said about it.

    Args:
        folder: of the class.
        max_gb: limit of its size (GB).
        clock: returns seconds; to be replaced in tests.
    """

    def __init__(
        self, folder: Path, max_gb: float = MAX_GB, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._folder, self.max_gb, self._clock = folder, max_gb, clock
        self._measured_at = -MEASURE_S
        self._used_gb = 0.0

    def measure(self) -> None:
        """Measure the folder if that is due; a thread may do it."""
        now = self._clock()
        if now - self._measured_at >= MEASURE_S:
            self._measured_at = now
            self._used_gb = _size_of(self._folder) / GB

    @property
    def is_full(self) -> bool:
        """True if nothing more of students' work is kept."""
        return self._used_gb >= self.max_gb

    @property
    def warning(self) -> str:
        """Sentence for the teacher; empty while there is enough room."""
        if self.is_full:
            return _(
                "The class's folder has its {most:g} GB, and nothing more of students' work "
                "is kept. Export the class and forget it, or start it with a larger "
                "--max-folder.",
                most=self.max_gb,
            )
        if self._used_gb >= WARNING_SHARE * self.max_gb:
            return _(
                "The class's folder has {used_gb:.2g} of its {most:g} GB. Export the class "
                "and forget it soon, or start it with a larger --max-folder.",
                used_gb=self._used_gb,
                most=self.max_gb,
            )
        return ""

    def check(self) -> None:
        """Check that more of students' work may be kept.

        Raises:
            StoreError: the folder is full.
        """
        if self.is_full:
            raise StoreError(_("The class's folder is full, and keeps nothing more."))


def _size_of(folder: Path) -> int:
    """Return the bytes of all files in a folder, and in those below it."""
    total = 0
    for place, _folders, names in os.walk(folder):
        for name in names:
            with suppress(OSError):  # it was deleted meanwhile
                total += Path(place, name).lstat().st_size
    return total

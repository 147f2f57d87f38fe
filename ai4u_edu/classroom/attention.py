"""The teacher's request for attention, which holds until it ends, also across a restart."""

import json
import time
from collections.abc import Callable
from contextlib import suppress
from typing import Literal

from pydantic import BaseModel, Field

from ai4u_edu.classroom.errors import StoreError
from ai4u_edu.classroom.store import ClassStore
from ai4u_edu.wire.class_link import MAX_MESSAGE_CHARS, Attention

SETTING = "attention"
MAX_SECONDS = 4 * 3600.0
SAVE_EVERY_S = 5.0
"""Interval of saving the remaining seconds; at most so much longer it lasts after a crash."""
Kind = Literal["", "pause", "blank"]


class _Stored(BaseModel):
    kind: Kind = ""
    message: str = Field(default="", max_length=MAX_MESSAGE_CHARS)
    seconds: float = Field(default=0.0, ge=0, le=MAX_SECONDS, allow_inf_nan=False)


class AttentionState:
    """The present request. Its end is counted by the monotonic clock, as others may be set.

    Args:
        store: of the class.
        clock: returns seconds; to be replaced in tests.
    """

    def __init__(self, store: ClassStore, clock: Callable[[], float] = time.monotonic) -> None:
        self._store, self._clock = store, clock
        self.read()

    def read(self) -> None:
        """Take the stored request, with the seconds that it had left."""
        stored = self._store.setting_as(SETTING, _Stored)
        self.kind, self.message = stored.kind, stored.message
        self._ends_at = self._clock() + stored.seconds if stored.seconds else None
        self._saved_at = self._clock()

    def set(self, kind: Kind, message: str, seconds: float) -> None:
        """Store another request; one without kind and message ends it.

        Args:
            kind: see :class:`~ai4u_edu.wire.class_link.Attention`.
            message: of the teacher.
            seconds: duration; 0 for no limit.
        """
        self._save(kind, message, seconds)
        self.kind, self.message = kind, message
        self._ends_at = self._clock() + seconds if seconds else None

    def is_over(self) -> bool:
        """Return True if a request's time has come to its end."""
        return self._ends_at is not None and self._clock() >= self._ends_at

    def end(self) -> None:
        """End the request, also if that can't be stored: its time is over."""
        self.kind, self.message, self._ends_at = "", "", None
        with suppress(StoreError):
            self._save("", "", 0.0)

    def save_rest(self) -> None:
        """Store the remaining seconds now and then; a thread may do it."""
        if self._ends_at is not None and self._clock() - self._saved_at >= SAVE_EVERY_S:
            with suppress(StoreError):
                self._save(self.kind, self.message, self.ends_in_s)

    @property
    def ends_in_s(self) -> float:
        """Seconds until the end; 0 if it does not end by itself."""
        return 0.0 if self._ends_at is None else max(0.1, self._ends_at - self._clock())

    def as_message(self) -> Attention:
        """Return the request as rooms get it."""
        return Attention(self.kind, self.message, self.ends_in_s)

    def as_event(self) -> dict[str, object]:
        """Return the request as pages get it."""
        return {"kind": self.kind, "message": self.message, "ends_in": round(self.ends_in_s, 1)}

    def _save(self, kind: str, message: str, seconds: float) -> None:
        self._saved_at = self._clock()
        stored = {"kind": kind, "message": message, "seconds": seconds}
        self._store.set_setting(SETTING, json.dumps(stored))

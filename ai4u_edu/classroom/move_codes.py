"""Codes with which a seat moves to another device."""

import time
from collections.abc import Callable, Collection
from dataclasses import dataclass

from ai4u_edu.classroom.names import new_code

LIFE_S = 300.0


@dataclass
class _MoveCode:
    seat: int
    ends_at: float
    is_teachers: bool
    request: str = ""
    """Digest of the join request that has used it; empty before."""


class MoveCodes:
    """Codes of five letters, each for one seat, one device and five minutes. Not thread-safe.

    Args:
        clock: returns seconds; to be replaced in tests.

    >>> codes = MoveCodes()
    >>> code = codes.new(3, ())
    >>> codes.use(code, "a"), codes.use(code, "a"), codes.use(code, "b")
    ((3, False), (3, False), (0, False))
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._codes: dict[str, _MoveCode] = {}

    def new(self, seat: int, taken: Collection[str], *, is_teachers: bool = False) -> str:
        """Return a new code of a seat, whose code before is void.

        Args:
            seat: its number.
            taken: codes that must not be used, such as the class's.
            is_teachers: True for a code that the teacher has asked for.
        """
        now = self._clock()
        self._codes = {
            code: each
            for code, each in self._codes.items()
            if each.ends_at > now and each.seat != seat
        }
        while (code := new_code()) in self._codes or code in taken:
            pass
        self._codes[code] = _MoveCode(seat, now + LIFE_S, is_teachers)
        return code

    def use(self, code: str, request: str) -> tuple[int, bool]:
        """Use a code, and return its seat, and True if it is the teacher's.

        The seat is 0 if there is no such code, or another request has used it.

        Args:
            code: normalized.
            request: digest of the join request, which may be repeated because an answer was lost.
        """
        found = self._codes.get(code)
        if found is None or found.ends_at <= self._clock() or found.request not in ("", request):
            return 0, False
        found.request = request
        return found.seat, found.is_teachers

    def is_open(self, seat: int) -> bool:
        """Return True while a seat has a code that nobody has used yet."""
        return any(
            each.seat == seat and not each.request and each.ends_at > self._clock()
            for each in self._codes.values()
        )

    def clear(self) -> None:
        """Make all codes void."""
        self._codes.clear()

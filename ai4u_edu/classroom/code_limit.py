"""Rate limit for join codes, against guessing, which does not lock a class out."""

import asyncio
import time
from collections import OrderedDict
from collections.abc import Awaitable, Callable

MAX_WRONG = 60
"""Wrong codes that an address may send before its codes have to wait for their turn."""
FORGOTTEN_PER_S = 1.0
"""Rate at which an address's wrong codes are forgotten."""
TURNS_PER_S = 20.0
"""Codes of one address that are checked, after too many wrong ones: at this rate it takes a day to
try all codes."""
MAX_WAIT_S = 60.0
"""Longest wait for a turn; codes that would wait longer are refused unchecked."""
MAX_ADDRESSES = 1000
"""Addresses that are remembered, the most recent ones."""


class CodeLimit:
    """Gives the codes of an address that has sent too many wrong ones their turns, in order.

    All students of a school may have one address. So the right code of one waits in the same queue
    as the wrong ones of another, and gets its turn. Belongs to one event loop.

    Args:
        clock: returns seconds; to be replaced in tests.
        sleep: waits for a number of seconds; to be replaced in tests.
    """

    def __init__(
        self,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], Awaitable[None]] = asyncio.sleep,
    ) -> None:
        self._clock, self._sleep = clock, sleep
        self._wrong: OrderedDict[str, tuple[float, float]] = OrderedDict()  # how many, and when
        self._last_turn: dict[str, float] = {}

    async def wait_for_turn(self, address: str) -> bool:
        """Wait until a code of this address may be checked; False if that would take too long."""
        now = self._clock()
        if self._count(address) < MAX_WRONG:
            return True
        turn = max(now, self._last_turn.get(address, 0.0)) + 1 / TURNS_PER_S
        if turn - now > MAX_WAIT_S:
            return False
        self._last_turn[address] = turn
        await self._sleep(turn - now)
        return True

    def add_wrong(self, address: str) -> None:
        """Count a wrong code."""
        count = min(self._count(address) + 1, MAX_WRONG + 10)  # the count must not grow without end
        self._wrong[address] = count, self._clock()
        self._wrong.move_to_end(address)
        while len(self._wrong) > MAX_ADDRESSES:
            gone, _ = self._wrong.popitem(last=False)
            self._last_turn.pop(gone, None)

    def _count(self, address: str) -> float:
        count, when = self._wrong.get(address, (0.0, 0.0))
        return max(0.0, count - (self._clock() - when) * FORGOTTEN_PER_S)

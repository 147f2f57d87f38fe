"""Rate limit for join codes, against guessing, which does not lock a class out."""

import asyncio
import time
from collections import OrderedDict
from collections.abc import Awaitable, Callable

from ai4u_edu.page.server.wrong_counts import WrongCounts, remember

TURNS_PER_S = 20.0
"""Codes of one address that are checked, after too many wrong ones: at this rate it takes a day to
try all codes."""
MAX_WAIT_S = 60.0
"""Longest wait for a turn; codes that would wait longer are refused unchecked."""


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
        self._wrong = WrongCounts(clock)
        self._last_turn: OrderedDict[str, float] = OrderedDict()

    async def wait_for_turn(self, address: str) -> bool:
        """Wait until a code of this address may be checked; False if that would take too long."""
        now = self._clock()
        if not self._wrong.seconds_over(address):
            return True
        turn = max(now, self._last_turn.get(address, 0.0)) + 1 / TURNS_PER_S
        if turn - now > MAX_WAIT_S:
            return False
        remember(self._last_turn, address, turn)
        await self._sleep(turn - now)
        return True

    def add_wrong(self, address: str) -> None:
        """Count a wrong code."""
        self._wrong.add(address)

"""Rate limit for wrong tokens, so that nobody guesses one by trying.

An address that has given too many wrong tokens waits before the next one is looked at, whether it
is right or wrong: else a quick answer would be worth as much as a limit that is not there. Only an
address that has given the right one before, as a class's own, is let in at once with the right one.
"""

import asyncio
import math
import time
from collections import OrderedDict
from collections.abc import Awaitable, Callable
from enum import Enum, auto
from typing import TypeVar

from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from ai4u_edu.server.connections import address_of

MAX_WRONG = 60
"""Wrong tokens in a row that an address may give before it has to wait."""
FORGOTTEN_PER_S = 1.0
"""Wrong tokens of an address that are forgotten in a second."""
DELAY_S = 1.0
"""Time that a token is not looked at once there were too many wrong ones."""
MAX_WAITING = 20
"""Tokens of one address that may wait at a time; further ones are not looked at."""
MAX_ADDRESSES = 1000
"""Addresses that are remembered, the latest ones."""
TOO_MANY = "too many wrong tokens from this address; try again in {seconds} s"

Value = TypeVar("Value")


class Verdict(Enum):
    """Result of looking at a token."""

    RIGHT = auto()
    WRONG = auto()
    TOO_MANY = auto()


class Attempts:
    """The wrong tokens of each address. Belongs to the server's event loop.

    Args:
        clock: seconds; to be replaced in tests.
        sleep: waits for so many seconds; to be replaced in tests.
    """

    def __init__(
        self,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], Awaitable[None]] = asyncio.sleep,
    ) -> None:
        self._clock, self._sleep = clock, sleep
        self._wrong: OrderedDict[str, tuple[float, float]] = OrderedDict()  # how many, and when
        self._known: OrderedDict[str, None] = OrderedDict()
        self._waiting: dict[str, int] = {}

    async def look(self, address: str, is_right: Callable[[], bool]) -> Verdict:
        """Look at a token, after a while if its address has given too many wrong ones.

        Args:
            address: where it comes from.
            is_right: tells whether it is the right one.
        """
        if address in self._known:
            if is_right():
                return Verdict.RIGHT
        elif not await self.wait(address):
            return Verdict.TOO_MANY
        elif is_right():
            _remember(self._known, address, None)
            return Verdict.RIGHT
        was_over = self.retry_after(address) > 0
        self.add_wrong(address)
        if was_over and address in self._known:
            await self.wait(address)
        return Verdict.TOO_MANY if was_over else Verdict.WRONG

    async def wait(self, address: str) -> bool:
        """Wait if an address has given too many wrong tokens; False if too many wait already."""
        if not self.retry_after(address):
            return True
        waiting = self._waiting.get(address, 0)
        if waiting >= MAX_WAITING:
            return False
        self._waiting[address] = waiting + 1
        try:
            await self._sleep(DELAY_S)
        finally:
            self._waiting[address] -= 1
            if not self._waiting[address]:
                del self._waiting[address]
        return True

    def add_wrong(self, address: str) -> None:
        """Count a wrong token."""
        count = min(self._count(address) + 1, MAX_WRONG + 10)  # so that it is forgotten soon
        _remember(self._wrong, address, (count, self._clock()))

    def retry_after(self, address: str) -> int:
        """Return the seconds after which an address does not have to wait; 0 if it does not now."""
        over = self._count(address) - MAX_WRONG + 1
        return max(0, math.ceil(over / FORGOTTEN_PER_S))

    def is_known(self, address: str) -> bool:
        """Return True if an address has given the right token."""
        return address in self._known

    def _count(self, address: str) -> float:
        count, when = self._wrong.get(address, (0.0, 0.0))
        return max(0.0, count - (self._clock() - when) * FORGOTTEN_PER_S)


class LimitScripts:
    """ASGI middleware for sockets that look at the token themselves, and close with a code.

    Args:
        app: the socket's.
        attempts: counts the wrong tokens.
        code: with which the socket is closed for a wrong token.
    """

    def __init__(self, app: ASGIApp, attempts: Attempts, code: int) -> None:
        self._app, self._attempts, self._code = app, attempts, code

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Let a connection in, after a while if its address has given too many wrong tokens."""
        address = client_address(scope)
        if not self._attempts.is_known(address) and not await self._attempts.wait(address):
            seconds = self._attempts.retry_after(address)
            await too_many(seconds)(scope, receive, send)
            return

        async def send_and_count(message: Message) -> None:
            if message["type"] == "websocket.close" and message.get("code") == self._code:
                self._attempts.add_wrong(address)
            await send(message)

        await self._app(scope, receive, send_and_count)


def client_address(scope: Scope) -> str:
    """Return the address of the other end, or of the one that a proxy on this machine names."""
    return address_of(scope.get("client"))


def too_many(seconds: int) -> PlainTextResponse:
    """Return the answer to who has given too many wrong tokens."""
    text = TOO_MANY.format(seconds=seconds)
    headers = {"Retry-After": str(seconds), "Cache-Control": "no-store"}
    return PlainTextResponse(f"token: {text}\n", 429, headers)


def _remember(kept: OrderedDict[str, Value], address: str, value: Value) -> None:
    kept[address] = value
    kept.move_to_end(address)
    if len(kept) > MAX_ADDRESSES:
        kept.popitem(last=False)

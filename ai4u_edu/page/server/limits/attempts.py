"""Rate limit for wrong tokens, against guessing.

After too many wrong tokens from an address, each further one is checked after a delay, whether it
is right or wrong. Otherwise a quick answer would tell that a guess was right. An address that has
sent the right token before, as a class's own has, is not delayed with the right one.
"""

import asyncio
import time
from collections import OrderedDict
from collections.abc import Awaitable, Callable
from enum import Enum, auto

from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from ai4u_edu.page.server.limits.connections import address_of
from ai4u_edu.page.server.wrong_counts import WrongCounts, remember

DELAY_S = 1.0
"""Delay of each token after too many wrong ones."""
MAX_WAITING = 20
"""Delayed tokens of one address at a time; further ones are refused unchecked."""
TOO_MANY = "too many wrong tokens from this address; try again in {seconds} s"


class Verdict(Enum):
    """Result of checking a token."""

    RIGHT = auto()
    WRONG = auto()
    TOO_MANY = auto()


class Attempts:
    """Counts of wrong tokens by address. Belongs to the server's event loop.

    Args:
        clock: returns seconds; to be replaced in tests.
        sleep: waits for a number of seconds; to be replaced in tests.
    """

    def __init__(
        self,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], Awaitable[None]] = asyncio.sleep,
    ) -> None:
        self._sleep = sleep
        self._wrong = WrongCounts(clock)
        self._known: OrderedDict[str, None] = OrderedDict()
        self._waiting: dict[str, int] = {}

    async def check(self, address: str, is_right: Callable[[], bool]) -> Verdict:
        """Check a token, after a delay if its address has sent too many wrong ones.

        Args:
            address: the sender's.
            is_right: compares the token.
        """
        if address in self._known:
            if is_right():
                return Verdict.RIGHT
        elif not await self.wait(address):
            return Verdict.TOO_MANY
        elif is_right():
            remember(self._known, address, None)
            return Verdict.RIGHT
        was_over = self.retry_after(address) > 0
        self.add_wrong(address)
        if was_over and address in self._known:
            await self.wait(address)
        return Verdict.TOO_MANY if was_over else Verdict.WRONG

    async def wait(self, address: str) -> bool:
        """Wait if an address has sent too many wrong tokens; False if too many wait already."""
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
        self._wrong.add(address)

    def retry_after(self, address: str) -> int:
        """Return the seconds until an address is not delayed any more; 0 if it is not now."""
        return self._wrong.seconds_over(address)

    def is_known(self, address: str) -> bool:
        """Return True if an address has sent the right token."""
        return address in self._known


class LimitScripts:
    """ASGI middleware for sockets that check the token themselves, and close with a code.

    Args:
        app: the socket's app.
        attempts: the rate limit.
        code: code of the close for a wrong token.
    """

    def __init__(self, app: ASGIApp, attempts: Attempts, code: int) -> None:
        self._app, self._attempts, self._code = app, attempts, code

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a connection on, after a delay if its address has sent too many wrong tokens."""
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
    """Return the client's address, or the one that a reverse proxy on this machine gives."""
    return address_of(scope.get("client"))


def too_many(seconds: int) -> PlainTextResponse:
    """Return the answer to an address that has sent too many wrong tokens."""
    text = TOO_MANY.format(seconds=seconds)
    headers = {"Retry-After": str(seconds), "Cache-Control": "no-store"}
    return PlainTextResponse(f"token: {text}\n", 429, headers)

"""Rate limits for wrong secrets, against guessing: tokens of rooms, and join codes of classes."""

import asyncio
import math
import time
from collections import OrderedDict
from collections.abc import Awaitable, Callable
from enum import Enum, auto

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from ai4u_edu.locale import gettext as _
from ai4u_edu.page.server.limits.connections import address_of
from ai4u_edu.page.server.limits.rate_limit import MAX_KEYS, RateLimits
from ai4u_edu.page.server.reader_language import TextResponse

MAX_WRONG = 60
"""Wrong secrets in a row after which an address is limited."""
FORGOTTEN_PER_S = 1.0
"""Rate at which an address's wrong secrets are forgotten."""
MAX_DEBT = 10
"""Wrong secrets beyond that which count, so that an address is not limited without end."""
DELAY_S = 1.0
"""Delay of each token after too many wrong ones."""
MAX_WAITING = 20
"""Delayed tokens of one address at a time; further ones are refused unchecked."""
CODE_TURNS_PER_S = 20.0
"""Codes of one address that are checked, after too many wrong ones: at this rate it takes a day to
try all codes."""
MAX_CODE_WAIT_S = 60.0
"""Longest wait for a turn; codes that would wait longer are refused unchecked."""


class AttemptResult(Enum):
    """Result of checking a token."""

    RIGHT = auto()
    WRONG = auto()
    TOO_MANY = auto()


class Attempts:
    """Delays the tokens of addresses that have sent too many wrong ones.

    Each further token is checked after a delay, whether it is right or wrong: otherwise a quick
    answer would tell that a guess was right. An address that has sent the right token before, as a
    class's own has, is not delayed with the right one. Belongs to the server's event loop.

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
        self._wrong = _wrong_secrets(clock)
        self._known: OrderedDict[str, None] = OrderedDict()
        self._waiting: dict[str, int] = {}

    async def check(self, address: str, is_right: Callable[[], bool]) -> AttemptResult:
        """Check a token, after a delay if its address has sent too many wrong ones.

        Args:
            address: the sender's.
            is_right: compares the token.
        """
        if address in self._known:
            if is_right():
                return AttemptResult.RIGHT
        elif not await self.wait(address):
            return AttemptResult.TOO_MANY
        elif is_right():
            self._known[address] = None
            if len(self._known) > MAX_KEYS:
                self._known.popitem(last=False)
            return AttemptResult.RIGHT
        was_over = self.retry_after(address) > 0
        self.add_wrong(address)
        if was_over and address in self._known:
            await self.wait(address)
        return AttemptResult.TOO_MANY if was_over else AttemptResult.WRONG

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
        self._wrong.take(address)

    def retry_after(self, address: str) -> int:
        """Return the seconds until an address is not delayed any more; 0 if it is not now."""
        return math.ceil(self._wrong.wait_s(address))

    def is_known(self, address: str) -> bool:
        """Return True if an address has sent the right token."""
        return address in self._known


class CodeLimit:
    """Gives the codes of an address that has sent too many wrong ones their turns, in order.

    All students of a school may have one address. So the right code of one waits in the same queue
    as the wrong ones of another, gets its turn, and nobody locks a class out. Belongs to one event
    loop.

    Args:
        clock: returns seconds; to be replaced in tests.
        sleep: waits for a number of seconds; to be replaced in tests.
    """

    def __init__(
        self,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], Awaitable[None]] = asyncio.sleep,
    ) -> None:
        self._sleep, self._wrong = sleep, _wrong_secrets(clock)
        self._turns = RateLimits(CODE_TURNS_PER_S, 0, clock=clock)

    async def wait_for_turn(self, address: str) -> bool:
        """Wait until a code of this address may be checked; False if that would take too long."""
        if not self._wrong.wait_s(address):
            return True
        wait_s = self._turns.take_within(address, MAX_CODE_WAIT_S)
        if wait_s is None:
            return False
        await self._sleep(wait_s)
        return True

    def add_wrong(self, address: str) -> None:
        """Count a wrong code."""
        self._wrong.take(address)


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


def too_many_text(seconds: int) -> str:
    """Return the sentence for an address that has sent too many wrong tokens."""
    return _("too many wrong tokens from this address; try again in {seconds} s", seconds=seconds)


def too_many(seconds: int) -> TextResponse:
    """Return the answer to an address that has sent too many wrong tokens."""
    headers = {"Retry-After": str(seconds), "Cache-Control": "no-store"}
    return TextResponse(_("token: {problem}", problem=too_many_text(seconds)), 429, headers)


def _wrong_secrets(clock: Callable[[], float]) -> RateLimits:
    """Return counts of wrong secrets by address, which are forgotten with time."""
    return RateLimits(FORGOTTEN_PER_S, MAX_WRONG, max_debt=MAX_DEBT, clock=clock)

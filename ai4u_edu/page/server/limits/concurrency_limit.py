"""Limit of requests and WebSockets that are open at the same time, by who holds them."""

import asyncio
from collections import defaultdict
from collections.abc import AsyncIterator, Hashable
from contextlib import asynccontextmanager, suppress

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from ai4u_edu.base.errors import AI4UError, text_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.server.limits.connections import max_connections
from ai4u_edu.page.server.limits.socket_close import TRY_LATER, close_reason
from ai4u_edu.page.server.reader_language import TextResponse

RETRY_AFTER_S = 5


class TooManyOpenError(AI4UError):
    """A holder has too many open, or one was open for too long."""


class ConcurrencyLimit:
    """Counts what is open of each holder, such as an address or a seat, and refuses more.

    All holders together have a share of the server's connections. When it is used up, whoever has
    the most gives one back to whoever has fewer: so one who takes many keeps nobody out. Belongs to
    one event loop.

    Args:
        per_holder: limit of one holder.
        share: of the server's connections, for all holders, between 0 and 1.
        life_s: time after which each one is ended; default: no limit.
        what: plural of what is counted, for the message.
    """

    def __init__(
        self, per_holder: int, share: float, life_s: float | None = None, what: str = _("sockets")
    ) -> None:
        self._per_holder, self._share = per_holder, share
        self._life_s, self._what = life_s, what
        self._open: defaultdict[Hashable, list[asyncio.Timeout]] = defaultdict(list)

    @asynccontextmanager
    async def one_of(self, holder: Hashable) -> AsyncIterator[None]:
        """Context in which one more is open.

        Args:
            holder: who has it.

        Raises:
            TooManyOpenError: there are too many, or this one was ended inside the context.
        """
        if len(self._open.get(holder, ())) >= self._per_holder:
            raise TooManyOpenError(
                _(
                    "expected at most {per_holder} open {what} of one student or network, got "
                    "another one; close some pages",
                    per_holder=self._per_holder,
                    what=self._what,
                )
            )
        if not self._has_room_for(holder):
            raise TooManyOpenError(_("too many {what} are open; try again later", what=self._what))
        try:
            async with asyncio.timeout(self._life_s) as timer:
                self._open[holder].append(timer)
                try:
                    yield
                finally:
                    self._remove(holder, timer)
        except TimeoutError:
            if not timer.expired():
                raise
            raise TooManyOpenError(
                _(
                    "too many {what} are open, or this one was for too long; try again later",
                    what=self._what,
                )
            ) from None

    async def serve(
        self, holder: Hashable, app: ASGIApp, scope: Scope, receive: Receive, send: Send
    ) -> None:
        """Call an app for a request or socket within the limit; answer with 503 beyond it."""
        sent: set[str] = set()

        async def send_and_note(message: Message) -> None:
            sent.add(message["type"])
            await send(message)

        try:
            async with self.one_of(holder):
                await app(scope, receive, send_and_note)
        except TooManyOpenError as error:
            if "websocket.accept" in sent:
                with suppress(RuntimeError, OSError):  # it is closed already
                    reason = close_reason(text_of(error))
                    await send({"type": "websocket.close", "code": TRY_LATER, "reason": reason})
            elif not sent:
                headers = {"Retry-After": str(RETRY_AFTER_S), "Cache-Control": "no-store"}
                await TextResponse(text_of(error), 503, headers)(scope, receive, send)
            # else the answer is cut off, which its client sees by its length

    def _has_room_for(self, holder: Hashable) -> bool:
        """Return True if one more may be open, after ending one of whoever has the most."""
        if sum(map(len, self._open.values())) < int(self._share * max_connections()):
            return True
        most = max(self._open, key=lambda each: len(self._open[each]), default=holder)
        if len(self._open.get(most, ())) <= len(self._open.get(holder, ())) + 1:
            return False
        evicted = self._open[most][0]
        self._remove(most, evicted)
        evicted.reschedule(0.0)
        return True

    def _remove(self, holder: Hashable, timer: asyncio.Timeout) -> None:
        left = self._open.get(holder, [])
        if timer in left:
            left.remove(timer)
        if not left:
            self._open.pop(holder, None)

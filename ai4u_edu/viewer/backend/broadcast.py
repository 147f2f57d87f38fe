"""What all pages get is packed once, and not once for each of them.

viser lets every page gather, pack and compress the same messages anew. With a class that looks on
(measured: sixty pages) most of the processor's time goes into that. Here pages that are up to date
share one packing; a page that can't keep up skips what is outdated by then, and gets the newest.
"""

import asyncio
import logging
import socket
import time
from collections import defaultdict
from collections.abc import Awaitable, Callable, Sequence
from contextlib import suppress
from threading import get_ident
from weakref import WeakKeyDictionary

import msgspec
import viser
import zstandard
from viser.infra import WebsockClientConnection, _infra
from viser.infra._async_message_buffer import AsyncMessageBuffer
from viser.infra._messages import Message
from websockets.asyncio.server import ServerConnection, broadcast

from ai4u_edu.base.log_limit import log_limited

KNOWN = "1.1.1"
"""The viser whose insides this fits. Any other one goes on in its own way."""
SEND_PERIOD_S = 1 / 120
"""Shortest time between two messages to a page: less than between two frames, so that none is sent
together with the next."""
CHUNK = 128
"""Messages in a frame for a page that has just come."""

SEND_BUFFER_BYTES = 64 * 2**10
"""Size of the system's buffer for what one page has not taken yet."""

_NAME = "_ai4u_edu_fan_out"
_IS_OWN = "_ai4u_edu_is_own"
"""Marks the buffers of single pages of a server of ours."""
_logger = logging.getLogger(__name__)
Producer = Callable[..., Awaitable[None]]


class Awakener(asyncio.Event):
    """In place of a buffer's event, which viser sets from other threads too.

    To wake who waits is for the loop's thread alone, and viser has that done besides: from another
    one it may fail, since who waits comes and goes meanwhile.
    """

    def __init__(self) -> None:
        super().__init__()
        self._thread = get_ident()

    def set(self) -> None:
        """Sets it; whoever waits is woken in the loop's thread."""
        if get_ident() != self._thread:
            self._value = True
            return
        self._value = False  # else those would not be woken who wait since before it was set
        super().set()


class Page:
    """The way to one page.

    Args:
        connection: viser's.
    """

    def __init__(self, connection: ServerConnection) -> None:
        self.connection = connection
        # what waits for a slow page is to wait here, where newer messages replace it
        stream: socket.socket = connection.transport.get_extra_info("socket")
        stream.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, SEND_BUFFER_BYTES)

    def is_clear(self) -> bool:
        """Whether it has taken all that it was told."""
        return not self.connection.transport.get_write_buffer_size()

    async def send(self, message: bytes) -> None:
        """Tells it something after all else; viser's producers call this."""
        await self.connection.send(message)


class FanOut:
    """Tells all pages of a server what is new. Belongs to viser's loop.

    Args:
        buffer: viser's, of the messages for all pages.
    """

    def __init__(self, buffer: AsyncMessageBuffer) -> None:
        self._buffer = buffer
        self._pages: dict[int, Page] = {}
        self._sending: asyncio.Task[None] | None = None

    async def serve(self, page: Page, number: int, replayed: Message | None) -> None:
        """One page: all that there is first, then what is new, until it is cancelled.

        Args:
            page: the way to it.
            number: the page's.
            replayed: is said after what there was when the page came.
        """
        buffer, cursors = self._buffer, self._buffer.generator_cursors
        backlog = buffer.message_counter - 1
        cursors[number] = -1
        try:
            while buffer.atomic_counter:  # somebody is in the middle of something
                await asyncio.sleep(0.001)
            there = self._between(-1, backlog, number)
            for first in range(0, len(there), CHUNK):
                await page.send(packed(there[first : first + CHUNK]))
            if replayed is not None:
                await page.send(packed([replayed]))
            cursors[number] = backlog
            self._pages[number] = page
            if self._sending is None:
                self._sending = asyncio.create_task(self._send())
            buffer.message_event.set()
            await asyncio.shield(self._sending)
        finally:
            self._pages.pop(number, None)
            cursors.pop(number, None)
            if not self._pages and self._sending is not None:
                self._sending.cancel()
                self._sending = None

    async def _send(self) -> None:
        buffer = self._buffer
        while True:
            is_done = False
            try:  # all pages would be closed if this task ended
                is_done = self._send_news()
            except Exception as error:
                _log_failure("sending", "some pages were not told what is new: %a", error)
            with suppress(TimeoutError):
                await asyncio.wait_for(buffer.flush_event.wait(), SEND_PERIOD_S)
            buffer.flush_event.clear()
            if is_done:
                await buffer.message_event.wait()
            buffer.message_event.clear()

    def _send_news(self) -> bool:
        """Sends to every page what it lacks; whether no page is left behind."""
        buffer, cursors = self._buffer, self._buffer.generator_cursors
        last = buffer.message_counter - 1
        if buffer.atomic_counter:
            return True  # at its end we are woken again
        lacking = defaultdict(list)
        is_done = True
        for number, page in self._pages.items():
            if cursors[number] == last:
                continue
            if page.is_clear():
                lacking[cursors[number]].append(number)
            else:
                is_done = False
        for since, numbers in lacking.items():
            messages = self._between(since, last)
            barred = {message.excluded_self_client for message in messages}
            for number in numbers:
                cursors[number] = last  # first: what fails to be told now would fail again
            self._tell([number for number in numbers if number not in barred], messages)
            for number in numbers:
                if number in barred:
                    self._tell([number], [m for m in messages if m.excluded_self_client != number])
        return is_done

    def _tell(self, numbers: Sequence[int], messages: Sequence[Message]) -> None:
        if not (numbers and messages):
            return
        broadcast([self._pages[number].connection for number in numbers], packed(messages))

    def _between(self, since: int, last: int, number: int = -1) -> list[Message]:
        """The messages after one and up to another that are still of use, but for one page's."""
        messages = self._buffer.message_from_id
        if last - since <= len(messages):
            found = [messages.get(each) for each in range(since + 1, last + 1)]
        else:  # of what was said in the last hour little is left
            with self._buffer.buffer_lock:
                found = [each for key, each in messages.items() if since < key <= last]
        return [each for each in found if each and each.excluded_self_client != number]


def packed(messages: Sequence[Message]) -> bytes:
    """Return a frame as viser's page reads it (see viser's ``_message_producer``).

    A message that msgpack can't hold is left out, and logged.
    """
    try:
        plain, buffers = _plain(messages)
    except Exception:
        plain, buffers = _plain([each for each in messages if _can_be_packed(each)])
    small = zstandard.ZstdCompressor(level=1).compress(plain)
    parts: list[bytes | memoryview] = [
        len(plain).to_bytes(8, "little"),
        len(small).to_bytes(8, "little"),
        small,
    ]
    _infra._append_aligned_buffers(parts, buffers, 16 + len(small))
    return b"".join(parts)


def _plain(messages: Sequence[Message]) -> tuple[bytes, list[memoryview]]:
    buffers: list[memoryview] = []
    plain = msgspec.msgpack.encode(
        {
            "messages": tuple(message.as_serializable_dict(buffers) for message in messages),
            "timestampSec": time.perf_counter(),
            "binaryBufferLengths": tuple(each.nbytes for each in buffers),
        }
    )
    return plain, buffers


def _can_be_packed(message: Message) -> bool:
    try:
        _plain([message])
    except Exception as error:  # whatever a value's type does when it is asked for its content
        kind = type(message).__name__
        _log_failure(kind, f"a {kind} was left out, it can't be sent: %a", error)
        return False
    return True


def _log_failure(key: str, text: str, error: Exception) -> None:
    log_limited(_logger, logging.ERROR, key, text, f"{type(error).__name__}: {error!s:.200}")


def fan_out(server: viser.ViserServer) -> bool:
    """Has a server pack once what all pages get; whether it can be done with this viser.

    Args:
        server: viser's.
    """
    if viser.__version__ != KNOWN:
        return False
    buffer = server._websock_server._broadcast_buffer
    setattr(buffer, _NAME, FanOut(buffer))
    server._websock_server.on_client_connect(_mark_own)
    if _infra._message_producer is _viser_does:
        _infra._message_producer = _produce
    return True


async def _mark_own(connection: WebsockClientConnection) -> None:
    setattr(connection.get_message_buffer(), _IS_OWN, True)


_pages: WeakKeyDictionary[ServerConnection, Page] = WeakKeyDictionary()
_viser_does: Producer = _infra._message_producer


async def _send_windows(
    page: Page, buffer: AsyncMessageBuffer, client_id: int, backlog_done_message: Message | None
) -> None:
    """Send a buffer that belongs to one page, as viser's ``_message_producer`` does."""
    windows = buffer.window_generator(client_id, backlog_done_message=backlog_done_message)
    try:
        while not buffer.done:
            try:
                window = await anext(windows)
            except StopAsyncIteration:
                break
            await page.send(packed(window))
    finally:
        await windows.aclose()


async def _produce(
    websocket: ServerConnection,
    buffer: AsyncMessageBuffer,
    client_id: int,
    backlog_done_message: Message | None = None,
) -> None:
    """Send a page what is in a buffer, in place of viser's function of that name.

    A message that can't be packed is left out, also if it is for one page only: viser would close
    the page. Servers that are not ours go on in viser's way.
    """
    if not isinstance(buffer.message_event, Awakener):
        buffer.message_event = Awakener()
        buffer.message_event.set()
    page = _pages.get(websocket)
    if page is None:
        page = _pages[websocket] = Page(websocket)
    ours: FanOut | None = getattr(buffer, _NAME, None)
    if ours is None and hasattr(buffer, _IS_OWN):
        await _send_windows(page, buffer, client_id, backlog_done_message)
    elif ours is None:
        await _viser_does(page, buffer, client_id, backlog_done_message)
    else:
        await ours.serve(page, client_id, backlog_done_message)

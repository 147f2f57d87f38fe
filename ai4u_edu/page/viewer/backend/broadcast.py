"""Broadcast of viser's messages: each is packed once for all pages, not once for each page.

viser lets every page gather, pack and compress the same messages again, which takes most of a core
with thirty pages. Here all pages that are up to date share one packing. A page that can't keep up
skips outdated messages. Messages for one page go out as soon as they are complete, where viser
waits a sixtieth of a second, for which it starts a timer and a task.
See ``docs/adr/0006-serialize-once-for-all-pages.md``.
"""

import asyncio
import logging
import socket
import time
from collections import defaultdict
from collections.abc import Awaitable, Callable, Sequence
from contextlib import suppress
from threading import get_ident

import msgspec
import viser
import zstandard
from viser.infra import Message, WebsockClientConnection, _infra
from viser.infra._async_message_buffer import AsyncMessageBuffer
from websockets.asyncio.server import ServerConnection, broadcast

from ai4u_edu.base.log_limit import log_limited

VISER_VERSION = "1.1.1"
"""The version of viser whose private parts are used here; any other one is left as it is."""
SEND_PERIOD_S = 1 / 120
"""Shortest time between two messages to a page: less than between two frames, so that none is sent
together with the next."""
MAX_BACKLOG_MESSAGES = 128
"""Messages in one WebSocket message to a page that has just connected."""
SEND_BUFFER_BYTES = 64 * 2**10
"""Size of the system's send buffer for a page: frames for a slow page wait here, where newer
messages replace them, and not on the way."""

_BROADCASTER = "_ai4u_edu_broadcaster"
"""Attribute of the buffers of a server whose messages are sent by broadcasters."""
_logger = logging.getLogger(__name__)
Producer = Callable[..., Awaitable[None]]


class LoopEvent(asyncio.Event):
    """Event of a buffer that other threads can't set.

    viser sets a buffer's event from any thread, and besides has the loop set it. asyncio's events
    are not thread-safe: the first call may fail, or keep the second from waking anybody.
    """

    def __init__(self) -> None:
        super().__init__()
        self._thread_id = get_ident()

    def set(self) -> None:
        """Set the event in the loop's thread; do nothing in another one."""
        if get_ident() == self._thread_id:
            super().set()


class Broadcaster:
    """Sends new messages of a buffer to its pages. Belongs to viser's event loop.

    Args:
        buffer: viser's buffer of the messages for all pages of a server, or for one page.
    """

    def __init__(self, buffer: AsyncMessageBuffer) -> None:
        self._buffer = buffer
        self._pages: dict[int, ServerConnection] = {}
        self._sending: asyncio.Task[None] | None = None

    async def serve(
        self, connection: ServerConnection, client_id: int, backlog_done_message: Message | None
    ) -> None:
        """Send one page its backlog, then new messages until it is cancelled.

        Args:
            connection: the page's.
            client_id: the page's number.
            backlog_done_message: is sent after the backlog.
        """
        buffer, cursors = self._buffer, self._buffer.generator_cursors
        backlog = buffer.message_counter - 1
        cursors[client_id] = -1
        try:
            while buffer.atomic_counter:
                await asyncio.sleep(0.001)
            messages = self._taken(-1, backlog, client_id)
            for first in range(0, len(messages), MAX_BACKLOG_MESSAGES):
                await connection.send(pack(messages[first : first + MAX_BACKLOG_MESSAGES]))
            if backlog_done_message is not None:
                await connection.send(pack([backlog_done_message]))
            cursors[client_id] = backlog
            self._pages[client_id] = connection
            if self._sending is None:
                self._sending = asyncio.create_task(self._send())
            buffer.message_event.set()
            await asyncio.shield(self._sending)
        finally:
            self._pages.pop(client_id, None)
            cursors.pop(client_id, None)
            if not self._pages and self._sending is not None:
                ended, self._sending = self._sending, None
                ended.cancel()
                await asyncio.wait([ended])  # the loop may be closed when this has returned

    async def _send(self) -> None:
        buffer = self._buffer
        while True:
            is_done = False
            try:  # all pages would be closed if this task ended
                is_done = self._send_new()
            except Exception as error:
                _log_failure("sending", "some pages were not told what is new: %a", error)
            sent_at = time.monotonic()
            if is_done:
                await buffer.message_event.wait()
            rest = sent_at + SEND_PERIOD_S - time.monotonic()
            if rest > 0:  # not after a usual pause: a timer would wake this thread once more
                # not wait_for, which in Python 3.11 loses a cancellation that comes with the event
                with suppress(TimeoutError):
                    async with asyncio.timeout(rest):
                        await buffer.flush_event.wait()
            buffer.flush_event.clear()
            buffer.message_event.clear()

    def _send_new(self) -> bool:
        """Send each page the messages that it lacks; return True if all pages are up to date."""
        buffer, cursors = self._buffer, self._buffer.generator_cursors
        last = buffer.message_counter - 1
        if buffer.atomic_counter:
            return True  # viser sets the event at the end of the atomic block
        behind = defaultdict(list)
        is_done = True
        for client_id, connection in self._pages.items():
            if cursors[client_id] == last:
                continue
            if connection.transport.get_write_buffer_size():
                is_done = False
            else:
                behind[cursors[client_id]].append(client_id)
        for since, client_ids in behind.items():
            messages = self._taken(since, last)
            excluded = {message.excluded_self_client for message in messages}
            for client_id in client_ids:
                cursors[client_id] = last  # first: a message that fails would fail again
            self._send_to([each for each in client_ids if each not in excluded], messages)
            for client_id in client_ids:
                if client_id in excluded:
                    rest = [each for each in messages if each.excluded_self_client != client_id]
                    self._send_to([client_id], rest)
        return is_done

    def _send_to(self, client_ids: Sequence[int], messages: Sequence[Message]) -> None:
        if client_ids and messages:
            broadcast([self._pages[each] for each in client_ids], pack(messages))

    def _taken(self, since: int, last: int, client_id: int = -1) -> list[Message]:
        """Return the messages after ``since`` up to ``last``, except those that exclude a page.

        viser has removed those that a newer one replaces. A buffer for one page forgets them.
        """
        buffer, messages = self._buffer, self._buffer.message_from_id
        if not buffer.persistent_messages:
            with buffer.buffer_lock:
                taken = [buffer.pop_message_locked(each) for each in range(since + 1, last + 1)]
            return [each for each in taken if each is not None]
        if last - since <= len(messages):
            found = [messages.get(each) for each in range(since + 1, last + 1)]
        else:  # after a long time few numbers are left
            with buffer.buffer_lock:
                found = [each for key, each in messages.items() if since < key <= last]
        return [each for each in found if each and each.excluded_self_client != client_id]


def pack(messages: Sequence[Message]) -> bytes:
    """Return a WebSocket message as viser's page reads it (see viser's ``_message_producer``).

    A message that msgpack can't hold is left out, and logged.
    """
    try:
        encoded, buffers = _encode(messages)
    except Exception:
        encoded, buffers = _encode([each for each in messages if _can_be_encoded(each)])
    compressed = zstandard.ZstdCompressor(level=1).compress(encoded)
    parts: list[bytes | memoryview] = [
        len(encoded).to_bytes(8, "little"),
        len(compressed).to_bytes(8, "little"),
        compressed,
    ]
    _infra._append_aligned_buffers(parts, buffers, 16 + len(compressed))
    return b"".join(parts)


def _encode(messages: Sequence[Message]) -> tuple[bytes, list[memoryview]]:
    buffers: list[memoryview] = []
    encoded = msgspec.msgpack.encode(
        {
            "messages": tuple(message.as_serializable_dict(buffers) for message in messages),
            "timestampSec": time.perf_counter(),
            "binaryBufferLengths": tuple(each.nbytes for each in buffers),
        }
    )
    return encoded, buffers


def _can_be_encoded(message: Message) -> bool:
    try:
        _encode([message])
    except Exception as error:  # a value's own type may raise anything
        kind = type(message).__name__
        _log_failure(kind, f"a {kind} was left out, it can't be sent: %a", error)
        return False
    return True


def _log_failure(key: str, text: str, error: Exception) -> None:
    log_limited(_logger, logging.ERROR, key, text, f"{type(error).__name__}: {error!s:.200}")


def install_broadcaster(server: viser.ViserServer) -> bool:
    """Let a server pack messages for all pages once; return False if its viser is another version.

    This replaces viser's ``_message_producer`` for the whole process; servers without a broadcaster
    go on as before.
    """
    if viser.__version__ != VISER_VERSION:
        return False
    web = server._websock_server
    _let_broadcast(web.get_message_buffer())
    web.on_client_connect(_let_broadcast_to_one)
    if _infra._message_producer is _visers_producer:
        _infra._message_producer = _produce
    return True


def _let_broadcast(buffer: AsyncMessageBuffer) -> None:
    setattr(buffer, _BROADCASTER, Broadcaster(buffer))


async def _let_broadcast_to_one(connection: WebsockClientConnection) -> None:
    _let_broadcast(connection.get_message_buffer())


_visers_producer: Producer = _infra._message_producer


async def _produce(
    websocket: ServerConnection,
    buffer: AsyncMessageBuffer,
    client_id: int,
    backlog_done_message: Message | None = None,
) -> None:
    """Send a page the messages of a buffer, in place of viser's ``_message_producer``.

    A message that can't be packed is left out, also if it is for one page only: viser would close
    the page.
    """
    broadcaster: Broadcaster | None = getattr(buffer, _BROADCASTER, None)
    if broadcaster is None:
        await _visers_producer(websocket, buffer, client_id, backlog_done_message)
        return
    if not isinstance(buffer.message_event, LoopEvent):
        buffer.message_event = LoopEvent()
        buffer.message_event.set()
    stream: socket.socket = websocket.transport.get_extra_info("socket")
    stream.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, SEND_BUFFER_BYTES)
    await broadcaster.serve(websocket, client_id, backlog_done_message)

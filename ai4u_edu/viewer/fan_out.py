"""What all pages get is packed once, and not once for each of them.

viser lets every page gather, pack and compress the same messages anew. With a class that looks on
(measured: sixty pages) most of the processor's time goes into that. Here pages that are up to date
share one packing; a page that can't keep up skips what is outdated by then, and gets the newest.
"""

import asyncio
import time
from collections import defaultdict
from collections.abc import Awaitable, Callable, Sequence
from contextlib import suppress

import msgspec
import viser
import zstandard
from viser.infra import _infra
from viser.infra._async_message_buffer import AsyncMessageBuffer
from viser.infra._messages import Message
from websockets.asyncio.server import ServerConnection, broadcast

KNOWN = "1.1.1"
"""The viser whose insides this fits. Any other one goes on in its own way."""
PERIOD = 1 / 60
"""Seconds between two pictures at least."""
MOST = 0.4
"""The share of the time that may go into sending pictures: then there are fewer of them."""
CHUNK = 128
"""Messages in a frame for a page that has just come."""

_NAME = "_ai4u_edu_fan_out"
Producer = Callable[..., Awaitable[None]]


class FanOut:
    """Tells all pages of a server what is new. Belongs to viser's loop.

    Args:
        buffer: viser's, of the messages for all pages.
    """

    def __init__(self, buffer: AsyncMessageBuffer) -> None:
        self._buffer = buffer
        self._pages: dict[int, ServerConnection] = {}
        self._sending: asyncio.Task[None] | None = None

    async def serve(self, page: ServerConnection, number: int, replayed: Message | None) -> None:
        """One page: all that there is first, then what is new, until it is cancelled.

        Args:
            page: its connection.
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
            began = time.monotonic()
            is_done = self._send_news()
            spent = time.monotonic() - began
            with suppress(TimeoutError):
                await asyncio.wait_for(buffer.flush_event.wait(), max(PERIOD, spent / MOST))
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
            if page.transport.get_write_buffer_size():
                is_done = False
            else:
                lacking[cursors[number]].append(number)
        for since, numbers in lacking.items():
            messages = self._between(since, last)
            barred = {message.excluded_self_client for message in messages}
            self._tell([number for number in numbers if number not in barred], messages)
            for number in numbers:
                if number in barred:
                    self._tell([number], [m for m in messages if m.excluded_self_client != number])
                cursors[number] = last
        return is_done

    def _tell(self, numbers: Sequence[int], messages: Sequence[Message]) -> None:
        if numbers and messages:
            broadcast([self._pages[number] for number in numbers], packed(messages))

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
    """A frame as viser's page reads it (see viser's ``_message_producer``)."""
    buffers: list[memoryview] = []
    plain = msgspec.msgpack.encode(
        {
            "messages": tuple(message.as_serializable_dict(buffers) for message in messages),
            "timestampSec": time.perf_counter(),
            "binaryBufferLengths": tuple(each.nbytes for each in buffers),
        }
    )
    small = zstandard.ZstdCompressor(level=1).compress(plain)
    parts: list[bytes | memoryview] = [
        len(plain).to_bytes(8, "little"),
        len(small).to_bytes(8, "little"),
        small,
    ]
    _infra._append_aligned_buffers(parts, buffers, 16 + len(small))
    return b"".join(parts)


def fan_out(server: viser.ViserServer) -> bool:
    """Has a server pack once what all pages get; whether it can be done with this viser."""
    if viser.__version__ != KNOWN:
        return False
    buffer = server._websock_server._broadcast_buffer
    setattr(buffer, _NAME, FanOut(buffer))
    if _infra._message_producer is _viser_does:
        _infra._message_producer = _produce
    return True


_viser_does: Producer = _infra._message_producer


async def _produce(
    websocket: ServerConnection,
    buffer: AsyncMessageBuffer,
    client_id: int,
    backlog_done_message: Message | None = None,
) -> None:
    """In place of viser's function of that name; other buffers than ours go viser's way."""
    ours: FanOut | None = getattr(buffer, _NAME, None)
    if ours is None:
        await _viser_does(websocket, buffer, client_id, backlog_done_message)
    else:
        await ours.serve(websocket, client_id, backlog_done_message)

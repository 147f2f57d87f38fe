"""A connection for scripts that do other things meanwhile: the steps of a dialogue, awaited."""

import asyncio
from typing import Any, TypeVar

from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, WebSocketException
from websockets.protocol import State

from ai4u_edu.remote.address import Address
from ai4u_edu.remote.connection_options import OPTIONS, lost_by
from ai4u_edu.remote.limit import Limit
from ai4u_edu.remote.steps import Close, Flow, LineLost, Open, Pause, Receive, Send, Step

T = TypeVar("T")


class AsynchronousLine:
    """One WebSocket to a world, opened anew when a dialogue wants that."""

    def __init__(self, address: Address) -> None:
        self._address = address
        self._socket: ClientConnection | None = None
        self._limit: Limit

    async def run(self, flow: Flow[T]) -> T:
        """Carries out what a dialogue wants, and gives back what it comes to."""
        came: Any = None
        lost: LineLost | None = None
        while True:
            try:
                step = flow.throw(lost) if lost is not None else flow.send(came)
            except StopIteration as end:
                return end.value  # type: ignore[no-any-return]
            came = lost = None
            try:
                came = await self._carry_out(step)
            except LineLost as error:
                lost = error

    async def _carry_out(self, step: Step) -> Any:
        match step:
            case Receive(timeout):
                return await self._receive(timeout)
            case Send(frame):
                await self._send(frame)
            case Open(timeout):
                await self._close()
                await self._open(timeout)
            case Close():
                await self._close()
            case Pause(seconds):
                await asyncio.sleep(seconds)
        return None

    async def _open(self, timeout: float) -> None:
        self._limit = Limit()
        try:
            self._socket = await connect(
                self._address.url,
                open_timeout=timeout,
                proxy=None if self._address.is_loopback else True,
                **OPTIONS,
            )
        except (OSError, WebSocketException) as error:
            raise lost_by(error) from None

    async def _send(self, frame: bytes) -> None:
        socket = self._there
        try:
            if socket.state is State.OPEN and not socket.transport.get_write_buffer_size():
                # a small frame behind no other needs neither a lock nor flow control
                socket.protocol.send_binary(frame)
                socket.transport.write(b"".join(socket.protocol.data_to_send()))
            else:
                await socket.send(frame)
        except ConnectionClosed as closed:
            raise lost_by(closed) from None

    async def _receive(self, timeout: float) -> bytes | None:
        socket = self._there
        try:
            with self._limit.of(timeout):
                return await socket.recv(decode=False)
        except TimeoutError:
            return None
        except ConnectionClosed as closed:
            raise lost_by(closed) from None

    async def _close(self) -> None:
        if self._socket is not None:
            await self._socket.close()
            self._socket = None

    @property
    def _there(self) -> ClientConnection:
        if self._socket is None:
            raise LineLost("there is no connection")
        return self._socket

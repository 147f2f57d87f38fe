"""A WebSocket connection that can be awaited; carries out the steps of a dialogue."""

import asyncio
from typing import Any, TypeVar

from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, WebSocketException

from ai4u_edu.locale import gettext as _
from ai4u_edu.remote.address import Address
from ai4u_edu.remote.connection_options import (
    OPTIONS,
    authorization,
    connection_lost_from,
    log_note,
)
from ai4u_edu.remote.steps import (
    Close,
    ConnectionLostError,
    Delay,
    Flow,
    Note,
    Open,
    Receive,
    Send,
    Step,
)

T = TypeVar("T")


class AsyncConnection:
    """A WebSocket to a world; reconnects when a dialogue asks for it."""

    def __init__(self, address: Address) -> None:
        self._address = address
        self._socket: ClientConnection | None = None

    async def run(self, flow: Flow[T]) -> T:
        """Carry out a dialogue's steps one after another, and return its result."""
        result: Any = None
        error: ConnectionLostError | None = None
        while True:
            try:
                step = flow.throw(error) if error is not None else flow.send(result)
            except StopIteration as end:
                return end.value  # type: ignore[no-any-return]
            result = error = None
            try:
                result = await self._carry_out(step)
            except ConnectionLostError as lost:
                error = lost

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
            case Delay(seconds):
                await asyncio.sleep(seconds)
            case Note(text):
                log_note(text)
        return None

    async def _open(self, timeout: float) -> None:
        try:
            self._socket = await connect(
                self._address.url,
                open_timeout=timeout,
                additional_headers=authorization(self._address.token),
                proxy=None if self._address.is_loopback else True,
                **OPTIONS,
            )
        except (OSError, WebSocketException) as error:
            raise connection_lost_from(error) from None

    async def _send(self, frame: bytes) -> None:
        try:
            await self._connected.send(frame)
        except ConnectionClosed as closed:
            raise connection_lost_from(closed) from None

    async def _receive(self, timeout: float) -> bytes | None:
        try:
            async with asyncio.timeout(timeout):
                return await self._connected.recv(decode=False)
        except TimeoutError:
            return None
        except ConnectionClosed as closed:
            raise connection_lost_from(closed) from None

    async def _close(self) -> None:
        if self._socket is not None:
            await self._socket.close()
            self._socket = None

    @property
    def _connected(self) -> ClientConnection:
        if self._socket is None:
            raise ConnectionLostError(_("there is no connection"))
        return self._socket

"""A WebSocket connection that blocks while it waits; carries out the steps of a dialogue."""

import threading
import time
from collections.abc import Callable
from typing import Any, TypeVar

from websockets.exceptions import ConnectionClosed, WebSocketException
from websockets.sync.client import ClientConnection, connect

from ai4u_edu.locale import gettext as _
from ai4u_edu.remote.address import Address
from ai4u_edu.remote.connection_options import (
    OPTIONS,
    authorization,
    connection_lost_from,
    log_note,
)
from ai4u_edu.remote.errors import RemoteError
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
_WAITING_STEPS = (Open, Receive, Delay)


class ConnectionStoppedError(RemoteError):
    """Another thread asked to stop waiting for the world."""


class SyncConnection:
    """A WebSocket to a world; reconnects when a dialogue asks for it.

    While the script computes, threads of ``websockets`` answer the world's pings, and notice a lost
    connection.

    Args:
        address: of the world.
        stop: set by another thread to stop waiting. Then each step that waits raises a
            ConnectionStoppedError, at the latest after a second, since no step waits longer for a
            frame. Sending, such as of a goodbye, still works.
        tell: called with each note; default: notes are logged.
    """

    def __init__(
        self,
        address: Address,
        *,
        stop: threading.Event | None = None,
        tell: Callable[[str], object] = log_note,
    ) -> None:
        self._address = address
        self._tell = tell
        self._stop = stop
        self._socket: ClientConnection | None = None

    def run(self, flow: Flow[T]) -> T:
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
                result = self._carry_out(step)
            except ConnectionLostError as lost:
                error = lost

    def _carry_out(self, step: Step) -> Any:
        if isinstance(step, _WAITING_STEPS) and self._stop is not None and self._stop.is_set():
            raise ConnectionStoppedError(_("the bridge was stopped"))
        match step:
            case Receive(timeout):
                return self._receive(timeout)
            case Send(frame):
                self._send(frame)
            case Open(timeout):
                self._close()
                self._open(timeout)
            case Close():
                self._close()
            case Delay(seconds):
                time.sleep(seconds)
            case Note(text):
                self._tell(text)
        return None

    def _open(self, timeout: float) -> None:
        try:
            self._socket = connect(
                self._address.url,
                open_timeout=timeout,
                additional_headers=authorization(self._address.token),
                proxy=None if self._address.is_loopback else True,
                **OPTIONS,
            )
        except (OSError, WebSocketException) as error:
            raise connection_lost_from(error) from None

    def _send(self, frame: bytes) -> None:
        try:
            self._connected.send(frame)
        except ConnectionClosed as closed:
            raise connection_lost_from(closed) from None

    def _receive(self, timeout: float) -> bytes | None:
        try:
            return self._connected.recv(timeout, decode=False)
        except TimeoutError:
            return None
        except ConnectionClosed as closed:
            raise connection_lost_from(closed) from None

    def _close(self) -> None:
        if self._socket is not None:
            self._socket.close()
            self._socket = None

    @property
    def _connected(self) -> ClientConnection:
        if self._socket is None:
            raise ConnectionLostError(_("there is no connection"))
        return self._socket

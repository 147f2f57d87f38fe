"""A connection for scripts that wait: the steps of a dialogue, one after another."""

import threading
import time
from typing import Any, TypeVar, cast

from websockets.exceptions import ConnectionClosed, WebSocketException
from websockets.sync.client import connect

from ai4u_edu.remote.address import Address
from ai4u_edu.remote.connection_options import OPTIONS, lost_by
from ai4u_edu.remote.direct_socket import DirectSocket
from ai4u_edu.remote.errors import RemoteError
from ai4u_edu.remote.steps import Close, Flow, LineLost, Open, Pause, Receive, Send, Step

T = TypeVar("T")
_WAITING = (Open, Receive, Pause)


class NotWantedError(RemoteError):
    """Another thread wants nobody to wait for the world any more."""


class PlainLine:
    """One WebSocket to a world, opened anew when a dialogue wants that.

    Args:
        address: of the world.
        is_over: once another thread has set it, whoever waits gets a NotWantedError; within
            a second, since no step of a dialogue waits longer for a frame. Saying goodbye still
            works.
    """

    def __init__(self, address: Address, *, is_over: threading.Event | None = None) -> None:
        self._address = address
        self._is_over = is_over
        self._socket: DirectSocket | None = None

    def run(self, flow: Flow[T]) -> T:
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
                came = self._carry_out(step)
            except LineLost as error:
                lost = error

    def _carry_out(self, step: Step) -> Any:
        if isinstance(step, _WAITING) and self._is_over is not None and self._is_over.is_set():
            raise NotWantedError("the bridge was stopped")
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
            case Pause(seconds):
                time.sleep(seconds)
        return None

    def _open(self, timeout: float) -> None:
        ours: Any = DirectSocket  # has what connect() calls, and no more of websockets' own
        try:
            self._socket = cast(
                "DirectSocket",
                connect(
                    self._address.url,
                    open_timeout=timeout,
                    proxy=None if self._address.is_loopback else True,
                    create_connection=ours,
                    **OPTIONS,
                ),
            )
        except (OSError, WebSocketException) as error:
            raise lost_by(error) from None

    def _send(self, frame: bytes) -> None:
        try:
            self._there.send(frame)
        except ConnectionClosed as closed:
            raise lost_by(closed) from None

    def _receive(self, timeout: float) -> bytes | None:
        try:
            return self._there.recv(timeout)
        except TimeoutError:
            return None
        except ConnectionClosed as closed:
            raise lost_by(closed) from None

    def _close(self) -> None:
        if self._socket is not None:
            self._socket.close()
            self._socket = None

    @property
    def _there(self) -> DirectSocket:
        if self._socket is None:
            raise LineLost("there is no connection")
        return self._socket

"""The connection of a room, or a notebook, with its class."""

import logging
import socket
import struct
import sys
import time
from collections.abc import Callable
from contextlib import suppress
from threading import Condition, Thread, current_thread
from typing import Any, Literal
from urllib.parse import urlsplit

from websockets.exceptions import ConnectionClosed, InvalidStatus, WebSocketException
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Subprotocol

from ai4u_edu.locale import gettext as _
from ai4u_edu.member.dialogue import LinkDialogue, LinkPhase, PresentState
from ai4u_edu.member.link import LinkTimeouts
from ai4u_edu.member.outbox import ResultOutbox
from ai4u_edu.wire.class_link import (
    MAX_FRAME_BYTES,
    PATH,
    SUBPROTOCOL,
    VERSION,
    Delivery,
    FromClass,
    LinkHello,
)

_logger = logging.getLogger("ai4u_edu.member")
_silent = logging.getLogger("ai4u_edu.member.websockets")
_silent.setLevel(logging.CRITICAL + 1)  # a lost connection is normal

_OPTIONS: dict[str, Any] = {
    "subprotocols": [Subprotocol(SUBPROTOCOL)],
    "compression": None,
    "max_size": MAX_FRAME_BYTES,
    "proxy": None,
    "logger": _silent,
}


class LinkClient:
    """A link that is kept: it reconnects until it is stopped, or the class ends it.

    Two threads belong to it: one connects and sends, the other one receives and calls ``receive``.
    All methods are thread-safe, and may be called by ``receive``. Only :meth:`stop` waits for the
    network.

    Args:
        url: address of the class, such as ``http://teacher:8080/``.
        secret: token of the room, or of the seat.
        kind: ``room``, or ``notebook`` for one that may have no world.
        receive: called for each message except :class:`~ai4u_edu.wire.class_link.Ack`, one after
            the other, in a thread of the client.
        outbox: for results; default: they are kept in memory only.
        timeouts: of the connection, and of the class's answers.
    """

    def __init__(
        self,
        url: str,
        secret: str,
        kind: Literal["room", "notebook"],
        receive: Callable[[FromClass], object],
        outbox: ResultOutbox | None = None,
        timeouts: LinkTimeouts | None = None,
    ) -> None:
        self.outbox = ResultOutbox() if outbox is None else outbox
        self._timeouts = timeouts or LinkTimeouts()
        self._url = url.rstrip("/") + PATH
        self._receive = receive
        hello = LinkHello(VERSION, secret, kind)
        self._dialogue = LinkDialogue(hello, self.outbox, timeouts=self._timeouts)
        self._changed = Condition()
        """Guards the dialogue and the attributes below; notified when there is something to do."""
        self._stop_at: float | None = None
        self._is_stopped = False
        """Nothing is delivered any more."""
        self._is_delivering = False
        self._closed: ConnectionClosed | None = None
        """Why the present connection has ended; None while it is open."""
        self._thread = Thread(target=self._run, name="class-link", daemon=True)
        self._reader: Thread | None = None

    @property
    def is_connected(self) -> bool:
        """True while the class has accepted the link."""
        return self._dialogue.phase is LinkPhase.LINKED

    @property
    def is_over(self) -> bool:
        """True after the class has ended the link; :attr:`problem` says why."""
        return self._dialogue.phase is LinkPhase.OVER

    @property
    def problem(self) -> str:
        """Sentence on why there is no link, or what went wrong last; empty if all is well."""
        return self._dialogue.problem or self.outbox.problem

    def start(self) -> None:
        """Connect, in the background."""
        self._thread.start()

    def stop(self, timeout_s: float = 2.0) -> None:
        """End the link; if there is a connection, send first what was not sent.

        No message is delivered after it has returned.

        Args:
            timeout_s: longest time (s) to wait for results to be acknowledged, and then for
                ``receive`` to return.
        """
        with self._changed:
            self._stop_at = time.monotonic() + timeout_s
            self._changed.notify_all()
        own = (self._thread, self._reader)
        if self._thread.is_alive() and current_thread() not in own:
            self._thread.join(timeout_s + 2 * self._timeouts.close)
        with self._changed:
            self._is_stopped = True
            if current_thread() not in own:
                self._changed.wait_for(lambda: not self._is_delivering, timeout_s)

    def renew(self) -> None:
        """Connect again if the class has ended the link, such as for another program's."""
        with self._changed:
            self._dialogue.renew(time.monotonic())
            self._changed.notify_all()

    def send(self, message: PresentState) -> None:
        """Send a present state: the latest message of its kind replaces one that was not sent.

        After a reconnect the latest one of each kind is sent again.
        """
        with self._changed:
            self._dialogue.set(message)
            self._changed.notify_all()

    def clear(self) -> None:
        """Forget all present states, since what they described is gone; results stay."""
        with self._changed:
            self._dialogue.clear()

    def send_result(self, result: Delivery) -> None:
        """Deliver a result, now or as soon as there is a connection, until it is acknowledged.

        If the outbox has a folder this waits for the disk, so don't call it in a world's thread.
        """
        self.outbox.add(result)
        with self._changed:
            self._changed.notify_all()

    # -- the thread that connects and sends ------------------------------------------------------

    def _run(self) -> None:
        while self._wait_for_attempt():
            try:
                connection = self._open()
            except (OSError, WebSocketException, ValueError) as error:
                self._lose(_reason(error))
                continue
            try:
                self._converse(connection)
            except ConnectionClosed as closed:
                self._lose(*_close_of(closed))
            finally:
                connection.close()
                if self._reader is not None:  # one connection's messages after the other's
                    self._reader.join()
        with self._changed:
            self._dialogue.stop()

    def _wait_for_attempt(self) -> bool:
        """Wait until the next attempt is due; return False when the client is stopped."""
        with self._changed:
            while self._stop_at is None:
                wait_s = self._dialogue.wait_s(time.monotonic())
                if wait_s == 0.0:
                    self._dialogue.open()
                    return True
                self._changed.wait(wait_s)
            return False

    def _open(self) -> ClientConnection:
        """Open a connection.

        Raises:
            OSError: nobody listens there, or does not answer in time.
            WebSocketException: whoever listens there is no class.
        """
        address = urlsplit(self._url)
        is_safe = address.scheme == "https"
        port = address.port or (443 if is_safe else 80)
        limits = self._timeouts
        raw = socket.create_connection((address.hostname or "", port), limits.open)
        try:
            raw.settimeout(None)  # a link may be silent; pings tell whether it is alive
            _set_send_timeout(raw, limits.send)
            connection = connect(
                self._url.replace("http", "ws", 1),
                sock=raw,
                open_timeout=limits.open,
                ping_interval=limits.ping,
                ping_timeout=limits.pong,
                close_timeout=limits.close,
                **_OPTIONS,
            )
        except BaseException:
            raw.close()
            raise
        if connection.subprotocol != SUBPROTOCOL:
            connection.close()
            raise WebSocketException(
                _("it does not speak this version's protocol; update AI4U Edu")
            )
        return connection

    def _converse(self, connection: ClientConnection) -> None:
        """Send until the connection is lost or the link is to end.

        Raises:
            ConnectionClosed: it is lost.
        """
        with self._changed:
            self._closed = None
            hello = self._dialogue.opened(time.monotonic())
        connection.send(hello)
        self._reader = Thread(
            target=self._read, args=(connection,), name="class-link-reader", daemon=True
        )
        self._reader.start()
        while (frame := self._next_frame()) is not None:
            connection.send(frame)
        with self._changed:
            if self._closed is not None:
                raise self._closed
            if self._dialogue.is_overdue(time.monotonic()):
                self._dialogue.lost(time.monotonic(), _("it does not answer"))

    def _next_frame(self) -> bytes | None:
        """Wait for a frame to send; return None when the connection should be closed."""
        with self._changed:
            while self._closed is None and self._dialogue.phase is not LinkPhase.OVER:
                now = time.monotonic()
                frame = self._dialogue.next_frame(now)
                if frame is not None:
                    return frame
                wait_s = self._dialogue.wait_s(now)
                if self._stop_at is not None:
                    is_done = self.is_connected and not len(self.outbox)
                    if is_done or now >= self._stop_at:
                        return None
                    wait_s = min(self._stop_at - now, wait_s or self._stop_at)
                if self._dialogue.is_overdue(now):
                    return None
                self._changed.wait(wait_s)
            return None

    def _lose(self, why: str, code: int = 0) -> None:
        with self._changed:
            self._dialogue.lost(time.monotonic(), why, code)

    # -- the thread that receives ----------------------------------------------------------------

    def _read(self, connection: ClientConnection) -> None:
        try:
            while True:
                frame = connection.recv(decode=False)
                with self._changed:
                    message = self._dialogue.receive(frame)
                    self._changed.notify_all()
                if message is not None:
                    self._tell(message)
        except ConnectionClosed as closed:
            with self._changed:
                self._closed = closed
                self._changed.notify_all()

    def _tell(self, message: FromClass) -> None:
        with self._changed:
            if self._is_stopped:
                return
            self._is_delivering = True
        try:
            self._receive(message)
        except Exception:
            _logger.exception("a message of the class could not be handled")
        finally:
            with self._changed:
                self._is_delivering = False
                self._changed.notify_all()


def _set_send_timeout(raw: socket.socket, timeout_s: float) -> None:
    """Let sending fail when the network is gone; a ping would have to wait behind what is sent."""
    is_windows, ms = sys.platform == "win32", round(1000 * timeout_s)
    value = struct.pack("L", ms) if is_windows else struct.pack("ll", ms // 1000, ms % 1000 * 1000)
    with suppress(OSError):  # the system's own timeout stays
        raw.setsockopt(socket.SOL_SOCKET, socket.SO_SNDTIMEO, value)


def _reason(error: Exception) -> str:
    if isinstance(error, InvalidStatus):
        return f"answer {error.response.status_code}"
    if isinstance(error, OSError) and error.strerror:
        return error.strerror
    return str(error) or type(error).__name__


def _close_of(closed: ConnectionClosed) -> tuple[str, int]:
    if closed.rcvd is None:
        return _("the connection was lost"), 0
    return closed.rcvd.reason or _(
        "closed with code {code}", code=closed.rcvd.code
    ), closed.rcvd.code

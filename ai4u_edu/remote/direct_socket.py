"""A WebSocket that the script's own thread reads and writes.

websockets' own connection has a thread that reads, and hands over what came. On one machine that
takes a quarter of a round trip's time. Here the same ``connect`` opens the line, and the same
Sans-I/O protocol makes and reads frames; only who waits for the socket is another.
"""

import socket
import weakref
from contextlib import suppress
from threading import Lock
from time import monotonic

from websockets.client import ClientProtocol
from websockets.datastructures import HeadersLike
from websockets.exceptions import ConnectionClosed
from websockets.frames import CloseCode
from websockets.protocol import State

from ai4u_edu.remote.channel import Channel
from ai4u_edu.remote.keepalive import Watch
from ai4u_edu.remote.readiness import is_readable

_FRESH = 0.0005
"""Seconds after a message in which nobody looks for a close before saying something: as long as a
script takes that answers at once. One that thinks has the time to look."""


class DirectSocket:
    """What ``websockets.sync.client.connect(..., create_connection=DirectSocket)`` gives.

    Args:
        sock: connected, and TLS begun where the address wants it.
        protocol: makes frames of bytes and bytes of frames.
        ping_interval: seconds from one ping to the next.
        ping_timeout: seconds after which an end that answers no ping, or takes no bytes, is gone.
        close_timeout: seconds that closing may take.
        max_queue: messages that may wait while nobody reads; then they wait at the other end.
    """

    def __init__(
        self,
        sock: socket.socket,
        protocol: ClientProtocol,
        *,
        ping_interval: float,
        ping_timeout: float,
        close_timeout: float,
        max_queue: int,
    ) -> None:
        self.socket = sock
        self._protocol = protocol
        self._channel = Channel(sock, protocol, patience=ping_timeout)
        self._speaking = self._channel.lock
        self._inbox = self._channel.inbox
        self._most = max_queue
        self._close_timeout = close_timeout
        self._reading = Lock()
        """Whoever waits for the socket holds it; only then may the socket be closed."""
        self._fresh_until = 0.0
        self._is_tls = type(sock) is not socket.socket
        weakref.finalize(self, sock.close).atexit = False
        self.recv_events_thread = Watch(self, self._channel, ping_interval, ping_timeout)
        """Named as websockets' own: ``connect`` waits for its end if the handshake fails."""
        self.recv_events_thread.start()

    def handshake(
        self, headers: HeadersLike | None, user_agent: str | None, timeout: float
    ) -> None:
        """Asks for a WebSocket, and waits until there is one; ``connect`` calls it."""
        until = monotonic() + timeout
        with self._speaking:
            request = self._protocol.connect()
            request.headers.update(headers or {})
            if user_agent is not None:
                request.headers.setdefault("User-Agent", user_agent)
            self._protocol.send_request(request)
            self._channel.flush()
        with self._reading:
            while self._protocol.state is State.CONNECTING and not self._protocol.handshake_exc:
                if not self._await_more(until - monotonic()):
                    raise TimeoutError("expected an answer to the handshake, got none in time")
        if self._protocol.handshake_exc is not None:
            raise self._protocol.handshake_exc

    def start_keepalive(self) -> None:
        """Does nothing: the watch is there from the beginning; ``connect`` calls it."""

    def send(self, message: bytes) -> None:
        """Sends a binary message, from any thread.

        Raises:
            ConnectionClosed: the connection is over, or the other end takes nothing any more.
        """
        if monotonic() > self._fresh_until:
            self.catch_up()  # a close may have come while the script thought
        with self._speaking:
            if self._protocol.state is State.OPEN:
                self._protocol.send_binary(message)
                if self._channel.flush():
                    return
                while len(self._inbox) < self._most and self._channel.take_in():
                    pass  # a close that came before says why
            self._channel.end()
            raise self._protocol.close_exc

    def recv(self, timeout: float) -> bytes:
        """The next message, binary or text.

        Raises:
            TimeoutError: there was none for so many seconds.
            ConnectionClosed: the connection is over.
        """
        until = monotonic() + timeout
        if not self._reading.acquire(timeout=max(timeout, 0.0)):
            raise TimeoutError
        try:
            while not self._inbox:
                if self._protocol.state is State.CLOSED:
                    raise self._protocol.close_exc
                if not self._await_more(until - monotonic()):
                    raise TimeoutError
            self._fresh_until = monotonic() + _FRESH
            return self._inbox.popleft()
        finally:
            self._reading.release()

    def close(self) -> None:
        """Says goodbye, and waits a moment for the other end to do so too. Twice is fine."""
        until = monotonic() + self._close_timeout
        with self._speaking:
            if self._protocol.state is State.OPEN:
                self._channel.is_closing, self._channel.patience = True, self._close_timeout
                self._protocol.send_close(CloseCode.NORMAL_CLOSURE)
                if not self._channel.flush():
                    self._channel.end()
        with suppress(ConnectionClosed, TimeoutError):
            while (left := until - monotonic()) > 0:
                self.recv(left)
        self.close_socket()
        self.recv_events_thread.join()

    def close_socket(self) -> None:
        """Ends the connection without a farewell."""
        with self._speaking:
            self._channel.end()
        with self._reading:
            self.socket.close()

    def catch_up(self) -> bool:
        """Takes in what came while nobody read; whether there is nothing left to take in."""
        if not self._reading.acquire(blocking=False):
            return True  # somebody does read
        try:
            while len(self._inbox) < self._most:
                if not self._listen():
                    return True
            return False
        finally:
            self._reading.release()

    def _await_more(self, within: float) -> bool:
        """Waits until something comes, and takes it in; whether anything came. Wants _reading."""
        if self._is_tls and self._listen():
            return True  # of what TLS has unwrapped already, no poll knows
        if not is_readable(self.socket, within):
            return False
        self._listen()
        return True

    def _listen(self) -> bool:
        with self._speaking:
            return self._channel.take_in()

"""A socket that never waits, and the WebSocket protocol that is spoken over it."""

import socket
from collections import deque
from contextlib import suppress
from ssl import SSLWantReadError, SSLWantWriteError
from threading import Event, Lock
from time import monotonic

from websockets.client import ClientProtocol
from websockets.frames import Frame, Opcode
from websockets.protocol import State

from ai4u_edu.remote.readiness import is_writable

_AT_ONCE = 2**16
_NOT_NOW = (BlockingIOError, SSLWantReadError, SSLWantWriteError)
_MESSAGES = (Opcode.BINARY, Opcode.TEXT, Opcode.CONT)


class Channel:
    """Frames out, messages in; every method wants :attr:`lock` to be held.

    Args:
        sock: connected, and TLS begun where the address wants it.
        protocol: makes frames of bytes and bytes of frames.
        patience: seconds after which an end that takes no bytes is gone.
    """

    def __init__(self, sock: socket.socket, protocol: ClientProtocol, patience: float) -> None:
        sock.setblocking(False)
        self.socket = sock
        self.protocol = protocol
        self.patience = patience
        self.lock = Lock()
        """Never held while nothing comes."""
        self.inbox: deque[bytes] = deque()
        """Messages, binary and text, that came and wait."""
        self.over = Event()
        """Set at the end; then :attr:`protocol` knows why."""
        self.is_closing = False
        """Whether this end said goodbye first."""
        self.waits_for_pong = False
        self._parts: list[bytes | bytearray | memoryview] = []

    def take_in(self) -> bool:
        """Takes in what has come, and answers what wants an answer; whether anything had come."""
        if self.protocol.state is State.CLOSED:
            return False
        try:
            try:
                data = self.socket.recv(_AT_ONCE)
            except _NOT_NOW:
                return False
            except OSError:
                data = b""
            if data:
                self._hear(data)
            # who said goodbye first waits until the other end hangs up
            is_over = not data or (self.protocol.close_expected() and not self.is_closing)
            if not self.flush() or is_over:
                self.end()
        except BaseException:  # such as Ctrl-C: what was half taken in can't go on
            self.end()
            raise
        return True

    def flush(self) -> bool:
        """Writes what the protocol has to say; whether that went well."""
        try:
            for data in self.protocol.data_to_send():
                self._write(data)
        except OSError:
            return False
        except BaseException:  # such as Ctrl-C: a frame may have gone in part
            self.end()
            raise
        return True

    def end(self) -> None:
        """Ends the connection as it is; the socket remains to be closed."""
        if not self.over.is_set():
            self.over.set()
            with suppress(OSError):
                self.socket.shutdown(socket.SHUT_RDWR)  # wakes up whoever waits for it
            self.protocol.receive_eof()

    def _hear(self, data: bytes) -> None:
        self.protocol.receive_data(data)
        for event in self.protocol.events_received():
            if not isinstance(event, Frame):
                continue  # the handshake's answer
            if event.opcode in _MESSAGES:
                self._parts.append(event.data)
                if event.fin:
                    self.inbox.append(b"".join(self._parts))
                    self._parts.clear()
            elif event.opcode is Opcode.PONG:
                self.waits_for_pong = False

    def _write(self, data: bytes) -> None:
        until = 0.0
        while data:  # none would mean to close the socket's half, and soon all of it is closed
            try:
                data = data[self.socket.send(data) :]
            except _NOT_NOW:
                until = until or monotonic() + self.patience
                if not is_writable(self.socket, until - monotonic()):
                    raise TimeoutError from None

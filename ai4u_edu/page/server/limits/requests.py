"""uvicorn's HTTP protocol with timeouts.

uvicorn itself waits without a limit for a request's head and body, and for a client that does not
read its answer. See ``docs/adr/0003-limits-of-connections.md``.
"""

import asyncio
import sys
from collections.abc import Callable
from http import HTTPStatus
from typing import cast

import h11
import uvicorn
from uvicorn.protocols.http.h11_impl import H11Protocol

from ai4u_edu.locale import gettext as _
from ai4u_edu.page.server.limits.connections import Connections
from ai4u_edu.page.server.limits.plain_response import plain_response
from ai4u_edu.page.server.limits.timeouts import DEFAULT_TIMEOUTS, Timeouts

PART_BYTES = 4096
"""Bytes of a head that are parsed at a time, until it is complete."""


class ServerConfig(uvicorn.Config):
    """uvicorn's configuration, by which the protocols reach what belongs to the server."""

    connections: Connections | None = None
    timeouts = DEFAULT_TIMEOUTS


class RequestProtocol(H11Protocol):
    """uvicorn's protocol with time limits for requests and answers."""

    _deadline: asyncio.TimerHandle | None = None
    _stall: asyncio.TimerHandle | None = None
    _has_begun = False  # True once a byte of the next request has come
    _is_ending = False
    _unread = 0

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Start the timeout of the first request."""
        super().connection_made(cast(asyncio.Transport, transport))
        if self._connections is not None and self._connections.is_closing:
            # uvicorn has closed the others already, and would wait for this one in vain
            self.transport.abort()
            return
        self._wait_for_request()

    def data_received(self, data: bytes) -> None:
        """Parse the next bytes; a head's timeout starts with its first byte."""
        if self.is_ending():
            return
        if not self._has_begun:
            self._has_begun = True
            self._restart_deadline()
        before = self.conn.their_state
        while data and not self.is_ending() and self.conn.their_state is h11.IDLE:
            # h11 limits the size of incomplete heads only; one that comes whole would pass
            super().data_received(data[:PART_BYTES])
            data = data[PART_BYTES:]
        if self.is_ending():
            return
        if data and self.transport.get_protocol() is self:
            super().data_received(data)
        state = self.conn.their_state
        if self.transport.get_protocol() is not self or state not in (h11.IDLE, h11.SEND_BODY):
            self._stop_waiting()
        elif state is h11.SEND_BODY and before is h11.IDLE:
            self._restart_deadline()

    def on_response_complete(self) -> None:
        """Start the next request's timeout; it may have come already."""
        super().on_response_complete()
        if self.transport.is_closing():
            self._watch_reader()
        elif self.conn.their_state is h11.IDLE:
            self._wait_for_request()
        elif self.conn.their_state is h11.SEND_BODY and self._deadline is None:
            self._restart_deadline()

    def connection_lost(self, exc: Exception | None) -> None:
        """Cancel the timers."""
        for timer in (self._deadline, self._stall):
            if timer is not None:
                timer.cancel()
        self._deadline = self._stall = None
        super().connection_lost(exc)

    def send_400_response(self, msg: str) -> None:
        """Answer a malformed request; one that is too long gets its own status."""
        error = sys.exception()  # uvicorn calls this in an except clause
        hint = error.error_status_hint if isinstance(error, h11.RemoteProtocolError) else 400
        if hint == HTTPStatus.REQUEST_HEADER_FIELDS_TOO_LARGE:
            msg = _("expected a request whose address and headers are shorter, such as its cookies")
        self.end(plain_response(hint, msg))

    def shutdown(self) -> None:
        """Close the connection with the server, whatever its state."""
        if self.is_ending():
            self.transport.abort()
            return
        try:
            super().shutdown()
        except h11.LocalProtocolError:
            self.transport.abort()

    def is_ending(self) -> bool:
        """Return True once the connection's last answer is on its way."""
        return self._is_ending

    def pause_writing(self) -> None:
        """Start to check that the other side reads; meanwhile another one may have its place."""
        super().pause_writing()
        self._set_idle(True)
        self._watch_reader()

    def resume_writing(self) -> None:
        """Go on with an answer that the other side reads."""
        super().resume_writing()
        if self._deadline is None:  # else it waits for a request
            self._set_idle(False)

    def end(self, answer: bytes = b"") -> None:
        """Close the connection with an answer, and give the other side time to read it."""
        self._is_ending = True
        if self.cycle is not None:  # its app may still be running
            self.cycle.disconnected = True
            self.cycle.message_event.set()
        self._set_idle(True)
        self.transport.write(answer)
        if not self.transport.can_write_eof():
            self.transport.close()
            return
        # closing a socket with unread bytes resets it, and the answer would be lost
        self.transport.write_eof()
        self._set_deadline(self._timeouts.linger, self.transport.abort)

    def _wait_for_request(self) -> None:
        self._has_begun = bool(self.conn.trailing_data[0])
        self._set_idle(True)
        self._restart_deadline()

    def _restart_deadline(self) -> None:
        self._set_deadline(self._timeouts.request, self._time_out)

    def _stop_waiting(self) -> None:
        self._set_idle(False)
        if self._deadline is not None:
            self._deadline.cancel()
            self._deadline = None

    def _set_deadline(self, seconds: float, end: Callable[[], object]) -> None:
        if self._deadline is not None:
            self._deadline.cancel()
        self._deadline = self.loop.call_later(seconds, end)

    def _time_out(self) -> None:
        self._deadline = None
        if self.transport.is_closing():
            self._watch_reader()
        elif self.transport.get_write_buffer_size():  # it still reads the answer before
            self._watch_reader()
            self._restart_deadline()
        elif not self._has_begun:
            self.transport.close()
        elif self.conn.their_state is h11.SEND_BODY and self.cycle.response_started:
            self.transport.abort()  # it was answered without its body
        else:
            expected = _(
                "expected the whole request within {seconds} s",
                seconds=f"{self._timeouts.request:g}",
            )
            self.end(plain_response(HTTPStatus.REQUEST_TIMEOUT, expected))

    def _watch_reader(self) -> None:
        if self._stall is None and self.transport.get_write_buffer_size():
            self._unread = self.transport.get_write_buffer_size()
            self._stall = self.loop.call_later(self._timeouts.stall, self._look_at_reader)

    def _look_at_reader(self) -> None:
        self._stall = None
        unread = self.transport.get_write_buffer_size()
        if unread and unread >= self._unread:
            self.transport.abort()
        elif unread:
            self._watch_reader()

    def _set_idle(self, idle: bool) -> None:
        if self._connections is not None:
            self._connections.set_idle(self.transport, idle)

    @property
    def _timeouts(self) -> Timeouts:
        return cast(ServerConfig, self.config).timeouts

    @property
    def _connections(self) -> Connections | None:
        return cast(ServerConfig, self.config).connections

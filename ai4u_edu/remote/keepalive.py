"""Who looks after a connection while its script thinks."""

import weakref
from threading import Thread
from typing import Protocol

from websockets.frames import CloseCode
from websockets.protocol import State

from ai4u_edu.remote.channel import Channel


class Watched(Protocol):
    """A connection that is read from now and then."""

    def catch_up(self) -> bool:
        """Takes in what came while nobody read; whether there is nothing left to take in."""

    def close_socket(self) -> None:
        """Ends the connection."""


class Watch(Thread):
    """A thread that answers pings, sends some, and notices the end.

    It ends with the connection, or when nobody has that any more.

    Args:
        watched: the connection.
        channel: what it speaks over.
        interval: seconds from one ping to the next.
        timeout: seconds after which an end that answers no ping is gone.
    """

    def __init__(self, watched: Watched, channel: Channel, interval: float, timeout: float) -> None:
        super().__init__(name="watch", daemon=True)
        self._watched = weakref.ref(watched)
        self._channel = channel
        self._turn = interval / 2
        # counted in turns: a process that stood still has not waited for an answer all that time
        self._ping_after, self._lost_after = 2.0, timeout / self._turn
        self._turns = 0

    def run(self) -> None:
        """Takes turns."""
        while not self._channel.over.wait(self._turn):
            watched = self._watched()
            if watched is None:
                return
            if watched.catch_up():  # else a pong may wait behind the messages
                self._ping()
            del watched  # while it waits, it holds on to nothing
        watched = self._watched()
        if watched is not None:
            watched.close_socket()

    def _ping(self) -> None:
        channel = self._channel
        with channel.lock:
            if channel.protocol.state is not State.OPEN:
                return
            self._turns += 1
            if not channel.waits_for_pong and self._turns >= self._ping_after:
                self._turns, channel.waits_for_pong = 0, True
                channel.protocol.send_ping(b"")
                if not channel.flush():
                    channel.end()
            elif channel.waits_for_pong and self._turns >= self._lost_after:
                channel.patience = 0.0
                channel.protocol.fail(CloseCode.INTERNAL_ERROR, "keepalive ping timeout")
                channel.flush()
                channel.end()

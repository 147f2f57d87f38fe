"""A thread that talks to a script, so that the world does not wait for the network."""

import threading
import time
from collections.abc import Callable

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.blocks.brains.links.link import Observation, Reply, ResetRequest

POLL_S = 0.05
"""Interval at which the thread looks for a newer observation, and for its end."""


class LinkThread:
    """A thread that talks to a script, and a mailbox between it and the runner's thread.

    The mailbox holds one observation and one answer. The runner's thread calls ``put``,
    ``exchange`` and ``close``; the thread itself calls ``talk``. A condition guards both.

    Args:
        talk: continues the dialogue until a deadline (s, of the clock) or an answer.
        name: of the thread.
        clock: seconds.
    """

    def __init__(
        self,
        talk: Callable[[Observation | None, float], Reply | None],
        name: str,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._talk = talk
        self._clock = clock
        self._changed = threading.Condition()
        self._latest: Observation | None = None
        self._reply: Reply | None = None
        self._answered_number = 0
        """Number of the observation that was answered last; the next one has a higher number."""
        self._is_closing = False
        self._error: AI4UError | None = None
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    def put(self, observation: Observation) -> None:
        """Replace the observation in the mailbox."""
        with self._changed:
            self._latest = observation
            self._changed.notify_all()

    def exchange(self, observation: Observation, timeout: float) -> Reply | None:
        """Replace the observation, and take the answer if there is one within the timeout (s).

        Raises:
            AI4UError: the dialogue raised it, for example for an observation that can't be sent.
        """
        with self._changed:
            self._latest = observation
            self._changed.notify_all()
            if timeout and self._reply is None:
                self._changed.wait_for(lambda: self._reply is not None, timeout)
            if self._error is not None:
                raise self._error
            reply, self._reply = self._reply, None
            if reply is not None and isinstance(reply.answer, ResetRequest):
                self._latest = None  # of the episode that ends: the script waits for another one
        return reply

    def close(self) -> None:
        """End the thread, and wait until it has ended."""
        self.end()
        self._thread.join()

    def end(self) -> None:
        """End the thread soon."""
        with self._changed:
            self._is_closing = True
            self._changed.notify_all()

    def _run(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(self._has_work)
                if self._is_closing:
                    return
                observation = self._latest
            try:
                reply = self._talk(observation, self._clock() + POLL_S)
            except AI4UError as error:
                self._error = error
                return
            if reply is not None:
                with self._changed:
                    self._reply = reply
                    if observation is not None:
                        self._answered_number = observation.number
                    self._changed.notify_all()

    def _has_work(self) -> bool:
        """Return True if there is an observation to send, or the thread has to end."""
        is_new = self._latest is not None and self._latest.number > self._answered_number
        return self._is_closing or (is_new and self._reply is None)

"""A conversation that nobody waits for: a thread has it."""

import threading
import time
from collections.abc import Callable

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.blocks.brains.links.link import Answered, Reset, Situation

TURN = 0.05
"""Seconds after which the thread looks whether there is a newer situation, or an end."""


class Desk:
    """Where the thread that talks and the one that runs the world hand things over.

    Args:
        talk: goes on with the conversation until a time (time.monotonic) or an answer.
        name: of the thread.
    """

    def __init__(
        self, talk: Callable[[Situation | None, float], Answered | None], name: str
    ) -> None:
        self._talk = talk
        self._news = threading.Condition()
        self._latest: Situation | None = None
        self._answered: Answered | None = None
        self._number = 0
        """Of the situation that was answered last: the next one has a higher one."""
        self._closing = False
        self._error: AI4UError | None = None
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    def leave(self, situation: Situation) -> None:
        """Leaves the latest situation."""
        with self._news:
            self._latest = situation
            self._news.notify_all()

    def exchange(self, situation: Situation, timeout: float) -> Answered | None:
        """Leaves the latest situation, takes the answer that lies there.

        Raises:
            AI4UError: what the conversation raised, such as a situation that can't be sent.
        """
        with self._news:
            self._latest = situation
            self._news.notify_all()
            if timeout and self._answered is None:
                self._news.wait_for(lambda: self._answered is not None, timeout)
            if self._error is not None:
                raise self._error
            answered, self._answered = self._answered, None
            if answered is not None and isinstance(answered.answer, Reset):
                self._latest = None  # of the episode that ends: the script waits for another one
        return answered

    def close(self) -> None:
        """Ends the thread."""
        with self._news:
            self._closing = True
            self._news.notify_all()
        self._thread.join()

    def _run(self) -> None:
        while True:
            with self._news:
                self._news.wait_for(self._due)
                if self._closing:
                    return
                situation = self._latest
            try:
                answered = self._talk(situation, time.monotonic() + TURN)
            except AI4UError as error:
                self._error = error
                return
            if answered is not None:
                with self._news:
                    self._answered = answered
                    self._number = situation.number if situation else self._number
                    self._news.notify_all()

    def _due(self) -> bool:
        """Whether there is something to tell."""
        news = self._latest is not None and self._latest.number > self._number
        return self._closing or (news and self._answered is None)

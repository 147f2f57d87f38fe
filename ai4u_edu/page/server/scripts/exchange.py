"""The exchange of percepts and answers with one script, as a state machine."""

from collections import deque
from collections.abc import Mapping
from enum import Enum, auto
from threading import Lock

from ai4u_edu.blocks.brains.links.link import Observation, Reply, ResetRequest


class Turn(Enum):
    """States of an exchange."""

    IDLE = auto()
    """No percept waits for an answer."""
    ASKED = auto()
    """The script owes an answer to the latest percept."""
    ANSWERED = auto()
    """The script's answer to the latest percept waits for the brain."""
    RESETTING = auto()
    """The script has answered with a reset, which waits for the brain. No percept is sent: one of
    the episode that ends would make the script ask for another reset."""


_NEXT = {
    Turn.IDLE: {Turn.ASKED},
    Turn.ASKED: {Turn.ASKED, Turn.ANSWERED, Turn.RESETTING, Turn.IDLE},
    Turn.ANSWERED: {Turn.ASKED, Turn.IDLE},
    Turn.RESETTING: {Turn.IDLE},
}
"""Transitions that are allowed."""


class Exchange:
    """The latest percept of a script, and its answers that the brain has not taken yet.

    The runner's thread asks and takes answers; the server's event loop adds answers. A lock guards
    every method, and is held for a short time only.

    Attributes:
        turn: the state.
        observation: what the latest percept was made of; None while idle.
        ignored: answers that were discarded.
    """

    def __init__(self) -> None:
        self.turn = Turn.IDLE
        self.observation: Observation | None = None
        self.ignored = 0
        self._replies: deque[Reply] = deque()
        self._frame = b""
        self._lock = Lock()

    def __len__(self) -> int:
        """Return the number of answers that wait for the brain."""
        return len(self._replies)

    # -- for the brain, in the runner's thread ---------------------------------------------------

    def ask(self, observation: Observation, frame: bytes) -> bool:
        """Make this the percept that the script has to answer.

        Returns:
            False, and nothing changes, while a reset waits for the brain.
        """
        with self._lock:
            if self.turn is Turn.RESETTING:
                return False
            # in realtime a newer percept replaces one that the script never answered
            self._change_to(Turn.ASKED)
            self.observation, self._frame = observation, frame
            return True

    def ask_again(self, observation: Observation) -> bool:
        """Let the script answer once more, unless a newer percept was sent; return True if so."""
        with self._lock:
            if self.turn is not Turn.IDLE:
                return False
            self._change_to(Turn.ASKED)
            self.observation = observation
            return True

    def take(self) -> Reply | None:
        """Take the next answer; an action that came too late is skipped if there is a newer one."""
        with self._lock:
            if not self._replies:
                return None
            reply = self._replies.popleft()
            # only actions grow old: a reset or a pause is carried out however late it comes
            while self._replies and isinstance(reply.answer, Mapping):
                self.ignored += 1
                reply = self._replies.popleft()
            # else a newer percept was sent meanwhile, and still waits for its own answer
            if reply.observation is self.observation:
                self._become_idle()
            return reply

    def cancel(self) -> None:
        """Expect no answer any more."""
        with self._lock:
            if self.turn is not Turn.IDLE:
                self._become_idle()

    # -- for the connection, in the event loop ---------------------------------------------------

    def observation_for(self, seq: int) -> Observation | None:
        """Return what the percept with this number was made of, if it waits for an answer."""
        with self._lock:
            asked = self.observation if self.turn is Turn.ASKED else None
            return asked if asked is not None and asked.number == seq else None

    def answer(self, reply: Reply) -> bool:
        """Add the answer to the latest percept; return False if another one was sent meanwhile."""
        with self._lock:
            if self.turn is not Turn.ASKED or reply.observation is not self.observation:
                return False
            is_reset = isinstance(reply.answer, ResetRequest)
            self._change_to(Turn.RESETTING if is_reset else Turn.ANSWERED)
            self._replies.append(reply)
            return True

    def unanswered_frame(self) -> bytes | None:
        """Return the frame of the percept that waits for an answer, if there is one."""
        with self._lock:
            # a script that reconnects gets this frame again: the same bytes, the same number
            return self._frame if self.turn is Turn.ASKED else None

    # -- state ------------------------------------------------------------------------------------

    def _become_idle(self) -> None:
        self._change_to(Turn.IDLE)
        self.observation = None

    def _change_to(self, turn: Turn) -> None:
        if turn not in _NEXT[self.turn]:
            raise RuntimeError(f"expected {_NEXT[self.turn]} after {self.turn}, got {turn}")
        self.turn = turn

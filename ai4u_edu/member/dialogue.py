"""A room's side of the dialogue with its class, without input and output.

A client tells it of each event on the connection, and sends the frames that it gives. Times are in
seconds of any clock that only goes forward.
"""

import random
from collections.abc import Callable
from enum import Enum

from ai4u_edu.base.errors import text_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.member.link import LinkTimeouts
from ai4u_edu.member.outbox import ResultOutbox
from ai4u_edu.wire.class_link import (
    MAX_FRAME_BYTES,
    Ack,
    Applied,
    Drawing,
    FromClass,
    LinkHello,
    LinkProblem,
    LinkWelcome,
    Poses,
    State,
    Work,
    decode_from_class,
    encode_from_room,
)
from ai4u_edu.wire.validation import WireError

MIN_BACKOFF_S = 0.5
"""Pause after the first failed attempt to connect; it doubles with each failure."""
MAX_BACKOFF_S = 10.0
MIN_BYTES_PER_S = 50_000
"""Rate of a slow network; a large result has more time until it is sent again."""
MAX_RESULTS_IN_FLIGHT = 8
"""Limit of the results that were sent and are not acknowledged yet."""
POLICY_VIOLATION = 1008
"""Close code of a class that refuses the link for good."""

PresentState = Drawing | Poses | State | Work | Applied
"""Messages of which only the latest one of each kind counts."""
_ORDER: tuple[type, ...] = (Drawing, Poses, State, Work, Applied)


class LinkPhase(Enum):
    """Phase of a link."""

    WAITING = "waiting"
    """There is no connection; the next attempt is due at :attr:`LinkDialogue.retry_at`."""
    OPENING = "opening"
    GREETING = "greeting"
    """The hello was sent, and has no answer yet."""
    LINKED = "linked"
    OVER = "over"
    """The class has ended the link; it is opened again only if somebody asks for that."""


_NEXT: dict[LinkPhase, frozenset[LinkPhase]] = {
    LinkPhase.WAITING: frozenset({LinkPhase.OPENING}),
    LinkPhase.OPENING: frozenset({LinkPhase.GREETING, LinkPhase.WAITING}),
    LinkPhase.GREETING: frozenset({LinkPhase.LINKED, LinkPhase.WAITING, LinkPhase.OVER}),
    LinkPhase.LINKED: frozenset({LinkPhase.WAITING, LinkPhase.OVER}),
    LinkPhase.OVER: frozenset({LinkPhase.WAITING}),
}


class LinkDialogue:
    """State of a link. Not thread-safe.

    Args:
        hello: begins each connection.
        outbox: results to deliver.
        jitter: returns random numbers in [0, 1).
        timeouts: of the class's answers.
    """

    def __init__(
        self,
        hello: LinkHello,
        outbox: ResultOutbox,
        jitter: Callable[[], float] = random.random,
        timeouts: LinkTimeouts | None = None,
    ) -> None:
        self.phase = LinkPhase.WAITING
        self.problem = ""
        """Sentence on why there is no link, or why the class refused a message; empty if all is
        well."""
        self.retry_at = 0.0
        """Time of the next attempt to connect, while :attr:`phase` is WAITING."""
        self._hello, self._outbox, self._jitter = hello, outbox, jitter
        self._timeouts = timeouts or LinkTimeouts()
        self._backoff_s = MIN_BACKOFF_S
        self._greeted_at = 0.0
        self._latest: dict[type, PresentState] = {}
        self._unsent: dict[type, None] = {}
        """Kinds of present states to send, in this order."""
        self._in_flight: dict[str, float] = {}
        """Results that were sent over this connection, and when to send them again."""

    # -- the connection --------------------------------------------------------------------------

    def open(self) -> None:
        """Begin an attempt to connect."""
        self._enter(LinkPhase.OPENING)

    def opened(self, now: float) -> bytes:
        """Return the first frame of a connection that was opened."""
        self._enter(LinkPhase.GREETING)
        self._greeted_at = now
        return encode_from_room(self._hello)

    def lost(self, now: float, why: str, code: int = 0) -> None:
        """Note that an attempt failed, or that the connection was lost.

        Args:
            now: the time.
            why: the reason, without a full stop.
            code: of the WebSocket's close; 0 if it had none.
        """
        if self.phase is LinkPhase.OVER:
            return
        if code == POLICY_VIOLATION:
            self.problem = why or _("The class has ended this link.")
            self._enter(LinkPhase.OVER)
            return
        self.problem = _(
            "The class can't be reached ({why}). Results are kept and sent later.", why=why
        )
        self._enter(LinkPhase.WAITING)
        self.retry_at = now + self._backoff_s * (0.5 + self._jitter() / 2)
        self._backoff_s = min(2 * self._backoff_s, MAX_BACKOFF_S)

    def stop(self) -> None:
        """Note that the connection was closed on purpose."""
        if self.phase not in (LinkPhase.WAITING, LinkPhase.OVER):
            self._enter(LinkPhase.WAITING)

    def renew(self, now: float) -> None:
        """Try again although the class has ended the link."""
        if self.phase is LinkPhase.OVER:
            self.problem, self.retry_at = "", now
            self._enter(LinkPhase.WAITING)

    def is_overdue(self, now: float) -> bool:
        """Return True if the class has not answered the hello in time."""
        return self.phase is LinkPhase.GREETING and now >= self._greeted_at + self._timeouts.welcome

    # -- from the class --------------------------------------------------------------------------

    def receive(self, frame: bytes) -> FromClass | None:
        """Handle a frame; return its message, or None if it is none for the room.

        A frame that can't be read is ignored.
        """
        if self.phase not in (LinkPhase.GREETING, LinkPhase.LINKED):
            return None
        try:
            message = decode_from_class(frame)
        except WireError as error:
            self.problem = _(
                "The class sent a message that this version can't read: {problem}",
                problem=text_of(error),
            )
            return None
        match message:
            case LinkWelcome() if self.phase is LinkPhase.GREETING:
                self._begin()
            case Ack(key):
                self._in_flight.pop(key, None)
                self._outbox.acknowledge(key)
                return None
            case LinkProblem(code="message", text=text):
                self.problem = text
            case LinkProblem(text=text):
                self.problem = text
                self._enter(LinkPhase.OVER)
        return message

    def _begin(self) -> None:
        self._enter(LinkPhase.LINKED)
        self.problem = ""
        self._backoff_s = MIN_BACKOFF_S
        self._in_flight.clear()
        self._unsent = {kind: None for kind in _ORDER if kind in self._latest}

    # -- to the class ----------------------------------------------------------------------------

    def set(self, message: PresentState) -> None:
        """Replace the present state of the message's kind; it is sent as soon as possible."""
        kind = type(message)
        if kind is Drawing:  # the poses are of the drawing before
            self._latest.pop(Poses, None)
            self._unsent.pop(Poses, None)
        self._latest[kind] = message
        self._unsent[kind] = None

    def clear(self) -> None:
        """Forget all present states; after a reconnect, none is sent again."""
        self._latest.clear()
        self._unsent.clear()

    def next_frame(self, now: float) -> bytes | None:
        """Return the next frame to send; None if there is none at present."""
        if self.phase is not LinkPhase.LINKED:
            return None
        keys = self._outbox.keys()
        self._in_flight = {key: due for key, due in self._in_flight.items() if key in keys}
        for key in keys:
            due = self._in_flight.get(key)
            if due is None and len(self._in_flight) >= MAX_RESULTS_IN_FLIGHT:
                break
            frame = self._outbox.frame(key)
            if frame is not None and (due is None or now >= due):
                due = now + self._timeouts.ack + len(frame) // MIN_BYTES_PER_S
                self._in_flight[key] = due
                return frame
        while self._unsent:
            kind = next(iter(self._unsent))
            del self._unsent[kind]
            frame = encode_from_room(self._latest[kind])
            if len(frame) <= MAX_FRAME_BYTES:
                return frame
            self.problem = _(
                "{kind}: expected at most {most} bytes, got {n}; make the scene smaller",
                kind=kind.__name__,
                most=MAX_FRAME_BYTES,
                n=len(frame),
            )
        return None

    def wait_s(self, now: float) -> float | None:
        """Return the seconds until this dialogue has to be asked again; None: at an event only."""
        match self.phase:
            case LinkPhase.WAITING:
                due = self.retry_at
            case LinkPhase.GREETING:
                due = self._greeted_at + self._timeouts.welcome
            case LinkPhase.LINKED if self._in_flight:
                due = min(self._in_flight.values())
            case _:
                return None
        return max(0.0, due - now)

    def _enter(self, phase: LinkPhase) -> None:
        if phase not in _NEXT[self.phase]:
            raise RuntimeError(
                _(
                    "expected a phase after {name}, got {name2}",
                    name=self.phase.name,
                    name2=phase.name,
                )
            )
        self.phase = phase

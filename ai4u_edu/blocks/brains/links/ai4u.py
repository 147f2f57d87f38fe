"""AI4U's protocol over UDP: the world knocks, a script listens."""

import socket
import time
import weakref

from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks.brains.command import Command
from ai4u_edu.blocks.brains.links.ai4u_codec import AI4UCodec
from ai4u_edu.blocks.brains.links.link import Answered, LinkState, Offer, Reset, Situation
from ai4u_edu.blocks.brains.links.link_thread import Desk
from ai4u_edu.blocks.brains.links.udp import Datagrams
from ai4u_edu.wire.ai4u_dialogue import Dialogue, Heard, Phase, State, Word
from ai4u_edu.wire.validation import WireError

KNOCK_EVERY = 0.25
"""Seconds between two knocks while no script is there."""
SETTLE = 0.1
"""Seconds that a script gets to put itself together, before it is greeted and before it is told a
first state: it asks for its reset meanwhile."""
POLL_EVERY = 0.01
"""Seconds between two questions to a script that is there and has not begun."""
PATIENT_AFTER = 20
"""A script that asks for time is asked again at once, so many times; then it thinks about something
longer, and asking would only take the processor from it."""
MOST_PATIENT = 0.004
"""Seconds between two questions to a script that thinks longer."""
FAREWELL = 0.3
"""Seconds for which a script's last reply is waited for."""
MAX_READ_AT_ONCE = 1000
"""Datagrams; somebody may send garbage faster than it is read, and the world is not to wait."""
NEVER = float("-inf")

COMMANDS = {
    Word.NOOP: Command.WAIT,
    Word.PAUSE: Command.PAUSE,
    Word.RESUME: Command.RESUME,
    Word.STOP: Command.STOP,
}


class AI4ULink:
    """A :class:`~ai4u_edu.blocks.brains.links.link.Link` that speaks AI4U's own protocol.

    Nothing is ever sent twice: the protocol has no numbers, and one datagram too many would shift
    the script's dialogue for good. So a lost one ends the session; then it knocks again, and a
    script may begin a new one.

    Args:
        host: where the script listens.
        port: its UDP port.
        receive_timeout: seconds for which a script may be silent.
        threaded: whether a thread of its own talks to the script, so that nobody waits for it.

    Raises:
        SetupError: there is no such host.
    """

    def __init__(
        self, host: str, port: int, *, receive_timeout: float = 2.0, threaded: bool = False
    ) -> None:
        self.where = f"{host}:{port}"
        self.state = LinkState.WAITING
        self.reason = ""
        self.ignored = 0
        self.heard = 0.0
        self._peer = _address_of(host, port)
        self._timeout = receive_timeout
        self._threaded = threaded
        self._datagrams: Datagrams | None = None

    @property
    def expecting(self) -> bool:
        """Whether the script owes an answer."""
        return self._datagrams is not None and self._dialogue.phase is Phase.PLAYING

    @property
    def will_call(self) -> bool:
        """Never: it is asked again and again."""
        return False

    def open(self, offer: Offer) -> None:
        """Begins to knock."""
        self.close("the agent is set up anew")
        self._codec = AI4UCodec(offer)
        self._dialogue = Dialogue(
            offer.agent,
            metadata=self._codec.metadata,
            max_steps=offer.max_steps,
            skip_frame=offer.skip_frame,
            repeat_action=offer.repeat_action,
        )
        self.state = LinkState.WAITING
        self.reason = f"no AI4U script listens at {self.where} yet"
        self._sent = NEVER
        self._waits = 0
        self._open: Situation | None = None
        self._told: tuple[Situation, State] | None = None
        self._kept: Answered | None = None
        self._datagrams = Datagrams(self._peer)
        self._closed = weakref.finalize(self, self._datagrams.close)
        if self._threaded:
            self._desk = Desk(self.talk, f"ai4u {self.where}")

    def tell(self, situation: Situation) -> None:
        """Sends it, or has the thread that talks to the script do so."""
        if not self.expecting:
            return
        if self._threaded:
            self._desk.leave(situation)
        elif self._kept is None and not self._dialogue.in_flight:
            self._send(situation, NEVER)

    def ask(self, situation: Situation, timeout: float) -> Answered | None:
        """The script's answer."""
        if self._threaded:
            return self._desk.exchange(situation, timeout)
        if self._kept is not None:
            kept, self._kept = self._kept, None
            return kept
        return self.talk(situation, time.monotonic() + timeout)

    def refuse(self, answered: Answered, reason: str) -> bool:
        """The protocol has no word for it: the script gets the next state, and nothing moved."""
        return False

    def idle(self) -> None:
        """Goes on asking a script that asked for time, and polling one that has not begun."""
        if self._threaded or self._datagrams is None or self._kept is not None:
            return
        if self._open is not None or not self.expecting:
            self._kept = self.talk(self._open, time.monotonic())

    def close(self, reason: str) -> None:
        """Tells the script that the world has ended."""
        if self._datagrams is None:
            return
        if self._threaded:
            self._desk.close()
        if self.state is LinkState.CONNECTED:
            self._say_goodbye()
        self._closed()
        self._datagrams = None
        self.state, self.reason = LinkState.WAITING, reason

    # -- the conversation ------------------------------------------------------------------------

    def talk(self, situation: Situation | None, until: float) -> Answered | None:
        """Sends what is due and takes what comes, until there is an answer or it is late enough."""
        while self._dialogue.in_flight or self._send(situation, until):
            heard = self._receive(until)
            if heard is None:
                return None
            answered = self._understood(heard)
            if answered is not None:
                self._open = None
                return answered
        return None

    def _send(self, situation: Situation | None, until: float) -> bool:
        """Sends the next request, unless it is too early for it; whether one is on its way."""
        now = time.monotonic()
        due = self._sent + self._pause()
        if due > now:
            until = min(due, self._patience(until))
            if until > now:
                time.sleep(until - now)
            if due > until:
                return False
        if self._dialogue.phase in (Phase.STARTED, Phase.PLAYING):
            if situation is None:
                return False
            self._open = situation
            if self._told is None or self._told[0] is not situation:
                self._told = situation, self._codec.state(situation)
        wire = self._wire
        self.ignored += wire.drain()
        request = self._dialogue.request(self._told[1] if self._told else None)
        self._sent = time.monotonic()
        try:
            wire.send(request)
        except OSError as error:
            self._unreachable(error)
            return False
        return True

    def _patience(self, until: float) -> float:
        """Until when to wait: before a session has begun there is nothing to wait for."""
        return until if self._threaded or self._dialogue.phase is Phase.PLAYING else NEVER

    def _pause(self) -> float:
        """Seconds that have to pass from one request to the next."""
        match self._dialogue.phase:
            case Phase.PLAYING if self._waits <= PATIENT_AFTER:
                return 0.0
            case Phase.KNOCKING:
                return KNOCK_EVERY
            case Phase.GREETING:
                return SETTLE
            case Phase.STARTED if not self._waits:
                return SETTLE
            case Phase.STARTED | Phase.POLLING:
                return POLL_EVERY
        return min(MOST_PATIENT, max(0, self._waits - PATIENT_AFTER) * 1e-4)

    def _receive(self, until: float) -> Heard | None:
        """The reply to what is on its way; None if it is not there yet, or never comes."""
        for _ in range(MAX_READ_AT_ONCE):
            try:
                reply, is_the_scripts = self._read(self._patience(until))
            except BlockingIOError:
                self._look_at_the_clock()
                return None
            except OSError as error:
                self._unreachable(error)
                return None
            if is_the_scripts:
                try:
                    return self._dialogue.hear(reply)
                except WireError:
                    pass
            self.ignored += 1
        self._look_at_the_clock()
        return None

    def _read(self, until: float) -> tuple[bytes, bool]:
        """The next datagram, and whether it is the script's; raises what a socket raises."""
        wire = self._wire
        wire.is_there(max(0.0, until - time.monotonic()) * 1000)
        return wire.take()

    def _understood(self, heard: Heard) -> Answered | None:
        """What a reply asks of the agent; None if it asks for nothing."""
        word, situation = heard.word, self._open
        self._waits = self._waits + 1 if word is Word.WAIT else 0
        if self.state is not LinkState.CONNECTED and self._dialogue.phase is not Phase.GREETING:
            self.state, self.reason = LinkState.CONNECTED, ""
        match word:
            case Word.CONFIGURED:
                self._sent = NEVER
            case Word.WAIT:
                self.heard = time.monotonic()
            case Word.RESET:
                return Answered(Reset(), situation)
            case Word.HALT:
                self._over(LinkState.WAITING, f"the script at {self.where} has ended")
            case Word.ACTION if self.expecting:
                return Answered(self._codec.action(heard.orders), situation)
            case _ if self.expecting:
                return Answered(COMMANDS[word], situation)
        return None

    def _look_at_the_clock(self) -> None:
        silent = time.monotonic() - self._sent
        if self._dialogue.phase is Phase.KNOCKING:
            self._dialogue.in_flight = silent < KNOCK_EVERY
        elif silent > self._timeout:
            self._over(
                LinkState.LOST,
                f"the script at {self.where} did not answer for {self._timeout:g} s: its session "
                "is over, since AI4U's protocol can't make up for a lost packet; start the script "
                "again (or give it a longer receive_timeout, if it was only slow)",
            )

    def _unreachable(self, error: OSError) -> None:
        if self._dialogue.phase is Phase.KNOCKING:
            self._dialogue.in_flight = False
            if not isinstance(error, ConnectionError):
                self.reason = f"{self.where} can't be reached: {error.strerror or error}"
        else:
            self._over(
                LinkState.LOST,
                f"the script at {self.where} is gone ({error.strerror or error}); start it again",
            )

    def _over(self, state: LinkState, reason: str) -> None:
        """A session has ended; from now on it knocks again."""
        if self.state is not LinkState.WAITING:  # else it had not begun yet
            self.state = state
        self.reason = reason
        self._open = self._told = None
        self._dialogue.begin()

    def _say_goodbye(self) -> None:
        until = time.monotonic() + FAREWELL
        wire = self._wire
        try:
            wire.send(self._dialogue.farewell())
            while (left := until - time.monotonic()) > 0:
                wire.is_there(left * 1000)
                if wire.take() == (b"halt", True):
                    return
        except OSError:
            return  # then it has gone already

    @property
    def _wire(self) -> Datagrams:
        if self._datagrams is None:
            raise SetupError(f"the link to {self.where} is closed; expected open() first")
        return self._datagrams


def _address_of(host: str, port: int) -> tuple[str, int]:
    try:
        found = socket.getaddrinfo(host, port, socket.AF_INET, socket.SOCK_DGRAM)
    except OSError as error:
        raise SetupError(
            f"host: expected a name or an IPv4 address, got {host!r} ({error.strerror or error})"
        ) from None
    address = found[0][4]
    return str(address[0]), int(address[1])

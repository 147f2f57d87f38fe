"""The link to an AI4U script: the world sends requests over UDP, the script answers."""

import contextlib
import select
import socket
import sys
import time
import weakref
from collections.abc import Callable

from ai4u_edu.base.errors import SetupError, text_of
from ai4u_edu.blocks.brains.brain import Command
from ai4u_edu.blocks.brains.links.link import (
    AgentSpec,
    LinkState,
    LinkThread,
    Observation,
    Reply,
    ResetRequest,
)
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join
from ai4u_edu.wire.agent_codec import AgentCodec
from ai4u_edu.wire.ai4u_dialogue import AI4UDialogue, AI4UReply, ReplyKind, SentState, SessionPhase
from ai4u_edu.wire.validation import WireError, shown

RECEIVE_BUFFER_BYTES = 2**16
"""More than the largest datagram."""
MAX_DRAINED = 1000
"""Datagrams that one drain discards at most: somebody may send faster than we read."""
LINUX_IP_RECVERR = 11
"""Socket option that reports unreachable ports at once; Python has no name for it."""
CONNECT_INTERVAL_S = 0.25
"""Interval of the requests that look for a script."""
SETTLE_S = 0.1
"""Time that a script gets to initialise, before the handshake and before its first state. It asks
for its reset meanwhile."""
POLL_INTERVAL_S = 0.01
"""Interval of the requests to a script that is connected and has not started."""
IMMEDIATE_REPEATS = 20
"""A script that asks for time is asked again at once, this many times. After that the interval
grows, since each question takes processor time from the script."""
REPEAT_BACKOFF_S = 1e-4
"""Growth of that interval with each question."""
MAX_REPEAT_INTERVAL_S = 0.004
"""Longest interval between two questions to a script that asks for time."""
GOODBYE_TIMEOUT_S = 0.3
"""Timeout of a script's last reply."""
MAX_RECEIVED_AT_ONCE = 1000
"""Datagrams read before the world goes on, even if somebody sends faster than we read."""
NEVER = float("-inf")

COMMANDS = {
    ReplyKind.NOOP: Command.WAIT,
    ReplyKind.PAUSE: Command.PAUSE,
    ReplyKind.RESUME: Command.RESUME,
    ReplyKind.STOP: Command.STOP,
}


class UdpSocket:
    """A UDP socket that talks to one address, and never blocks by itself.

    It is not connected, so that datagrams from others can be counted. Its timeout never changes,
    since setting one is a system call.

    Args:
        peer: the address.
    """

    def __init__(self, peer: tuple[str, int]) -> None:
        self.peer = peer
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setblocking(False)
        if sys.platform == "linux":
            # without it, only a timeout shows that nobody listens at a port
            self._socket.setsockopt(socket.IPPROTO_IP, LINUX_IP_RECVERR, 1)
        self.wait_readable = _poller(self._socket)
        """Waits at most the given milliseconds; returns something true if there is a datagram or an
        error to receive."""
        self.close = self._socket.close

    def send(self, data: bytes) -> None:
        """Send a datagram to the address.

        Raises:
            OSError: this datagram, or an earlier one, can't reach it.
        """
        try:
            self._socket.sendto(data, self.peer)
        except OSError:
            self._clear_errors()
            raise

    def receive(self) -> tuple[bytes, bool]:
        """Return the next datagram, and whether it is from the address.

        Raises:
            BlockingIOError: there is none.
            OSError: an earlier datagram reached nobody.
        """
        try:
            data, sender = self._socket.recvfrom(RECEIVE_BUFFER_BYTES)
        except BlockingIOError:
            raise
        except OSError:
            self._clear_errors()
            raise
        return data, sender == self.peer

    def drain(self) -> int:
        """Discard the datagrams that have arrived, and return their number."""
        count = 0
        for _number in range(MAX_DRAINED):
            if not self.wait_readable(0):
                break
            with contextlib.suppress(OSError):  # a datagram reached nobody; the next one will tell
                self.receive()
                count += 1
        return count

    def _clear_errors(self) -> None:
        """Empty Linux's error queue: while an error is in it, polling returns at once."""
        if sys.platform == "linux":
            with contextlib.suppress(OSError):
                while True:
                    self._socket.recvmsg(0, 0, socket.MSG_ERRQUEUE)


def _poller(udp: socket.socket) -> Callable[[float], object]:
    if hasattr(select, "poll"):
        poll = select.poll()
        poll.register(udp, select.POLLIN)
        return poll.poll
    return lambda milliseconds: select.select([udp], [], [], milliseconds / 1000)[0]


class AI4ULink:
    """A :class:`~ai4u_edu.blocks.brains.links.link.Link` that uses AI4U's own protocol.

    It never resends: the protocol has no sequence numbers, so the script would take a repeated
    datagram for the next one, and stay one behind for good. A lost datagram ends the session; the
    link then looks for a script again.

    Args:
        host: where the script listens.
        port: its UDP port.
        receive_timeout: seconds for which a script may be silent.
        threaded: whether a thread of its own talks to the script, so that the world never waits.
        clock: seconds; the brain's.

    Raises:
        SetupError: there is no such host.
    """

    def __init__(
        self,
        host: str,
        port: int,
        *,
        receive_timeout: float = 2.0,
        threaded: bool = False,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.where = f"{host}:{port}"
        self.state = LinkState.WAITING
        self.reason = ""
        self.ignored = 0
        self.time_asked_at = 0.0
        self._peer = _resolve(host, port)
        self._timeout = receive_timeout
        self._is_threaded = threaded
        self._clock = clock
        self._is_open = False
        self._socket: UdpSocket | None = None
        """None until the first question: a scene that is only read or tried opens no socket."""

    @property
    def expects_reply(self) -> bool:
        """True while the script owes an answer."""
        return self._socket is not None and self._dialogue.phase is SessionPhase.PLAYING

    @property
    def will_notify(self) -> bool:
        """Always False: the runner has to poll."""
        return False

    def open(self, spec: AgentSpec) -> None:
        """Begin to look for a script."""
        self.close(_("the agent is set up again"))
        self._codec = AI4UCodec(spec)
        self._readable = spec.fields
        self._dialogue = AI4UDialogue(
            spec.agent,
            metadata=self._codec.metadata,
            max_steps=spec.max_steps,
            skip_frame=spec.skip_frame,
            repeat_action=spec.repeat_action,
        )
        self.state = LinkState.WAITING
        self.reason = _("no AI4U script listens at {where} yet", where=self.where)
        self._sent_at = NEVER
        self._time_requests = 0
        """Replies in a row by which the script asked for time."""
        self._asked: Observation | None = None
        """The observation that waits for an answer."""
        self._state: tuple[Observation, SentState] | None = None
        """The last observation that was converted, and its state."""
        self._early_reply: Reply | None = None
        """A reply that came while the world stood still."""
        self._note = ""
        """A sentence for the script about what had no effect."""
        self._malformed = ""
        """A sentence about the last message of the session that was no reply, or had no effect."""
        self._is_open = True

    def tell(self, observation: Observation) -> None:
        """Send an observation in advance, or let the thread send it."""
        if not self.expects_reply:
            return
        if self._is_threaded:
            self._thread.put(observation)
        elif self._early_reply is None and not self._dialogue.in_flight:
            # the script computes while this world ticks on; the next `ask` reads its answer
            self._send(observation, NEVER)

    def ask(self, observation: Observation, timeout: float) -> Reply | None:
        """Return the script's answer."""
        if self._is_threaded:
            self._opened_socket()
            return self._thread.exchange(observation, timeout)
        if self._early_reply is not None:
            reply, self._early_reply = self._early_reply, None
            return reply
        return self.talk(observation, self._clock() + timeout)

    def refuse(self, reply: Reply, reason: str) -> bool:
        """Return False: the protocol can't express it; the script gets the next state instead."""
        return False

    def note(self, warning: str) -> None:
        """Send a sentence with the next new observation."""
        self._note = warning

    def idle(self) -> None:
        """Repeat the question to a script that asked for time, or poll one that has not started."""
        if self._is_threaded or not self._is_open or self._early_reply is not None:
            return
        if self._asked is not None or not self.expects_reply:
            self._early_reply = self.talk(self._asked, self._clock())

    def close(self, reason: str) -> None:
        """Tell the script that the world has ended."""
        if not self._is_open:
            return
        self._is_open = False
        if self._socket is not None:
            if self._is_threaded:
                self._thread.close()
            if self.state is LinkState.CONNECTED:
                self._say_goodbye()
            self._close_socket()
            self._socket = None
        self.state, self.reason = LinkState.WAITING, reason

    # -- the dialogue ----------------------------------------------------------------------------

    def talk(self, observation: Observation | None, deadline: float) -> Reply | None:
        """Send requests and handle replies, until there is an answer or the deadline is over."""
        while self._dialogue.in_flight or self._send(observation, deadline):
            received = self._receive(deadline)
            if received is None:
                return None
            reply = self._handle(received)
            if reply is not None:
                self._asked = None
                return reply
        return None

    def _send(self, observation: Observation | None, deadline: float) -> bool:
        """Send the next request if it is due; return True if a request is in flight."""
        now = self._clock()
        due = self._sent_at + self._interval()
        if due > now:
            deadline = min(due, self._wait_until(deadline))
            if deadline > now:
                time.sleep(deadline - now)
            if due > deadline:
                return False
        if self._dialogue.phase in (SessionPhase.STARTED, SessionPhase.PLAYING):
            if observation is None:
                return False
            self._asked = observation
            if self._state is None or self._state[0] is not observation:
                note, self._note = self._note, ""
                self._state = observation, self._codec.state(observation)._replace(warning=note)
        udp = self._opened_socket()
        # the protocol has no numbers: an old reply would be taken for the answer to this request
        self.ignored += udp.drain()
        request = self._dialogue.request(self._state[1] if self._state else None)
        try:
            udp.send(request)
        except OSError as error:
            self._handle_unreachable(error)
            return False
        finally:
            # also after a failure, so that the next attempt keeps its distance
            self._sent_at = self._clock()
        return True

    def _wait_until(self, deadline: float) -> float:
        """Return the deadline, or NEVER if the world must not wait since no session has begun."""
        may_wait = self._is_threaded or self._dialogue.phase is SessionPhase.PLAYING
        return deadline if may_wait else NEVER

    def _interval(self) -> float:
        """Return the seconds that have to pass from one request to the next."""
        match self._dialogue.phase:
            case SessionPhase.PLAYING if self._time_requests <= IMMEDIATE_REPEATS:
                return 0.0
            case SessionPhase.CONNECTING:
                return CONNECT_INTERVAL_S
            case SessionPhase.HANDSHAKE:
                return SETTLE_S
            case SessionPhase.STARTED if not self._time_requests:
                return SETTLE_S
            case SessionPhase.STARTED | SessionPhase.POLLING:
                return POLL_INTERVAL_S
        excess = max(0, self._time_requests - IMMEDIATE_REPEATS)
        return min(MAX_REPEAT_INTERVAL_S, excess * REPEAT_BACKOFF_S)

    def _receive(self, deadline: float) -> AI4UReply | None:
        """Return the reply to the request in flight; None if it is not there yet, or was lost."""
        udp = self._opened_socket()
        for _datagram in range(MAX_RECEIVED_AT_ONCE):
            udp.wait_readable(max(0.0, self._wait_until(deadline) - self._clock()) * 1000)
            looked_at = self._clock()  # a reply may come while this thread gets no processor time
            try:
                datagram, is_from_script = udp.receive()
            except BlockingIOError:
                self._check_timeout(looked_at)
                return None
            except OSError as error:
                self._handle_unreachable(error)
                return None
            if is_from_script:
                try:
                    return self._dialogue.parse_reply(datagram)
                except WireError as error:
                    if self.state is LinkState.CONNECTED:
                        self._malformed = _(
                            "a message of the script was ignored: {error}", error=text_of(error)
                        )
            self.ignored += 1
        self._check_timeout(looked_at)
        return None

    def _handle(self, received: AI4UReply) -> Reply | None:
        """Return what a reply means for the agent; None if it means nothing."""
        kind, observation = received.kind, self._asked
        fields = self._codec.fields(received.orders)
        self._time_requests = self._time_requests + 1 if kind is ReplyKind.WAIT else 0
        if (
            self.state is not LinkState.CONNECTED
            and self._dialogue.phase is not SessionPhase.HANDSHAKE
        ):
            self.state, self.reason = LinkState.CONNECTED, ""
        match kind:
            case ReplyKind.CONFIGURED:
                # NEVER lies in the past: the next request is due at once
                self._sent_at = NEVER
            case ReplyKind.WAIT:
                self.time_asked_at = self._clock()
            case ReplyKind.RESET:
                return Reply(ResetRequest(), observation, self._warning(received), fields)
            case ReplyKind.HALT:
                self._end_session(
                    LinkState.WAITING, _("the script at {where} has ended", where=self.where)
                )
            case ReplyKind.ACTION if self.expects_reply:
                action = self._codec.action(received.orders)
                return Reply(action, observation, self._warning(received), fields)
            case ReplyKind.ACTION:
                self._malformed = _(
                    "action {name} had no effect: expected '__reset__' first, with which an "
                    "episode begins",
                    name=shown(received.orders[0].name),
                )
            case _ if self.expects_reply:
                return Reply(COMMANDS[kind], observation, self._warning(received), fields)
        return None

    def _warning(self, received: AI4UReply) -> str:
        """Return a sentence about what had no effect, in a reply and in messages before it."""
        malformed, self._malformed = self._malformed, ""
        is_action = received.kind is ReplyKind.ACTION
        dropped = self._codec.find_dropped(
            received.orders, is_action=is_action, readable=self._readable
        )
        return join(list(filter(None, (malformed, dropped))), "; ")

    def _check_timeout(self, looked_at: float) -> None:
        """End a session whose script had not answered when the socket was looked at."""
        silence = looked_at - self._sent_at
        if self._dialogue.phase is SessionPhase.CONNECTING:
            self._dialogue.in_flight = silence < CONNECT_INTERVAL_S
        elif silence > self._timeout:
            lost = _(
                "the script at {where} did not answer for {timeout:g} s: its session is over, "
                "since AI4U's protocol can't make up for a lost packet; start the script again "
                "(if it was only slow, because it learned say, start the world with a longer "
                "--receive-timeout, in milliseconds)",
                where=self.where,
                timeout=self._timeout,
            )
            reasons = list(filter(None, (lost, self._malformed)))
            self._end_session(LinkState.LOST, join(reasons, "; "))

    def _handle_unreachable(self, error: OSError) -> None:
        if self._dialogue.phase is SessionPhase.CONNECTING:
            self._dialogue.in_flight = False
            if not isinstance(error, ConnectionError):
                self.reason = _(
                    "{where} can't be reached: {why}",
                    where=self.where,
                    why=error.strerror or str(error),
                )
        else:
            self._end_session(
                LinkState.LOST,
                _(
                    "the script at {where} is gone ({why}); start it again",
                    where=self.where,
                    why=error.strerror or str(error),
                ),
            )

    def _end_session(self, state: LinkState, reason: str) -> None:
        """End a session, and look for a script again."""
        if self.state is not LinkState.WAITING:  # else it had not begun yet
            self.state = state
        self.reason = reason
        self._asked = self._state = None
        self._malformed = self._note = ""
        self._codec.begin()
        self._dialogue.begin()

    def _say_goodbye(self) -> None:
        deadline = time.monotonic() + GOODBYE_TIMEOUT_S
        udp = self._opened_socket()
        try:
            udp.send(self._dialogue.goodbye_request())
            while (left := deadline - time.monotonic()) > 0:
                udp.wait_readable(left * 1000)
                if udp.receive() == (b"halt", True):
                    return
        except OSError:
            return  # then it has gone already

    def _opened_socket(self) -> UdpSocket:
        """Return the socket; open it first, and start the thread, if that was not done yet."""
        if self._socket is None:
            if not self._is_open:
                raise SetupError(
                    _("the link to {where} is closed; expected open() first", where=self.where)
                )
            self._socket = UdpSocket(self._peer)
            self._close_socket = weakref.finalize(self, self._socket.close)
            if self._is_threaded:
                self._start_thread()
        return self._socket

    def _start_thread(self) -> None:
        link = weakref.ref(self)  # a thread that held it would keep it when the world is gone

        def talk(observation: Observation | None, deadline: float) -> Reply | None:
            here = link()
            return None if here is None else here.talk(observation, deadline)

        self._thread = LinkThread(talk, f"ai4u {self.where}", self._clock)
        weakref.finalize(self, self._thread.end)


def _resolve(host: str, port: int) -> tuple[str, int]:
    try:
        found = socket.getaddrinfo(host, port, socket.AF_INET, socket.SOCK_DGRAM)
    except OSError as error:
        raise SetupError(
            _(
                "host: expected a name or an IPv4 address, got {host} ({why})",
                host=repr(host),
                why=error.strerror or str(error),
            )
        ) from None
    address = found[0][4]
    return str(address[0]), int(address[1])


class AI4UCodec(AgentCodec):
    """Converts observations to AI4U's states, and replies to actions.

    Args:
        spec: of the agent.

    Raises:
        SetupError: AI4U's protocol can't express what a sensor reads.
    """

    def __init__(self, spec: AgentSpec) -> None:
        try:
            super().__init__(spec.readings, spec.outputs)
        except WireError as error:
            raise SetupError(text_of(error)) from None
        self._last: Observation | None = None

    def begin(self) -> None:
        """Forget what was sent: another session begins."""
        self._last = None

    def state(self, observation: Observation) -> SentState:
        """Return what the script is sent; its reward is that of all decisions since the last."""
        last, self._last = self._last, observation
        reward = observation.reward
        if last is not None and last.episode == observation.episode:
            if observation.steps > last.steps + 1:
                # decisions without a state in between, in realtime: the sum has what they paid
                reward = observation.episode_reward - last.episode_reward
        elif observation.steps > 1:
            # the first state in this episode, which began before the script came
            reward = observation.episode_reward
        return SentState(
            sensors=self.sensors(observation.percept),
            reward=reward,
            steps=observation.steps,
            done=observation.done,
            truncated=observation.truncated,
            paused=observation.paused,
            stopped=observation.stopped,
        )

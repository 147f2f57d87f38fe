"""A bridge between an AI4U script on this machine and a world elsewhere.

AI4U's own protocol can't recover a lost or repeated datagram. Between script and bridge, on
loopback, none is lost. Between bridge and world our own protocol recovers losses, which the script
notices as a delay only.
"""

import contextlib
import socket
import sys
import threading
import time
from collections.abc import Callable
from secrets import token_urlsafe
from typing import NamedTuple

from gymnasium import spaces

from ai4u_edu.base.errors import ActionError, text_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.remote.address import address_of
from ai4u_edu.remote.dialogue import Dialogue
from ai4u_edu.remote.errors import RemoteError
from ai4u_edu.remote.percept import RemotePercept
from ai4u_edu.remote.spaces import output_space, reading_space
from ai4u_edu.remote.sync_connection import ConnectionStoppedError, SyncConnection
from ai4u_edu.wire import ai4u_dialogue, native
from ai4u_edu.wire.agent_codec import AgentCodec
from ai4u_edu.wire.ai4u import ReplyCommand, number
from ai4u_edu.wire.ai4u_dialogue import AI4UDialogue, AI4UReply, ReplyKind, SentState, SessionPhase
from ai4u_edu.wire.validation import WireError

CONNECT_INTERVAL_S = 0.25
"""Interval of the requests that look for a script."""
MAX_DRAINED = 1000
"""Datagrams that are discarded before a request at most."""
STOP_POLL_S = 0.2
"""Interval at which a wait for a reply checks whether it was stopped."""
GOODBYE_TIMEOUT_S = 0.3
"""Timeout of a script's last reply."""
MAX_DATAGRAM_BYTES = 2**16
SETTLE_S = 0.1
"""Time that a script gets to initialise, before the handshake and before its first state. It asks
for its reset meanwhile."""
POLL_INTERVAL_S = 0.01
"""Interval of the requests to a script that has not started, or asks for nothing."""
REPEAT_BACKOFF_S = 1e-4
"""Growth of the pause with each request to a script that asks for time."""
MAX_REPEAT_INTERVAL_S = 0.004
"""Longest pause between two requests to a script that asks for time."""
KEEPALIVE_INTERVAL_S = 0.1
"""Interval at which the world is asked for time on behalf of the script; shorter than the shortest
``receive_timeout`` of a world (0.2 s)."""

_ORDERS = {ReplyKind.PAUSE: "pause", ReplyKind.RESUME: "resume", ReplyKind.STOP: "stop"}


class _Reading(NamedTuple):
    name: str
    kind: str
    space: spaces.Space[object]
    is_input: bool


class _Output(NamedTuple):
    name: str
    space: spaces.Space[object]
    is_output: bool


class Bridge:
    """Lets an AI4U script on this machine drive an agent of a world elsewhere.

    The script has the agent only while it runs: before, between two scripts and after the last, the
    agent's own brain drives.

    Args:
        url: the page's address of the world; a token in it counts.
        agent: the agent's id; may be left out where there is only one.
        port: where the script listens (UDP).
        host: where it listens, if not on loopback.
        token: the world's, if it has one.
        mode: lockstep: the world waits for each action; realtime: it never waits.
        script_id: the id by which the script knows its agent.
        patience: seconds for which the script may be silent, and for which the bridge waits for a
            world that is not there, or for an agent that another script has.
        on_missing: substitute for an action that is missing; see
            :func:`~ai4u_edu.remote.connect`.
        tell: called with sentences for the person at this machine.

    Raises:
        RemoteError: one of the addresses is invalid.
    """

    def __init__(
        self,
        url: str,
        agent: str = "",
        *,
        port: int = 8080,
        host: str = "127.0.0.1",
        token: str = "",
        mode: native.Mode = "lockstep",
        script_id: str = "0",
        patience: float = 10.0,
        on_missing: native.OnMissing = "",
        tell: Callable[[str], object] = print,
    ) -> None:
        self._address = address_of(url)
        self._agent, self._token, self._mode = agent, token or self._address.token, mode
        self._on_missing = on_missing
        self._secret, self._patience = token_urlsafe(16), patience
        self._is_over = threading.Event()
        self._tell = tell
        self._connection, self._robot = self._connect()
        welcome = self._robot.welcome
        self._title = _("agent {agent!r} of {title!r}", agent=welcome.agent, title=welcome.title)
        self._codec = _codec_of(welcome)
        dialogue = ai4u_dialogue.AI4UDialogue(
            script_id,
            metadata=self._codec.metadata,
            max_steps=welcome.max_steps,
            skip_frame=welcome.skip_frame,
            repeat_action=welcome.repeat_action,
        )
        self._leave()
        self._script = AI4UScript(
            port, dialogue, host=host, patience=patience, is_over=self._is_over
        )

    def run(self) -> None:
        """Serve one script after another, until :meth:`stop`.

        Raises:
            RefusedError: the world does not give the agent to a script; the text says why.
            LostError: the world is gone, or has given the agent to another script.
        """
        try:
            while self._await_script():
                try:
                    self._let_drive()
                except ScriptGoneError as gone:
                    self._tell(text_of(gone))
                except ConnectionStoppedError:
                    pass  # it was stopped while it waited for the world
                finally:
                    self._leave()
        finally:
            self._script.say_goodbye()
            self._script.close()

    def stop(self) -> None:
        """End :meth:`run`, from another thread."""
        self._is_over.set()

    # -- steps -----------------------------------------------------------------------------------

    def _connect(self) -> tuple[SyncConnection, Dialogue]:
        connection = SyncConnection(self._address, stop=self._is_over, tell=self._tell)
        # with the same secret, since the goodbye of the session before may have been lost
        robot = Dialogue(
            self._agent,
            token=self._token,
            mode=self._mode,
            session=f":{self._secret}",
            patience=self._patience,
            on_missing=self._on_missing,
        )
        connection.run(robot.begin())
        return connection, robot

    def _leave(self) -> None:
        self._connection.run(self._robot.end(_("the AI4U script has ended")))

    def _await_script(self) -> bool:
        """Look for a script until one starts; return False if the bridge was stopped before."""
        script, told = self._script, False
        while not script.is_over.is_set():
            if script.dialogue.phase in (SessionPhase.STARTED, SessionPhase.PLAYING):
                return True
            try:
                reply = script.ask()
            except ScriptGoneError as gone:
                self._tell(text_of(gone))
                continue
            if reply is None and not told and not script.is_over.is_set():
                told = True
                self._tell(_("no AI4U script listens at {where} yet; start it", where=script.where))
            elif reply is not None and reply.kind is ReplyKind.HALT:
                script.dialogue.begin()
            elif reply is not None:
                greets = script.dialogue.phase is SessionPhase.HANDSHAKE
                time.sleep(SETTLE_S if greets else POLL_INTERVAL_S)
        return False

    def _let_drive(self) -> None:
        """Let a script drive, from its start or reset until it ends."""
        script = self._script
        self._connection, self._robot = self._connect()
        self._tell(_("an AI4U script drives {title}", title=self._title))
        starts = script.dialogue.phase is SessionPhase.STARTED
        percept = self._connection.run(self._robot.sense() if starts else self._robot.reset())
        if starts:
            time.sleep(SETTLE_S)
        state, waits, asked_at = self._state(percept), 0, 0.0
        while not script.is_over.is_set():
            reply = script.ask(state)
            kind = reply.kind if reply else ReplyKind.CONTROL
            if kind is ReplyKind.HALT:
                script.dialogue.begin()
                self._tell(_("the AI4U script has ended; start another one, or end me with Ctrl-C"))
            if kind in (ReplyKind.HALT, ReplyKind.CONTROL):
                return
            if kind is ReplyKind.WAIT and time.monotonic() - asked_at > KEEPALIVE_INTERVAL_S:
                self._connection.run(self._robot.wait())
                asked_at = time.monotonic()
            waits = waits + 1 if kind is ReplyKind.WAIT else 0
            after = self._carry_out(kind, reply.orders if reply else [], percept)
            if after is None:
                pause = min(waits * REPEAT_BACKOFF_S, MAX_REPEAT_INTERVAL_S)
                time.sleep(pause if waits else POLL_INTERVAL_S)
            else:
                percept, state = after, self._state(after)

    def _carry_out(
        self, kind: ReplyKind, orders: list[ReplyCommand], percept: RemotePercept
    ) -> RemotePercept | None:
        """Carry out a script's reply; return the next percept, or None if nothing was done."""
        run, robot = self._connection.run, self._robot
        if kind is ReplyKind.RESET:
            return run(robot.reset())
        if kind in _ORDERS:
            run(robot.order(_ORDERS[kind]))  # type: ignore[arg-type]  # they are what it takes
            return run(robot.sense())
        if (
            kind is not ReplyKind.ACTION
            or percept.done
            or self._script.dialogue.phase is SessionPhase.STARTED
        ):
            return None
        try:
            run(robot.act(_numbers(self._codec.action(orders))))
            return run(robot.sense())
        except ActionError as error:
            self._tell(
                _("{problem}; the agent does nothing in this decision", problem=text_of(error))
            )
            run(robot.act({}))
            return run(robot.sense())

    def _state(self, percept: RemotePercept) -> SentState:
        return SentState(
            sensors=self._codec.sensors(percept),
            reward=percept.reward,
            steps=percept.step,
            done=percept.done,
            truncated=percept.truncated,
            paused=percept.paused,
            stopped=percept.stopped,
        )


def _codec_of(welcome: native.Welcome) -> AgentCodec:
    readings = [
        _Reading(each.key, each.sensor_type, reading_space(each), each.is_input)
        for each in welcome.readings
    ]
    outputs = [_Output(each.name, output_space(each), each.is_output) for each in welcome.outputs]
    try:
        return AgentCodec(readings, outputs)
    except WireError as error:
        raise RemoteError(text_of(error)) from None


def _numbers(action: dict[str, tuple[str, ...]]) -> dict[str, list[float]]:
    try:
        return {name: [number(arg) for arg in args] for name, args in action.items()}
    except WireError as error:
        raise ActionError(_("action: {problem}", problem=text_of(error))) from None


class ScriptGoneError(RemoteError):
    """The script's session is over: AI4U's protocol can't recover a lost datagram."""


class AI4UScript:
    """A UDP socket to a script, and the dialogue with it.

    Args:
        port: its UDP port.
        dialogue: with the script.
        host: where it listens.
        patience: seconds for which a script may be silent; see :attr:`patience`.
        is_over: set by another thread to stop waiting for replies.

    Raises:
        RemoteError: there is no such host.
    """

    def __init__(
        self,
        port: int,
        dialogue: AI4UDialogue,
        *,
        host: str = "127.0.0.1",
        patience: float = 5.0,
        is_over: threading.Event | None = None,
    ) -> None:
        self.where = f"{host}:{port}"
        self.dialogue = dialogue
        self.ignored = 0
        """Datagrams that were no answer."""
        self.is_over = is_over or threading.Event()
        self.patience = patience
        """Seconds for which a script may be silent; counts from the next request on."""
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            self._socket.connect((host, port))  # so that nobody else is heard
        except OSError as error:
            self._socket.close()
            raise RemoteError(
                _(
                    "expected the name or address of this machine, got {host!r} ({problem})",
                    host=host,
                    problem=str(error),
                )
            ) from None
        if sys.platform == "win32":  # there each later datagram would raise for an earlier refusal
            self._socket.ioctl(0x9800000C, False)

    def ask(self, state: SentState | None = None) -> AI4UReply | None:
        """Send the next request, and wait for the reply.

        Only requests that look for a script are repeated: the script would take a repeated datagram
        for the next one.

        Returns:
            The reply; None if no script answers yet, or the wait was stopped.

        Raises:
            ScriptGoneError: a script that was connected does not reply.
        """
        dialogue = self.dialogue
        is_connecting = dialogue.phase is SessionPhase.CONNECTING
        self._drain()
        until = time.monotonic() + (CONNECT_INTERVAL_S if is_connecting else self.patience)
        try:
            self._socket.send(dialogue.request(state))
            while (left := until - time.monotonic()) > 0:
                self._socket.settimeout(min(left, STOP_POLL_S))
                try:
                    return dialogue.parse_reply(self._socket.recv(MAX_DATAGRAM_BYTES))
                except WireError:
                    self.ignored += 1
                except TimeoutError:
                    pass
                if self.is_over.is_set():
                    return None
            error: OSError = TimeoutError(_("no answer for {patience:g} s", patience=self.patience))
        except OSError as failed:
            error = failed
        dialogue.begin()
        if is_connecting:
            time.sleep(max(0.0, until - time.monotonic()))
            return None
        raise ScriptGoneError(
            _(
                "the AI4U script at {where} is gone ({problem}); start it again",
                where=self.where,
                problem=str(error),
            )
        )

    def say_goodbye(self) -> None:
        """Tell a script that the world has ended."""
        if self.dialogue.phase not in (SessionPhase.CONNECTING, SessionPhase.OVER):
            with contextlib.suppress(OSError):
                self._socket.send(self.dialogue.goodbye_request())
                self._socket.settimeout(GOODBYE_TIMEOUT_S)
                self._socket.recv(MAX_DATAGRAM_BYTES)
        self.dialogue.begin()

    def close(self) -> None:
        """Close the socket."""
        self._socket.close()

    def _drain(self) -> None:
        """Discard what arrived before a request: it can't be the reply."""
        self._socket.settimeout(0.0)
        for _number in range(MAX_DRAINED):
            try:
                self._socket.recv(MAX_DATAGRAM_BYTES)
                self.ignored += 1
            except BlockingIOError:
                return
            except OSError:
                continue  # an earlier datagram reached nobody; the next one will tell

"""The world's side of AI4U's protocol as a state machine, without I/O.

::

    phase       request                        reply                     next phase
    CONNECTING  poll for a command             any                       HANDSHAKE
    HANDSHAKE   handshake                      max_steps ...@id ...      POLLING
    POLLING     poll for a command             __noop__                  POLLING
                                               __start_agent__           STARTED
                                               __reset__                 PLAYING
    STARTED     state, with done               __waitnewaction__         STARTED
                                               __reset__                 PLAYING
    PLAYING     state                          an action,
                                               __waitnewaction__,
                                               __reset__, ...            PLAYING
                                               __envcontrol__            POLLING

A script's ``halt`` ends the session in any phase.

AI4U's own world is started after the script, and begins with the handshake. Ours looks for a script
until there is one. A script that is still initialising would forget a handshake, so our world polls
for a command first, which does no harm. If the script answers that with a command, the command
takes effect after the handshake.

The protocol has no sequence numbers. Only its content tells that a reply belongs to the last
request; a reply that is not valid in the current phase is ignored.
"""

from collections.abc import Sequence
from enum import Enum, StrEnum
from typing import NamedTuple

from ai4u_edu.locale import gettext as _
from ai4u_edu.wire.ai4u import (
    HALT,
    Field,
    Kind,
    ReplyCommand,
    decode_reply,
    encode_request,
    joined,
    packed,
    packer,
)
from ai4u_edu.wire.validation import WireError

COMMANDS = "restart, resume, start_and_reset, start"


class SessionPhase(Enum):
    """Phases of a session."""

    CONNECTING = "connecting"
    HANDSHAKE = "handshake"
    POLLING = "polling"
    STARTED = "started"
    PLAYING = "playing"
    OVER = "over"


class ReplyKind(StrEnum):
    """Kinds of replies, by the command that they carry."""

    CONFIGURED = "max_steps"
    NOOP = "__noop__"
    START = "__start_agent__"
    RESET = "__reset__"
    RESTART = "__restart__"
    """The old name of RESET."""
    WAIT = "__waitnewaction__"
    PAUSE = "__pause__"
    RESUME = "__resume__"
    STOP = "__stop__"
    CONTROL = "__envcontrol__"
    HALT = HALT
    ACTION = "an action"


_COMMANDS = {ReplyKind.NOOP, ReplyKind.START, ReplyKind.RESET, ReplyKind.RESTART}
VALID_KINDS = {
    SessionPhase.CONNECTING: {ReplyKind.NOOP, ReplyKind.START, ReplyKind.RESET, ReplyKind.RESTART},
    SessionPhase.HANDSHAKE: {ReplyKind.CONFIGURED, ReplyKind.HALT},
    SessionPhase.POLLING: {
        ReplyKind.NOOP,
        ReplyKind.START,
        ReplyKind.RESET,
        ReplyKind.RESTART,
        ReplyKind.HALT,
    },
    SessionPhase.STARTED: set(ReplyKind) - {ReplyKind.CONFIGURED, ReplyKind.START},
    SessionPhase.PLAYING: set(ReplyKind) - {ReplyKind.CONFIGURED, ReplyKind.START},
    SessionPhase.OVER: {ReplyKind.HALT},
}
"""Kinds of replies that are valid in each phase."""


class AI4UReply(NamedTuple):
    """A reply of a script, parsed."""

    kind: ReplyKind
    orders: list[ReplyCommand]
    """All of its commands; the first one of an action has the actuator's name."""


class SentState(NamedTuple):
    """The state of an agent, as it is sent to a script."""

    sensors: Sequence[bytes]
    """Their readings, encoded, without those that have the name of one of the following fields."""
    reward: float
    steps: int
    done: bool
    truncated: bool
    paused: bool = False
    stopped: bool = False
    warning: str = ""
    """A sentence about what had no effect in the script's messages; sent only if there is one."""


WARNING = "__warning__"
"""Name of our own field with a sentence for the script, which finds it in its ``info``."""
STANDARD = ("done", "reward", "id", "steps", "truncated")
"""Names of the fields that every state has, whether or not sensors have these names."""


class AI4UDialogue:
    """The world's side of AI4U's protocol: one session with a script after another, without I/O.

    Args:
        agent: the agent's id.
        max_steps: decisions after which an episode is truncated.
        metadata: from :func:`~ai4u_edu.wire.agent_codec.metadata`.
        skip_frame: ticks skipped between two decisions.
        repeat_action: whether an action is applied on each of these ticks.

    >>> dialogue = AI4UDialogue("0", metadata="{}")
    >>> dialogue.request(None)[:40]
    b'   4  10__target__3      10envcontrol  1'
    >>> dialogue.parse_reply(b"__noop__;1;0").kind, dialogue.phase
    (<ReplyKind.NOOP: '__noop__'>, <SessionPhase.HANDSHAKE: 'handshake'>)
    >>> handshake = dialogue.request(None)
    >>> dialogue.parse_reply(b"max_steps;1;0@id;1;0").kind, dialogue.phase
    (<ReplyKind.CONFIGURED: 'max_steps'>, <SessionPhase.POLLING: 'polling'>)
    >>> poll = dialogue.request(None)
    >>> dialogue.parse_reply(b"__reset__;1;0").kind, dialogue.phase
    (<ReplyKind.RESET: '__reset__'>, <SessionPhase.PLAYING: 'playing'>)
    """

    def __init__(
        self,
        agent: str,
        *,
        metadata: str,
        max_steps: int = 0,
        skip_frame: int = 4,
        repeat_action: bool = True,
    ) -> None:
        self.agent = agent
        self.phase = SessionPhase.CONNECTING
        self.in_flight = False
        """True while a request waits for its reply; no other one may be sent."""
        self._last = ""
        self._first = AI4UReply(ReplyKind.NOOP, [])
        """The answer to the request that found the script; it counts after the handshake."""
        self._id = Field("id", Kind.TEXT, agent)
        self._handshake = encode_request(
            (
                Field("__target__", Kind.TEXT, "envcontrol"),
                Field("max_steps", Kind.INT, max_steps),
                self._id,
                Field("modelmetadata", Kind.TEXT, metadata),
                Field("config", Kind.INT, 1),
            )
        )
        self._reward, self._steps = packer("reward", Kind.FLOAT), packer("steps", Kind.INT)
        self._last_request: tuple[SentState, SessionPhase, bytes] | None = None
        """The last state request; a script that asks for time gets the same bytes again."""
        self._always = [
            packed(field)
            for field in (
                self._id,
                Field("__ctrl_applyingAction__", Kind.BOOL, False),
                Field("__ctrl_frameCounter__", Kind.INT, 0),
                Field("__ctrl_skipFrame__", Kind.INT, skip_frame),
                Field("__ctrl_repeatAction__", Kind.BOOL, repeat_action),
                Field("__ctrl_envMode__", Kind.BOOL, False),
            )
        ]

    def begin(self) -> None:
        """Forget the session; the next request looks for a script."""
        self.phase, self.in_flight, self._last = SessionPhase.CONNECTING, False, ""

    def request(self, state: SentState | None) -> bytes:
        """Return the next request.

        Args:
            state: of the agent; needed in the phases STARTED and PLAYING.
        """
        self.in_flight = True
        phase = self.phase
        if state is None or phase not in _STATE_PHASES:
            return self._handshake if phase is SessionPhase.HANDSHAKE else self._poll()
        last = self._last_request
        if last is None or last[0] is not state or last[1] is not phase:
            request = self._state(state, done=state.done or phase is SessionPhase.STARTED)
            self._last_request = last = state, phase, request
        return last[2]

    def parse_reply(self, reply: bytes) -> AI4UReply:
        """Parse a reply, and go on to the phase that follows it.

        Raises:
            WireError: it is malformed, or not valid in this phase; the phase stays as it is.
        """
        orders = decode_reply(reply)
        name = orders[0].name
        kind = _KINDS.get(name, ReplyKind.ACTION)
        if kind not in VALID_KINDS[self.phase]:
            raise WireError(
                _(
                    "nothing that can be said while {phase}: {name!r}",
                    phase=self.phase.value,
                    name=name,
                )
            )
        if kind is ReplyKind.CONFIGURED and ReplyCommand("id", (self.agent,)) not in orders[1:]:
            raise WireError(
                _(
                    "expected an answer for agent {agent!r}, got {orders}",
                    agent=self.agent,
                    orders=str(orders[1:]),
                )
            )
        self.in_flight, self._last = False, name
        if self.phase is SessionPhase.CONNECTING:
            self.phase, self._first = SessionPhase.HANDSHAKE, AI4UReply(kind, orders)
            return AI4UReply(ReplyKind.NOOP, orders)
        if kind is ReplyKind.CONFIGURED and self._first.kind is not ReplyKind.NOOP:
            kind, orders = self._first
        match kind:
            case ReplyKind.ACTION | ReplyKind.WAIT:
                pass  # most replies
            case ReplyKind.CONFIGURED | ReplyKind.CONTROL:
                self.phase = SessionPhase.POLLING
            case ReplyKind.START:
                self.phase = SessionPhase.STARTED
            case ReplyKind.RESET | ReplyKind.RESTART:
                self.phase = SessionPhase.PLAYING
            case ReplyKind.HALT:
                self.phase = SessionPhase.OVER
        return AI4UReply(ReplyKind.RESET if kind is ReplyKind.RESTART else kind, orders)

    def goodbye_request(self) -> bytes:
        """Return the last request; its reply is ``halt``."""
        self.phase, self.in_flight = SessionPhase.OVER, True
        return encode_request(
            (
                Field("__target__", Kind.TEXT, "envcontrol"),
                Field("__stop__", Kind.TEXT, "stop"),
                self._id,
            )
        )

    def _poll(self) -> bytes:
        # the script would take fields of these names for requests
        last = "" if self._last in ("max_steps", "__stop__") else self._last
        return encode_request(
            (
                Field("__target__", Kind.TEXT, "envcontrol"),
                Field("wait_command", Kind.TEXT, COMMANDS),
                self._id,
                Field(last, Kind.TEXT, last),
            )
        )

    def _state(self, state: SentState, *, done: bool) -> bytes:
        return joined(
            [
                *state.sensors,
                _DONE[done],
                self._reward(state.reward),
                self._steps(state.steps),
                _TRUNCATED[state.truncated],
                _PAUSED[state.paused],
                _STOPPED[state.stopped],
                *self._always,
                *([packed(Field(WARNING, Kind.TEXT, state.warning))] if state.warning else ()),
            ]
        )


def _encoded_bools(name: str) -> dict[bool, bytes]:
    return {on: packed(Field(name, Kind.BOOL, on)) for on in (False, True)}


_DONE, _TRUNCATED = _encoded_bools("done"), _encoded_bools("truncated")
_PAUSED, _STOPPED = _encoded_bools("__ctrl_paused__"), _encoded_bools("__ctrl_stopped__")
_STATE_PHASES = (SessionPhase.PLAYING, SessionPhase.STARTED)
_KINDS = {kind.value: kind for kind in ReplyKind if kind is not ReplyKind.ACTION}

"""Who says what when in AI4U's protocol, seen from the world's side; without a socket.

::

    KNOCKING   is there a command?               -> whatever               GREETING
    GREETING   handshake                         -> max_steps ...@id ...   POLLING
    POLLING    is there a command?               -> __noop__               (asked again)
                                                 -> __start_agent__        STARTED
                                                 -> __reset__              PLAYING
    STARTED    state, with done                  -> __waitnewaction__      (asked again)
                                                 -> __reset__              PLAYING
    PLAYING    state                             -> an action, __waitnewaction__, __reset__, ...
                                                 -> __envcontrol__         POLLING

A script's ``halt`` ends the session at any time. AI4U's world is started after the script, and
begins with the handshake. One that knocks until a script is there may meet it while it is still
putting itself together, and what it says then would be forgotten: so it asks for a command first,
which does no harm. What a script answers to that, it means; it is done after the handshake.

There are no numbers in this protocol: that a reply is one to the request before can only be told by
what it says, and what nobody can say in a phase is no reply.
"""

from collections.abc import Sequence
from enum import Enum, StrEnum
from typing import NamedTuple

from ai4u_edu.wire.ai4u import (
    HALT,
    Field,
    Kind,
    Order,
    decode_reply,
    encode_request,
    joined,
    packed,
    packer,
)
from ai4u_edu.wire.validation import WireError

COMMANDS = "restart, resume, start_and_reset, start"


class Phase(Enum):
    """How far a session is."""

    KNOCKING = "knocking"
    GREETING = "greeting"
    POLLING = "polling"
    STARTED = "started"
    PLAYING = "playing"
    OVER = "over"


class Word(StrEnum):
    """What a reply asks for."""

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


WORDS = {
    Phase.KNOCKING: {Word.NOOP, Word.START, Word.RESET, Word.RESTART},
    Phase.GREETING: {Word.CONFIGURED, Word.HALT},
    Phase.POLLING: {Word.NOOP, Word.START, Word.RESET, Word.RESTART, Word.HALT},
    Phase.STARTED: set(Word) - {Word.CONFIGURED, Word.START},
    Phase.PLAYING: set(Word) - {Word.CONFIGURED, Word.START},
    Phase.OVER: {Word.HALT},
}
"""What can be said when."""


class Heard(NamedTuple):
    """A reply."""

    word: Word
    orders: list[Order]
    """All commands of it; of an action the first has the actuator's name."""


class State(NamedTuple):
    """What a script is told of an agent."""

    sensors: Sequence[bytes]
    """Their readings, packed, without those named as one of the following."""
    reward: float
    steps: int
    done: bool
    truncated: bool
    paused: bool = False
    stopped: bool = False


STANDARD = ("done", "reward", "id", "steps", "truncated")
"""Readings that every state has, whether or not there are sensors of that name."""


class Dialogue:
    """One world's sessions with a script, one after another.

    Args:
        agent: the agent's id.
        max_steps: decisions after which an episode is cut off.
        metadata: as :func:`~ai4u_edu.wire.ai4u_metadata.metadata` makes it.
        skip_frame: ticks skipped between two decisions.
        repeat_action: whether an action is applied on each of them.

    >>> dialogue = Dialogue("0", metadata="{}")
    >>> dialogue.request(None)[:40]
    b'   4  10__target__3      10envcontrol  1'
    >>> dialogue.hear(b"__noop__;1;0").word, dialogue.phase
    (<Word.NOOP: '__noop__'>, <Phase.GREETING: 'greeting'>)
    >>> handshake = dialogue.request(None)
    >>> dialogue.hear(b"max_steps;1;0@id;1;0").word, dialogue.phase
    (<Word.CONFIGURED: 'max_steps'>, <Phase.POLLING: 'polling'>)
    >>> poll = dialogue.request(None)
    >>> dialogue.hear(b"__reset__;1;0").word, dialogue.phase
    (<Word.RESET: '__reset__'>, <Phase.PLAYING: 'playing'>)
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
        self.phase = Phase.KNOCKING
        self.in_flight = False
        """Whether a request is on its way; the next one has to wait for the reply."""
        self._last = ""
        self._meant = Word.NOOP
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
        self._told: tuple[State, Phase, bytes] | None = None
        """What was told last, and how: a script that asks for time is told the same again."""
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
        """Forgets the session; the next request knocks."""
        self.phase, self.in_flight, self._last = Phase.KNOCKING, False, ""

    def request(self, state: State | None) -> bytes:
        """What is to be sent now.

        Args:
            state: of the agent; needed when started and while playing.
        """
        self.in_flight = True
        phase = self.phase
        if state is None or phase not in _TOLD:
            return self._handshake if phase is Phase.GREETING else self._poll()
        told = self._told
        if told is None or told[0] is not state or told[1] is not phase:
            request = self._state(state, done=state.done or phase is Phase.STARTED)
            self._told = told = state, phase, request
        return told[2]

    def hear(self, reply: bytes) -> Heard:
        """Takes a reply.

        Raises:
            WireError: it is garbage, or nothing that can be said now; it counts as not heard.
        """
        orders = decode_reply(reply)
        name = orders[0].name
        word = _WORDS.get(name, Word.ACTION)
        if word not in WORDS[self.phase]:
            raise WireError(f"nothing that can be said while {self.phase.value}: {name!r}")
        if word is Word.CONFIGURED and Order("id", (self.agent,)) not in orders[1:]:
            raise WireError(f"expected an answer for agent {self.agent!r}, got {orders[1:]}")
        self.in_flight, self._last = False, name
        if self.phase is Phase.KNOCKING:
            self.phase, self._meant = Phase.GREETING, word
            return Heard(Word.NOOP, orders)
        if word is Word.CONFIGURED and self._meant is not Word.NOOP:
            word = self._meant
        match word:
            case Word.ACTION | Word.WAIT:
                pass  # most replies
            case Word.CONFIGURED | Word.CONTROL:
                self.phase = Phase.POLLING
            case Word.START:
                self.phase = Phase.STARTED
            case Word.RESET | Word.RESTART:
                self.phase = Phase.PLAYING
            case Word.HALT:
                self.phase = Phase.OVER
        return Heard(Word.RESET if word is Word.RESTART else word, orders)

    def farewell(self) -> bytes:
        """The last request; its reply is ``halt``."""
        self.phase, self.in_flight = Phase.OVER, True
        return encode_request(
            (
                Field("__target__", Kind.TEXT, "envcontrol"),
                Field("__stop__", Kind.TEXT, "stop"),
                self._id,
            )
        )

    def _poll(self) -> bytes:
        # the script looks for fields by name, and would take these for requests
        last = "" if self._last in ("max_steps", "__stop__") else self._last
        return encode_request(
            (
                Field("__target__", Kind.TEXT, "envcontrol"),
                Field("wait_command", Kind.TEXT, COMMANDS),
                self._id,
                Field(last, Kind.TEXT, last),
            )
        )

    def _state(self, state: State, *, done: bool) -> bytes:
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
            ]
        )


def _switch(name: str) -> dict[bool, bytes]:
    return {on: packed(Field(name, Kind.BOOL, on)) for on in (False, True)}


_DONE, _TRUNCATED = _switch("done"), _switch("truncated")
_PAUSED, _STOPPED = _switch("__ctrl_paused__"), _switch("__ctrl_stopped__")
_TOLD = (Phase.PLAYING, Phase.STARTED)
_WORDS = {word.value: word for word in Word if word is not Word.ACTION}

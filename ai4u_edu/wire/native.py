"""Our own protocol between a world and a script on another machine.

A frame is one msgpack array: the kind of message, then its fields. The script begins::

    script  hello                        which agent, and how
    world   welcome                      what the agent senses and can do
    world   percept 1                    what it senses now
    script  action for 1 (or a reset)    what it shall do
    world   percept 2 ...                when the decision is over

Frames may get lost, be duplicated, or arrive out of order. So percepts are numbered, an answer
carries the number of its percept, and a side that waits for too long repeats its last frame: the
script its answer, upon which the world repeats its percept if it has that answer already. No answer
counts twice.

The readings of a percept are one block of little-endian numbers, laid out as the welcome says.

Compatibility: see :mod:`ai4u_edu.wire.message_codec`. Versions work together as long as nobody uses
a field that the other side does not know. Any other change needs another :data:`VERSION`.
"""

import math
from collections.abc import Collection, Iterable, Mapping
from typing import Annotated, Literal

from msgspec import Meta

from ai4u_edu.base.errors import shorten, shown, suggest
from ai4u_edu.base.seeding import MAX_SEED
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import ngettext
from ai4u_edu.wire.message_codec import MessageCodec, Record, TaggedMessage
from ai4u_edu.wire.validation import LIST, MAX_FLOAT, MAX_TEXT_CHARS, Finite, Int, Text

VERSION = 1
SUBPROTOCOL = f"ai4u-edu-remote.v{VERSION}"
"""The WebSocket's subprotocol."""
MAX_SCRIPT_FRAME_BYTES = 64 * 2**10
"""Largest frame from a script."""
MAX_WORLD_FRAME_BYTES = 4 * 2**20
"""Largest frame from a world."""
MAX_READING_CHARS = 4000
"""Longest reading that is text."""
MAX_GRACE_S = 86_400.0

Mode = Literal["lockstep", "realtime"]
OnMissing = Literal["", "hold", "coast", "stop"]
"""Substitutes for an action that is missing: the last one again, nothing, or zeros for all
actuators; empty: the room's setting."""
Texts = Annotated[tuple[Text, ...], LIST]
Fields = Annotated[Mapping[Text, Texts], LIST]
"""Numbers, as text, and texts that a script tells an agent besides an action, by name."""
_Size = Annotated[int, Meta(ge=0, le=MAX_WORLD_FRAME_BYTES)]
_Data = Annotated[bytes, Meta(max_length=MAX_WORLD_FRAME_BYTES)]
_ReadingText = Annotated[str, Meta(max_length=MAX_READING_CHARS)]


class Hello(TaggedMessage, frozen=True):
    """A script asks for an agent, or to resume its session."""

    version: Int
    agent: Text
    """Its id; empty for the only agent of a world."""
    token: Text
    mode: Mode
    keys: Texts
    """Keys of the readings that the script wants; empty for all."""
    session: Text
    """Name of the session to resume; empty for a new one."""
    secret: Annotated[str, Meta(max_length=80)]
    """Chosen by the script; needed to resume the session."""
    on_missing: OnMissing = ""


class Reading(Record, frozen=True):
    """The description of a reading: its space, and its place in a percept."""

    key: Text
    kind: Literal["box", "discrete", "text"]
    sensor_type: Text
    """AI4U's type: sfloatarray, simage, ..."""
    dtype: Literal["<f4", "<i4", "|b1", "|u1", ""]
    shape: Annotated[tuple[_Size, ...], LIST]
    """Shape of an array; of a text, its largest number of characters."""
    offset: Int
    """Offset in the percept's data in bytes; of a text, its index in the texts."""
    low: _Data
    """Lowest value, encoded as the reading: one number for all entries, or one for each."""
    high: _Data
    """Highest value, in the same form."""
    unit: Text
    is_input: bool
    """True if it is part of a policy's observation."""


class Output(Record, frozen=True):
    """The description of an actuator: the space of its actions."""

    name: Text
    kind: Literal["box", "discrete"]
    low: Annotated[tuple[float, ...], LIST]
    high: Annotated[tuple[float, ...], LIST]
    is_output: bool
    """True if a policy drives it."""

    def __post_init__(self) -> None:
        if any(map(math.isnan, (*self.low, *self.high))):
            raise ValueError("expected bounds that are numbers or infinities, got nan")


class Welcome(TaggedMessage, frozen=True):
    """The world gives the agent to the script, and describes it."""

    version: Int
    session: Text
    grace: Annotated[float, Meta(ge=0.0, le=MAX_GRACE_S)]
    """Seconds for which a script whose connection is lost keeps its agent."""
    agent: Text
    mode: Mode
    title: Text
    """Title of the scene."""
    ticks_per_second: Annotated[float, Meta(ge=0.0, le=MAX_FLOAT)]
    skip_frame: Int
    repeat_action: bool
    max_steps: Int
    """Decisions after which an episode is truncated; 0 for no limit."""
    rewards: Texts
    """Names of the reward's terms."""
    success: Text
    """Name of the term that is paid when the scene's goal is reached; empty if there is none."""
    readings: Annotated[tuple[Reading, ...], LIST]
    outputs: Annotated[tuple[Output, ...], LIST]
    fields: Texts = ()
    """Names of the fields that the agent's sensors read."""


class Percept(TaggedMessage, frozen=True):
    """The readings of the agent, and the result of its last decision."""

    episode: Int
    """Counted by the agent, from 1."""
    step: Int
    """Decisions in this episode so far."""
    seq: Int
    """Number of the percept in the session, from 1; its answer carries the same number."""
    tick: Int
    """Ticks of the world since its reset."""
    reward: Finite
    """Sum over all decisions since the percept before; in lockstep there is one."""
    terms: Annotated[Mapping[Text, Finite], LIST]
    terminated: bool
    truncated: bool
    paused: bool
    """True while the agent is paused by the script; its actions have no effect."""
    stopped: bool
    """True if the script ended its decisions until the next reset."""
    data: _Data
    texts: Annotated[tuple[_ReadingText, ...], LIST]


class Action(TaggedMessage, frozen=True):
    """An action for the agent, as the answer to one percept."""

    episode: Int
    step: Int
    seq: Int
    values: Annotated[Mapping[Text, Annotated[tuple[float, ...], LIST]], LIST]
    """Numbers by the actuator's name; actuators that are left out do nothing. NaN and infinities
    pass here: the actuator refuses them, which makes the error an answer to this percept."""
    fields: Fields | None = None
    """All that the script tells the agent besides; what an earlier answer told is forgotten."""


class Reset(TaggedMessage, frozen=True):
    """A request for a new episode, as the answer to one percept."""

    seq: Int
    seed: Annotated[int, Meta(ge=0, le=MAX_SEED)] | None
    """With a seed, the whole world is reset; without, the agent alone if there are others."""
    fields: Fields | None = None
    """All that the script tells the agent before the first percept of the episode."""


class Order(TaggedMessage, frozen=True):
    """A command other than an action, as the answer to one percept."""

    seq: Int
    word: Literal["pause", "resume", "stop", "wait"]
    """``wait`` is no answer: it asks a world in lockstep to wait longer."""


class Problem(TaggedMessage, frozen=True):
    """An error: the text says what was wrong, and how to mend it."""

    code: Annotated[str, Meta(max_length=40)]
    """One of :data:`PROBLEMS`; or bad_message, bad_action, episode_over, seed_refused, after which
    the session goes on."""
    text: _ReadingText
    seq: Int
    """Number of the percept whose answer was wrong; 0 if it was no answer."""


class Bye(TaggedMessage, frozen=True):
    """The end of the session, from either side."""

    reason: Text


Answer = Action | Reset | Order
Message = Hello | Welcome | Percept | Answer | Problem | Bye

PROBLEMS = {
    "version": 4000,
    "bad_token": 4001,
    "unknown_agent": 4002,
    "unknown_key": 4003,
    "agent_taken": 4004,
    "session_over": 4005,
    "malformed": 4006,
    "too_large": 4007,
    "too_fast": 4008,
    "taken_over": 4009,
    "ended": 4010,
    "lockstep_refused": 4011,
}
"""Errors that close the connection, with the WebSocket's close code."""


def without_reader(names: Iterable[str], readable: Collection[str]) -> str:
    """Return a sentence about fields that no sensor reads; empty if there are none.

    >>> without_reader(["goal"], ["goal"])
    ''
    >>> without_reader(["gaol"], ["goal"])
    "no sensor reads the field 'gaol'; did you mean 'goal'?"
    """
    unread = [name for name in names if name not in readable]
    if not unread:
        return ""
    hint = _("expected an AgentArraySensor of that name")
    return ngettext(
        "no sensor reads the field {names}; {hint}",
        "no sensor reads the fields {names}; {hint}",
        len(unread),
        names=", ".join(map(shown, unread[:5])),
        hint=suggest(unread[0], readable) if readable else hint,
    )


_codec: MessageCodec[Message] = MessageCodec(Message)


def encode(message: Message) -> bytes:
    """Return a message as a frame; a sentence in it that is too long is cut.

    >>> len(encode(Bye("enough")))
    12
    """
    if isinstance(message, Problem):
        text = shorten(message.text, MAX_READING_CHARS)
        message = Problem(message.code, text, message.seq)
    elif isinstance(message, Bye):
        message = Bye(shorten(message.reason, MAX_TEXT_CHARS))
    return _codec.encode(message)


def decode(frame: bytes, max_bytes: int = MAX_SCRIPT_FRAME_BYTES) -> Message:
    """Return the message in a frame.

    Args:
        frame: the bytes that were received.
        max_bytes: limit of its size.

    Raises:
        WireError: there is no valid message in it. No other error is raised for any bytes.

    >>> decode(encode(Reset(seq=3, seed=None)))
    Reset(seq=3, seed=None, fields=None)
    >>> import msgspec
    >>> decode(msgspec.msgpack.encode(["rest", 3, None]))
    Traceback (most recent call last):
    ...
    ai4u_edu.wire.validation.WireError: expected a message (hello, welcome, percept, action, \
reset, order, problem, bye), got 'rest'
    """
    return _codec.decode(frame, max_bytes)

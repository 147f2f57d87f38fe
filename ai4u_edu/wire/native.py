"""Our own protocol: what a world and a script on another machine say to each other.

A frame is one msgpack array: the kind of message, then its fields. The script speaks first::

    script  hello                        which agent, and how
    world   welcome                      what the agent senses and can do
    world   percept 1                    what it senses now
    script  action for 1 (or a reset)    what it shall do
    world   percept 2 ...                when the decision is over

Frames may get lost, come twice or in another order. So everything has its number, and whoever waits
says again what it said last: the script its last frame, upon which the world says its own last one
again if it has already heard that. Nothing counts twice.

Readings are one piece of memory, little-endian, as the welcome lays it out.

A field that was added to a message later stands at its end and has a default. Who says the default
leaves the field out, and who does not find it takes the default: so older scripts and worlds go
together with newer ones, as long as nobody wants what the other does not know. Any other change
needs another :data:`VERSION`.
"""

from collections.abc import Mapping
from typing import Annotated, Any, Literal, NamedTuple

import msgpack

from ai4u_edu.base.errors import shorten
from ai4u_edu.base.seeding import MAX_SEED
from ai4u_edu.wire.validation import (
    ENDLESS,
    LARGEST_FLOAT,
    LONGEST_TEXT,
    MOST,
    UNCHECKED,
    Bounds,
    WireError,
    reader,
    shown,
)

VERSION = 1
SUBPROTOCOL = f"ai4u-edu-remote.v{VERSION}"
"""The WebSocket's subprotocol."""
LARGEST_SAID = 64 * 2**10
"""Bytes of a frame from a script."""
LARGEST_HEARD = 4 * 2**20
"""Bytes of a frame from a world."""
LONGEST_READ = 4000
"""Characters of a reading that is text."""
LONGEST_GRACE = 86_400.0
"""Seconds."""

Mode = Literal["lockstep", "realtime"]
OnMissing = Literal["", "hold", "coast", "stop"]
"""Substitutes for an action that is missing: the last one again, nothing, or zeros for all
actuators; empty: as the room has it."""


class Hello(NamedTuple):
    """A script wants an agent, or the session back that it had."""

    version: int
    agent: str
    """Its id; empty: the world's only one."""
    token: str
    mode: Mode
    keys: tuple[str, ...]
    """The readings that it wants; none named: all."""
    session: str
    """Empty for a new one."""
    secret: Annotated[str, 80]
    """Made up by the script. Who knows it may come back to the session."""
    on_missing: OnMissing = ""


class Reading(NamedTuple):
    """One reading: its space, and where it lies in a percept."""

    key: str
    kind: Literal["box", "discrete", "text"]
    sensor_type: str
    """AI4U's type of it: sfloatarray, simage, ..."""
    dtype: Literal["<f4", "<i4", "|b1", "|u1", ""]
    shape: tuple[Annotated[int, LARGEST_HEARD], ...]
    """Of a text: the most characters."""
    offset: int
    """Bytes from the beginning of the data; of a text, its place among the texts."""
    low: Annotated[bytes, LARGEST_HEARD]
    """The lowest value: one number for all entries, or one for each; as the reading itself."""
    high: Annotated[bytes, LARGEST_HEARD]
    unit: str
    is_input: bool
    """Whether a policy gets it as part of its observation."""


class Output(NamedTuple):
    """One actuator: what an action of it may be."""

    name: str
    kind: Literal["box", "discrete"]
    low: tuple[Annotated[float, ENDLESS], ...]
    high: tuple[Annotated[float, ENDLESS], ...]
    is_output: bool
    """Whether a policy drives it."""


class Welcome(NamedTuple):
    """The script has the agent."""

    version: int
    session: str
    grace: Annotated[float, Bounds(0.0, LONGEST_GRACE)]
    """Seconds that the seat is kept for a script whose connection is lost."""
    agent: str
    mode: Mode
    title: str
    """Of the scene."""
    ticks_per_second: Annotated[float, Bounds(0.0, LARGEST_FLOAT)]
    skip_frame: int
    repeat_action: bool
    max_steps: int
    """Decisions after which an episode is cut off; 0 for no limit."""
    rewards: tuple[str, ...]
    """The names of the reward's terms."""
    success: str
    """The term that is paid when the scene's goal is reached; empty if there is none."""
    readings: tuple[Reading, ...]
    outputs: tuple[Output, ...]


class Percept(NamedTuple):
    """What the agent senses, and what its last decision brought."""

    episode: int
    """The agent's own count."""
    step: int
    """Decisions in this episode so far."""
    seq: int
    """The percept's number in the session, from 1 on; the answer carries it."""
    tick: int
    """Of the world, since its reset."""
    reward: float
    """Of all decisions since the percept before; in lockstep that is one."""
    terms: Mapping[str, float]
    terminated: bool
    truncated: bool
    paused: bool
    """Whether the script asked for a pause; an action moves nothing until it ends."""
    stopped: bool
    """Whether the script asked for no more decisions until the next reset."""
    data: Annotated[bytes, LARGEST_HEARD]
    texts: tuple[Annotated[str, LONGEST_READ], ...]


class Action(NamedTuple):
    """What the agent shall do, as the answer to one percept."""

    episode: int
    step: int
    seq: int
    values: Mapping[str, tuple[Annotated[float, UNCHECKED], ...]]
    """Numbers by the actuator's name; what is left out does nothing. The actuator checks them, so
    that one that is not finite is refused as the answer to its percept."""


class Reset(NamedTuple):
    """A new episode shall begin, as the answer to one percept."""

    seq: int
    seed: Annotated[int, MAX_SEED] | None
    """With a seed the whole world begins anew; without, the agent alone if there are others."""


class Order(NamedTuple):
    """Something other than an action, as the answer to one percept."""

    seq: int
    word: Literal["pause", "resume", "stop", "wait"]
    """``wait`` is no answer: the script needs more time, and a world in lockstep gives it."""


class Problem(NamedTuple):
    """Something was wrong; the text says what, and what to do."""

    code: Annotated[str, 40]
    """One of :data:`PROBLEMS`; or bad_message, bad_action, episode_over, seed_refused, after which
    the script may say something else."""
    text: Annotated[str, LONGEST_READ]
    seq: int
    """Of the percept whose answer it was; 0 where it was none."""


class Bye(NamedTuple):
    """The end; from the script: the seat is free."""

    reason: str


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
"""Problems after which the connection is closed, with the code of the close."""

_KINDS: dict[str, type[Message]] = {
    kind.__name__.lower(): kind
    for kind in (Hello, Welcome, Percept, Action, Reset, Order, Problem, Bye)
}
_NAMES = {kind: name for name, kind in _KINDS.items()}
_READERS = {name: reader(kind) for name, kind in _KINDS.items()}
_LATER = {
    kind: tuple(reversed(kind._field_defaults.values()))
    for kind in _KINDS.values()
    if kind._field_defaults
}
"""The defaults of the fields that were added later, the last field's first."""


def encode(message: Message) -> bytes:
    """A message as a frame; a sentence in it that is too long for one is cut.

    >>> len(encode(Bye("enough")))
    12
    """
    if isinstance(message, Problem):
        message = message._replace(text=shorten(message.text, LONGEST_READ))
    elif isinstance(message, Bye):
        message = Bye(shorten(message.reason, LONGEST_TEXT))
    fields: tuple[Any, ...] = message
    for default in _LATER.get(type(message), ()):
        if fields[-1] != default:
            break
        fields = fields[:-1]
    packed: bytes = msgpack.packb((_NAMES[type(message)], *fields), unicode_errors="replace")
    return packed


def decode(frame: bytes, largest: int = LARGEST_SAID) -> Message:
    """The message in a frame.

    Args:
        frame: what came.
        largest: bytes that it may have.

    Raises:
        WireError: there is none in it; nothing else is ever raised, whatever the bytes are.

    >>> decode(encode(Reset(seq=3, seed=None)))
    Reset(seq=3, seed=None)
    >>> decode(msgpack.packb(["rest", 3, None]))
    Traceback (most recent call last):
    ...
    ai4u_edu.wire.validation.WireError: expected a message (hello, welcome, percept, action, \
reset, order, problem, bye), got 'rest'
    """
    if len(frame) > largest:
        raise WireError(f"expected at most {largest} bytes, got {len(frame)}")
    try:
        parts = msgpack.unpackb(
            frame,
            use_list=False,
            strict_map_key=True,
            max_array_len=MOST,
            max_map_len=MOST,
            max_ext_len=0,
        )
    except Exception as error:  # whatever is wrong with the bytes is wrong with the bytes
        raise WireError(f"expected msgpack, got {shown(frame)} ({error})") from None
    name = parts[0] if type(parts) is tuple and parts else None
    read = _READERS.get(name) if type(name) is str else None
    if read is None:
        raise WireError(f"expected a message ({', '.join(_READERS)}), got {shown(name)}")
    return read(parts[1:])

"""Protocol between a room (or a notebook) and its class.

The room opens one WebSocket to the class and keeps it. A frame is one msgpack array: the kind of
message, then its fields. The room begins::

    room    hello                       which seat or room, by its secret
    class   welcome                     whose link this is
    class   people, assignment, attention, race      the present ones, and again at each change
    class   settings                                 likewise
    room    drawing, poses, state, work              the present ones, and again at each change
    room    episodeResult, exerciseResult, network   each with a key
    room    learn, practise, stopTraining            each with a key
    class   ack                         the message with that key is stored
    class   handedIn                    the seat's networks, and again at each change
    class   trainings                   those of the room, and again at each change

All messages except those with a key describe a present state: the latest one counts, and after a
reconnect each side sends its own again. A room sends what has a key again, with the same key, until
it is acknowledged; the class stores a key once.

Compatibility: see :mod:`ai4u_edu.wire.message_codec`. Any other change needs another
:data:`VERSION`.
"""

from typing import Annotated, Any, Literal

from msgspec import Meta, Struct
from msgspec.structs import replace

from ai4u_edu.base.errors import shorten
from ai4u_edu.base.seeding import MAX_SEED
from ai4u_edu.locale import PACKED, packed, unpacked
from ai4u_edu.wire.message_codec import MessageCodec, Record, TaggedMessage
from ai4u_edu.wire.validation import LIST, MAX_TEXT_CHARS, Finite, Int, Text

VERSION = 2
SUBPROTOCOL = f"ai4u-edu-class.v{VERSION}"
"""The WebSocket's subprotocol."""
PATH = "/link"
"""Path of the class's WebSocket for links."""
MAX_FRAME_BYTES = 6 * 2**20
"""Largest frame of either side: one with a network."""
MAX_SENT_SCENE_CHARS = 1_600_000
"""Length of a scene's text: 200,000 characters, and its pictures."""
MAX_EPISODE_BYTES = 5 * 2**19
"""Size of an episode: 1 MB, and the pictures of its scene."""
MAX_NETWORK_BYTES = 5 * 2**20
"""Size of a network that a student hands in."""
MAX_STARTING_PROGRAM_CHARS = 20_000
MAX_TAUGHT_DRIVES = 50
"""Drives from which a network learns."""
MAX_MESSAGE_CHARS = 200
"""Longest message of a teacher."""
POSES_PER_S = 4
HEARTBEAT_S = 2.0
"""Longest time between two states of a room; they are also its sign of life."""

Key = Annotated[str, Meta(pattern=r"^[A-Za-z0-9_-]{8,64}$")]
"""Random id of a result."""
_Colour = Annotated[str, Meta(pattern=r"^#[0-9a-f]{6}$")]
_Scene = Annotated[str, Meta(max_length=MAX_SENT_SCENE_CHARS)]
_Seed = Annotated[int, Meta(ge=0, le=MAX_SEED)]
_Numbers = Annotated[tuple[Finite, ...], LIST]

Status = Literal["waiting", "driving", "solved", "fell", "over", "idle", "paused", "error"]
"""``waiting`` for the first key; ``idle``: nobody has driven or edited for a minute; ``over``: the
episode has ended in another way."""
TaskKind = Literal["open", "try"]
"""``open``: check a network in a file; ``try``: drive with many values of a number."""
Outcome = Literal["goal", "won", "lost", "fell", "time", "over"]


# -- from the room ---------------------------------------------------------------------------------


class LinkHello(TaggedMessage, frozen=True, tag="hello"):
    """A room, or a notebook without a world, begins its link."""

    version: Int
    secret: Text
    """Token of the room (on the class's machine), or of the seat."""
    kind: Literal["room", "notebook"]


class DrawnShape(Record, frozen=True):
    """A filled disc or polygon of a drawing, in metres."""

    colour: _Colour
    radius: Finite
    """Radius of a disc; 0 for a polygon."""
    points: _Numbers
    """x, y of each corner, or of the disc's centre; in the body's frame, or the world's."""


class BodyDrawing(Record, frozen=True):
    """The shapes of one body, in its frame."""

    name: Text
    is_agent: bool
    shapes: Annotated[tuple[DrawnShape, ...], LIST]


class Drawing(TaggedMessage, frozen=True):
    """Everything that a thumbnail shows, apart from poses; sent when something was built."""

    number: Int
    """Counted by the room, from 1."""
    bounds: tuple[Finite, Finite, Finite, Finite]
    """Left, bottom, right, top (m)."""
    ground: Annotated[tuple[DrawnShape, ...], LIST]
    """Floors and areas, in the world's frame, in the order in which they are drawn."""
    bodies: Annotated[tuple[BodyDrawing, ...], LIST]


class Poses(TaggedMessage, frozen=True):
    """Poses of all bodies of a drawing; sent if one has changed."""

    drawing: Int
    """Number of the drawing."""
    values: _Numbers
    """x, y (m), heading (rad) and visibility (1; 0 for a body that fell) of each body in turn."""


class State(TaggedMessage, frozen=True):
    """State of a room; sent at each change, and every :data:`HEARTBEAT_S`."""

    status: Status
    scene: Text
    """Title of the scene."""
    driver: Text
    """Title of the first agent's driver, such as "A person"; empty if nothing drives it."""
    seconds: Finite
    """Time of the episode."""
    episodes: Int
    """Episodes of this scene so far."""
    falls: Int
    """Falls in this scene so far."""
    is_solved: bool
    """True if the scene's goal was reached at least once."""
    error: Text = ""
    page: Text = ""
    """Path of its page at a JupyterHub, below the hub's own; empty without one."""


class Work(TaggedMessage, frozen=True):
    """The room's present scene; sent when it was changed or another one was opened."""

    title: Text
    scene: _Scene
    """Its YAML."""


class EpisodeResult(TaggedMessage, frozen=True):
    """Result of an episode that has ended."""

    key: Key
    scene: Text
    """Title of the scene."""
    seed: _Seed
    outcome: Outcome
    seconds: Finite
    reward: Finite
    driver: Text
    race: Text = ""
    """Id of the race that it belongs to; empty for none."""
    episode: Annotated[bytes, Meta(max_length=MAX_EPISODE_BYTES)] = b""
    """The recorded episode; only of a race."""


class ExerciseResult(TaggedMessage, frozen=True):
    """Result of a check, or a hint that was read."""

    key: Key
    exercise: Text
    """Its id, such as ``04.2``."""
    event: Literal["right", "wrong", "hint"]
    diagnosis: Text = ""
    """Id of the mistake that was found, such as ``04.2/narrow``."""


class HandedInNetwork(TaggedMessage, frozen=True, tag="network"):
    """A trained network that the seat hands in for tournaments; the latest one counts."""

    key: Key
    scene: Text
    """Name of a scene of the library."""
    part: Text
    """Role or side that it drives, such as ``keeper``; empty for all agents of a side."""
    file: Text
    """Name of its file."""
    data: Annotated[bytes, Meta(max_length=MAX_NETWORK_BYTES)]
    """An ONNX file."""


class Learn(TaggedMessage, frozen=True):
    """A room of the class's machine has a network learn from drives, in a process of the class."""

    key: Key
    """Names the training."""
    scene: Text
    """Name of the scene."""
    agent: Text
    """Id of the agent."""
    drives: Annotated[tuple[Text, ...], Meta(min_length=1, max_length=MAX_TAUGHT_DRIVES)]
    """Names of files in the room's folder of drives."""


class Practise(TaggedMessage, frozen=True):
    """A room of the class's machine has a network practise, in a process of the class."""

    key: Key
    """Names the practice."""
    practice: Text
    """Name of its folder in the room's folder of practices."""


class Task(TaggedMessage, frozen=True):
    """A room of the class's machine has something done in a process of the class."""

    key: Key
    """Names the task, and its folder in the room's folder of tasks."""
    kind: TaskKind


class StopTraining(TaggedMessage, frozen=True, tag="stopTraining"):
    """A training, practice or task of the room must end now."""

    key: Key
    training: Key
    """Key of the training, practice or task."""


class Applied(TaggedMessage, frozen=True):
    """The room has opened an assignment's scene, or could not."""

    assignment: Text
    """Its id."""
    problem: Text = ""


# -- from the class --------------------------------------------------------------------------------


class LinkWelcome(TaggedMessage, frozen=True, tag="welcome"):
    """The class accepts the link."""

    version: Int
    name: Text
    """Name of the seat; of a room with several, empty."""
    colour: Text


class Ack(TaggedMessage, frozen=True):
    """The result with this key is on disk."""

    key: Key


class CheckedNetwork(Record, frozen=True):
    """A network that the seat has handed in."""

    key: Text
    """Key of the message that brought it; empty for one that a page has sent."""
    scene: Text
    part: Text
    file: Text
    verdict: Literal["open", "right", "refused"]
    """``open``: it was not checked yet; ``right``: it can play."""
    reason: Text
    """Reason for which it was refused."""


class HandedIn(TaggedMessage, frozen=True):
    """All networks that the seat has handed in."""

    networks: Annotated[tuple[CheckedNetwork, ...], LIST]


class Training(Record, frozen=True):
    """A network that learns in the class's process, or has learned there."""

    key: Text
    scene: Text
    agent: Text
    drives: Int
    """Count of the drives that it learns from."""
    place: Int = 0
    """Place in the line, from 1; 0 if it learns or is over."""
    errors: _Numbers = ()
    """Errors on held-out moments, at equal distances of gradient steps."""
    is_done: bool = False
    """True if the network lies in the room's folder, for the room to take."""
    problem: Text = ""
    """Sentence about why it brought nothing; empty if it is under way or done."""
    decisions: Int = 0
    """Decisions that it learned from; 0 until it is done."""
    alike: Finite = 0.0
    """Share of held-out moments in which the network acts like the person."""
    commonest: Finite = 0.0
    """The same share for always doing what was done most often."""
    held_out: Int = 0
    """Held-out moments."""
    starts: Int = 0
    """Starts from which the network was tried; 0 if it was not."""
    successes: Int = 0
    """Starts from which it reached the goal."""
    has_all_starts: bool = False
    """True if the scene has no other starts."""
    remarks: Annotated[tuple[Text, ...], LIST] = ()
    """Sentences about what is wrong with the drives."""

    @property
    def is_over(self) -> bool:
        """True once it is done, has failed or was stopped."""
        return self.is_done or bool(self.problem)


class Practised(Record, frozen=True):
    """A practice in the class's process; what it has reached lies in its folder."""

    key: Text
    practice: Text
    """Name of its folder."""
    place: Int = 0
    """Place in the line, from 1; 0 if it practises or is over."""
    is_over: bool = False
    problem: Text = ""
    """Sentence about why it ended early; empty if it did not."""


class TaskState(Record, frozen=True):
    """A task in the class's process; its results lie in its folder."""

    key: Text
    kind: TaskKind
    place: Int = 0
    """Place in the line, from 1; 0 if it is under way or over."""
    is_over: bool = False
    problem: Text = ""
    """Sentence about why it ended early; empty if it did not."""


class RoomTrainings(TaggedMessage, frozen=True, tag="trainings"):
    """The latest training of a room, its practices, and its tasks."""

    trainings: Annotated[tuple[Training, ...], LIST]
    """None before the first one."""
    practices: Annotated[tuple[Practised, ...], LIST] = ()
    """Practices that are under way, and the latest ones that are over."""
    tasks: Annotated[tuple[TaskState, ...], LIST] = ()
    """Tasks that wait or are under way, and the latest ones that are over."""


class Person(Record, frozen=True):
    """A seat of the room."""

    number: Int
    name: Text
    colour: _Colour
    is_here: bool
    """True while a page or a notebook of the seat is connected."""


class People(TaggedMessage, frozen=True):
    """All seats of the room."""

    people: Annotated[tuple[Person, ...], LIST]
    is_visited: bool = True
    """False while no page and no script is connected: a room of the class's machine may rest."""
    has_teacher: bool = False
    """True while the teacher has the page of a room of the class's machine open."""


class Assignment(TaggedMessage, frozen=True):
    """A scene that the teacher gives to the room.

    A room that has opened it before (it remembers the id) only answers with :class:`Applied`.
    """

    id: Text
    """Empty if nothing is assigned."""
    title: Text
    scene: _Scene
    """Name in the library, or YAML, which contains a line break; empty if the world is to stay."""
    seed: _Seed | None
    lesson: Text = ""
    """Lesson for which it is assigned, such as "04 Sensors"; empty for none."""
    program: Annotated[str, Meta(max_length=MAX_STARTING_PROGRAM_CHARS)] = ""
    """Python that pages offer as a program to begin with; empty for none."""
    mission: Text = ""
    """Name of the mission that pages open; empty for none."""


class Attention(TaggedMessage, frozen=True):
    """The teacher's request for attention, or its end."""

    kind: Literal["", "pause", "blank"]
    """``pause``: worlds stand still; ``blank``: pages show the message only, too."""
    message: Annotated[str, Meta(max_length=MAX_MESSAGE_CHARS)]
    """Shown in the page, also without a pause."""
    ends_in_s: Finite
    """Seconds until it ends by itself; 0: it does not."""


class Switches(Record, frozen=True):
    """Switches of the whole class, which its teacher turns. All are off at first."""

    sound: bool = False
    """Students' pages may make sounds."""


class ClassSettings(TaggedMessage, frozen=True, tag="settings"):
    """Settings that hold in all rooms."""

    switches: Switches


class RaceRow(Record, frozen=True):
    """A place in a race."""

    name: Text
    colour: _Colour
    outcome: Text
    seconds: Finite
    room: Text


class CurrentRace(TaggedMessage, frozen=True, tag="race"):
    """The present race.

    A room resets to the seed, stands still until ``starts_in_s`` is over, and then sends the result
    of each episode with the race's id. A page shows its own best, and the board if there is one.
    """

    id: Text
    """Empty if there is none."""
    phase: Literal["countdown", "running", "over"]
    starts_in_s: Finite
    scene: _Scene
    """See :attr:`Assignment.scene`."""
    seed: _Seed
    board: Annotated[tuple[RaceRow, ...], LIST]
    """Best first; empty while the teacher hides it."""
    ghosts: Annotated[tuple[bytes, ...], Meta(max_length=3)] = ()
    """Recorded episodes of the best three."""
    own_best: Finite = 0.0
    """Shortest time (s) of the room to the goal that the class has checked; 0 for none."""


def race_assignment(race: str) -> str:
    """Return the id of the assignment with which a race's scene comes to later students."""
    return f"race-{race}"


class LinkProblem(TaggedMessage, frozen=True, tag="problem"):
    """An error: the text says what was wrong, and how to mend it."""

    code: Literal["version", "secret", "message", "over"]
    """The link ends after all but ``message``, and is not opened again."""
    text: Text


FromRoom = (
    LinkHello
    | Drawing
    | Poses
    | State
    | Work
    | EpisodeResult
    | ExerciseResult
    | HandedInNetwork
    | Learn
    | Practise
    | Task
    | StopTraining
    | Applied
)
FromClass = (
    LinkWelcome
    | Ack
    | HandedIn
    | RoomTrainings
    | People
    | Assignment
    | Attention
    | ClassSettings
    | CurrentRace
    | LinkProblem
)
Result = EpisodeResult | ExerciseResult
Delivery = Result | HandedInNetwork | Learn | Practise | Task | StopTraining
"""Messages that a room sends again until they are acknowledged."""


def _sent(text: str) -> str:
    """Return a sentence that its receiver translates for its own readers."""
    return packed(text, MAX_TEXT_CHARS)


def _received(message: Any, frame: bytes) -> Any:
    """Return a message whose sentences can be translated again."""
    # most frames have none, and poses many numbers to go through
    return _unpacked(message) if PACKED.encode() in frame else message


def _unpacked(value: Any) -> Any:
    if isinstance(value, str):
        return unpacked(value)
    if isinstance(value, tuple):
        return tuple(map(_unpacked, value))
    if isinstance(value, Struct):
        fields = {name: _unpacked(getattr(value, name)) for name in value.__struct_fields__}
        return replace(value, **fields)
    return value


_room_codec: MessageCodec[FromRoom] = MessageCodec(FromRoom, _sent)
_class_codec: MessageCodec[FromClass] = MessageCodec(FromClass, _sent)


def encode_from_room(message: FromRoom) -> bytes:
    """Return a room's message as a frame.

    >>> decode_from_room(encode_from_room(Applied("a1")))
    Applied(assignment='a1', problem='')
    """
    return _room_codec.encode(message)


def decode_from_room(frame: bytes) -> FromRoom:
    """Return the room's message in a frame.

    Raises:
        WireError: there is no valid message in it. No other error is raised for any bytes.
    """
    message: FromRoom = _received(_room_codec.decode(frame, MAX_FRAME_BYTES), frame)
    return message


def encode_from_class(message: FromClass) -> bytes:
    """Return a class's message as a frame; a sentence that is too long is cut."""
    if isinstance(message, LinkProblem):
        message = LinkProblem(message.code, shorten(message.text, MAX_TEXT_CHARS))
    return _class_codec.encode(message)


def decode_from_class(frame: bytes) -> FromClass:
    """Return the class's message in a frame.

    Raises:
        WireError: there is no valid message in it. No other error is raised for any bytes.
    """
    message: FromClass = _received(_class_codec.decode(frame, MAX_FRAME_BYTES), frame)
    return message

"""Every field of every message of our own protocol, with every odd value: a sentence, no more."""

import logging
import math
import random
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from functools import partial
from itertools import product
from typing import Any, NamedTuple

import msgpack
import pytest
from msgspec import Struct
from msgspec.structs import astuple, replace
from websockets.exceptions import ConnectionClosed

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.page.server.scripts import sockets
from ai4u_edu.remote.dialogue import Dialogue
from ai4u_edu.remote.percept import RemotePercept
from ai4u_edu.remote.spaces import action_space, observation_space
from ai4u_edu.remote.steps import Close, Open, Receive, Send
from ai4u_edu.wire import native
from ai4u_edu.wire.validation import WireError
from tests.fuzz.messages import KINDS, example
from tests.page.server.rooms import Room
from tests.remote.rooms import SECRET, Script, log_of, log_room
from tests.waiting import LIMIT_S, until

MAX_SENTENCE_CHARS = 1000


class Packed(NamedTuple):
    """A value that msgpack would not pack."""

    data: bytes


def nested(depth: int) -> Packed:
    """Lists in lists."""
    return Packed(b"\x91" * depth + b"\x01")


ODD: dict[str, Any] = {
    "nan": math.nan,
    "infinity": math.inf,
    "minus infinity": -math.inf,
    "largest float": 1.7e308,
    "smallest float": 5e-324,
    "a fraction": 0.5,
    "minus one": -1,
    "lowest int": -(2**63),
    "2**53": 2**53,
    "2**63 - 1": 2**63 - 1,
    "2**63": 2**63,
    "largest int": 2**64 - 1,
    "zero": 0,
    "true": True,
    "none": None,
    "no text": "",
    "long text": "x" * 30_000,
    "a zero in a text": "\0\x1b[31m\u202e",
    "no unicode": b"\xff\xfe",
    "long bytes": b"\xff" * 30_000,
    "empty list": [],
    "nan in a list": [math.nan],
    "largest int in a list": [2**64 - 1],
    "long list": [1.0] * 1024,
    "too long a list": [1.0] * 1025,
    "deep": nested(500),
    "too deep": nested(2000),
    "empty map": {},
    "nan in a map": {"log": [math.nan]},
    "infinity in a map": {"log": [math.inf]},
    "largest int in a map": {"log": [2**64 - 1]},
    "deep in a map": {"log": nested(500)},
    "a long row": {"log": [1.0] * 1000},
    "another name": {"lgo": [1.0]},
    "long name": {"x" * 20_000: [1.0]},
    "many names": {f"key {number}": [1.0] for number in range(1000)},
    "too many names": {f"key {number}": [1] for number in range(4000)},
    "numbers for names": {1: [1.0]},
    "a time": msgpack.Timestamp(1),
    "an extension": msgpack.ExtType(5, b"x" * 100),
}


class Bent(NamedTuple):
    """A frame with one odd value in it."""

    where: str
    frame: bytes


def bend(message: native.Message, path: tuple[Any, ...], what: str) -> Bent:
    """A message with an odd value at a place."""
    kind = type(message)
    where = ".".join([kind.__name__, kind.__struct_fields__[path[0]], *map(str, path[1:]), what])
    return Bent(where, pack([kind.__name__.lower(), *_put(as_tree(message), path, PACKED[what])]))


def bent_frames(message: native.Message) -> Iterator[Bent]:
    """Each field of a message, and of what is in it, with each odd value."""
    for what, path in product(ODD, _paths(as_tree(message))):
        yield bend(message, path, what)


def as_tree(value: Any) -> Any:
    """A message as tuples of its fields."""
    if isinstance(value, Struct):
        return tuple(map(as_tree, astuple(value)))
    return tuple(map(as_tree, value)) if isinstance(value, tuple) else value


def _paths(tree: Any) -> Iterator[tuple[Any, ...]]:
    pairs = tree.items() if isinstance(tree, Mapping) else enumerate(tree)
    for key, inner in pairs:
        yield (key,)
        if isinstance(inner, tuple | Mapping):
            for path in _paths(inner):
                yield (key, *path)


def _put(tree: Any, path: tuple[Any, ...], odd: Any) -> Any:
    """A copy with another value at a place."""
    key, *rest = path
    copy = dict(tree) if isinstance(tree, Mapping) else list(tree)
    copy[key] = _put(tree[key], tuple(rest), odd) if rest else odd
    return copy


def pack(value: Any) -> bytes:
    """Pack a value like msgpack does, without its limit on nesting depth."""
    packer = msgpack.Packer()
    if isinstance(value, Packed):
        return value.data
    if isinstance(value, list | tuple) and type(value) is not msgpack.ExtType:
        header: bytes = packer.pack_array_header(len(value))
        return header + b"".join(map(pack, value))
    if isinstance(value, Mapping):
        header = packer.pack_map_header(len(value))
        return header + b"".join(pack(key) + pack(inner) for key, inner in value.items())
    packed: bytes = packer.pack(value)
    return packed


PACKED = {what: Packed(pack(odd)) for what, odd in ODD.items()}


def numbers_in(value: Any, name: str = "") -> Iterator[tuple[str, float]]:
    """All numbers of a message, each with the name of its field."""
    if isinstance(value, Struct):
        for field in value.__struct_fields__:
            yield from numbers_in(getattr(value, field), field)
    elif isinstance(value, Mapping):
        for inner in value.values():
            yield from numbers_in(inner, name)
    elif isinstance(value, tuple):
        for inner in value:
            yield from numbers_in(inner, name)
    elif isinstance(value, int | float):
        yield name, value


def is_sane(message: native.Message) -> bool:
    """Return True if every number is usable; an action's numbers are checked by the world."""
    return all(
        math.isfinite(number) or name == "values" or (name in {"low", "high"} and abs(number) > 0)
        for name, number in numbers_in(message)
    )


@pytest.mark.parametrize("kind", KINDS)
def test_no_odd_value_gets_through(kind: type[native.Message]) -> None:
    count = 0
    for where, frame in bent_frames(example(kind, random.Random(3))):
        count += 1
        try:
            message = native.decode(frame, native.MAX_WORLD_FRAME_BYTES)
        except WireError as error:
            check_sentence(error, where)
        else:
            assert is_sane(message), where
            native.decode(native.encode(message), native.MAX_WORLD_FRAME_BYTES)
    assert count >= len(ODD)


# -- a world that hears them -----------------------------------------------------------------------


@pytest.fixture
def quiet(caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """A room says nothing in its log, and listens to as many odd frames as a test has."""
    monkeypatch.setattr(sockets, "MAX_STRAY_FRAMES_PER_S", 1_000_000)
    with caplog.at_level(logging.INFO):
        yield
    assert [each.getMessage() for each in caplog.records if each.levelno > logging.INFO] == []


def hear(script: Script) -> native.Message:
    """The next message; every sentence in it can be read."""
    message = script.hear()
    if isinstance(message, native.Problem):
        assert 0 < len(message.text) < MAX_SENTENCE_CHARS
    return message


def go_on(script: Script, percept: native.Percept) -> native.Percept:
    """Answers a percept; the next one, whatever else is said in between."""
    message: native.Message | None = None
    while not (isinstance(message, native.Percept) and message.seq > percept.seq):
        # once more after a refusal: the world hears one answer at a time
        if message is None or isinstance(message, native.Problem):
            if percept.truncated or percept.terminated:
                script.say(native.Reset(percept.seq, None))
            else:
                script.act(percept, 1)
        message = hear(script)
    return message


def begin(room: Room) -> tuple[Script, native.Percept]:
    """A script that has the agent."""
    script = Script(room)
    while isinstance(script.hello(), native.Problem):  # the one before has just said goodbye
        script.socket.close()
        script = Script(room)
    return script, script.percept()


def samples(percept: native.Percept) -> list[native.Message]:
    """Return valid messages of a script for tests to alter, and some that only a world may send."""
    seq, place = percept.seq, (percept.episode, percept.step)
    return [
        native.Action(*place, seq, {"log": (1.0,)}),
        native.Reset(seq, 7),
        native.Order(seq, "wait"),
        native.Problem("bad_action", "why", seq),
        native.Bye("enough"),
    ]


@pytest.mark.usefixtures("quiet")
@pytest.mark.parametrize("place", range(5), ids=["action", "reset", "order", "problem", "bye"])
def test_a_world_refuses_them_and_the_session_goes_on(place: int) -> None:
    with log_room() as room:
        script, percept = begin(room)
        for what, path in product(ODD, list(_paths(as_tree(samples(percept)[place])))):
            where, frame = bend(samples(percept)[place], path, what)
            script.socket.send(frame)
            try:
                percept = go_on(script, percept)
            except ConnectionClosed:
                assert where.startswith("Bye.reason"), where  # it is one, whatever the reason
                script, percept = begin(room)
            assert room.runner.error == "", where
        script.socket.close()
        assert all(0 <= number <= 1e9 for _, _, number in log_of(room))
        assert room.sim.world.seeds.seed < 2**63


@pytest.mark.usefixtures("quiet")
def test_a_world_refuses_an_odd_hello_and_hears_the_next_one(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(sockets, "MAX_MALFORMED_FRAMES", 1_000_000)
    right = native.Hello(native.VERSION, "a", "", "lockstep", ("id",), "", SECRET, "coast")
    with log_room(grace=0.0) as room:
        script = Script(room)
        for where, frame in [*bent_frames(right), Bent("right", native.encode(right))]:
            script.socket.send(frame)
            message = hear(script)
            if isinstance(message, native.Problem) and message.code == "bad_message":
                continue
            if isinstance(message, native.Problem):
                assert script.end()[0] == native.PROBLEMS[message.code], where
            else:
                assert isinstance(message, native.Welcome), where
                script.say(native.Bye("enough"))
                script.end()
                until(lambda: len(room.sim.agents[0].brains) == 1)
            script = Script(room)
        assert isinstance(message, native.Welcome)
        assert room.runner.error == ""
        script.socket.close()


# -- a script that hears them ----------------------------------------------------------------------

WELCOME = native.Welcome(
    version=native.VERSION,
    session="7",
    grace=LIMIT_S,
    agent="a",
    mode="lockstep",
    title="A room",
    ticks_per_second=60.0,
    skip_frame=0,
    repeat_action=True,
    max_steps=0,
    rewards=("pay",),
    success="",
    readings=(
        native.Reading("place", "box", "sfloatarray", "<f4", (2,), 0, bytes(4), bytes(4), "", True),
        native.Reading("count", "discrete", "sint", "<i4", (), 8, bytes(4), b"\1\0\0\0", "", True),
        native.Reading("id", "text", "sstring", "", (9,), 0, b"", b"", "", False),
    ),
    outputs=(
        native.Output("log", "box", (0.0,), (1.0,), True),
        native.Output("pick", "discrete", (0.0,), (3.0,), True),
    ),
)
PERCEPT = native.Percept(
    1, 0, 1, 0, 0.5, {"pay": 0.5}, False, False, False, False, bytes(12), ("a",)
)


class World:
    """The other end of a dialogue: says the frames that it is given, one at each question."""

    def __init__(self) -> None:
        self.dialogue = Dialogue("a", patience=LIMIT_S)  # none of it is waited for
        self.frames: list[bytes] = []

    def run(self, flow: Any) -> Any:
        """Carries out what a dialogue wants; what it comes to, None if it would wait for ever."""
        came: Any = None
        while True:
            try:
                step = flow.send(came)
            except StopIteration as end:
                return end.value
            came = None
            match step:
                case Receive():
                    if not self.frames:
                        flow.close()
                        return None
                    came = self.frames.pop(0)
                case Send() | Open() | Close():
                    pass

    def begin(self, welcome: bytes) -> None:
        self.frames = [welcome]
        self.run(self.dialogue.begin())


def check_sentence(error: AI4UError, where: str) -> None:
    assert 0 < len(str(error)) < MAX_SENTENCE_CHARS, where


def test_a_script_refuses_an_odd_welcome_in_a_sentence() -> None:
    for where, frame in bent_frames(WELCOME):
        world = World()
        try:
            world.begin(frame)
            world.frames = [native.encode(PERCEPT)]
            percept = world.run(world.dialogue.sense())
        except AI4UError as error:
            check_sentence(error, where)
            continue
        use_all(world.dialogue, percept)


def use_all(dialogue: Dialogue, percept: RemotePercept) -> None:
    """Reads all readings, and makes the spaces; or is told in a sentence why that can't be."""
    uses: list[Callable[[], object]] = [partial(percept.__getitem__, key) for key in percept]
    readings = dialogue.readings.values()
    uses += [partial(observation_space, readings, form) for form in ("dict", "flat")]
    uses.append(partial(action_space, dialogue.outputs))
    for use in uses:
        with suppress(AI4UError):
            use()


@pytest.mark.parametrize(
    "message", [PERCEPT, native.Problem("bad_action", "why", 1), native.Bye("enough")]
)
def test_a_script_refuses_odd_messages_and_hears_the_next_percept(message: native.Message) -> None:
    for where, frame in bent_frames(message):
        world = World()
        world.begin(native.encode(WELCOME))
        world.frames = [frame, native.encode(replace(PERCEPT, seq=9))]
        try:
            percept = world.run(world.dialogue.sense())
        except AI4UError as error:
            check_sentence(error, where)
            if str(error).startswith("the world has ended the session"):
                continue
            percept = world.run(world.dialogue.sense())
        use_all(world.dialogue, percept)
        if percept.seq < 9:
            assert math.isfinite(percept.reward), where
            assert all(map(math.isfinite, percept.reward_terms.values())), where

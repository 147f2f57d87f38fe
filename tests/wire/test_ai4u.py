"""AI4U's datagrams, in both directions, and what is none."""

import contextlib
import io
import zlib
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ai4u_edu.wire.agent_codec import grey_png
from ai4u_edu.wire.ai4u import (
    MAX_DATAGRAM_BYTES,
    Field,
    Kind,
    ReplyCommand,
    decode_reply,
    decode_request,
    encode_reply,
    encode_request,
    floats,
    number,
)
from ai4u_edu.wire.ai4u_dialogue import AI4UDialogue, ReplyKind, SentState, SessionPhase
from ai4u_edu.wire.validation import WireError

EVERY_KIND = (
    Field("reward", Kind.FLOAT, -0.1),
    Field("steps", Kind.INT, -7),
    Field("done", Kind.BOOL, True),
    Field("truncated", Kind.BOOL, False),
    Field("id", Kind.TEXT, "Zoë @ 0;1"),
    Field("raw", Kind.BYTES, bytes(range(256))),
    Field("eyes", Kind.FLOATS, np.array([0.1, 1e-7, -3e38], np.float32)),
    Field("codes", Kind.INTS, np.array([300, -4])),
    Field("pictures", Kind.TEXTS, ["aGk=", "eQ=="]),
)


def test_every_kind_comes_back() -> None:
    for before, after in zip(EVERY_KIND, decode_request(encode_request(EVERY_KIND)), strict=True):
        assert (after.name, after.kind) == (before.name, before.kind)
        if isinstance(before.value, np.ndarray):
            assert after.value.astype(before.value.dtype).tolist() == before.value.tolist()
        else:
            assert after.value == before.value


def test_a_request_byte_by_byte() -> None:
    request = encode_request([Field("ü", Kind.TEXT, "é!"), Field("x", Kind.FLOATS, [0.5, 2])])
    assert request == "   2   2ü3       3é!   1x5       50.5 2".encode()


@given(st.lists(st.floats(width=32, allow_nan=False, allow_infinity=False), max_size=20))
def test_floats_come_back_as_the_same_float32(numbers: list[float]) -> None:
    sent = np.array(numbers, np.float32)
    read = [float(part) for part in floats(sent).split()]
    assert np.array(read, np.float32).tobytes() == sent.tobytes()


@pytest.mark.parametrize("kind", ["<f4", ">f4", "<f8", "<i8", "|u1", "|b1"])
@pytest.mark.parametrize("shape", [(), (0,), (5,), (0, 40), (4, 0), (3, 2), (3, 2, 40)])
def test_rows_are_written_as_if_they_stood_alone(shape: tuple[int, ...], kind: str) -> None:
    numbers = (np.arange(np.prod(shape, dtype=int)).reshape(shape) % 97).astype(kind)
    written = " ".join(f"{each:.9g}" for each in numbers.ravel().tolist())
    assert floats(numbers) == written
    assert floats(np.roll(numbers, 1)) != written or numbers.size < 2
    assert floats(numbers) == written


def test_the_same_bytes_are_other_numbers_in_another_type() -> None:
    numbers = np.ones((2, 32), np.int64)
    assert floats(numbers) == " ".join(["1"] * 64)
    assert floats(numbers.view(np.float64)) == " ".join(["4.94065646e-324"] * 64)


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_a_reward_comes_back_as_the_same_double(reward: float) -> None:
    (field,) = decode_request(encode_request([Field("reward", Kind.FLOAT, reward)]))
    assert field.value == reward


@pytest.mark.parametrize("value", [float("nan"), float("inf"), "much", None])
def test_what_is_no_number_is_not_sent(value: Any) -> None:
    with pytest.raises(WireError, match=r"field 'reward': .* is no FLOAT"):
        encode_request([Field("reward", Kind.FLOAT, value)])


def test_what_does_not_fit_into_a_datagram_says_what_to_do() -> None:
    big = Field("grid", Kind.FLOATS, np.ones(40_000))
    with pytest.raises(WireError, match="at most 65507 bytes, got 80020: make sensors that read"):
        encode_request([big])


@pytest.mark.parametrize(
    ("data", "says"),
    [
        (b"", "expected the number of fields in 4 characters, got b''"),
        (b"   1", "expected the length of a name in 4 characters, got b''"),
        (b"  -1", "expected the number of fields in 4 characters, got b'  -1'"),
        (b"   1   9id", "expected 9 bytes for a name, got 2"),
        (b"   1   2\xff\xfe3       10", "expected UTF-8 for a name, got b'\\xff\\xfe'"),
        (b"   1   2id8       10", "'id': expected a type from 0 to 7, got 8"),
        (b"   1   2id0       3abc", "'id': expected FLOAT, got 'abc'"),
        (b"   1   2id0       30,5", "'id': expected FLOAT, got '0,5'"),
        (b"   1   2id1       31.5", "'id': expected INT, got '1.5'"),
        (b"   1   2id2       12", "'id': expected BOOL, got '2'"),
        (b"   1   2id4       3abc", "'id': expected BYTES, got 'abc'"),
        (b"   1   2id5       5a b c", "'id': expected FLOATS, got 'a b c'"),
        (b"   0?", "expected the end after 0 fields, got 1 bytes more"),
        (b"   0" + bytes(MAX_DATAGRAM_BYTES), "expected at most 65507 bytes, got 65511"),
    ],
)
def test_what_is_no_request(data: bytes, says: str) -> None:
    with pytest.raises(WireError) as error:
        decode_request(data)
    assert str(error.value) == says


@pytest.mark.parametrize(
    ("data", "orders"),
    [
        (b"halt", [ReplyCommand("halt")]),
        (b"__noop__;1;0", [ReplyCommand("__noop__", ("0",))]),
        (b"__noop__;0;", [ReplyCommand("__noop__")]),
        (b"__noop__;0", [ReplyCommand("__noop__")]),
        (
            b"max_steps;1;0@id;1;0\n",
            [ReplyCommand("max_steps", ("0",)), ReplyCommand("id", ("0",))],
        ),
        (b"move;2;1.0;-1e-05", [ReplyCommand("move", ("1.0", "-1e-05"))]),
    ],
)
def test_replies(data: bytes, orders: list[ReplyCommand]) -> None:
    assert decode_reply(data) == orders


@pytest.mark.parametrize(
    ("data", "says"),
    [
        (b"", "expected a command as in 'move;2;1.0;0.5', got ''"),
        (b"move", "expected a command as in 'move;2;1.0;0.5', got 'move'"),
        (b";1;0", "expected a command as in 'move;2;1.0;0.5', got ';1;0'"),
        (b"move;-1;0", "expected a command as in 'move;2;1.0;0.5', got 'move;-1;0'"),
        (b"move;2;1", "'move': expected 2 arguments as it says, got 1"),
        (b"move;1;1;2", "'move': expected 1 arguments as it says, got 2"),
        (b"move;1;1@", "expected a command as in 'move;2;1.0;0.5', got ''"),
        (b"\xff\xfe", "expected a reply in UTF-8, got b'\\xff\\xfe'"),
        (bytes(MAX_DATAGRAM_BYTES + 1), "expected at most 65507 bytes, got 65508"),
    ],
)
def test_what_is_no_reply(data: bytes, says: str) -> None:
    with pytest.raises(WireError) as error:
        decode_reply(data)
    assert str(error.value) == says


def test_a_reply_comes_back() -> None:
    orders = [ReplyCommand("move", ("1.0", "0")), ReplyCommand("speed", ())]
    assert decode_reply(encode_reply(orders)) == orders
    assert encode_reply([ReplyCommand("halt")]) == b"halt"


@given(st.binary(max_size=200))
def test_garbage_raises_nothing_else(data: bytes) -> None:
    for decode in (decode_request, decode_reply):
        with contextlib.suppress(WireError):
            decode(data)


@given(st.data())
def test_a_damaged_request_raises_nothing_else(data: st.DataObject) -> None:
    request = bytearray(encode_request(EVERY_KIND))
    for _ in range(data.draw(st.integers(1, 4))):
        place = data.draw(st.integers(0, len(request) - 1))
        request[place] = data.draw(st.integers(0, 255))
    with contextlib.suppress(WireError):
        decode_request(bytes(request))


@pytest.mark.parametrize("text", ["1_0", "0x1", "", "one", "1,5", "--1", "٣"])
def test_what_is_no_number(text: str) -> None:
    with pytest.raises(WireError, match="expected a number, got"):
        number(text)


def test_a_picture_can_be_read_by_others() -> None:
    picture = np.arange(12, dtype=np.uint8).reshape(3, 4)
    data = io.BytesIO(grey_png(picture))
    assert data.read(16)[8:] == b"\x00\x00\x00\rIHDR"
    assert data.read(13) == bytes([0, 0, 0, 4, 0, 0, 0, 3, 8, 0, 0, 0, 0])
    data.read(4)
    size = int.from_bytes(data.read(4))
    assert data.read(4) == b"IDAT"
    rows = np.frombuffer(zlib.decompress(data.read(size)), np.uint8).reshape(3, 5)
    assert rows[:, 1:].tolist() == picture.tolist()
    assert rows[:, 0].tolist() == [0, 0, 0]


# -- the dialogue ----------------------------------------------------------------------------------

STATE = SentState(sensors=[], reward=0.5, steps=3, done=False, truncated=False)


def asked(dialogue: AI4UDialogue, state: SentState | None = None) -> dict[str, Any]:
    return {field.name: field.value for field in decode_request(dialogue.request(state))}


def playing() -> AI4UDialogue:
    dialogue = AI4UDialogue("0", metadata="{}")
    for reply in (b"__noop__;1;0", b"max_steps;1;0@id;1;0", b"__reset__;1;0"):
        dialogue.request(None)
        dialogue.parse_reply(reply)
    assert dialogue.phase.value == "playing"
    return dialogue


def test_a_session_from_its_beginning() -> None:
    dialogue = AI4UDialogue("7", metadata='{"inputs": []}', max_steps=300, skip_frame=8)
    poll = {
        "__target__": "envcontrol",
        "wait_command": "restart, resume, start_and_reset, start",
        "id": "7",
    }
    assert asked(dialogue) == poll | {"": ""}
    assert dialogue.parse_reply(b"__noop__;1;0").kind is ReplyKind.NOOP
    assert asked(dialogue) == {
        "__target__": "envcontrol",
        "max_steps": 300,
        "id": "7",
        "modelmetadata": '{"inputs": []}',
        "config": 1,
    }
    assert dialogue.parse_reply(b"max_steps;1;300@id;1;7").kind is ReplyKind.CONFIGURED
    assert asked(dialogue) == poll | {"": ""}
    dialogue.parse_reply(b"__noop__;1;0")
    assert asked(dialogue) == poll | {"__noop__": "__noop__"}
    assert dialogue.parse_reply(b"__start_agent__;1;0").kind is ReplyKind.START
    assert asked(dialogue, STATE)["done"] is True  # it waits for a reset
    assert dialogue.parse_reply(b"__waitnewaction__;1;0").kind is ReplyKind.WAIT
    assert dialogue.phase.value == "started"
    dialogue.request(STATE)
    assert dialogue.parse_reply(b"__restart__;1;0").kind is ReplyKind.RESET
    assert asked(dialogue, STATE) == {
        "done": False,
        "reward": 0.5,
        "steps": 3,
        "truncated": False,
        "__ctrl_paused__": False,
        "__ctrl_stopped__": False,
        "id": "7",
        "__ctrl_applyingAction__": False,
        "__ctrl_frameCounter__": 0,
        "__ctrl_skipFrame__": 8,
        "__ctrl_repeatAction__": True,
        "__ctrl_envMode__": False,
    }
    heard = dialogue.parse_reply(b"move;1;0.5@note;1;hello")
    assert (heard.kind, heard.orders[1]) == (ReplyKind.ACTION, ReplyCommand("note", ("hello",)))
    dialogue.request(STATE)
    assert dialogue.parse_reply(b"__envcontrol__;1;0").kind is ReplyKind.CONTROL
    assert dialogue.phase.value == "polling"
    assert decode_request(dialogue.goodbye_request())[1] == Field("__stop__", Kind.TEXT, "stop")
    assert dialogue.parse_reply(b"halt").kind is ReplyKind.HALT


def test_fields_of_a_reset_that_answers_the_first_request_count_after_the_handshake() -> None:
    dialogue = AI4UDialogue("0", metadata="{}")
    dialogue.request(None)
    dialogue.parse_reply(b"__restart__;0;@goalDist;1;3")
    dialogue.request(None)
    heard = dialogue.parse_reply(b"max_steps;1;0@id;1;0")
    assert heard.kind is ReplyKind.RESET
    assert [order.name for order in heard.orders] == ["__restart__", "goalDist"]


def test_a_warning_is_one_more_field() -> None:
    plain = asked(playing(), STATE)
    warned = asked(playing(), STATE._replace(warning="field 'x' had no effect"))
    assert warned == plain | {"__warning__": "field 'x' had no effect"}


def test_who_asks_for_time_is_told_the_same_again() -> None:
    dialogue = playing()
    request = dialogue.request(STATE)
    dialogue.parse_reply(b"__waitnewaction__;1;0")
    assert dialogue.request(STATE) is request
    dialogue.parse_reply(b"move;1;1")
    assert asked(dialogue, STATE._replace(steps=4))["steps"] == 4


def test_what_can_not_be_told_is_not_told_as_something_else() -> None:
    dialogue = playing()
    dialogue.request(STATE)
    odd = STATE._replace(reward=float("nan"))
    for _ in range(2):
        with pytest.raises(WireError, match="field 'reward': nan is no FLOAT"):
            dialogue.request(odd)


@pytest.mark.parametrize(
    ("first", "phase", "word"),
    [
        (b"__start_agent__;1;0", SessionPhase.STARTED, ReplyKind.START),
        (b"__reset__;1;0", SessionPhase.PLAYING, ReplyKind.RESET),
    ],
)
def test_what_a_script_says_to_a_knock_it_means(
    first: bytes, phase: SessionPhase, word: ReplyKind
) -> None:
    dialogue = AI4UDialogue("0", metadata="{}")
    dialogue.request(None)
    dialogue.parse_reply(first)
    dialogue.request(None)
    assert dialogue.parse_reply(b"max_steps;1;0@id;1;0").kind is word
    assert dialogue.phase is phase


@pytest.mark.parametrize("word", ["__pause__", "__resume__", "__stop__", "__noop__"])
def test_commands_while_playing(word: str) -> None:
    dialogue = playing()
    dialogue.request(STATE)
    assert dialogue.parse_reply(f"{word};1;0".encode()).kind.value == word
    assert dialogue.phase.value == "playing"
    assert not dialogue.in_flight


def test_after_a_stop_the_script_is_not_told_to_stop() -> None:
    dialogue = playing()
    for reply in (b"__stop__;1;0", b"__envcontrol__;1;0"):
        dialogue.request(STATE)
        dialogue.parse_reply(reply)
    dialogue._last = "__stop__"
    assert "__stop__" not in asked(dialogue)


@pytest.mark.parametrize("reply", [b"max_steps;1;0@id;1;0", b"__start_agent__;1;0", b"?"])
def test_what_can_not_be_said_while_playing_is_not_heard(reply: bytes) -> None:
    dialogue = playing()
    dialogue.request(STATE)
    with pytest.raises(WireError):
        dialogue.parse_reply(reply)
    assert dialogue.in_flight
    dialogue.parse_reply(b"move;1;0")
    assert not dialogue.in_flight


def test_a_greeting_for_another_agent_is_not_heard() -> None:
    dialogue = AI4UDialogue("0", metadata="{}")
    dialogue.request(None)
    dialogue.parse_reply(b"__noop__;1;0")
    dialogue.request(None)
    with pytest.raises(WireError, match="expected an answer for agent '0'"):
        dialogue.parse_reply(b"max_steps;1;0@id;1;1")

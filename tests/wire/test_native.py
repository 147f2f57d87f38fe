"""Our own frames: what goes in comes out, and nothing but a message is let through."""

import random
from contextlib import suppress
from typing import Any

import msgpack
import msgspec
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ai4u_edu.base.errors import text_of
from ai4u_edu.base.seeding import MAX_SEED
from ai4u_edu.locale import Catalogue
from ai4u_edu.wire.native import (
    MAX_GRACE_S,
    MAX_READING_CHARS,
    MAX_SCRIPT_FRAME_BYTES,
    MAX_WORLD_FRAME_BYTES,
    Action,
    Bye,
    Hello,
    Message,
    Order,
    Output,
    Percept,
    Problem,
    Reading,
    Reset,
    Welcome,
    decode,
    encode,
)
from ai4u_edu.wire.validation import WireError

numbers = st.integers(0, 2**53 - 1)
floats = st.floats(allow_nan=False, allow_infinity=False)
names = st.text(max_size=20)
readings = st.builds(
    Reading,
    names,
    st.sampled_from(["box", "discrete", "text"]),
    names,
    st.sampled_from(["<f4", "<i4", "|b1", "|u1", ""]),
    st.lists(st.integers(0, MAX_WORLD_FRAME_BYTES), max_size=4).map(tuple),
    numbers,
    st.binary(max_size=20),
    st.binary(max_size=20),
    names,
    st.booleans(),
)
rows = st.lists(st.floats(allow_nan=False), max_size=4).map(tuple)
outputs = st.builds(Output, names, st.sampled_from(["box", "discrete"]), rows, rows, st.booleans())
modes = st.sampled_from(["lockstep", "realtime"])
texts = st.lists(names, max_size=3).map(tuple)
messages: st.SearchStrategy[Message] = st.one_of(
    st.builds(Hello, numbers, names, names, modes, texts, names, names),
    st.builds(
        Hello,
        numbers,
        names,
        names,
        modes,
        texts,
        names,
        names,
        st.sampled_from(["", "hold", "coast", "stop"]),
    ),
    st.builds(
        Welcome,
        numbers,
        names,
        st.floats(0.0, MAX_GRACE_S),
        names,
        modes,
        names,
        st.floats(0.0, 1e300),
        numbers,
        st.booleans(),
        numbers,
        texts,
        names,
        st.lists(readings, max_size=3).map(tuple),
        st.lists(outputs, max_size=3).map(tuple),
    ),
    st.builds(
        Percept,
        numbers,
        numbers,
        numbers,
        numbers,
        floats,
        st.dictionaries(names, floats, max_size=3),
        st.booleans(),
        st.booleans(),
        st.booleans(),
        st.booleans(),
        st.binary(max_size=200),
        texts,
    ),
    st.builds(Action, numbers, numbers, numbers, st.dictionaries(names, rows, max_size=3)),
    st.builds(Reset, numbers, st.none() | st.integers(0, MAX_SEED)),
    st.builds(Order, numbers, st.sampled_from(["pause", "resume", "stop", "wait"])),
    st.builds(Problem, names, names, numbers),
    st.builds(Bye, names),
)


@given(messages)
def test_what_goes_in_comes_out(message: Message) -> None:
    assert decode(encode(message), MAX_WORLD_FRAME_BYTES) == message


@pytest.mark.parametrize(
    ("parts", "complaint"),
    [
        (7, "expected a message (hello, welcome, percept, action, reset, order, problem, bye), got "
            "None"),
        (["rest"], "expected a message (hello, welcome, percept, action, reset, order, problem, "
                   "bye), got 'rest'"),
        (["order", 1, "sit"], "word: expected one of 'pause', 'resume', 'stop', 'wait', got 'sit'"),
        (["reset", 1], "expected 2 to 3 fields (seq, seed, fields), got 1"),
        (["reset", -1, None], "seq: expected a whole number from 0 on, got -1"),
        (["reset", True, None], "seq: expected a whole number from 0 on, got True"),
        (["reset", 2**53, None], "seq: expected a whole number from 0 to 9007199254740991, got "
                                 "9007199254740992"),
        (["reset", 1, 2**63], "seed: expected a whole number from 0 to 9223372036854775807, got "
                              "9223372036854775808"),
        (["percept", 1, 0, 1, 0, float("nan"), {}, False, False, False, False, b"", []],
         "reward: expected a finite number, got nan"),
        (["hello", 1], "expected 7 to 8 fields (version, agent, token, mode, keys, session, "
                       "secret, on_missing), got 1"),
        (["reset", 1, 0.5], "seed: expected a whole number from 0 on, got 0.5"),
        (["bye", "x" * 401], "reason: expected text of up to 400 characters, got "
                             "'xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx..."),
        (["bye", b"bytes"], "reason: expected text of up to 400 characters, got b'bytes'"),
        (["action", 1, 0, 1, [["move", [1]]]], "values: expected names and values, up to 1024, "
                                               "got [['move', [1]]]"),
        (["action", 1, 0, 1, {"move": "fast"}], "values: expected a list of up to 1024, "
                                                "got 'fast'"),
        (["action", 1, 0, 1, {"move": [None]}], "values: expected a number, got None"),
        (["action", 1, 0, 1, {"move": [True]}], "values: expected a number, got True"),
        (["hello", 1, "", "", "slow", [], "", ""], "mode: expected one of 'lockstep', 'realtime', "
                                                   "got 'slow'"),
        (["percept", 1, 0, 1, 0, 0.0, {}, 0, False, False, False, b"", []],
         "terminated: expected true or false, got 0"),
    ],
)  # fmt: skip
def test_what_is_no_message_is_explained(parts: Any, complaint: str) -> None:
    with pytest.raises(WireError) as caught:
        decode(msgpack.packb(parts))
    assert str(caught.value) == complaint


@pytest.mark.parametrize(
    "frame",
    [
        b"",
        b"\xc1",
        b"\x92\xa3bye",
        b"\x92\xa3bye\xa1\xff",  # no UTF-8
        b"\x91" * 3000,  # deep
        b"\xdd\xff\xff\xff\xff",  # four thousand million entries, it says
        b"\x92\xa3bye\xd6\xff\x00\x00\x00\x00",  # a time
        b"\x92\xa3bye\xc7\x00\x05",  # an extension
        b"\x81\x90\x01",
        encode(Bye("x")) + b"\x00",
    ],
)
def test_other_bytes_are_a_wire_error(frame: bytes) -> None:
    with pytest.raises(WireError):
        decode(frame)


def test_a_frame_has_a_size() -> None:
    frame = encode(Bye("x")) + bytes(MAX_SCRIPT_FRAME_BYTES)
    with pytest.raises(WireError, match=f"expected at most {MAX_SCRIPT_FRAME_BYTES} bytes, got "):
        decode(frame)


def test_a_text_that_is_no_unicode_does_not_stop_the_world() -> None:
    assert decode(encode(Bye("\ud800"))) == Bye("?")


@settings(max_examples=50)
@given(messages, st.integers(0, 2**32))
def test_nothing_else_is_ever_raised(message: Message, seed: int) -> None:
    rng = random.Random(seed)
    whole = encode(message)
    for _ in range(100):
        frame = bytearray(whole)
        for _ in range(rng.randint(1, 4)):
            place = rng.randrange(len(frame) + 1)
            match rng.randrange(3):
                case 0:
                    frame[place:place] = rng.randbytes(rng.randint(1, 5))
                case 1:
                    del frame[place : place + rng.randint(1, 5)]
                case _:
                    frame[place : place + 1] = rng.randbytes(1)
        with suppress(WireError):
            decode(bytes(frame), MAX_WORLD_FRAME_BYTES)


OLD_HELLO = ("hello", 1, "red", "", "lockstep", (), "", "s" * 20)
"""Hello of version 1 before the field ``on_missing`` was added."""


def test_a_field_that_came_later_is_said_only_if_it_is_not_the_default() -> None:
    hello = Hello(*OLD_HELLO[1:])  # type: ignore[arg-type]  # each field has its own type
    assert decode(msgpack.packb(OLD_HELLO)) == hello
    assert encode(hello) == msgpack.packb(OLD_HELLO)
    newer = msgspec.structs.replace(hello, on_missing="coast")
    assert encode(newer) == msgpack.packb((*OLD_HELLO, "coast"))
    assert decode(encode(newer)) == newer


def test_a_sentence_that_is_too_long_for_a_message_is_cut() -> None:
    problem = decode(encode(Problem("bad_action", "x" * 10_000, 1)))
    assert isinstance(problem, Problem)
    assert problem.text == "x" * (MAX_READING_CHARS - 3) + "..."
    assert decode(encode(Bye("x" * 10_000))) == Bye("x" * 397 + "...")


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        (["reset", -1, None], "seq: o esperado é um número inteiro a partir de 0, mas veio -1"),
        (["oops"], "era esperada uma mensagem (hello, "),
        (["problem", 1], "o esperado são 3 campos (code, text, seq), mas vieram 1"),
    ],
)
def test_a_mistake_is_told_in_the_readers_language(fields: list[object], said: str) -> None:
    with pytest.raises(WireError) as raised:
        decode(msgspec.msgpack.encode(fields))
    assert said in Catalogue("pt_BR").translate(text_of(raised.value))

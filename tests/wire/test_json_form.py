"""The same messages as JSON: what goes in comes out, and numbers that JSON lacks are refused."""

import json
import math
from contextlib import suppress
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ai4u_edu.wire.json_form import JsonForm
from ai4u_edu.wire.native import (
    MAX_READING_CHARS,
    MAX_WORLD_FRAME_BYTES,
    Action,
    Message,
    Output,
    Percept,
    Reading,
    Reset,
    Welcome,
    decode,
    encode,
)
from ai4u_edu.wire.texts import pack_texts
from ai4u_edu.wire.validation import WireError
from tests.wire.test_native import floats, messages, names, numbers

BOUND = st.floats(width=32, allow_nan=False, allow_infinity=False)
KINDS = {"<f4": BOUND, "<i4": st.integers(-(2**31), 2**31 - 1)}
KINDS |= {"|u1": st.integers(0, 255), "|b1": st.booleans()}
shapes = st.lists(st.integers(1, 4), max_size=3).map(tuple)
low_rows = st.lists(st.floats(allow_nan=False, max_value=1e308), max_size=4).map(tuple)
high_rows = st.lists(st.floats(allow_nan=False, min_value=-1e308), max_size=4).map(tuple)
outputs = st.builds(
    Output, names, st.sampled_from(["box", "discrete"]), low_rows, high_rows, st.booleans()
)


@st.composite
def described(draw: st.DrawFn) -> tuple[Welcome, Percept]:
    """Draw a welcome, and a percept that it describes."""
    readings: list[Reading] = []
    data, texts = b"", list[str]()
    for key in draw(st.lists(names, unique=True, max_size=4)):
        dtype = draw(st.sampled_from(["", *KINDS]))
        if not dtype:
            is_several = draw(st.booleans())
            said = draw(st.lists(names, max_size=3))
            text = pack_texts(said, MAX_READING_CHARS) if is_several else draw(names)
            kind = "sstrings" if is_several else "sstring"
            readings.append(
                Reading(key, "text", kind, "", (80,), len(texts), b"", b"", "", draw(st.booleans()))
            )
            texts.append(text)
            continue
        shape = draw(shapes)
        values = [draw(KINDS[dtype]) for _ in range(math.prod(shape))]
        low, high = (np.array([draw(KINDS[dtype])], dtype) for _ in range(2))
        if dtype == "<f4" and draw(st.booleans()):
            low, high = np.array([-np.inf], dtype), np.array([np.inf], dtype)
        readings.append(
            Reading(
                key,
                "box",
                "simage" if len(shape) > 1 else "sfloatarray",
                dtype,  # type: ignore[arg-type]  # one of its values
                shape,
                len(data),
                low.tobytes(),
                high.tobytes(),
                "m",
                draw(st.booleans()),
            )
        )
        data += np.array(values, dtype).tobytes()
    welcome = Welcome(
        draw(numbers),
        draw(names),
        draw(st.floats(0.0, 100.0)),
        draw(names),
        draw(st.sampled_from(("lockstep", "realtime"))),
        draw(names),
        draw(st.floats(0.0, 1e300)),
        draw(numbers),
        draw(st.booleans()),
        draw(numbers),
        tuple(draw(st.lists(names, max_size=3))),
        draw(names),
        tuple(readings),
        tuple(draw(st.lists(outputs, max_size=3))),
    )
    percept = Percept(
        draw(numbers),
        draw(numbers),
        draw(numbers),
        draw(numbers),
        draw(floats),
        draw(st.dictionaries(names, floats, max_size=3)),
        draw(st.booleans()),
        draw(st.booleans()),
        draw(st.booleans()),
        draw(st.booleans()),
        data,
        tuple(texts),
    )
    return welcome, percept


def there_and_back(form: JsonForm, message: Message) -> Message:
    text = form.text_of(encode(message))
    strict = json.loads(text, parse_constant=pytest.fail)
    assert strict["type"] == type(message).__name__.lower()
    return decode(form.frame_of(text.encode()), MAX_WORLD_FRAME_BYTES)


@given(messages.filter(lambda each: not isinstance(each, Welcome | Percept | Action)))
def test_what_goes_in_comes_out(message: Message) -> None:
    assert there_and_back(JsonForm(), message) == message


@given(st.dictionaries(names, st.lists(floats, max_size=4).map(tuple), max_size=3))
def test_an_action_comes_out_as_it_went_in(values: dict[str, tuple[float, ...]]) -> None:
    action = Action(1, 2, 3, values)
    assert there_and_back(JsonForm(), action) == action


@given(described())
def test_a_percept_comes_out_as_its_welcome_describes_it(drawn: tuple[Welcome, Percept]) -> None:
    welcome, percept = drawn
    form = JsonForm()
    assert there_and_back(form, welcome) == welcome
    assert there_and_back(form, percept) == percept


def form_of(*readings: Reading) -> JsonForm:
    form = JsonForm()
    welcome = Welcome(
        1, "s", 3.0, "a", "realtime", "A room", 60.0, 0, True, 0, (), "", readings, ()
    )
    form.text_of(encode(welcome))
    return form


def percept(data: bytes, texts: tuple[str, ...] = (), reward: float = 0.0) -> bytes:
    return encode(Percept(1, 0, 1, 0, reward, {}, False, False, False, False, data, texts))


def packed(*numbers: float) -> bytes:
    return np.array(numbers, np.float32).tobytes()


def array(key: str, dtype: Any, *shape: int) -> Reading:
    return Reading(key, "box", "simage", dtype, shape, 0, b"", b"", "", True)


def test_a_picture_is_nested_lists() -> None:
    form = form_of(array("camera", "|u1", 2, 3))
    said = json.loads(form.text_of(percept(bytes(range(6)))))
    assert said["readings"] == {"camera": [[0, 1, 2], [3, 4, 5]]}
    assert not {"data", "texts"} & said.keys()


def test_a_missing_bound_is_null() -> None:
    low, high = packed(-np.inf, 0), packed(np.inf, 1)
    reading = Reading("place", "box", "sfloatarray", "<f4", (2,), 0, low, high, "", True)
    welcome = Welcome(
        1, "s", 3.0, "a", "realtime", "A room", 60.0, 0, True, 0, (), "", (reading,),
        (Output("log", "box", (-math.inf,), (math.inf,), True),),
    )  # fmt: skip
    said = json.loads(JsonForm().text_of(encode(welcome)))
    assert (said["readings"][0]["low"], said["readings"][0]["high"]) == ([None, 0], [None, 1])
    assert (said["outputs"][0]["low"], said["outputs"][0]["high"]) == ([None], [None])


@pytest.mark.parametrize("number", [math.nan, math.inf, -math.inf])
def test_a_number_that_json_lacks_is_not_sent(number: float) -> None:
    form = form_of(array("place", "<f4", 1))
    with pytest.raises(WireError) as caught:
        form.text_of(percept(packed(number)))
    assert str(caught.value) == (
        f"place: expected finite numbers, got [{number}]; JSON has no NaN and no infinity"
    )
    with pytest.raises(WireError, match=r"^values: expected a finite number, got "):
        form.text_of(encode(Action(1, 0, 1, {"log": (number,)})))


def test_a_bound_that_no_number_reaches_is_not_sent() -> None:
    output = Output("log", "box", (math.inf,), (math.inf,), True)
    welcome = Welcome(1, "s", 3.0, "a", "realtime", "", 60.0, 0, True, 0, (), "", (), (output,))
    with pytest.raises(WireError, match=r"^low: expected a finite number, got inf; JSON has"):
        JsonForm().text_of(encode(welcome))


ACTION = '{"type":"action","episode":1,"step":0,"seq":1,"values":'


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        (ACTION + '{"log":[null]}}', "values: 'log': expected finite numbers, got null; JSON has "
                                     "no NaN and no infinity"),
        (ACTION + '{"log":[NaN]}}', "expected JSON, got b'{\"type\":\"action\""),
        (ACTION + '{"log":[NaN]}}', "; JSON has no NaN and no infinity"),
        (ACTION + '{"log":[-Infinity]}}', "; JSON has no NaN and no infinity"),
        (ACTION + '{"log":[1e999]}}', "Number out of range"),
        (ACTION + '{"log":"fast"}}', "values: expected a list of up to 1024, got 'fast'"),
        (ACTION + '["log"]}', "values: expected names and values, up to 1024, got ['log']"),
        ("7", "expected an object with a type (hello, welcome, percept, action, reset, order, "
              "problem, bye), got None"),
        ('{"type":"rest"}', "got 'rest'"),
        ('{"type":["reset"]}', "got ['reset']"),
        ('{"type":"reset","sq":1,"seed":null}', "reset: no field is called 'sq'; did you mean "
                                                "'seq'?"),
        ('{"type":"reset","seq":1}', "reset: expected the fields seq, seed, fields; missing: seed"),
        ('{"type":"reset","seq":-1,"seed":null}', "expected a whole number from 0 on, got -1"),
        ('{"type":"reset","seq":' + "9" * 40 + ',"seed":null}', "numbers of up to 64 bits"),
        ('{"type":"bye","reason":"\\ud800"}', "expected JSON, got"),
        ("[" * 5000, "expected JSON, got"),
        ("", "expected JSON, got b''"),
    ],
)  # fmt: skip
def test_what_is_no_message_is_explained(text: str, complaint: str) -> None:
    with pytest.raises(WireError) as caught:
        decode(JsonForm().frame_of(text.encode()))
    assert complaint in str(caught.value)


@given(st.binary(max_size=60) | st.text(max_size=60).map(str.encode))
def test_nothing_else_is_ever_raised_for_bytes(text: bytes) -> None:
    with pytest.raises(WireError):
        decode(JsonForm().frame_of(text))


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | floats | names,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(names, inner, max_size=3),
    max_leaves=5,
)


@given(st.data(), messages.filter(lambda each: not isinstance(each, Welcome | Percept | Action)))
def test_nothing_else_is_ever_raised_for_a_message_with_another_field(
    data: st.DataObject, message: Message
) -> None:
    form = JsonForm()
    said = json.loads(form.text_of(encode(message)))
    said[data.draw(st.sampled_from(sorted(said)))] = data.draw(JSON)
    with suppress(WireError):
        decode(form.frame_of(json.dumps(said).encode()))


@pytest.mark.parametrize(
    "readings",
    [None, 7, {}, {"place": 1}, {"place": [1]}, {"place": [1, None]}, {"place": ["1", "2"]},
     {"place": [1, 2], "more": 1}, {"place": {}}],
)  # fmt: skip
def test_readings_that_do_not_fit_are_refused(readings: Any) -> None:
    form = form_of(array("place", "<f4", 2))
    said = json.loads(form.text_of(percept(bytes(8))))
    said["readings"] = readings
    with pytest.raises(WireError):
        decode(form.frame_of(json.dumps(said).encode()))
    said["readings"] = {"place": [1, 2]}
    there = decode(form.frame_of(json.dumps(said).encode()))
    assert isinstance(there, Percept)
    assert there.data == packed(1, 2)


def test_the_largest_seed_is_whole() -> None:
    reset = Reset(1, 2**63 - 1)
    assert there_and_back(JsonForm(), reset) == reset

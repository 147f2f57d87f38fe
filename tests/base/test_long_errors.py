"""Errors about a lot of junk: a short sentence, and few names are compared."""

import difflib
import json
from collections.abc import Callable
from typing import Any

import pytest
from pydantic import BaseModel, ValidationError

from ai4u_edu import AI4UError, BoxShape, RBMoveActuator, VelocitySensor
from ai4u_edu.base import errors
from ai4u_edu.base.errors import shown, suggest
from ai4u_edu.base.parameters import MAX_EXPLAINED, MAX_HINTS, explain
from ai4u_edu.blocks import Sensor
from ai4u_edu.blocks.actuators import DiscreteActuator
from ai4u_edu.page.server.input_messages import INPUT_READER
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.serialization import from_plain
from tests.builders import small_sim

KEYS: dict[str, Any] = {f"key{number}": 1 for number in range(2000)}
MAX_CHARS = 10_000


def nested(depth: int) -> Any:
    value: Any = 1
    for _ in range(depth):
        value = [value]
    return value


JUNK = [
    ["x" * 10_000] * 1000,
    [1.0] * 100_000,
    KEYS,
    nested(900),
    {"a": nested(900)},
    "x" * 1_000_000,
    b"x" * 1_000_000,
    10**5000,
    [10**5000],
    {10**5000: 1},
    float("nan"),
    {("x" * 1000,) * 1000: 1},
]


@pytest.mark.parametrize("place", range(len(JUNK)))
def test_any_value_is_shown_by_its_beginning(place: int) -> None:
    assert len(shown(JUNK[place])) <= errors.MAX_SHOWN_CHARS


@pytest.mark.parametrize("value", [[1, "a", {"b": (2,)}], {"a": [None, 1.5]}, "it's", b"\x00", -3])
def test_a_short_value_is_shown_as_it_is(value: Any) -> None:
    assert shown(value) == repr(value)


@pytest.mark.parametrize("place", range(len(JUNK)))
@pytest.mark.parametrize("block", [RBMoveActuator, DiscreteActuator])
def test_an_actuator_refuses_junk_in_a_short_sentence(block: Any, place: int) -> None:
    (actuator,) = small_sim(actuators=[block()]).agents[0].actuators
    with pytest.raises(AI4UError, match=r"^action 'move': expected") as caught:
        actuator.accept(JUNK[place])
    assert len(str(caught.value)) < 200


def scene_with(change: Callable[[dict[str, Any]], object]) -> str:
    plain = json.loads(json.dumps(Scene.load("box_chase").plain()))
    change(plain)
    return json.dumps(plain)


@pytest.mark.parametrize(
    "make",
    [
        lambda: VelocitySensor(**KEYS),
        lambda: BoxShape(**KEYS),
        lambda: from_plain(Sensor, {"type": "VelocitySensor", **KEYS}),
        lambda: from_plain(Sensor, {"type": "x" * 100_000}),
        lambda: from_plain(Sensor, {"type": ["x" * 1000] * 1000}),
        lambda: from_plain(
            Sensor,
            {
                "type": "FloatArrayCompositeSensor",
                "sensors": [{"type": f"Velocity{number}"} for number in range(2000)],
            },
        ),
        lambda: Scene.loads(scene_with(lambda plain: plain.update(KEYS))),
        lambda: Scene.loads(scene_with(lambda plain: plain["bodies"][0].update(KEYS))),
        lambda: Scene.loads(scene_with(lambda plain: plain["agents"][0].update(KEYS))),
        lambda: Scene.loads(
            scene_with(lambda plain: plain["agents"][0]["sensors"][0].update(KEYS))
        ),
        lambda: INPUT_READER.read(json.dumps({"type": "keys", **KEYS})),
    ],
)
def test_thousands_of_unknown_names_are_refused_with_a_few_hints(
    make: Callable[[], object], monkeypatch: pytest.MonkeyPatch
) -> None:
    compared = []
    compare = difflib.get_close_matches

    def count(name: str, names: list[str], n: int) -> list[str]:
        compared.append(name)
        assert len(name) <= errors.MAX_NAME_CHARS
        assert len(names) <= errors.MAX_NAMES_COMPARED
        return compare(name, names, n=n)

    monkeypatch.setattr(errors, "get_close_matches", count)
    with pytest.raises((AI4UError, ValueError)) as caught:
        make()
    assert len(compared) <= 2 * MAX_HINTS  # a block in a scene is explained twice
    assert len(str(caught.value)) <= MAX_CHARS


def test_many_known_names_are_told_in_part() -> None:
    text = suggest("moon", [f"body {number:04}" for number in range(2000)])
    assert text.startswith("known are 'body 0000', 'body 0001', ")
    assert text.endswith(" and 1950 more")
    assert len(suggest("moon", ["x" * 10_000])) < 100
    assert suggest("x" * 100_000, ["box"]) == "known are 'box'"


def test_of_very_many_mistakes_the_first_ones_are_explained_and_all_are_counted() -> None:
    """To explain each of 30,000 unknown keys of a scene took seconds."""

    class Empty(BaseModel, extra="forbid"):
        pass

    with pytest.raises(ValidationError) as raised:
        Empty.model_validate({f"key{number}": 1 for number in range(30_000)})
    problems = explain(raised.value.errors(), Empty)
    assert len(problems) == 30_000
    explained = [each for each in problems if each.path]
    assert len(explained) == MAX_EXPLAINED
    assert all(each.text.startswith("unknown parameter") for each in explained)

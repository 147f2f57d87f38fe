"""Declared parameters: construction, errors and schema follow from the declaration."""

from typing import Any

import pytest

from ai4u_edu import (
    BasicAgent,
    Block,
    Controller,
    FloatArrayCompositeSensor,
    LocalBrain,
    RayCastingSensor,
    Sensor,
    VelocitySensor,
    WASDRBMoveController,
)
from ai4u_edu.base.errors import AI4UError, ParameterError
from ai4u_edu.blocks import Brain
from ai4u_edu.blocks.block import is_built_in


def error_of(make: Any) -> str:
    with pytest.raises(ParameterError) as caught:
        make()
    return str(caught.value)


def test_exact_texts() -> None:
    rays: Any = RayCastingSensor  # the mistakes below are also a type checker's
    assert error_of(lambda: rays(rows=0)) == ("RayCastingSensor: rows: expected at least 1, got 0")
    assert error_of(lambda: rays(rows=2.5)) == (
        "RayCastingSensor: rows: expected a whole number, got 2.5"
    )
    assert error_of(lambda: rays(field_of_view=float("nan"))) == (
        "RayCastingSensor: field_of_view: expected a finite number, got nan"
    )
    assert error_of(lambda: rays(feild_of_view=90)) == (
        "RayCastingSensor: feild_of_view: unknown parameter; did you mean 'field_of_view'?"
    )
    assert error_of(lambda: rays(rows=0, columns=999)) == (
        "RayCastingSensor: rows: expected at least 1, got 0; columns: expected at most 256, got 999"
    )
    assert error_of(lambda: FloatArrayCompositeSensor(sensors=[])) == (
        "FloatArrayCompositeSensor: sensors: expected at least 1 entries, got []"
    )
    for cls, field in ((LocalBrain, "controller"), (BasicAgent, "body")):
        made: Any = cls
        assert error_of(made) == f"{cls.__name__}: {field}: is missing and has no default"


def test_repr_shows_what_is_not_as_by_default() -> None:
    assert repr(VelocitySensor(max_speed=3)) == (
        "VelocitySensor(perception_key='velocity', max_speed=3.0)"
    )


def test_changed_makes_a_new_one() -> None:
    sensor = VelocitySensor(max_speed=3)
    other = sensor.changed(max_turn=2)
    assert (other.max_speed, other.max_turn, sensor.max_turn) == (3.0, 2.0, 20.0)
    assert other is not sensor


def test_the_schema_has_range_and_unit() -> None:
    field = RayCastingSensor.json_schema()["properties"]["field_of_view"]
    assert field == {
        "default": 90.0,
        "exclusiveMinimum": 0,
        "maximum": 360,
        "title": "Field Of View",
        "type": "number",
        "unit": "deg",
        "description": "The whole horizontal angle.",
    }


def test_blocks_may_carry_attributes_of_their_own() -> None:
    class Mine(Sensor):
        """A block with an attribute of its own."""

    mine = Mine()
    mine.best = 3  # type: ignore[attr-defined]  # that a student may is what is tested
    assert "best" not in mine.values()


def test_every_built_in_block_has_a_docstring_and_a_registered_name() -> None:
    for name, cls in Block.types.items():
        if is_built_in(cls):
            assert cls.__name__ == name
            assert cls.__doc__, name


def test_default_names_come_from_the_class() -> None:
    class HTTPLikeSensor(Sensor):
        """Has capitals in its name."""

    assert HTTPLikeSensor().perception_key == "http_like"


@pytest.mark.parametrize(
    ("cls", "call", "text"),
    [
        (Brain, "decide", "Brain has no decide(self, percept): it must return an action"),
        (
            Controller,
            "get_action",
            "Controller has no get_action(self, percept): it must return an action",
        ),
    ],
)
def test_a_base_says_what_to_fill(cls: Any, call: str, text: str) -> None:
    with pytest.raises(AI4UError) as caught:
        getattr(cls(), call)({})
    assert str(caught.value) == text


def test_a_controller_among_the_brains_gets_a_brain_of_its_own() -> None:
    controller = WASDRBMoveController()
    agent = BasicAgent(body="x", brains=[controller])  # type: ignore[list-item]
    (brain,) = agent.brains
    assert isinstance(brain, LocalBrain)
    assert brain.controller is controller

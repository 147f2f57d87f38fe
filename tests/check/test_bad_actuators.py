"""The findings about actuators that break a rule, word for word."""

from typing import Any

import pytest
from gymnasium.spaces import Box

from ai4u_edu import (
    Actuator,
    check_actuator,
)
from ai4u_edu.base.errors import ActionError
from ai4u_edu.check import Outcome
from tests.check.reports import SHORT, failed, outcome


class Wheel(Actuator):
    """Drives forward; the other classes break one rule each."""

    action_name: str = "move"

    def space(self) -> Box:
        return Box(-1.0, 1.0, (1,))

    def act(self, body: Any, action: Any) -> None:
        body.set_velocity(3 * action[0], 0)


class Sinking(Wheel):
    """Puts its body nowhere."""

    def act(self, body: Any, action: Any) -> None:
        body.z = float("nan")


class Idle(Wheel):
    """Does nothing."""

    def act(self, body: Any, action: Any) -> None:
        pass


class Gullible(Wheel):
    """Takes whatever it gets."""

    def accept(self, values: Any) -> tuple[float, ...]:
        return (0.5,)


class Puzzled(Wheel):
    """Looks at the first number only, and is surprised by words."""

    def accept(self, values: Any) -> tuple[float, ...]:
        if values[0] != values[0]:
            raise ActionError("not a number")
        if not isinstance(values[0], str):
            return super().accept(values[:1])
        return (float(values[0]),)


class Surprised(Puzzled):
    """Counts its numbers, but is still surprised by words."""

    def accept(self, values: Any) -> tuple[float, ...]:
        if len(values) == 2 and not isinstance(values, str):
            raise ActionError("too many")
        return super().accept(values)


class Wearing(Wheel):
    """Gets slower, for good."""

    def on_setup(self, agent: Any, view: Any) -> None:
        self.power = 3.0

    def act(self, body: Any, action: Any) -> None:
        self.power *= 0.9
        body.set_velocity(self.power * action[0], 0)


def test_a_good_actuator() -> None:
    report = check_actuator(Wheel(), **SHORT)
    assert {finding.outcome for finding in report.findings} == {Outcome.PASSED}


@pytest.mark.parametrize(
    ("actuator", "expected"),
    [
        (
            Sinking(),
            {
                "finite": "expected every body at a finite place, got body 'robot' at (0.0, 0.0, "
                "nan, 0.0) after decision 1; does it divide by zero?"
            },
        ),
        (
            Gullible(),
            {
                "refuses": "expected an ActionError for the action [nan], got no error; let "
                "Actuator.accept look at it first"
            },
        ),
        (
            Puzzled(),
            {
                "refuses": "expected an ActionError for the action [0.0, 0.0], got no error; let "
                "Actuator.accept look at it first"
            },
        ),
        (
            Surprised(),
            {
                "refuses": "expected an ActionError for the action 'go', got ValueError: could not "
                "convert string to float: 'g'; let Actuator.accept look at it first"
            },
        ),
    ],
)
def test_bad_actuators(actuator: Actuator, expected: dict[str, str]) -> None:
    assert failed(check_actuator(actuator, **SHORT)) == expected


def test_an_actuator_that_does_not_forget() -> None:
    found = failed(check_actuator(Wearing(), **SHORT))
    assert list(found) == ["forgets"]
    assert found["forgets"].startswith(
        "expected the same places of all bodies and traces again after a reset, got ({'robot': ("
    )


def test_an_actuator_without_an_effect_is_a_warning() -> None:
    report = check_actuator(Idle(), **SHORT)
    assert report.ok
    assert outcome(report, "has an effect") == (
        Outcome.WARNING,
        "expected bodies at other places than without it, or ink, got all the same; if it needs "
        "something that is not here, check it in another scene, by scene=...",
    )

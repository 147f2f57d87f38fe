"""The findings about controllers and brains that break a rule, word for word."""

from typing import Any

import pytest

from ai4u_edu import (
    Brain,
    Command,
    Controller,
    DiscreteActuator,
    check_brain,
    check_controller,
)
from ai4u_edu.check import Outcome
from tests.check.reports import SHORT, failed, outcome


class Ahead(Controller):
    """Drives forward; the other classes break one rule each."""

    def get_action(self, percept: Any) -> Any:
        return {"move": [1, 0, 0, 0]}


class Lopsided(Ahead):
    """Gives too few numbers."""

    def get_action(self, percept: Any) -> Any:
        return {"move": [1, 0]}


class Marching(Ahead):
    """Counts its steps, and never starts again."""

    def on_setup(self, agent: Any, view: Any) -> None:
        self.count = 0

    def get_action(self, percept: Any) -> Any:
        self.count += 1
        return {"move": [0.5, 1 / self.count, 0, 0]}


class Quitting(Ahead):
    """Has enough."""

    def get_action(self, percept: Any) -> Any:
        return Command.STOP


@pytest.mark.parametrize(
    ("controller", "expected"),
    [
        (
            Lopsided(),
            {
                "runs": "expected 20 decisions without an error, got ActionError: action 'move': "
                "expected 4 numbers, got 2: [1, 0]"
            },
        ),
        (
            Marching(),
            {
                "forgets": "expected the same answers again after a reset, got {'move': [0.5, "
                "0.047619047619047616, 0, 0]} in place of {'move': [0.5, 1.0, 0, 0]} after "
                "decision 1; put back in on_reset whatever changes in an episode"
            },
        ),
    ],
)
def test_bad_controllers(controller: Controller, expected: dict[str, str]) -> None:
    assert failed(check_controller(controller, **SHORT)) == expected


@pytest.mark.parametrize("controller", [Ahead(), Quitting()])
def test_a_controller_that_always_answers_the_same_is_a_warning(controller: Controller) -> None:
    report = check_controller(controller, **SHORT)
    assert report.ok
    assert outcome(report, "changes")[0] is Outcome.WARNING


def test_a_controller_for_other_actuators() -> None:
    class Third(Ahead):
        """Chooses the third."""

        def get_action(self, percept: Any) -> Any:
            return {"move": 3}

    assert not check_controller(Third(), **SHORT).ok
    assert check_controller(Third(), actuators=[DiscreteActuator()], **SHORT).ok


class Silent(Brain):
    """Says nothing."""

    def decide(self, percept: Any) -> Any:
        return None


def test_a_bad_brain() -> None:
    assert failed(check_brain(Silent(), **SHORT)) == {
        "runs": "expected 20 decisions without an error, got ActionError: agent '0': expected an "
        "action by actuator name, such as {'move': [0.0, 0.0, 0.0, 0.0]}, got None"
    }

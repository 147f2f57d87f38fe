"""The findings about sensors that break a rule, word for word."""

import itertools
import random
from typing import Any

import numpy as np
import pytest
from gymnasium.spaces import Box

from ai4u_edu import (
    Sensor,
    check_sensor,
)
from ai4u_edu.check import CheckError, Outcome
from tests.check.reports import SHORT, failed, outcome


class Gauge(Sensor):
    """Reads the body's x; the other classes break one rule each."""

    def space(self) -> Box:
        return Box(-1e4, 1e4, (1,))

    def read(self, body: Any, view: Any) -> Any:
        return body.position[0]


class Undocumented(Gauge):
    def read(self, body: Any, view: Any) -> Any:
        return body.position[1]


class Doubling(Gauge):
    """Changes its own parameter."""

    gain: float = 1.0

    def __post_init__(self) -> None:
        super().__post_init__()
        self.gain *= 2


class Unwritable(Gauge):
    """Has a parameter that is no plain data."""

    weights: Any = None


class Lost(Gauge):
    """Looks for something that is not there."""

    target: str = "moon"

    def on_setup(self, agent: Any, view: Any) -> None:
        _ = view[self.target]


class Breaking(Gauge):
    """Breaks at the third reading."""

    def on_reset(self, agent: Any, view: Any) -> None:
        self.left = 3

    def read(self, body: Any, view: Any) -> Any:
        self.left -= 1
        return 1 / self.left


class NotFinite(Gauge):
    """Divides by zero, in place."""

    def on_reset(self, agent: Any, view: Any) -> None:
        self.count = 0

    def write(self, out: Any, body: Any, view: Any) -> None:
        self.count += 1
        out[0] = np.nan if self.count == 3 else self.count


class TooFar(Gauge):
    """Reads more than it says, but not at first."""

    def space(self) -> Box:
        return Box(0.0, 2.0, (1,))

    def on_reset(self, agent: Any, view: Any) -> None:
        self.count = 0

    def read(self, body: Any, view: Any) -> float:
        self.count += 1
        return self.count


class Sharing(Gauge):
    """Returns the same array again and again."""

    def on_setup(self, agent: Any, view: Any) -> None:
        self.array = np.zeros(1)

    def read(self, body: Any, view: Any) -> Any:
        self.array[0] = body.position[0]
        return self.array


class Unseeded(Gauge):
    """Is random without a seed."""

    numbers = itertools.count()

    def read(self, body: Any, view: Any) -> Any:
        return float(next(self.numbers))  # unpredictable, but the text is the same


class Remembering(Gauge):
    """Keeps counting after a reset."""

    def on_setup(self, agent: Any, view: Any) -> None:
        self.count = 0

    def read(self, body: Any, view: Any) -> float:
        self.count += 1
        return self.count


class Pushing(Gauge):
    """Pushes the body that it reads."""

    def read(self, body: Any, view: Any) -> Any:
        view["ball"].set_velocity(1, 0)
        return body.position[0]


class Constant(Gauge):
    """Always reads 5."""

    def read(self, body: Any, view: Any) -> float:
        return 5.0


class Gambling(Gauge):
    """Draws from the global generators."""

    which: str = "random"

    def read(self, body: Any, view: Any) -> Any:
        if "random" in self.which.split():
            random.random()
        if "numpy" in self.which.split():
            np.random.rand()  # type: ignore[no-untyped-call, unused-ignore]
        return body.position[0]


def test_a_good_one_passes_everything() -> None:
    report = check_sensor(Gauge(), **SHORT)
    assert report.ok
    assert {finding.outcome for finding in report.findings} == {Outcome.PASSED}
    report.raise_for_findings()


SENSORS: list[tuple[Sensor, dict[str, str]]] = [
    (
        Undocumented(),
        {
            "documented": "expected a docstring that says what it reads, got none; write one "
            "under the class line"
        },
    ),
    (
        Doubling(gain=3),
        {
            "scene file": "expected {'type': 'Doubling', 'perception_key': 'doubling', 'gain': "
            "6.0} back, got {'type': 'Doubling', 'perception_key': 'doubling', 'gain': 12.0}; are "
            "all parameters declared as annotated fields, and left as they were given?"
        },
    ),
    (
        Unwritable(weights=1j),
        {
            "scene file": "expected {'type': 'Unwritable', 'perception_key': 'unwritable', "
            "'weights': 1j} to make the same block, got Object of type complex is not JSON "
            "serializable; are all parameters declared as annotated fields, and left as they were "
            "given?"
        },
    ),
    (
        Lost(),
        {
            "setup": "expected a setup without an error, got BlockError: agent '0', Lost 'lost': "
            "no body is named 'moon'; known are 'ball', 'box', 'other', 'robot', 'step', 'wall'"
        },
    ),
    (
        Breaking(),
        {
            "runs": "expected 20 decisions without an error, got ZeroDivisionError: division by "
            "zero; while Breaking 'breaking' of agent '0' was reading"
        },
    ),
    (
        NotFinite(),
        {
            "finite": "expected finite numbers, got [nan] after decision 2; does it divide by "
            "zero, or take the root of a negative number?"
        },
    ),
    (
        TooFar(),
        {
            "in its space": "expected numbers from 0 to 2 as its space() says, got [3.0] after "
            "decision 2; widen the space, or cut the reading"
        },
    ),
    (
        Sharing(),
        {
            "unshared": "expected a new array from every read, got the same memory twice; return "
            "a copy of it"
        },
    ),
    (
        Remembering(),
        {
            "forgets": "expected the same readings again after a reset, got [22.0] in place of "
            "[1.0] after decision 0; put back in on_reset whatever changes in an episode"
        },
    ),
    (
        Pushing(),
        {
            "only looks": "expected the world to go on as it does without it, got body 'ball' at "
            "another place after decision 1; what only looks must not move anything"
        },
    ),
    (
        Constant(),
        {
            "changes": "expected readings that change while the agent drives about, got [5.0] all "
            "21 times; if there is nothing here to make them change, check it in another scene, "
            "by scene=..."
        },
    ),
    (
        Gambling(),
        {
            "global chance": "expected no draw from a global generator, got one from random; take "
            "view.random(name), which grows from the world's seed"
        },
    ),
    (
        Gambling(which="random numpy"),
        {
            "global chance": "expected no draw from a global generator, got one from random and "
            "numpy.random; take view.random(name), which grows from the world's seed"
        },
    ),
]


@pytest.mark.parametrize(("sensor", "expected"), SENSORS, ids=lambda each: type(each).__name__)
def test_bad_sensors(sensor: Sensor, expected: dict[str, str]) -> None:
    assert failed(check_sensor(sensor, **SHORT)) == expected


def test_chance_from_nowhere_is_not_the_same_twice() -> None:
    Unseeded.numbers = itertools.count()
    report = check_sensor(Unseeded(), **SHORT)
    assert failed(report) == {
        "same twice": "expected the same readings from the same seed, got [21.0] in place of "
        "[0.0] after decision 0; take chance from view.random(name), and go through no set"
    }
    assert outcome(report, "forgets") == (
        Outcome.NOT_APPLICABLE,
        "it differs even without a reset",
    )


class OnlyOnce(Gauge):
    """Can be set up only once."""

    uses = itertools.count()

    def on_reset(self, agent: Any, view: Any) -> None:
        if next(self.uses):
            raise RuntimeError("used up")


def test_a_later_run_that_breaks_is_told_too() -> None:
    OnlyOnce.uses = itertools.count()
    report = check_sensor(OnlyOnce(), decisions=5)
    assert failed(report) == {
        "same twice": "expected the same readings from the same seed, got RuntimeError: used up; "
        "while OnlyOnce 'only_once' of agent '0' was reset; take chance from view.random(name), "
        "and go through no set"
    }


def test_what_holds_a_function_is_in_no_file() -> None:
    class Computed(Gauge):
        """Asks a function."""

        function: Any

    report = check_sensor(Computed(function=len), **SHORT)
    assert report.ok
    assert outcome(report, "scene file") == (
        Outcome.NOT_APPLICABLE,
        "it holds a Python function, which no file can say",
    )


def test_a_constant_that_is_no_input_is_a_warning() -> None:
    report = check_sensor(Constant(is_input=False), **SHORT)
    assert report.ok
    assert outcome(report, "changes")[0] is Outcome.WARNING


def test_what_need_not_be_forgotten() -> None:
    report = check_sensor(Remembering(resetable=False), **SHORT)
    assert report.ok
    assert outcome(report, "forgets") == (Outcome.NOT_APPLICABLE, "resetable is off")


def test_a_failure_can_be_raised() -> None:
    report = check_sensor(Constant(), **SHORT)
    with pytest.raises(CheckError) as caught:
        report.raise_for_findings()
    assert str(caught.value) == str(report)
    assert str(report).splitlines()[0] == "Constant 'constant': 1 of 12 checks failed"
    assert str(report).splitlines()[-1].startswith("  FAILED          changes: expected readings")


def test_the_block_itself_is_not_touched() -> None:
    gauge = Gauge()
    before = dict(vars(gauge))
    check_sensor(gauge, **SHORT)
    assert vars(gauge) == before

"""What each check says of a block that breaks its promise, word for word."""

import itertools
import random
from typing import Any

import numpy as np
import pytest
from gymnasium.spaces import Box

from ai4u_edu import (
    Actuator,
    Brain,
    Command,
    Controller,
    DiscreteActuator,
    EvalBoolValue,
    FallReward,
    FloatArrayCompositeSensor,
    GoneReward,
    GridMoveActuator,
    GridSensor,
    HomeostaticReward,
    HomeostaticVariable,
    LinearRayCastingSensor,
    LocalGridSensor,
    RayCastingSensor,
    Report,
    RewardFunc,
    Sensor,
    TouchRewardFunc,
    check_actuator,
    check_brain,
    check_controller,
    check_reward,
    check_sensor,
)
from ai4u_edu.base.errors import ActionError
from ai4u_edu.check import CheckError, Outcome

SHORT: dict[str, Any] = {"decisions": 20}


def failed(report: Report) -> dict[str, str]:
    """The checks that failed, and what they say."""
    return {finding.check: finding.text for finding in report.failed}


def outcome(report: Report, check: str) -> tuple[Outcome, str]:
    (finding,) = (each for each in report.findings if each.check == check)
    return finding.outcome, finding.text


class Gauge(Sensor):
    """Reads how far ahead the body is; the others here spoil it."""

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
    """Takes chance from nowhere."""

    numbers = itertools.count()

    def read(self, body: Any, view: Any) -> Any:
        return float(next(self.numbers))  # as unforeseeable as chance, but the text is the same


class Remembering(Gauge):
    """Counts on after a reset."""

    def on_setup(self, agent: Any, view: Any) -> None:
        self.count = 0

    def read(self, body: Any, view: Any) -> float:
        self.count += 1
        return self.count


class Pushing(Gauge):
    """Pushes what it looks at."""

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
    """Can be set up once, whoever does it."""

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


class Wheel(Actuator):
    """Drives ahead; the others here spoil it."""

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
        "expected the same places of all bodies again after a reset, got {'robot': ("
    )


def test_an_actuator_without_an_effect_is_a_warning() -> None:
    report = check_actuator(Idle(), **SHORT)
    assert report.ok
    assert outcome(report, "has an effect") == (
        Outcome.WARNING,
        "expected bodies at other places than without it, got all at the same; if it needs "
        "something that is not here, check it in another scene, by scene=...",
    )


class Fee(RewardFunc):
    """Costs the distance to the middle; the others here spoil it."""

    def on_update(self, body: Any, view: Any) -> Any:
        return -abs(body.position[0])


class PaysWords(Fee):
    """Pays in words."""

    def on_update(self, body: Any, view: Any) -> Any:
        return "a lot"


class Infinite(Fee):
    """Pays too much."""

    def on_update(self, body: Any, view: Any) -> Any:
        return float("inf")


class Growing(Fee):
    """Pays more each time, also in the next episode."""

    def on_setup(self, agent: Any, view: Any) -> None:
        self.count = 0

    def on_update(self, body: Any, view: Any) -> Any:
        self.count += 1
        return self.count


class Kicking(Fee):
    """Kicks the agent for its own good."""

    def on_update(self, body: Any, view: Any) -> Any:
        body.set_velocity(5, 0)
        return body.position[0]


class Flat(Fee):
    """Pays a point each time."""

    def on_update(self, body: Any, view: Any) -> Any:
        return 1.0


@pytest.mark.parametrize(
    ("reward", "expected"),
    [
        (Fee(), {}),
        (Fee(cause_episode_to_end=True), {}),
        (
            PaysWords(),
            {
                "runs": "expected 20 decisions without an error, got ReadingError: agent '0', "
                "PaysWords 'pays_words': expected a number from on_update, got 'a lot'"
            },
        ),
        (
            Infinite(),
            {
                "runs": "expected 20 decisions without an error, got ReadingError: agent '0', "
                "Infinite 'infinite': expected a finite number, got inf"
            },
        ),
        (
            Growing(),
            {
                "forgets": "expected the same rewards again after a reset, got 21.0 in place of "
                "1.0 after decision 1; put back in on_reset whatever changes in an episode"
            },
        ),
        (
            Kicking(),
            {
                "only looks": "expected the world to go on as it does without it, got body 'robot' "
                "at another place after decision 2; what only looks must not move anything"
            },
        ),
    ],
)
def test_bad_rewards(reward: RewardFunc, expected: dict[str, str]) -> None:
    assert failed(check_reward(reward, **SHORT)) == expected


def test_a_reward_that_never_changes_is_a_warning() -> None:
    for reward, got in ((Flat(), "1.0 all 20 times"), (Flat(is_active=False), "none")):
        report = check_reward(reward, **SHORT)
        assert report.ok
        assert outcome(report, "changes") == (
            Outcome.WARNING,
            f"expected rewards that change while the agent drives about, got {got}; if there is "
            "nothing here to make them change, check it in another scene, by scene=...",
        )


class Ahead(Controller):
    """Drives ahead; the others here spoil it."""

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


def test_the_block_itself_is_not_touched() -> None:
    gauge = Gauge()
    before = dict(vars(gauge))
    check_sensor(gauge, **SHORT)
    assert vars(gauge) == before


# -- blocks that run, and can't do what was meant ------------------------------------------------


@pytest.mark.parametrize(
    ("reward", "amounts"),
    [
        (TouchRewardFunc(target="box", cause_episode_to_end=True), "reward"),
        (
            FallReward(success_reward=0, cause_episode_to_end=True),
            "success_reward or fail_reward",
        ),
        (
            HomeostaticReward(
                variables=[HomeostaticVariable(name="e")], reward=0, cause_episode_to_end=True
            ),
            "reward",
        ),
    ],
)
def test_a_reward_of_nothing_that_is_to_end_the_episode(reward: RewardFunc, amounts: str) -> None:
    report = check_reward(reward, **SHORT)
    assert report.ok
    assert outcome(report, "ends") == (
        Outcome.WARNING,
        f"expected an amount other than 0 in {amounts}, got 0: the episode ends only where "
        "something is paid, so it never ends by it",
    )


def test_a_condition_alone_ends_nothing() -> None:
    condition = EvalBoolValue(property="on_ground", cause_episode_to_end=True)
    found, text = outcome(check_reward(condition, **SHORT), "ends")
    assert found is Outcome.WARNING
    assert "expected a condition inside an AndRewardFunc or OrRewardFunc" in text


def test_a_reward_that_can_end_the_episode_gets_no_warning() -> None:
    touch = TouchRewardFunc(target="box", reward=1, cause_episode_to_end=True)
    assert outcome(check_reward(touch, **SHORT), "ends") == (Outcome.PASSED, "")
    checks = {each.check for each in check_reward(TouchRewardFunc(target="box"), **SHORT).findings}
    assert "ends" not in checks


@pytest.mark.parametrize(
    ("sensor", "text"),
    [
        (
            LinearRayCastingSensor(group_code={"floor": 1, "tragt": 2}),
            "group_code: nothing that it could find carries the tag 'tragt'; "
            "did you mean 'target'?",
        ),
        (
            RayCastingSensor(group_code={"wall": 1, "goal": 2}),  # a ray meets no areas
            "group_code: nothing that it could find carries the tag 'goal'; known are 'agent', "
            "'floor', 'target', 'wall'",
        ),
        (
            FloatArrayCompositeSensor(
                sensors=[LinearRayCastingSensor(group_code={"wal": 1, "floor": 2})]
            ),
            "group_code: nothing that it could find carries the tag 'wal'; did you mean 'wall'?",
        ),
        (
            LocalGridSensor(channels=["void", "floor", "goal", "lamp"]),
            "channels: nothing that it could find carries the tag 'lamp'; known are 'agent', "
            "'floor', 'goal', 'target', 'void', 'wall'",
        ),
    ],
)
def test_a_group_that_nothing_carries(sensor: Sensor, text: str) -> None:
    report = check_sensor(sensor, decisions=2)
    assert outcome(report, "groups") == (Outcome.WARNING, text)


def test_groups_that_are_there_or_stand_there_by_default() -> None:
    for sensor in (LinearRayCastingSensor(group_code={"wall": 1}), GridSensor(), LocalGridSensor()):
        assert outcome(check_sensor(sensor, decisions=2), "groups") == (Outcome.PASSED, "")
    gone = outcome(check_reward(GoneReward(group="target"), **SHORT), "groups")
    assert gone == (Outcome.PASSED, "")
    grid = outcome(
        check_actuator(GridMoveActuator(rows=7, columns=7, blocked_by=["wall", "dor"]), **SHORT),
        "groups",
    )
    assert grid[0] is Outcome.WARNING

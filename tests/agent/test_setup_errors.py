"""Error messages for agents that are put together wrongly, word for word."""

from typing import Any

import numpy as np
import pytest
from gymnasium.spaces import Box, Dict, Text, Tuple

from ai4u_edu import (
    ActionSensor,
    AndRewardFunc,
    BasicAgent,
    BearingSensor,
    BoxShape,
    CircleShape,
    ControlRequestor,
    FallReward,
    FloatArrayCompositeSensor,
    LocalBrain,
    OrientationSensor,
    PositionSensor,
    RBMoveActuator,
    Sensor,
    StepSensor,
    TouchRewardFunc,
    VelocitySensor,
    World,
)
from ai4u_edu.base.errors import (
    AI4UError,
    BlockError,
    ParameterError,
    ReadingError,
    SetupError,
)
from ai4u_edu.base.seeding import MAX_SEED
from tests.builders import small_sim, small_world, still


class Odd(Sensor):
    """Reads whatever it was told to."""

    value: Any = 0.0

    def space(self) -> Box:
        return Box(0.0, 10.0, (2,))

    def read(self, body: Any, view: Any) -> Any:
        return self.value


def error_of(kind: type[AI4UError], **what: Any) -> str:
    with pytest.raises(kind) as caught:
        small_sim(**what)
    assert caught.type is kind
    return str(caught.value)


def brain(**fields: Any) -> LocalBrain:
    return LocalBrain(controller=still, **fields)


def test_two_enabled_brains() -> None:
    assert error_of(SetupError, brains=[brain(), brain(enabled=False), brain()]) == (
        "agent '0': expected exactly one enabled brain, got 2: LocalBrain(ScriptController) and "
        "LocalBrain(ScriptController); set enabled=False on the others"
    )


def test_no_brain() -> None:
    assert error_of(SetupError, brains=[]) == (
        "agent '0': expected exactly one enabled brain, got none; add one, such as "
        "brains=[LocalBrain(controller=WASDRBMoveController())]"
    )


def test_no_enabled_brain() -> None:
    assert error_of(SetupError, brains=[brain(enabled=False)]) == (
        "agent '0': expected exactly one enabled brain, got none (1 are switched off); add one, "
        "such as brains=[LocalBrain(controller=WASDRBMoveController())]"
    )


def test_duplicate_perception_key() -> None:
    sensors = [VelocitySensor(perception_key="v"), PositionSensor(perception_key="v")]
    assert error_of(SetupError, sensors=sensors) == (
        "agent '0': two sensors have the perception_key 'v'; give one of them another, as in "
        "perception_key='v_2'"
    )


def test_duplicate_action_name() -> None:
    assert error_of(SetupError, actuators=[RBMoveActuator(), RBMoveActuator()]) == (
        "agent '0': two actuators have the action_name 'move'; give one of them another, as in "
        "action_name='move_2'"
    )


def test_duplicate_reward_name() -> None:
    assert error_of(SetupError, rewards=[FallReward(), FallReward()]) == (
        "agent '0': two reward functions have the name 'fall'; give one of them another, as in "
        "name='fall_2'"
    )


@pytest.mark.parametrize("sensor", [OrientationSensor, BearingSensor])
def test_unknown_target(sensor: Any) -> None:
    key = {"OrientationSensor": "orientation", "BearingSensor": "bearing"}[sensor.__name__]
    assert error_of(BlockError, sensors=[sensor(target="bxo")]) == (
        f"agent '0', {sensor.__name__} '{key}': no body is named 'bxo'; did you mean 'box'?"
    )


def test_unknown_target_of_a_reward() -> None:
    assert error_of(BlockError, rewards=[TouchRewardFunc(target="moon")]) == (
        "agent '0', TouchRewardFunc 'touch': no body or area is named 'moon'; "
        "known are 'box', 'robot'"
    )


def test_unknown_body() -> None:
    agent = BasicAgent(body="robt", brains=[brain()])
    with pytest.raises(BlockError) as caught:
        ControlRequestor(small_world(), [agent])
    assert str(caught.value) == "agent '0': no body is named 'robt'; did you mean 'robot'?"


def test_stacked_observations_0() -> None:
    with pytest.raises(ParameterError) as caught:
        VelocitySensor(stacked_observations=0)
    assert str(caught.value) == "VelocitySensor: stacked_observations: expected at least 1, got 0"


def test_stacking_what_does_not_stack() -> None:
    assert error_of(BlockError, sensors=[StepSensor(stacked_observations=2)]) == (
        "agent '0', StepSensor 'steps': expected stacked_observations 1 (its readings "
        "don't stack), got 2"
    )


def test_parameter_by_position() -> None:
    with pytest.raises(ParameterError) as caught:
        BearingSensor("box")  # type: ignore[call-arg]  # the mistake under test
    assert "parameters are given by name, as in perception_key=...; got 'box'" in str(caught.value)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        ([1.0, float("nan")], "expected finite numbers, got [1.0, nan]"),
        ([1.0, float("inf")], "expected finite numbers, got [1.0, inf]"),
        ([1.0, 2.0, 3.0], "expected shape (2,) as its space() says, got shape (3,)"),
        (1.0, "expected shape (2,) as its space() says, got shape ()"),
        ("much", "expected numbers of shape (2,), got 'much'"),
        (None, "expected numbers of shape (2,), got None"),
        ([1.0, 11.0], "expected numbers from 0 to 10 as its space() says, got [1.0, 11.0]"),
        ([-1.0, 1.0], "expected numbers from 0 to 10 as its space() says, got [-1.0, 1.0]"),
    ],
)
def test_a_reading_that_was_not_declared(value: Any, text: str) -> None:
    assert error_of(ReadingError, sensors=[Odd(value=value)]) == f"agent '0', Odd 'odd': {text}"


def test_a_bad_reading_later_on() -> None:
    sensor = Odd(value=[1.0, 1.0])
    sim = small_sim([sensor])
    sim.step()
    sensor.value = [np.nan, 1.0]
    with pytest.raises(ReadingError, match=r"^agent '0', Odd 'odd': expected finite numbers"):
        sim.step()


def test_an_unknown_name_in_a_students_read_names_the_block() -> None:
    class Far(Sensor):
        """Looks at a body that is not there."""

        def space(self) -> Box:
            return Box(0, 1, (1,))

        def read(self, body: Any, view: Any) -> Any:
            return body.distance(view["bux"])

    assert error_of(ReadingError, sensors=[Far()]) == (
        "agent '0', Far 'far': no body is named 'bux'; did you mean 'box'?"
    )


def test_an_error_of_the_students_own_keeps_its_kind_and_gets_a_note() -> None:
    class Broken(Sensor):
        """Divides by zero."""

        def space(self) -> Box:
            return Box(0, 1, (1,))

        def read(self, body: Any, view: Any) -> Any:
            return 1 / 0

    with pytest.raises(ZeroDivisionError) as caught:
        small_sim([Broken()])
    assert caught.value.__notes__ == ["while Broken 'broken' of agent '0' was reading"]


def test_a_sensor_without_space() -> None:
    class Empty(Sensor):
        """Says nothing."""

    assert "Empty has no space(self): it must say what it can read, as a Box" in error_of(
        BlockError, sensors=[Empty()]
    )


def test_action_sensor_of_no_actuator() -> None:
    assert error_of(BlockError, sensors=[ActionSensor(action_name="mve")]) == (
        "agent '0', ActionSensor 'action': no actuator is called 'mve'; did you mean 'move'?"
    )


def test_action_sensor_of_another_size() -> None:
    assert error_of(BlockError, sensors=[ActionSensor(action_size=3)]) == (
        "agent '0', ActionSensor 'action': action_size: expected 4, since an action of 'move' has "
        "4 numbers, got 3; leave it out, and for the last 3 actions set stacked_observations=3"
    )


def test_two_agents_with_one_id() -> None:
    agents = [BasicAgent(body=name, brains=[brain()]) for name in ("robot", "box")]
    with pytest.raises(SetupError, match=r"^two agents have the id '0'; ids are unique$"):
        ControlRequestor(small_world(), agents)


def test_no_agents() -> None:
    with pytest.raises(SetupError, match=r"^expected at least one agent, got none$"):
        ControlRequestor(small_world(), [])


def test_an_agent_that_is_in_no_world() -> None:
    agent = BasicAgent(body="robot", brains=[brain()])
    with pytest.raises(SetupError) as caught:
        _ = agent.body
    assert str(caught.value) == (
        "agent '0' is in no world yet; expected ControlRequestor(world, [agent])"
    )


def test_an_agent_that_has_sensed_nothing() -> None:
    sim = ControlRequestor(small_world(), [BasicAgent(body="robot", brains=[brain()])])
    with pytest.raises(SetupError, match="has sensed nothing yet; expected a reset first"):
        _ = sim.agents[0].percept


class Loose(Sensor):
    """Says in an odd way what it reads."""

    what: Any = None

    def space(self) -> Any:
        return self.what

    def read(self, body: Any, view: Any) -> float:
        return 0.0


@pytest.mark.parametrize("what", [(0, 1), None, Box, Dict({"a": Box(0, 1)}), Tuple([Box(0, 1)])])
def test_a_space_that_is_none(what: Any) -> None:
    told = error_of(BlockError, sensors=[Loose(what=what)])
    assert told.startswith("agent '0', Loose 'loose': expected space() to return a Box, a Discrete")
    assert repr(what) in told
    composite = FloatArrayCompositeSensor(sensors=[Loose(what=what)])
    assert "expected space() to return a Box" in error_of(BlockError, sensors=[composite])


def test_an_unknown_kind_of_reading() -> None:
    class Words(Sensor):
        """Is spelt wrongly."""

        kind = "sstirng"

        def space(self) -> Text:
            return Text(10)

    assert error_of(BlockError, sensors=[Words()]) == (
        "agent '0', Words 'words': no type of reading is called 'sstirng'; did you mean 'sstring'?"
    )


@pytest.mark.parametrize(
    ("field", "given", "told"),
    [
        ("sensors", [VelocitySensor], "got the class VelocitySensor; make one, as in VelocityS"),
        ("sensors", [{"perception_key": "x"}], "expected a Sensor, got {'perception_key': 'x'}"),
        ("sensors", [RBMoveActuator()], "expected a Sensor, got RBMoveActuator("),
        ("sensors", [3], "expected a Sensor, got 3"),
        ("actuators", [RBMoveActuator], "expected an Actuator, got the class RBMoveActuator; make"),
        ("rewards", [{"type": "FallReward"}], "mappings with a 'type' stand in scene files only"),
        ("rewards", FallReward(), "expected a list, got FallReward("),
        ("brains", [LocalBrain], "expected a Brain, got the class LocalBrain; make one, as in"),
    ],
)
def test_what_is_no_block(field: str, given: Any, told: str) -> None:
    with pytest.raises(ParameterError) as caught:
        BasicAgent(body="robot", **{field: given})
    assert told in str(caught.value)
    assert str(caught.value).startswith(f"BasicAgent: {field}")


@pytest.mark.parametrize(
    ("given", "told"),
    [
        (5, "got 5"),
        (None, "got None"),
        ({"a": 1}, "got {'a': 1}"),
        (VelocitySensor, "got the class VelocitySensor; make one, as in VelocitySensor()"),
    ],
)
def test_what_is_no_controller(given: Any, told: str) -> None:
    with pytest.raises(ParameterError) as caught:
        LocalBrain(controller=given)
    assert str(caught.value) == (
        "LocalBrain: controller: expected a controller, or a function from percept to action, "
        + told
    )


def test_blocks_inside_blocks() -> None:
    for make in (
        lambda given: AndRewardFunc(children=[given]),
        lambda given: FloatArrayCompositeSensor(sensors=[given]),
    ):
        for given in (FallReward, {"type": "FallReward"}, None):
            with pytest.raises(ParameterError, match=r"\[0\]: expected a (RewardFunc|Sensor), got"):
                make(given)


def test_descriptions_take_names_only() -> None:
    mistakes: list[tuple[Any, str]] = [
        (CircleShape, "CircleShape: parameters are given by name, as in radius=..., got 1"),
        (BoxShape, "BoxShape: parameters are given by name, as in size=..., got 1"),
    ]
    for shape, told in mistakes:
        with pytest.raises(ParameterError) as caught:
            shape(1)
        assert str(caught.value) == told


@pytest.mark.parametrize("seed", ["a", 1.5, -1, [1], "7"])
def test_what_is_no_seed(seed: Any) -> None:
    for use in (lambda: World(seed=seed), lambda: small_sim().reset(seed)):
        with pytest.raises(SetupError) as caught:
            use()
        assert (
            str(caught.value) == f"seed: expected a whole number from 0 to {MAX_SEED}, got {seed!r}"
        )
        assert isinstance(caught.value, ValueError)
    whole: Any = np.int64(3)
    assert World(seed=whole).seeds.seed == 3


@pytest.mark.parametrize(
    ("world", "agents", "told"),
    [
        (None, [], "expected a World first, as in ControlRequestor(world, [agent]), got NoneType"),
        (World, [], "expected a World first, .*, got the class World"),
        (small_world(), BasicAgent(body="robot"), "expected a list of agents, .*, got BasicAgent"),
        (small_world(), "robot", "expected a list of agents, .*, got str 'robot'"),
        (small_world(), [BasicAgent], "expected agents in the list, .*, got the class BasicAgent"),
        (small_world(), ["robot"], "expected agents in the list, .*, got str 'robot'"),
    ],
)
def test_what_a_requestor_is_not_made_of(world: Any, agents: Any, told: str) -> None:
    with pytest.raises(SetupError, match=told.replace("(world, [agent])", ".*")):
        ControlRequestor(world, agents)


def test_print_shows_a_table_of_all_blocks() -> None:
    sim = small_sim(
        [OrientationSensor(target="box"), VelocitySensor(is_active=False)],
        rewards=[FallReward(cause_episode_to_end=True)],
    )
    assert str(sim.agents[0]).splitlines() == [
        "agent '0' on body 'robot'",
        "          block              name         parameters",
        "sensor    OrientationSensor  orientation  target='box'",
        "sensor    VelocitySensor     velocity     off;",
        "actuator  RBMoveActuator     move         move_amount=2.0",
        "reward    FallReward         fall         cause_episode_to_end=True",
        "brain     LocalBrain                      skip_frame=0, controller="
        "ScriptController(function=<function still at "
        + str(sim.agents[0]).split("<function still at ")[1].splitlines()[0],
    ]

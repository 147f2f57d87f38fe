"""AndRewardFunc, OrRewardFunc and conditions."""

from typing import Any

import pytest

from ai4u_edu import (
    AndRewardFunc,
    BoxShape,
    CircleShape,
    ControlRequestor,
    DoneSensor,
    EvalBoolValue,
    EvalFloatValue,
    EvalIntValue,
    FallReward,
    HeadingSensor,
    IDSensor,
    OrRewardFunc,
    RewardFunc,
    StepSensor,
    TouchRewardFunc,
    TouchSensor,
)
from ai4u_edu.base.errors import BlockError, ReadingError
from ai4u_edu.blocks.rewards.eval_value import BODY_PROPERTIES
from tests.builders import small_sim, small_world


class Pays(RewardFunc):
    """Pays the amounts of a list, one per decision."""

    amounts: list[float]
    ticks: int = 0

    def on_reset(self, agent: Any, view: Any) -> None:
        self.turn = -1

    def on_tick(self, body: Any, view: Any) -> None:
        self.ticks += 1

    def on_update(self, body: Any, view: Any) -> float:
        self.turn += 1
        return self.amounts[self.turn]


def paid(rewards: list[RewardFunc], steps: int, **fields: Any) -> list[float]:
    sim = small_sim(rewards=rewards, **fields)
    amounts = []
    for _ in range(steps):
        sim.step()
        amounts.append(sim.agents[0].reward)
    return amounts


def holds(condition: RewardFunc, **fields: Any) -> bool:
    """Return True if a condition holds after the first decision."""
    return paid([AndRewardFunc(children=[condition])], 1, **fields) == [1.0]


def test_conditions_pay_nothing_on_their_own() -> None:
    conditions: list[RewardFunc] = [
        EvalBoolValue(property="on_ground", name="a"),
        EvalIntValue(property="steps", min_value=0, max_value=9, name="b"),
        EvalFloatValue(property="x", min_value=-1, max_value=1, name="c"),
    ]
    assert paid(conditions, 3) == [0.0, 0.0, 0.0]


A, B = [1.0, 1.0, 0.0, 0.0], [-1.0, 0.0, 5.0, 0.0]


@pytest.mark.parametrize(
    ("kind", "expected"),
    [(AndRewardFunc, [7, 0, 0, 0]), (OrRewardFunc, [7, 7, 7, 0])],
)
def test_truth_tables(kind: Any, expected: list[float]) -> None:
    assert paid([kind(children=[Pays(amounts=A), Pays(amounts=B)], reward=7)], 4) == expected


def test_the_children_are_paid_on_request() -> None:
    children = [Pays(amounts=A), Pays(amounts=B), EvalBoolValue(property="on_ground", reward=0.25)]
    combined = OrRewardFunc(children=children, reward=0, update_children=True)
    assert paid([combined], 4) == [0.25, 1.25, 5.25, 0.25]
    assert paid([combined.changed(update_children=False)], 4) == [0.0] * 4


def test_every_child_is_asked_at_every_decision() -> None:
    never, counted = Pays(amounts=[0.0] * 3), Pays(amounts=[1.0, 2.0, 3.0])
    paid([AndRewardFunc(children=[never, counted])], 3, skip_frame=1)
    assert (counted.turn, counted.ticks) == (2, 6)


def test_children_that_are_off_take_no_part() -> None:
    off = Pays(amounts=[], is_active=False)
    assert paid([AndRewardFunc(children=[off, Pays(amounts=A)])], 2) == [1.0, 1.0]
    assert paid([AndRewardFunc(children=[off])], 2) == [0.0, 0.0]
    assert paid([OrRewardFunc(children=[off])], 2) == [0.0, 0.0]


def test_one_can_stand_in_the_other_whatever_it_pays() -> None:
    inner = OrRewardFunc(children=[Pays(amounts=A), Pays(amounts=B)], reward=0)
    assert paid([AndRewardFunc(children=[inner])], 4) == [1.0, 1.0, 1.0, 0.0]


def test_it_ends_the_episode_if_it_says_so_and_not_if_a_child_does() -> None:
    for whose, ends in (("child", False), ("parent", True)):
        child = Pays(amounts=[1.0], cause_episode_to_end=whose == "child")
        sim = small_sim(
            rewards=[AndRewardFunc(children=[child], cause_episode_to_end=whose == "parent")]
        )
        sim.step()
        assert sim.agents[0].terminated is ends


def test_a_reset_reaches_the_children() -> None:
    sim = small_sim(rewards=[AndRewardFunc(children=[Pays(amounts=[1.0])])])
    sim.step()
    sim.reset()
    sim.step()
    assert sim.agents[0].reward == 1.0


def test_touch_in_the_air() -> None:
    """And pays only if both hold: in the goal, and in the air."""
    world = small_world()
    world.add_area("goal", CircleShape(radius=1))
    children = [
        TouchRewardFunc(target="goal", reward=1, only_one_time=False),
        EvalBoolValue(property="on_ground", value=False),
    ]
    jumps = iter([0, 0, 1, 0])
    amounts = paid(
        [AndRewardFunc(children=children)],
        4,
        world=world,
        controller=lambda percept: {"move": [0, 0, next(jumps), 0]},
    )
    assert amounts == [0.0, 0.0, 1.0, 1.0]


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("x", 4.0), ("y", -1.0), ("z", 0.0), ("heading_deg", 90.0), ("speed", 5.0), ("vz", 0.0),
        ("turning_speed", 2.0), ("on_ground", 1.0), ("fallen", 0.0),
    ],
)  # fmt: skip
def test_every_property_of_a_body(name: str, value: float) -> None:
    world = small_world()
    body = world["box"]
    body.move_to(4, -1, heading=1.5707963267948966)
    body.set_velocity(3, 4)
    body.set_angular_velocity(2)
    assert BODY_PROPERTIES[name](body) == pytest.approx(value)
    assert len(BODY_PROPERTIES) == 9


def test_of_a_target_or_of_the_agent() -> None:
    near: dict[str, Any] = {"property": "x", "min_value": 3.9, "max_value": 4.1}
    assert holds(EvalFloatValue(**near, target="box"))
    assert not holds(EvalFloatValue(**near))


@pytest.mark.parametrize(
    ("low", "high", "expected"), [(4, 4, True), (3, 4, True), (4, 5, True), (4.1, 9, False)]
)
def test_the_ends_belong_to_the_range(low: float, high: float, expected: bool) -> None:
    condition = EvalFloatValue(property="x", target="box", min_value=low, max_value=high)
    assert holds(condition) is expected


def test_an_int_value_has_to_be_whole() -> None:
    for place, expected in ((4.0, True), (4.5, False)):
        world = small_world()
        sim = small_sim(
            rewards=[
                AndRewardFunc(
                    children=[EvalIntValue(property="x", target="box", min_value=0, max_value=9)]
                )
            ],
            world=world,
        )
        world["box"].move_to(place, 0)
        sim.step()
        assert (sim.agents[0].reward == 1.0) is expected


def test_steps_are_those_before_this_decision() -> None:
    condition = EvalIntValue(property="steps", min_value=1, max_value=2)
    assert paid([OrRewardFunc(children=[condition])], 4) == [0.0, 1.0, 1.0, 0.0]


def test_a_reading_is_the_one_that_the_decision_was_taken_on() -> None:
    def driven(percept: Any) -> dict[str, Any]:
        return {"move": [1, 0, 0, 0]}

    sim = small_sim(
        [TouchSensor(target="box")],
        rewards=[AndRewardFunc(children=[EvalBoolValue(property="touch")])],
        controller=driven,
    )
    before = False
    for _ in range(120):
        now = bool(sim.step()["touch"][0] > 0)
        assert (sim.agents[0].reward == 1.0) is before
        before = now
    assert before


def test_one_number_of_a_longer_reading() -> None:
    for index, value in ((0, 0.0), (1, 1.0)):
        condition = EvalFloatValue(
            property=f"heading[{index}]", min_value=value - 0.1, max_value=value + 0.1
        )
        assert holds(condition, sensors=[HeadingSensor()])


def test_sensors_made_of_one_number() -> None:
    sensors = [StepSensor(perception_key="count"), DoneSensor()]
    assert holds(EvalIntValue(property="count", min_value=0, max_value=0), sensors=sensors)
    assert holds(EvalBoolValue(property="done", value=False), sensors=sensors)


def setup_error(condition: RewardFunc, **fields: Any) -> str:
    with pytest.raises(BlockError) as caught:
        small_sim(rewards=[condition], **fields)
    return str(caught.value).removeprefix("agent '0', ")


def test_what_is_no_property() -> None:
    who = "EvalBoolValue 'eval_bool_value'"
    assert setup_error(EvalBoolValue(property="on_groud")) == (
        f"{who}: property: no body, agent or sensor has a 'on_groud'; did you mean 'on_ground'?"
    )
    assert setup_error(EvalBoolValue(property="eye[0]"), sensors=[TouchSensor(target="box")]) == (
        f"{who}: property: no body, agent or sensor has a 'eye'; known are 'episode_reward', "
        "'fallen', 'heading_deg', 'on_ground', 'speed', 'steps', 'touch', 'turning_speed', 'vz', "
        "'x', 'y', 'z'"
    )
    assert setup_error(EvalBoolValue(property="__class__")).startswith(
        f"{who}: property: no body, agent or sensor has a '__class__'"
    )
    assert setup_error(EvalBoolValue(property="steps", target="box")) == (
        f"{who}: property: a body has no 'steps'; known are 'fallen', 'heading_deg', 'on_ground', "
        "'speed', 'turning_speed', 'vz', 'x', 'y', 'z'"
    )
    assert setup_error(EvalBoolValue(property="x", target="bxo")) == (
        f"{who}: no body is named 'bxo'; did you mean 'box'?"
    )


@pytest.mark.parametrize(
    ("name", "text"),
    [
        (
            "heading",
            "property: expected one number, 'heading' has 2; choose one, as in 'heading[0]'",
        ),
        ("heading[2]", "property: expected an index up to 1, got 'heading[2]'"),
        ("who", "property: expected a reading made of numbers, 'who' is text"),
    ],
)
def test_readings_that_are_not_one_number(name: str, text: str) -> None:
    sim: ControlRequestor = small_sim(
        [HeadingSensor(), IDSensor(perception_key="who")],
        rewards=[AndRewardFunc(children=[EvalBoolValue(property=name)])],
    )
    with pytest.raises(ReadingError) as caught:
        sim.step()
    assert str(caught.value) == f"agent '0', AndRewardFunc 'and': {text}"


@pytest.mark.parametrize("kind", [EvalIntValue, EvalFloatValue])
def test_a_range_the_wrong_way_round(kind: Any) -> None:
    with pytest.raises(BlockError) as caught:
        kind(property="x", min_value=2, max_value=1, name="cond")
    assert str(caught.value) == (
        f"{kind.__name__} 'cond': expected min_value <= max_value, got 2..1"
    )


def test_a_childs_own_mistake_is_found_at_setup() -> None:
    text = setup_error(OrRewardFunc(children=[TouchRewardFunc(target="bxo")]))
    assert text == "OrRewardFunc 'or': no body or area is named 'bxo'; did you mean 'box'?"


def test_an_end_by_any_of_two() -> None:
    spike = BoxShape(size=(1, 1))
    world = small_world(plate=4)
    world.add_body("spike", spike, position=(-1.4, 0), kind="static")
    end = OrRewardFunc(
        name="end",
        children=[TouchRewardFunc(target="spike", reward=1), FallReward()],
        reward=-10,
        cause_episode_to_end=True,
    )
    for way in (1, -1):
        sim = small_sim(
            rewards=[end],
            world=world,
            controller=lambda percept, way=way: {"move": [way, 0, 0, 0]},
        )
        while not sim.agents[0].done:
            sim.step()
        assert sim.agents[0].reward_terms == {"end": -10.0}


def test_ticks_are_passed_on_only_where_a_child_wants_them() -> None:
    class Counting(OrRewardFunc):
        """Counts its own ticks."""

        def on_tick(self, body: Any, view: Any) -> None: ...

    def grounded() -> EvalBoolValue:
        return EvalBoolValue(property="on_ground")

    rewards = {
        "deep": AndRewardFunc(children=[OrRewardFunc(children=[Pays(amounts=[0.0])])]),
        "own": Counting(children=[grounded()]),
        "none": OrRewardFunc(children=[grounded()]),
    }
    for name, reward in rewards.items():
        reward.name = name
    sim = small_sim(rewards=list(rewards.values()), skip_frame=4)
    assert [each.name for each in sim.agents[0].bound_blocks.tick_rewards] == ["deep", "own"]

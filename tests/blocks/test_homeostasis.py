"""Internal variables: levels, drift, discomfort and reward."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ai4u_edu import (
    ControlRequestor,
    HomeostaticReward,
    HomeostaticSensor,
    HomeostaticVariable,
    RBMoveActuator,
)
from ai4u_edu.base.errors import BlockError, NameNotFoundError, ReadingError
from tests.builders import small_sim


def energy(**fields: Any) -> HomeostaticVariable:
    ends = {"range_min": -50, "range_max": 150, "comfort_min": 40, "comfort_max": 80, "value": 50}
    return HomeostaticVariable(name="energy", **(ends | fields))


@pytest.mark.parametrize(
    ("level", "check", "to_centroid", "discomfort", "share"),
    [
        (50, True, 10, 0, 0.5),
        (40, True, 20, 0, 0.45),
        (80, True, 20, 0, 0.65),
        (60, True, 0, 0, 0.55),
        (39, False, 21, 1, 0.445),
        (100, False, 40, 20, 0.75),
        (-50, False, 110, 90, 0.0),
        (150, False, 90, 70, 1.0),
    ],
)
def test_a_level(
    level: float, check: bool, to_centroid: float, discomfort: float, share: float
) -> None:
    variable = energy()
    variable.add_value(level - 50)
    assert variable.level == level
    assert variable.check() is check
    assert variable.centroid() == 60
    assert variable.distance_to_centroid() == to_centroid
    assert variable.discomfort() == discomfort
    assert variable.normalised() == pytest.approx(share)


@given(st.lists(st.floats(-1e6, 1e6), max_size=20))
def test_the_level_stays_in_its_range(amounts: list[float]) -> None:
    variable = energy()
    for amount in amounts:
        variable.add_value(amount)
        assert -50 <= variable.level <= 150
        assert 0 <= variable.normalised() <= 1


def test_the_declared_value_is_where_an_episode_begins() -> None:
    variable = energy()
    variable.add_value(20)
    assert (variable.value, variable.level) == (50, 70)
    assert variable.changed().level == 50


TITLE = "HomeostaticVariable 'energy'"


@pytest.mark.parametrize(
    ("fields", "text"),
    [
        (
            {"comfort_min": 90},
            "expected range_min <= comfort_min <= comfort_max <= range_max and a range that is "
            "not empty, got -50 .. 90 .. 80 .. 150",
        ),
        (
            {"range_max": 60},
            "expected range_min <= comfort_min <= comfort_max <= range_max and a range that is "
            "not empty, got -50 .. 40 .. 80 .. 60",
        ),
        ({"value": 151}, "expected a value within its range -50..150, got 151"),
        ({"value": -51}, "expected a value within its range -50..150, got -51"),
    ],
)
def test_impossible_variables(fields: dict[str, float], text: str) -> None:
    with pytest.raises(BlockError) as caught:
        energy(**fields)
    assert str(caught.value) == f"{TITLE}: {text}"


def test_an_empty_range() -> None:
    with pytest.raises(BlockError, match=r"not empty, got 0 \.\. 0 \.\. 0 \.\. 0"):
        HomeostaticVariable(name="x", range_max=0, comfort_max=0, value=0)


def kept(*variables: HomeostaticVariable, **fields: Any) -> tuple[ControlRequestor, Any]:
    reward = HomeostaticReward(variables=list(variables), **fields)
    sim = small_sim([HomeostaticSensor()], rewards=[reward], skip_frame=5)
    return sim, reward


def test_the_level_drifts_at_every_tick() -> None:
    sim, reward = kept(energy(drift_per_second=-6))
    variable = reward.variable("energy")
    sim.step()
    assert variable.level == pytest.approx(50 - 6 * 6 / 60)  # six ticks of a sixtieth of a second
    for _ in range(9):
        sim.step()
    assert variable.level == pytest.approx(50 - 6)


@pytest.mark.parametrize(
    ("moving", "airborne", "rates"),
    [
        (None, None, (-6, -6, -6)),
        (-12, None, (-6, -12, -12)),
        (None, -24, (-6, -6, -24)),
        (-12, -24, (-6, -12, -24)),
        (0, -24, (-6, 0, -24)),
    ],
)
def test_effort_costs_more(
    moving: float | None, airborne: float | None, rates: tuple[float, ...]
) -> None:
    variable = energy(
        drift_per_second=-6, moving_drift_per_second=moving, airborne_drift_per_second=airborne
    )
    reward = HomeostaticReward(variables=[variable])
    action = {"move": [0, 0, 0, 0]}
    move = RBMoveActuator(move_amount=2, jump_power=5)
    sim = small_sim(rewards=[reward], actuators=[move], controller=lambda _percept: action)
    for numbers, rate in zip(([0, 1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0]), rates, strict=True):
        action["move"], before = numbers, variable.level
        for _ in range(10):
            sim.step()
        assert variable.level - before == pytest.approx(rate * 10 / 60)


def test_what_discomfort_costs_as_it_comes_and_pays_as_it_goes() -> None:
    sim, reward = kept(energy(value=40), reward=10)
    variable = reward.variable("energy")
    amounts = []
    for change in (0, -30, -20, 30, 40, 30, 20, -10, 0):
        variable.add_value(change)
        sim.step()
        amounts.append(sim.agents[0].reward)
    # levels 40 10 -10 20 60 90 110 100 100, discomforts 0 30 50 20 0 10 30 20 20, of a range of 200
    assert amounts == pytest.approx([0, -1.5, -1, 1.5, 1, -0.5, -1, 0.5, 0])
    assert sum(amounts) == pytest.approx(10 * (0 - 20 / 200))
    assert sim.agents[0].reward_terms == {"homeostatic": pytest.approx(0)}


def test_discomforts_add_up_as_shares_of_their_ranges() -> None:
    warmth = HomeostaticVariable(
        name="warmth", range_max=40, comfort_min=18, comfort_max=24, value=8
    )
    _, reward = kept(energy(value=0), warmth)
    assert reward.discomfort() == pytest.approx(40 / 200 + 10 / 40)


def test_a_start_in_discomfort_is_not_paid_for() -> None:
    sim, _ = kept(energy(value=0))
    sim.step()
    assert sim.agents[0].reward == 0.0


def test_a_reset_restores_the_levels_before_the_first_reading() -> None:
    sim, reward = kept(energy(drift_per_second=-100))
    for _ in range(5):
        sim.step()
    assert reward.variable("energy").level == pytest.approx(0)
    sim.reset()
    assert reward.variable("energy").level == 50
    assert sim.agents[0].percept["homeostatic"].tolist() == [0.5]
    sim.step()
    assert sim.agents[0].reward == 0.0  # 40 is still in the zone: the last episode is forgotten


def test_the_sensor_reads_all_variables_in_order() -> None:
    warmth = HomeostaticVariable(
        name="warmth", range_max=40, comfort_min=18, comfort_max=24, value=10
    )
    sim, reward = kept(energy(), warmth)
    assert sim.agents[0].percept["homeostatic"].tolist() == [0.5, 0.25]
    reward.variable("warmth").add_value(100)
    assert sim.step()["homeostatic"].tolist() == [0.5, 1.0]


def test_unknown_names() -> None:
    _, reward = kept(energy())
    with pytest.raises(NameNotFoundError) as lost:
        reward.variable("enrgy")
    assert str(lost.value) == "no variable is named 'enrgy'; did you mean 'energy'?"
    keeper = HomeostaticReward(variables=[energy()])
    for source, rewards, hint in (
        ("homeostatik", [keeper], "did you mean 'homeostatic'?"),
        ("homeostatic", [], "there are none"),
        ("homeostatic", [keeper.changed(is_active=False)], "there are none"),
    ):
        with pytest.raises(BlockError) as caught:
            small_sim([HomeostaticSensor(source=source)], rewards=rewards)
        assert str(caught.value) == (
            f"agent '0', HomeostaticSensor 'homeostatic': no HomeostaticReward is called "
            f"{source!r}; {hint}"
        )


def test_two_variables_of_one_name() -> None:
    with pytest.raises(BlockError) as caught:
        HomeostaticReward(variables=[energy(), energy()])
    assert str(caught.value) == (
        "HomeostaticReward 'homeostatic': expected variables of different names, got 'energy' twice"
    )


def test_positions_and_distances_to_the_comfort_zone() -> None:
    variable = energy(value=30)
    assert variable.position_to_centroid() == -30
    assert (variable.position_to_min(), variable.position_to_max()) == (-10, -50)
    assert (variable.distance_to_min(), variable.distance_to_max()) == (10, 50)
    assert variable.distance_to_centroid() == 30
    variable.add_value(60)
    assert (variable.position_to_min(), variable.position_to_max()) == (50, 10)
    assert variable.normalised_comfort() == (0.45, 0.65)


@pytest.mark.parametrize(("value", "fits"), [(39.9, False), (40, True), (80, True), (81, False)])
def test_a_value_that_is_not_the_level(value: float, fits: bool) -> None:
    assert energy().check_value(value) is fits


def test_the_comfort_zone_can_be_moved() -> None:
    variable = energy()
    variable.set_centroid(130)
    assert (variable.comfort_min, variable.comfort_max) == (110, 150)
    assert variable.centroid() == 130
    assert (variable.check(), variable.discomfort()) == (False, 60)
    assert variable.changed().centroid() == 130


@pytest.mark.parametrize("value", [131, -31, float("nan"), float("inf")])
def test_the_comfort_zone_stays_in_the_range(value: float) -> None:
    variable = energy()
    with pytest.raises(BlockError, match="expected a centroid from -30 to 130, so that the"):
        variable.set_centroid(value)
    assert variable.centroid() == 60


def test_nan_is_no_amount() -> None:
    variable = energy()
    with pytest.raises(ReadingError, match="'energy': expected an amount, got nan"):
        variable.add_value(float("nan"))
    assert variable.level == 50

"""Each kind of check follows what happens, and is satisfied by nothing else."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from pydantic import TypeAdapter, ValidationError

from ai4u_edu import Scene
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import ParameterError
from ai4u_edu.blocks import LocalBrain
from ai4u_edu.locale import Text
from ai4u_edu.missions.check import Check, Following
from ai4u_edu.missions.checks import AnyCheck
from ai4u_edu.missions.events import Decision, Event, PersonAnswer, SeenPage, decision_of

CHECK: TypeAdapter[Check] = TypeAdapter(AnyCheck)
STILL = Decision(
    driver="keys",
    episode=1,
    step=1,
    seed=5,
    seconds=0.0,
    x=0.0,
    y=0.0,
    heading=0.0,
    speed=0.0,
    turning=0.0,
    terms={},
    reward_types={},
    outcome="",
    percept={"eyes": np.array([0.25, 0.75]), "level": 0.5},
    distances={"ahead": 2.0, "right": 1.0},
)


def following(type: str, **parameters: Any) -> Following:  # noqa: A002 - as in a file
    return Following(CHECK.validate_python({"type": type, **parameters}))


def moved(*places: float, **changes: Any) -> Iterator[Decision]:
    for step, x in enumerate(places):
        yield replace(STILL, x=x, step=step, **changes)


def see(check: Following, *events: Event) -> bool:
    for event in events:
        check.see(event)
    return check.is_done


def test_drives_counts_the_way_along_the_heading() -> None:
    check = following("drives", metres=2, way="forward")
    assert not see(check, *moved(0, 1, 0, 0.9))
    assert check.words == "1.9 of 2 m"
    assert see(check, *moved(0.9, 1.0))
    assert not see(following("drives", metres=2, way="backward"), *moved(0, 3))
    assert see(following("drives", metres=2), *moved(0, -2))
    sideways = [replace(STILL, y=y) for y in (0.0, 5.0)]
    assert not see(following("drives", metres=2), *sideways)


def test_a_robot_that_others_push_does_not_drive() -> None:
    way = [step * 0.1 for step in range(40)]
    pushed = following("drives", metres=2)
    assert not see(pushed, *moved(*way, acts=False))
    rolls_on = following("drives", metres=0.5)
    assert see(rolls_on, *moved(0.0), *moved(*way[1:8], acts=False))


def test_a_new_start_is_no_way() -> None:
    check = following("drives", metres=2)
    assert not see(check, *moved(0), *moved(50, episode=2), *moved(0, episode=3))


KINDS: list[dict[str, Any]] = [
    {"type": "drives", "metres": 2},
    {"type": "covers", "metres": 2, "seconds": 3},
    {"type": "turns", "degrees": 90},
    {"type": "reaches_goal", "times": 2},
    {"type": "reaches_goal", "times": 2, "of": 3},
    {"type": "is_paid", "reward": "touch", "times": 2},
    {"type": "holds", "ranges": [{"what": "speed", "above": 1}]},
    {"type": "holds", "ranges": [{"what": "speed", "above": 1}], "word": "fast"},
    {"type": "starts", "times": 2},
    {"type": "ends", "times": 2},
    {"type": "decides", "decisions": 9},
    {"type": "builds", "tag": "wall", "count": 2},
]


@pytest.mark.parametrize("check", KINDS, ids=str)
def test_how_far_it_is_can_be_translated(check: dict[str, Any]) -> None:
    told = following(**check)
    see(told, STILL)
    assert isinstance(told.words, Text)


@pytest.mark.parametrize("answer", ["", "5"])
@pytest.mark.parametrize("what", ["level", "unknown"])
@pytest.mark.parametrize("before", [None, STILL])
def test_what_is_wrong_with_a_number_can_be_translated(
    answer: str, what: str, before: Decision | None
) -> None:
    told = following("reads", question="?", what=what, within=0.1)
    see(told, PersonAnswer(answer, before))
    assert isinstance(told.words, Text)


def test_covers_looks_at_a_way_when_the_time_is_over() -> None:
    parameters = {"metres": 6, "seconds": 3, "width": 3}

    def way(*places: tuple[float, float], **changes: Any) -> list[Decision]:
        return [
            replace(STILL, x=x, y=y, step=step, seconds=float(step), **changes)
            for step, (x, y) in enumerate(places)
        ]

    far = way((0, 0), (2, 0), (4, 0), (4, 2))
    check = following("covers", **parameters)
    assert not see(check, *far[:-1])
    assert check.words == "4.0 of 6 m; 1 s are left"
    assert see(check, far[-1])
    slow = following("covers", **parameters)
    assert not see(slow, *way((0, 0), (2, 0), (4, 0), (5, 0), (9, 0)))
    words = "5.0 m, on a way 5.0 m wide: 6 m are needed, and 3 m wide. Press New start."
    assert slow.words == words
    assert see(slow, *way((0, 0), (2, 0), (4, 0), (4, 2), episode=2))
    assert not see(following("covers", **parameters), *way((0, 0), (2, 0), (0, 0), (2, 0)))
    waits = [replace(STILL, step=step, seconds=step - 9.0) for step in range(-9, 0)]
    assert see(following("covers", **parameters), *waits, *far)
    *most, last = far
    assert not see(following("covers", **parameters), *most, replace(last, outcome="fell"))
    assert not see(following("covers", **parameters), *most, replace(last, step=5))  # a break


def test_turns_takes_off_what_is_turned_back() -> None:
    headings = (0.0, 1.0, 0.5, 1.4)
    check = following("turns", degrees=75, way="left")
    assert not see(check, *(replace(STILL, heading=each) for each in headings[:3]))
    assert see(check, replace(STILL, heading=headings[3]))
    right = following("turns", degrees=75, way="right")
    assert not see(right, *(replace(STILL, heading=each) for each in headings))


def test_a_goal_counts_only_if_its_start_was_seen() -> None:
    check = following("reaches_goal")
    assert not see(check, replace(STILL, step=7, outcome="goal"))
    assert not see(check, replace(STILL, episode=2), replace(STILL, episode=2, outcome="fell"))
    assert see(check, replace(STILL, episode=3), replace(STILL, episode=3, step=9, outcome="goal"))


def test_a_slow_goal_does_not_count() -> None:
    slow = replace(STILL, step=90, outcome="goal", seconds=7.0)
    assert not see(following("reaches_goal", seconds=6), STILL, slow)
    assert see(following("reaches_goal", seconds=8), STILL, slow)
    assert not see(following("reaches_goal", decisions=80), STILL, slow)


def test_goals_are_counted_among_different_starts() -> None:
    def episode(seed: int, outcome: str) -> list[Decision]:
        begin = replace(STILL, episode=seed, seed=seed % 100)
        end = replace(begin, step=3, outcome=outcome)  # type: ignore[arg-type]
        return [begin, end]

    check = following("reaches_goal", times=2, of=3)
    assert check.words == "2 of 3 starts have to reach the goal"
    assert not see(check, *episode(1, "goal"), *episode(101, "goal"), *episode(201, "goal"))
    assert not see(check, *episode(2, "fell"), *episode(3, "fell"), *episode(4, "goal"))
    assert check.words == "1 of 3 starts reached the goal; 2 of 3 are needed"
    assert see(check, *episode(5, "goal"))


def test_rewards_are_counted_in_one_episode() -> None:
    check = following("is_paid", reward="touch", times=2)
    paid = replace(STILL, terms={"touch": 1.0})
    assert not see(check, paid, replace(paid, episode=2), replace(STILL, terms={"touch": -1.0}))
    assert see(check, paid, paid)


def test_a_reward_that_has_to_be_paid_has_a_name_or_a_class() -> None:
    for fields in ({}, {"reward": "touch", "block": "TouchRewardFunc"}):
        with pytest.raises(ValidationError, match="expected either a reward or a block"):
            following("is_paid", **fields)
    small = replace(STILL, terms={"closer": 0.1, "touch": 0.0})
    assert not see(following("is_paid", reward="touch"), small)


def test_a_reward_of_a_class_counts_whatever_its_name_is() -> None:
    types = {"cup": "TouchRewardFunc", "off": "FallReward"}
    paid = replace(STILL, terms={"cup": 1.0, "off": 0.0, "handlers": 1.0}, reward_types=types)
    assert see(following("is_paid", block="TouchRewardFunc"), paid)
    assert see(following("is_paid", reward="cup"), paid)
    assert not see(following("is_paid", block="FallReward"), paid)
    assert not see(following("is_paid", reward="touch"), paid)


def test_ranges_have_to_hold_together_and_in_a_row() -> None:
    ranges = [{"what": "eyes[1]", "above": 0.5}, {"what": "distance ahead", "below": 3}]
    check = following("holds", ranges=ranges, decisions=3)
    away = replace(STILL, distances={"ahead": 4.0})
    assert not see(check, STILL, STILL, away, STILL, STILL)
    assert see(check, STILL)
    half = following("holds", ranges=ranges, decisions=4, share=0.5)
    assert not see(half, STILL, away)
    assert half.words == "1 of 2 decisions"
    assert see(half, STILL)
    assert not see(following("holds", ranges=ranges, decisions=4, share=0.5), STILL, *[away] * 3)


def test_starts_are_told_apart_by_their_seeds() -> None:
    again, other = replace(STILL, episode=2), replace(STILL, episode=3, seed=6)
    check = following("starts", place="other")
    assert not see(check, STILL, again)
    assert see(check, other)
    assert see(following("starts", place="same"), STILL, again)


def test_one_decision_is_not_counted_in_words() -> None:
    ranges = [{"what": "level", "above": 0.7}]
    assert following("holds", ranges=ranges, decisions=1).words == ""
    assert following("holds", ranges=ranges, decisions=2).words == "0 of 2 decisions"


def test_pages_and_answers_are_seen() -> None:
    check = following("opens", tab="code")
    assert not see(check, STILL, SeenPage("drive"))
    assert see(check, SeenPage("code"))
    blocks = following("opens", tab="code", way="blocks")
    assert not see(blocks, SeenPage("code", "python"), SeenPage("build", "blocks"))
    assert see(blocks, SeenPage("code", "blocks"))
    reads = following("reads", question="How far?", what="level", within=0.05)
    assert not see(reads, PersonAnswer("0.5", None))
    assert reads.words == "Drive a little first."
    for wrong in ("abc", "0.6", "nan", "inf"):
        assert not see(reads, PersonAnswer(wrong, STILL))
    assert see(reads, PersonAnswer(" 0,52 ", STILL))
    chooses = following("chooses", question="Which?", options=["a", "b"], right="b")
    assert not see(chooses, PersonAnswer("a", STILL))
    assert see(chooses, PersonAnswer("b", STILL))


def test_what_is_built_is_counted() -> None:
    scene = Scene.load("maze").description
    assert see(following("builds", tag="wall", count=4), scene)
    assert not see(following("builds", tag="moon"), scene)
    assert see(following("builds", kind="rewards"), scene)
    assert see(following("builds", block="HeadingSensor"), scene)
    assert not see(following("builds", block="TouchSensor"), scene)


@pytest.mark.parametrize(
    ("parameters", "text"),
    [
        ({"type": "drives", "metres": 0}, "metres"),
        ({"type": "holds", "ranges": [{"what": "speed"}]}, "above, below or both"),
        ({"type": "reaches_goal", "times": 3, "of": 2}, "at most 2"),
        ({"type": "chooses", "question": "?", "options": ["a", "b"], "right": "c"}, "'a', 'b'"),
        ({"type": "builds"}, "a tag, a block or a kind"),
    ],
)
def test_wrong_parameters_are_refused(parameters: dict[str, Any], text: str) -> None:
    with pytest.raises((ParameterError, ValueError), match=text):
        CHECK.validate_python(parameters)


def test_a_decision_has_what_the_robot_did(maze: ControlRequestor) -> None:
    agent = maze.agents[0]
    maze.reset(1)
    for _ in range(24):
        maze.step()
    decision = decision_of(maze, agent)
    assert (decision.driver, decision.episode, decision.step) == ("keys", 1, 24)
    assert set(decision.distances) == {"around", "ahead", "left", "right"}
    assert decision.distances["around"] == min(decision.distances.values()) > 0.4
    assert decision.value_of("heading[0]") == agent.percept["heading"][0]


def test_a_fall_that_a_reward_ends_is_a_fall() -> None:
    """The body is not out of the world yet when its reward ends the episode."""
    sim = Scene.load("box_chase").build()
    agent = sim.agents[0]
    agent.use_brain(LocalBrain(controller=lambda _: {"move": [-1, 0, 0, 0]}))
    sim.reset(1)
    while not agent.done:
        sim.step()
    assert decision_of(sim, agent).outcome == "fell"


def test_what_a_robot_does_not_sense_yet_does_not_hold() -> None:
    check = following("holds", ranges=[{"what": "rays[3]", "above": 0}], decisions=1)
    blind = replace(STILL, distances={})
    assert not see(check, blind)
    assert not see(following("holds", ranges=[{"what": "distance left", "above": 0}]), blind)
    reads = following("reads", question="?", what="rays[3]", within=1)
    assert not see(reads, PersonAnswer("1", blind))
    assert reads.words == "The robot senses no rays[3] yet."


def test_builds_looks_at_parameters_and_their_defaults() -> None:
    scene = Scene.load("box_chase").description
    motor = {"block": "RBMoveActuator"}
    (amount,) = (
        each["move_amount"] for each in scene.agents[0]["actuators"] if "move_amount" in each
    )
    assert see(following("builds", **motor, values={"move_amount": amount}), scene)
    assert not see(following("builds", **motor, values={"move_amount": amount + 1}), scene)
    fall = {"block": "FallReward"}
    assert see(following("builds", **fall, values={"max_rewards": 1}), scene)
    with pytest.raises(ValueError, match="has no parameter 'move_amont'; did you mean 'move_am"):
        following("builds", **motor, values={"move_amont": 1})


@pytest.fixture
def maze() -> ControlRequestor:
    return Scene.load("maze").build()

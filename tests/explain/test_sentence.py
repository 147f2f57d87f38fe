"""The names of rays, and the sentence about the one that matters."""

import math
import re
from typing import Any

import numpy as np
import pytest

from ai4u_edu import (
    BasicAgent,
    BoxShape,
    CircleShape,
    ControlRequestor,
    LocalBrain,
    RayCastingSensor,
    Scene,
    World,
)
from ai4u_edu.explain import (
    axes_of_agent,
    explained,
    groups_of_agent,
    middle_of,
    occlusion,
    sentence,
)
from ai4u_edu.explain.groups import Group
from ai4u_edu.explain.sentence import Axis
from tests.explain.worlds import robot_and_box


def told_of(sim: ControlRequestor, actuators: tuple[str, ...] = ("move",)) -> str:
    agent = sim.agents[0]
    nothing = {"eyes": np.zeros_like(agent.percept["eyes"])}
    told = occlusion(
        agent.brain,
        agent.percept,
        baseline=middle_of(agent) | nothing,
        groups=groups_of_agent(agent),
    )
    return sentence(told, axes_of_agent(agent, actuators))


def turns_for_ray(ray: int, rays: int = 9) -> Any:
    """Turn left if one ray, counted from the left from 1, sees something."""
    index = 2 * (rays - ray)
    return lambda percept: {"move": [1.0, -percept["eyes"][index], 0, 0]}


def test_the_sentence_names_the_planted_ray() -> None:
    # 1 m to the left at 3 m: 18 degrees; ray 3 of 9 in 90 degrees is at 18
    assert told_of(robot_and_box(turns_for_ray(3))) == (
        "It turns left because ray 3 sees the box. Without it, it would go straight."
    )


def test_rays_are_counted_from_the_left() -> None:
    for side, seen in ((1.0, {"ray 3", "ray 4"}), (-1.0, {"ray 6", "ray 7"})):
        agent = robot_and_box(lambda percept: {}, box=(3.0, side)).agents[0]
        rays = [each for each in groups_of_agent(agent) if each.name.startswith("ray")]
        assert [each.name for each in rays] == [f"ray {number + 1}" for number in range(9)]
        found = {each.name for each in rays if each.sees == "box"}
        assert found & seen
        assert {each.sees for each in rays} == {"box", "nothing"}
        for ray in rays:  # the numbers of a ray are those that tell of the box
            assert agent.percept["eyes"][ray.mask].any() == (ray.sees == "box")


def test_the_rays_of_a_grid_are_counted_by_row() -> None:
    world = World()
    world.add_floor("floor", BoxShape(size=(12, 12)))
    world.add_body("robot", CircleShape(radius=0.4))
    world.add_body("box", BoxShape(size=(0.8, 0.8)), position=(3.0, 1.3), tags=["box"])
    sensor = RayCastingSensor(
        perception_key="eyes",
        rows=2,
        columns=3,
        vertical_shift=0,
        vertical_field_of_view=10,
        group_code={"box": 1},
        return_distance=True,
        stacked_observations=2,
    )
    brain = LocalBrain(controller=lambda percept: {})
    agent = BasicAgent(body="robot", sensors=[sensor], brains=[brain])
    ControlRequestor(world, [agent]).reset(seed=0)
    groups = groups_of_agent(agent, whole=True)
    by_name = {each.name: each for each in groups}
    assert list(by_name)[:3] == ["ray 1 of row 1", "ray 2 of row 1", "ray 3 of row 1"]
    assert by_name["ray 1 of row 1"].sees == "box"
    for group in groups[:6]:
        assert agent.percept["eyes"].ravel()[group.mask].any() == (group.sees == "box")
        assert group.mask.sum() == 4  # code and distance, now and before
    codes, distances = by_name["all codes of eyes"].mask, by_name["all distances of eyes"].mask
    assert (codes ^ distances).all()
    assert by_name["all of eyes"].mask.all()
    assert agent.percept["eyes"].ravel()[codes].max() == 1.0


@pytest.mark.parametrize("distances", [False, True])
def test_all_codes_and_all_distances_of_a_fan(distances: bool) -> None:
    agent = robot_and_box(lambda percept: {}, return_distance=distances).agents[0]
    groups = {each.name: each for each in groups_of_agent(agent, whole=True)}
    assert ("all codes of eyes" in groups) == distances
    if distances:
        seen = agent.percept["eyes"]
        assert set(seen[groups["all codes of eyes"].mask]) == {0.0, 1.0}
        assert 0 < seen[groups["all distances of eyes"].mask].max() < 1


ZERO = {"a": np.zeros(()), "b": np.zeros(())}
ONE = {"a": np.float64(1.0), "b": np.float64(1.0)}


def of(policy: Any, percept: dict[str, Any] = ONE, axes: tuple[Axis, ...] = ()) -> list[str]:
    """Return the sentence about a policy of two numbers, and how much of the whole it explains."""
    told = occlusion(lambda percept: [policy(**percept)], percept, baseline=ZERO)
    return [sentence(told, axes), explained(told, axes)]


@pytest.mark.parametrize(
    ("policy", "percept", "words"),
    [
        pytest.param(
            lambda a, b: 0.5,
            ONE,
            "It looks at nothing: the action is the same whatever it senses.",
            id="nothing-is-looked-at",
        ),
        pytest.param(
            lambda a, b: 0.3 + max(0.0, a - 2),
            ONE,
            "Nothing that it senses now decides: it would do the same if all of it were as in the "
            "comparison.",
            id="bias-only",
        ),
        pytest.param(
            lambda a, b: max(a, b),
            ONE,
            "It has action above 0 because of a and of b together. Without both, it would have "
            "action near 0.",
            id="two-together",
        ),
        pytest.param(
            lambda a, b: a + b,
            {"a": np.float64(0.0), "b": np.float64(0.0)},
            "All that it senses now is as in the comparison, so there is nothing to leave out. "
            "Let it move on.",
            id="at-the-baseline",
        ),
        pytest.param(
            lambda a, b: 0.03 * a,
            ONE,
            "Nothing that it senses moves the action much: a moves it most, by 1.5% of its range.",
            id="small-effect",
        ),
    ],
)
def test_each_cause_of_no_single_slot_has_its_sentence(
    policy: Any, percept: dict[str, Any], words: str
) -> None:
    assert of(policy, percept)[0] == words


def test_equal_slots_are_all_named_and_the_sum_of_the_parts_is_told() -> None:
    assert of(lambda a, b: a * b) == [
        "It has action above 0 because of a and of b. Without one of them, it would have action "
        "near 0.",
        "Left out one by one, the slots explain 200% of what all do together: some need each "
        "other.",
    ]
    assert of(lambda a, b: a + b / 10)[1] == (
        "Left out one by one, the slots explain 100% of what all do together."
    )
    assert of(lambda a, b: max(a, b))[1] == (
        "Left out one by one, the slots explain 0% of what all do together: some stand in for "
        "others."
    )


def test_parts_against_the_whole_are_told_as_that() -> None:
    assert of(lambda a, b: a + b - 1.2 * a * b)[1] == (
        "Left out one by one, the slots move it the other way than all of them together."
    )


def test_many_small_parts_are_told_as_that() -> None:
    many = {"all": np.ones(30)}
    told = occlusion(
        lambda percept: [percept["all"].sum() / 30], many, baseline={"all": np.zeros(30)}
    )
    assert sentence(told, []) == (
        "Many numbers decide together: each of them alone moves the action by less than 5% of its "
        "range, all of them by 50%."
    )


def test_no_sentence_has_a_number_that_is_none() -> None:
    for nan in (math.nan, math.inf, -math.inf):
        for said in (
            *of(lambda a, b, nan=nan: nan),
            *of(lambda a, b, nan=nan: nan if a == 0 else 0.5 * b),
            *of(lambda a, b, nan=nan: nan if a * b == 0 else 1.0),
            *of(lambda a, b, nan=nan: nan if a + b == 0 else 1.0),
        ):
            assert not re.search(r"\b(nan|inf)\b", said), said
    assert of(lambda a, b: math.nan)[0].startswith("Its action has a number that is none")
    assert of(lambda a, b: math.nan if a == 0 else 0.5)[0].startswith("Without a, its action")


def test_wheels_and_eyes_have_words_of_their_own() -> None:
    sim = Scene.load("line_follow").build()
    sim.reset(seed=1)
    agent = sim.agents[0]
    groups = [each for each in groups_of_agent(agent) if each.name.startswith("eye ")]
    lit = next(each for each in groups if each.sees == "line")
    assert {each.sees for each in groups} <= {"line", "nothing"}
    key, index = lit.key, int(np.flatnonzero(lit.mask)[0])
    told = occlusion(
        lambda percept: {"move": [0.0, float(percept[key][index])]},
        agent.percept,
        baseline=middle_of(agent) | {key: np.zeros(len(groups))},
        groups=groups,
    )
    assert sentence(told, [Axis("left", -1, 1), Axis("right", -1, 1)]) == (
        f"It turns its right wheel forward because {lit.name} sees the line. Without it, it would "
        "stop its right wheel."
    )
    jumps = [Axis("jump", 0, 1)]
    jump = occlusion(lambda percept: [percept["a"]], ONE, baseline=ZERO)
    assert "it would not jump" in sentence(jump, jumps)


def test_more_and_less_of_the_same() -> None:
    more = told_of(
        robot_and_box(lambda percept: {"move": [0.2 + 0.5 * percept["bearing"][1], 0, 0, 0]})
    )
    assert more == (
        "It drives forward more because the box is ahead of it: 0.67. "
        "Without that sensor, it would be 0.20."
    )
    less = told_of(
        robot_and_box(lambda percept: {"move": [1 - percept["bearing"][1] / 2, 0, 0, 0]})
    )
    assert less == (
        "It drives forward less because the box is ahead of it: 0.53. "
        "Without that sensor, it would be 1.00."
    )


def said_by(scene: str, name: str) -> str:
    """Return the clause on a number of a library scene's agent at its start."""
    sim = Scene.load(scene).build()
    sim.reset(seed=1)
    return next(each.says for each in groups_of_agent(sim.agents[0]) if each.name == name)


def test_numbers_of_a_robot_speak_plainly() -> None:
    assert said_by("push_block", "block: left") == "the block is to its right"
    assert said_by("parking", "bay: forward") == "the bay is ahead of it"
    assert said_by("parking", "heading: east?").startswith("it faces ")
    assert said_by("forage", "inside: energy").startswith("its energy is ")
    assert said_by("yardstick", "distance") in (
        "the target is near",
        "the target is not far",
        "the target is far away",
    )
    assert said_by("jumper", "position: z") == ""


def test_choices_on_a_grid_have_directions() -> None:
    sim = Scene.load("grid_world").build()
    (axis,) = axes_of_agent(sim.agents[0], ["move"])
    told = occlusion(lambda percept: [4.0 * (percept["a"] > 0)], ONE, baseline=ZERO)
    assert sentence(told, [axis]) == "It goes down because of a. Without it, it would stay."


def test_what_has_no_effect_is_not_told() -> None:
    # the robot's jump_power is 0
    said = told_of(robot_and_box(lambda percept: {"move": [0, 0, percept["bearing"][1], 0]}))
    assert said.startswith("Nothing that it senses now decides")


def test_an_action_nobody_described_has_its_own_names() -> None:
    told = occlusion(lambda percept: [percept["a"]], {"a": 0.5}, baseline={"a": np.zeros(())})
    assert sentence(told, []) == (
        "It has action above 0 because of a. Without it, it would have action near 0."
    )
    assert told.groups == (Group("a", "a", told.groups[0].mask),)

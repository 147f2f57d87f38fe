"""CheckpointsReward: each target is paid once, in order."""

from collections.abc import Sequence

import pytest

from ai4u_edu import BoxShape, CheckpointsReward, CircleShape, ControlRequestor
from ai4u_edu.base.errors import BlockError, ParameterError
from tests.builders import small_sim, small_world

PLACES = {"a": (2.0, 0.0), "b": (0.0, 2.0), "c": (-2.0, 0.0), "d": (0.0, -2.0), "-": (0.0, 0.0)}


def sim_with(reward: CheckpointsReward) -> ControlRequestor:
    world = small_world()
    for name in "abcd":
        world.add_area(name, CircleShape(radius=0.5), position=PLACES[name])
    return small_sim(actuators=[], rewards=[reward], world=world)


def paid(sim: ControlRequestor, way: str) -> list[float]:
    amounts = []
    for name in way:
        sim.agents[0].body.move_to(*PLACES[name])
        sim.step()
        amounts.append(sim.agents[0].reward)
    return amounts


def way_of(**fields: object) -> ControlRequestor:
    return sim_with(CheckpointsReward(targets=["a", "b", "c", "d"], **fields))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("way", "expected"),
    [
        ("-abcd", [0, 1, 1, 1, 1 + 5]),
        ("aaab-bb", [1, 0, 0, 1, 0, 0, 0]),
        ("ababab", [1, 1, 0, 0, 0, 0]),  # to and fro
        ("acdbcd", [1, 0, 0, 1, 1, 6]),  # the short cut was for nothing
        ("dcb-a", [0, 0, 0, 0, 1]),  # the wrong way round
        ("abcdabcd", [1, 1, 1, 6, 0, 0, 0, 0]),
    ],
)
def test_only_the_next_one_counts_and_only_once(way: str, expected: Sequence[float]) -> None:
    assert paid(way_of(lap_reward=5), way) == expected


@pytest.mark.parametrize(
    ("way", "expected"),
    [
        ("abcda", [1, 1, 1, 1, 6]),
        ("cdabc", [1, 1, 1, 1, 6]),
        ("dabcd", [1, 1, 1, 1, 6]),
        ("cdab-bcd", [1, 1, 1, 1, 0, 0, 6, 0]),
        ("cbad", [1, 0, 0, 1]),  # the wrong way round
    ],
)
def test_a_loop_begins_anywhere_and_ends_where_it_began(way: str, expected: list[float]) -> None:
    assert paid(way_of(lap_reward=5, loop=True), way) == expected


def test_the_lap_alone_is_a_term_that_ends_the_episode() -> None:
    sim = way_of(reward=0, lap_reward=7, cause_episode_to_end=True)
    assert paid(sim, "abc") == [0, 0, 0]
    assert not sim.agents[0].done
    assert paid(sim, "d") == [7]
    assert sim.agents[0].terminated


def test_a_reset_begins_anew() -> None:
    for loop, second in ((False, [0, 1]), (True, [1, 0])):
        sim = way_of(loop=loop)
        paid(sim, "ab")
        sim.reset()
        assert paid(sim, "ca") == second


def test_nobody_is_too_fast_for_them() -> None:
    # in one decision of 60 ticks the robot drives through all three
    world = small_world()
    for number in (1, 2, 3):
        world.add_area(str(number), BoxShape(size=(0.1, 1)), position=(0.4 * number, 0))
    reward = CheckpointsReward(targets=["1", "2", "3"])
    sim = small_sim(
        rewards=[reward],
        world=world,
        controller=lambda percept: {"move": [1, 0, 0, 0]},
        skip_frame=59,
    )
    sim.step()
    assert sim.agents[0].body.position[0] > 1.5
    assert sim.agents[0].reward == 3.0


def test_bodies_can_be_targets() -> None:
    reward = CheckpointsReward(targets=["box"], reward=3)
    sim = small_sim(rewards=[reward], controller=lambda percept: {"move": [1, 0, 0, 0]})
    total = 0.0
    for _ in range(150):
        sim.step()
        total += sim.agents[0].reward
    assert total == 3.0


def test_what_is_refused() -> None:
    with pytest.raises(ParameterError, match="targets: expected at least 1 entries"):
        CheckpointsReward(targets=[])
    with pytest.raises(BlockError, match="no body or area is named 'e'; "):
        sim_with(CheckpointsReward(targets=["a", "e"]))

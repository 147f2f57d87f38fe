"""Rescue lines by seed: whoever follows the line by its rules gets to the victim."""

import math

import numpy as np
import pytest

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.base.errors import ParameterError
from ai4u_edu.world import BodyDescription, BoxShape, RescueField
from ai4u_edu.world.fields import GeneratedField
from tests.scenes.solvers import solver_of
from tests.world.rescue_reading import Reading
from tests.world.test_fields import RESCUES, generated

SEEDS = pytest.mark.parametrize(
    "seeds", [range(20), pytest.param(range(20, 1000), marks=pytest.mark.nightly)], ids=str
)


@SEEDS
@pytest.mark.parametrize("field", RESCUES, ids=str)
def test_a_search_by_the_rules_finds_the_victim(field: RescueField, seeds: range) -> None:
    for seed in seeds:
        made = generated(field, seed)
        reading = Reading(field, made)
        tiles = reading.follow()
        assert len(tiles) == len(set(tiles)), seed
        goal = made.places[field.goal][0]
        assert reading.is_within_reach(field.centre(tiles[-1]), goal), seed
        assert reading.is_within_reach(field.centre(tiles[0]), goal), seed


def count(made: GeneratedField, tag: str) -> int:
    return sum(tag in piece.tags for piece in made.pieces)


@pytest.mark.parametrize("difficulty", [0.05, 0.5, 1.0])
def test_what_sensors_name_is_there_at_every_difficulty(difficulty: float) -> None:
    field = RescueField(
        width=10, height=8, length=32, crossings=3, gaps=2, obstacles=2, difficulty=difficulty
    )
    for seed in range(40):
        made = generated(field, seed)
        assert 1 <= count(made, "mark") <= 3
        assert count(made, "obstacle") == max(1, round(2 * difficulty))
        assert count(made, "entrance") == 1
        assert 4 <= count(made, "wall") <= 5
        assert count(made, "line") >= 1


def test_there_is_room_to_drive_around_an_obstacle_on_both_sides() -> None:
    field = RescueField(width=10, height=8, length=30, obstacles=2, gaps=0)
    for seed in range(40):
        made = generated(field, seed)
        obstacles = [piece for piece in made.pieces if "obstacle" in piece.tags]
        (left, low), (right, high) = field.bounds()
        for obstacle in obstacles:
            x, y = obstacle.position
            reach = 1.5 * field.cell
            assert left <= x - reach
            assert x + reach <= right
            assert low <= y - reach
            assert y + reach <= high
            for x0, y0, x1, y1 in Reading(field, made).solid:
                is_itself = x0 < x < x1 and y0 < y < y1
                # a wall's middle may lie on the border of the tiles around
                more = reach - field.wall / 2 - 1e-6
                assert (
                    is_itself
                    or x1 <= x - more
                    or x0 >= x + more
                    or y1 <= y - more
                    or y0 >= y + more
                ), seed


def test_a_victim_waits_in_the_room_and_not_in_its_entrance() -> None:
    field = RescueField(room_size=3, length=12)
    seen = set()
    for seed in range(60):
        made = generated(field, seed)
        entrance = next(piece for piece in made.pieces if "entrance" in piece.tags)
        goal = made.places["victim"][0]
        away = math.dist(entrance.position, goal)
        assert field.cell <= away <= 4.0 * field.cell, seed
        seen.add(round(away, 2))
    assert len(seen) > 3


def test_marks_of_the_scene_lie_on_the_line_and_under_no_obstacle() -> None:
    field = RESCUES[1]
    for seed in range(40):
        made = generated(field, seed)
        tiles = [field.centre(tile) for tile in Reading(field, made).follow()]
        places = [made.places[name][0] for name in field.marks]
        order = [min(range(len(tiles)), key=lambda at: math.dist(tiles[at], p)) for p in places]
        assert order == sorted(set(order)), seed
        blocked = [piece.position for piece in made.pieces if "obstacle" in piece.tags]
        assert not set(blocked) & set(places), seed
        assert [tiles[at] for at in order] == places, seed


def test_a_difficulty_makes_the_way_longer() -> None:
    lengths = [
        np.mean([len(Reading(field, generated(field, seed)).follow()) for seed in range(20)])
        for share in (0.3, 0.6, 1.0)
        for field in [RescueField(width=10, height=8, length=30, difficulty=share)]
    ]
    assert lengths == pytest.approx([12, 18, 30])


@pytest.mark.parametrize("seeds", [range(2), pytest.param(range(2, 20), marks=pytest.mark.nightly)])
def test_a_difficulty_raises_the_time_of_a_driver(seeds: range) -> None:
    sim = Scene.load("endless_rescue").build()
    agent = sim.agents[0]
    times = []
    for share in (0.1, 1.0):
        total = 0
        for seed in seeds:
            agent.use_brain(
                LocalBrain(
                    controller=solver_of("endless_rescue"), skip_frame=agent.brain.skip_frame
                )
            )
            sim.reset(seed, {"generate.difficulty": share})
            while not agent.done:
                sim.step()
            assert agent.ledger.episode_terms["victim"] > 0, seed
            total += agent.steps
        times.append(total)
    assert times[1] > 1.15 * times[0]


def test_what_a_rescue_line_can_not_be() -> None:
    with pytest.raises(ParameterError, match="at most 22 tiles in a field of 8 x 6 with a room"):
        RescueField(width=8, height=6, length=30)
    with pytest.raises(ParameterError, match="at least 12 tiles for 1 crossings, 1 gaps and 1 obs"):
        RescueField(width=8, height=6, length=8)
    with pytest.raises(ParameterError, match="room_size of at most 2 tiles in a field of 5 x 6"):
        RescueField(width=5, height=6, length=10, crossings=0, room_size=3)
    with pytest.raises(ParameterError, match="walls of at most a quarter of a cell"):
        RescueField(wall=0.5)


def test_a_room_has_one_opening_of_a_tile() -> None:
    field = RescueField()
    for seed in range(40):
        walls = [piece for piece in generated(field, seed).pieces if "wall" in piece.tags]
        total = 0.0
        for wall in walls:
            assert isinstance(wall, BodyDescription)
            assert isinstance(wall.shape, BoxShape)
            total += max(wall.shape.size) - field.wall
        assert total == pytest.approx((4 * field.room_size - 1) * field.cell)

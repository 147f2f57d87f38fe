"""The world as a grid: GridSensor, CellSensor and GridMoveActuator."""

import math
from typing import Any

import numpy as np
import pytest

from ai4u_edu import (
    BoxShape,
    CellSensor,
    CircleShape,
    ControlRequestor,
    GridMoveActuator,
    GridSensor,
    SegmentShape,
    World,
)
from ai4u_edu.base.errors import ActionError
from tests.builders import small_sim

STAY, RIGHT, LEFT, UP, DOWN = range(5)
SMALL: dict[str, Any] = {"rows": 4, "columns": 5}
CODES = {"floor": 1, "wall": 50, "dirty": 200}


class Drive:
    """Repeats the last choice that it was given."""

    choice: int | None = STAY

    def __call__(self, _percept: Any) -> dict[str, Any]:
        return {} if self.choice is None else {"move": self.choice}


def room(**robot: Any) -> World:
    """5 x 4 metres around the origin; the robot in row 1, column 1."""
    world = World()
    world.add_floor("floor", BoxShape(size=(5, 4)))
    world.add_body("robot", CircleShape(radius=0.4), **{"position": (-1, 0.5)} | robot)
    return world


def gridded(
    world: World, drive: Drive | None = None, skip_frame: int = 4, **fields: Any
) -> ControlRequestor:
    return small_sim(
        [GridSensor(group_code=CODES, **SMALL, **fields), CellSensor(**SMALL)],
        actuators=[GridMoveActuator(**SMALL, blocked_by=["wall", "door"])],
        world=world,
        controller=drive or Drive(),
        skip_frame=skip_frame,
    )


def at(world: World, name: str) -> tuple[float, float]:
    return world[name].position


def seen(sim: ControlRequestor) -> list[list[int]]:
    found: list[list[int]] = sim.agents[0].percept["grid"].tolist()
    return found


def cell(sim: ControlRequestor) -> tuple[int, int]:
    row, column = sim.agents[0].percept["cell"].tolist()
    return row, column


# -- the map -------------------------------------------------------------------------------------


def test_the_map_is_north_up_and_tells_what_is_where() -> None:
    world = room()
    world.add_body("north", BoxShape(size=(5, 1)), kind="static", position=(0, 1.5), tags=("wall",))
    world.add_body("dirt", CircleShape(radius=0.2), position=(2, -1.5), tags=("dirty",))
    world.add_body("nothing", CircleShape(radius=0.2), position=(0, -0.5))
    sim = gridded(world)
    assert seen(sim) == [
        [50, 50, 50, 50, 50],
        [1, 1, 1, 1, 1],
        [1, 1, 1, 1, 1],
        [1, 1, 1, 1, 200],
    ]
    assert sim.agents[0].percept["grid"].dtype == np.int32
    assert cell(sim) == (1, 1)


def test_the_void_is_nothing_and_endless_ground_is_floor() -> None:
    world = World()
    world.add_floor("floor", BoxShape(size=(3, 4)), position=(-1, 0))
    world.add_body("robot", CircleShape(radius=0.4), position=(-1, 0.5))
    assert seen(gridded(world)) == [[1, 1, 1, 0, 0]] * 4
    endless = World()
    endless.add_body("robot", CircleShape(radius=0.4))
    assert seen(gridded(endless)) == [[1] * 5] * 4


def test_areas_are_on_the_map() -> None:
    world = room()
    world.add_area("pool", BoxShape(size=(2, 1)), position=(1.5, 0.5), tags=("dirty",))
    assert seen(gridded(world))[1] == [1, 1, 1, 200, 200]


def test_the_largest_code_shows_whatever_came_first() -> None:
    world = room()
    world.add_body("dirt", CircleShape(radius=0.2), position=(1, 0.5), tags=("dirty",), z=2)
    wall = {"kind": "static", "position": (1, 0.5), "tags": ("wall",)}
    world.add_body("wall", BoxShape(size=(1, 1)), **wall)
    assert seen(gridded(world))[1] == [1, 1, 1, 200, 1]


def test_a_floor_may_have_the_largest_code() -> None:
    world = room()
    world.add_body("dirt", CircleShape(radius=0.2), position=(2, -1.5), tags=("dirty",))
    sim = small_sim([GridSensor(group_code={"floor": 9, "dirty": 2}, **SMALL)], world=world)
    assert seen(sim) == [[9] * 5] * 4


def test_turned_and_thin_bodies() -> None:
    world = room()
    bar = {"kind": "static", "tags": ("wall",)}
    world.add_body("bar", BoxShape(size=(4, 0.1)), position=(2, 0), heading_deg=90, **bar)
    fence = SegmentShape(a=(-2.5, -1.5), b=(0.4, -1.5), thickness=0.1)
    world.add_body("fence", fence, **bar)
    assert seen(gridded(world)) == [
        [1, 1, 1, 1, 50],
        [1, 1, 1, 1, 50],
        [1, 1, 1, 1, 50],
        [50, 50, 50, 1, 50],
    ]


@pytest.mark.parametrize(
    ("place", "cells"),
    [
        ((0, 1), [2, 7]),  # on the line between two
        ((0.2, 0.7), [7]),
        ((0.5, 1), [8]),  # where four meet it covers the centre of none, and is in the last
        ((2.9, 0), []),
    ],
)
def test_small_bodies(place: tuple[float, float], cells: list[int]) -> None:
    world = room()
    world.add_body("dirt", CircleShape(radius=0.2), position=place, tags=("dirty",))
    assert np.flatnonzero(np.ravel(seen(gridded(world))) == 200).tolist() == cells


def test_what_moves_and_what_left_is_followed() -> None:
    world = room()
    world.add_body("dirt", CircleShape(radius=0.2), position=(2, 1.5), tags=("dirty",))
    sim = gridded(world)
    assert seen(sim)[0][4] == 200
    world["dirt"].move_to(2, -1.5)
    sim.step()
    assert (seen(sim)[0][4], seen(sim)[3][4]) == (1, 200)
    world["dirt"].leave()
    sim.step()
    assert seen(sim) == [[1] * 5] * 4
    world["dirt"].come_back()
    sim.step()
    assert seen(sim)[0][4] == 200
    world.remove("dirt")
    sim.step()
    assert seen(sim) == [[1] * 5] * 4


def test_the_agent_shows_if_it_has_a_code_and_is_not_left_out() -> None:
    world = room(tags=("dirty",))
    assert seen(gridded(world)) == [[1] * 5] * 4
    assert seen(gridded(world, self_exclude=False))[1] == [1, 200, 1, 1, 1]


def test_around_the_agent() -> None:
    world = room(heading_deg=90)
    world.add_body("north", BoxShape(size=(5, 1)), kind="static", position=(0, 1.5), tags=("wall",))
    sim = gridded(world, around=2)
    assert seen(sim) == [
        [0, 0, 0, 0, 0],
        [0, 50, 50, 50, 50],
        [0, 1, 1, 1, 1],
        [0, 1, 1, 1, 1],
        [0, 1, 1, 1, 1],
    ]
    assert sim.agents[0].sensors[0].observation_space().contains(sim.agents[0].percept["grid"])


def test_another_grid() -> None:
    world = World()
    world.add_body("robot", CircleShape(radius=0.1), position=(10.1, 20.1))
    dirt = {"position": (10.4, 19.6), "tags": ("dirty",)}
    world.add_body("dirt", CircleShape(radius=0.1), **dirt)
    fields: dict[str, Any] = {"rows": 2, "columns": 2, "cell_size": 0.5, "centre": (10, 20)}
    sim = small_sim([GridSensor(group_code=CODES, **fields), CellSensor(**fields)], world=world)
    assert seen(sim) == [[1, 1], [1, 200]]
    assert cell(sim) == (0, 1)


@pytest.mark.parametrize(
    ("place", "expected"),
    [((-9, 9), (0, 0)), ((9, -9), (3, 4)), ((2.4, 1.9), (0, 4)), ((-2.4, -1.9), (3, 0))],
)
def test_the_cell_beside_the_grid_is_the_nearest(
    place: tuple[float, float], expected: tuple[int, int]
) -> None:
    world = World()
    world.add_body("robot", CircleShape(radius=0.4), position=place)
    assert cell(gridded(world)) == expected


# -- moving --------------------------------------------------------------------------------------


@pytest.mark.parametrize("skip_frame", [0, 1, 4, 9])
@pytest.mark.parametrize(
    ("choice", "to", "heading"),
    [(RIGHT, (0, 0.5), 0), (LEFT, (-2, 0.5), -180), (UP, (-1, 1.5), 90), (DOWN, (-1, -0.5), -90)],
)
def test_one_decision_is_one_cell_exactly(
    skip_frame: int, choice: int, to: tuple[float, float], heading: float
) -> None:
    world, drive = room(), Drive()
    sim = gridded(world, drive, skip_frame)
    drive.choice = choice
    sim.step()
    assert at(world, "robot") == to
    assert math.degrees(world["robot"].heading) == pytest.approx(heading)
    drive.choice = STAY
    sim.step()
    assert at(world, "robot") == to
    assert world.ticks == 2 * (skip_frame + 1)


def test_it_glides_evenly() -> None:
    world, drive = room(), Drive()
    sim = gridded(world, drive, skip_frame=3)
    drive.choice = RIGHT
    places = []
    for _ in range(8):
        sim.tick()
        places.append(at(world, "robot")[0])
    # what the last tick of a decision still has to do is done before it
    assert places == pytest.approx([-0.5, -0.25, 0, 0, 0.5, 0.75, 1, 1])


def test_it_does_not_leave_the_grid_but_turns() -> None:
    world, drive = room(position=(-2, 1.5)), Drive()
    sim = gridded(world, drive)
    for choice in (UP, LEFT):
        drive.choice = choice
        sim.step()
        assert cell(sim) == (0, 0)
        assert at(world, "robot") == (-2, 1.5)
    assert abs(math.degrees(world["robot"].heading)) == pytest.approx(180)


@pytest.mark.parametrize("tag", ["wall", "door", "curtain"])
def test_some_groups_block_the_way(tag: str) -> None:
    world, drive = room(), Drive()
    world.add_body("thing", BoxShape(size=(0.5, 0.5)), position=(0, 0.5), tags=(tag,))
    sim = gridded(world, drive)
    drive.choice = RIGHT
    sim.step()
    blocked = tag != "curtain"
    assert cell(sim) == ((1, 1) if blocked else (1, 2))
    world["thing"].leave()
    sim.step()
    assert cell(sim) == ((1, 2) if blocked else (1, 3))


def test_a_long_wall_blocks_the_way_far_from_its_middle() -> None:
    world, drive = room(position=(-2, 1.5)), Drive()
    wall = {"kind": "static", "position": (0.5, 0.5), "tags": ("wall",)}
    world.add_body("wall", BoxShape(size=(4, 1)), **wall)
    sim = gridded(world, drive)
    drive.choice = RIGHT
    sim.step()
    drive.choice = DOWN
    sim.step()
    assert cell(sim) == (0, 1)
    drive.choice = LEFT
    sim.step()
    drive.choice = DOWN
    sim.step()
    assert cell(sim) == (1, 0)


def test_whatever_it_pushes_it_ends_in_the_middle() -> None:
    world, drive = room(), Drive()
    world.add_body("post", CircleShape(radius=0.4), kind="static", position=(0, 0.6))
    sim = gridded(world, drive)
    drive.choice = RIGHT
    sim.step()
    assert at(world, "robot") == (0, 0.5)
    assert sim.agents[0].view.contacts(sim.agents[0].body) == ("post",)


def test_off_the_middle_it_goes_back_there() -> None:
    world, drive = room(position=(-1.2, 0.7)), Drive()
    sim = gridded(world, drive)
    sim.step()
    assert at(world, "robot") == (-1, 0.5)


def test_a_decision_without_a_move_moves_nothing() -> None:
    world, drive = room(position=(-1.2, 0.7)), Drive()
    sim = gridded(world, drive)
    drive.choice = None
    sim.step()
    assert at(world, "robot") == (-1.2, 0.7)


def test_acting_once_or_on_each_tick_is_the_same() -> None:
    for repeat in (True, False):
        world, drive = room(), Drive()
        sim = gridded(world, drive)
        sim.agents[0].brain.repeat_action = repeat
        drive.choice = RIGHT
        sim.step()
        assert at(world, "robot") == (0, 0.5)


def over(world: World) -> bool:
    return world["robot"].fallen


def test_over_the_void_it_falls() -> None:
    world = World()
    world.add_floor("floor", BoxShape(size=(3, 4)), position=(-1, 0))
    world.add_body("robot", CircleShape(radius=0.4), position=(0, 0.5))
    drive = Drive()
    sim = gridded(world, drive)
    drive.choice = RIGHT
    sim.step()
    assert at(world, "robot") == (1, 0.5)
    drive.choice = LEFT
    while not sim.agents[0].done:
        sim.step()
    assert over(world)
    assert at(world, "robot") == (1, 0.5), "in the air nothing moves it"


def test_a_reset_in_the_middle_of_a_move() -> None:
    world, drive = room(), Drive()
    sim = gridded(world, drive)
    drive.choice = RIGHT
    sim.tick()
    sim.tick()
    sim.reset()
    drive.choice = DOWN
    sim.step()
    assert at(world, "robot") == (-1, -0.5)


@pytest.mark.parametrize("action", [5, -1, 0.5, [1, 0], "up", None])
def test_what_is_no_choice_is_refused(action: Any) -> None:
    sim = gridded(room())
    with pytest.raises(ActionError) as caught:
        sim.agents[0].accept({"move": action})
    assert str(caught.value) == (
        f"action 'move': expected a whole number from 0 to 4, got {action!r}"
    )

"""Search on a map: paths are shortest, and A* visits no more cells than needed."""

from itertools import pairwise, product
from typing import Any

import numpy as np
import pytest

from ai4u_edu import (
    AStarController,
    BasicAgent,
    BreadthFirstController,
    ControlRequestor,
    LocalBrain,
    Scene,
    a_star,
    breadth_first,
)
from ai4u_edu.base.errors import BlockError
from ai4u_edu.blocks.brains.controllers.planner import Cell, Map

SEARCHES = (breadth_first, a_star)


def drawn(seed: int) -> tuple[Map, Cell, list[Cell]]:
    """A map with walls at random, a start and up to three goals."""
    rng = np.random.default_rng(seed)
    free = rng.random((9, 12)) > 0.3
    cells = [(int(row), int(column)) for row, column in np.argwhere(free)]
    start, *goals = (cells[index] for index in rng.permutation(len(cells))[: 2 + seed % 3])
    return free, start, goals


def steps_to(free: Map, start: Cell, goals: list[Cell]) -> int | None:
    """Return the distance to the nearest goal by an independent flood fill."""
    reached = np.zeros_like(free)
    reached[start] = True
    for steps in range(free.size):
        if any(reached[goal] for goal in goals):
            return steps
        wide = reached.copy()
        wide[1:] |= reached[:-1]
        wide[:-1] |= reached[1:]
        wide[:, 1:] |= reached[:, :-1]
        wide[:, :-1] |= reached[:, 1:]
        reached = wide & free
    return None


@pytest.mark.parametrize(
    "seed",
    [seed if seed < 12 else pytest.param(seed, marks=pytest.mark.nightly) for seed in range(60)],
)
def test_a_shortest_way_to_the_nearest_goal(seed: int) -> None:
    free, start, goals = drawn(seed)
    nearest = steps_to(free, start, goals)
    found, quick = (search(free, start, goals) for search in SEARCHES)
    for way, visited in (found, quick):
        assert len(set(visited)) == len(visited)
        if nearest is None:
            assert way == []
            continue
        assert len(way) == nearest + 1
        assert (way[0], way[-1]) == (start, visited[-1])
        assert way[-1] in goals
        assert all(free[cell] for cell in way)
        near = [abs(a - c) + abs(b - d) for (a, b), (c, d) in pairwise(way)]
        assert set(near) <= {1}
    assert len(quick.visited) <= len(found.visited)
    assert set(quick.visited[:-1]) <= set(found.visited)


def test_a_star_saves_work_on_most_maps() -> None:
    saved = [
        len(quick.visited) / len(found.visited)
        for found, quick in ([search(*drawn(seed)) for search in SEARCHES] for seed in range(60))
        if found.way
    ]
    assert np.mean(saved) < 0.6


@pytest.mark.parametrize("search", SEARCHES)
def test_the_ends(search: Any) -> None:
    free = np.ones((3, 3), bool)
    assert search(free, (1, 1), [(1, 1)]).way == [(1, 1)]
    assert search(free, (1, 1), []).way == []
    free[1] = False
    found = search(free, (0, 0), [(2, 2)])
    assert found.way == []
    assert sorted(found.visited) == [(0, 0), (0, 1), (0, 2)]


def driven(controller: Any, seed: int) -> BasicAgent:
    sim: ControlRequestor = Scene.load("grid_world").build()
    robot = sim.agents[0]
    robot.use_brain(LocalBrain(controller=controller, skip_frame=9))
    sim.reset(seed)
    while not robot.done:
        sim.step()
    return robot


@pytest.mark.parametrize(
    "seed",
    [seed if seed < 3 else pytest.param(seed, marks=pytest.mark.nightly) for seed in range(20)],
)
def test_both_clean_the_grid_world_in_the_same_time(seed: int) -> None:
    one, other = (driven(kind(), seed) for kind in (BreadthFirstController, AStarController))
    assert one.ledger.episode_terms["all_clean"] == 10.0
    assert other.ledger.episode_terms["all_clean"] == 10.0


def test_what_its_last_search_found_can_be_seen() -> None:
    controller = AStarController()
    robot = driven(controller, 3)
    # the episode ends on the last dirty place, so the last plan is one step long
    assert len(controller.found.way) == 2
    assert robot.percept["cell"].tolist() == list(controller.found.way[-1])


def test_it_stays_where_there_is_no_way() -> None:
    controller = BreadthFirstController()
    sim = Scene.load("grid_world").build()
    controller.on_setup(sim.agents[0], sim.agents[0].view)
    grid = np.full((3, 3), 50)
    grid[1, 1], grid[0, 0] = 1, 200
    assert controller.get_action({"grid": grid, "cell": (1, 1)}) == {"move": 0}  # type: ignore[arg-type]
    assert controller.found.way == []
    for (row, column), move in zip([(1, 2), (1, 0), (0, 1), (2, 1)], (1, 2, 3, 4), strict=True):
        grid[:] = 50
        grid[1, 1], grid[row, column] = 1, 200
        assert controller.get_action({"grid": grid, "cell": (1, 1)}) == {"move": move}  # type: ignore[arg-type]


def test_a_missing_sensor_is_named() -> None:
    sim = Scene.load("box_chase").build()
    sim.agents[0].use_brain(LocalBrain(controller=BreadthFirstController()))
    sim.reset(seed=0)
    with pytest.raises(BlockError, match=r"needs a GridSensor and a CellSensor.*key 'grid'"):
        sim.step()


def test_a_map_of_all_walls_and_none() -> None:
    for rows, columns in product((1, 4), repeat=2):
        free = np.ones((rows, columns), bool)
        way, _ = a_star(free, (0, 0), [(rows - 1, columns - 1)])
        assert len(way) == rows + columns - 1

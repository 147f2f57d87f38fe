"""Grid world: in every random layout there is a way to all the dirt."""

from itertools import product

import numpy as np
import pytest

from ai4u_edu import Scene
from tests.scenes.solvers.grid_world import DIRTY, FLOOR, first_step

Cell = tuple[int, int]


@pytest.fixture(scope="module")
def places() -> dict[str, list[Cell]]:
    """The cells in which each random body may be."""
    bodies = Scene.load("grid_world").description.bodies
    return {
        body.name: [(int(9.5 - y), int(9.5 + x)) for x, y in body.random.places]
        for body in bodies
        if body.random and body.random.places
    }


def test_no_two_things_want_the_same_cell(places: dict[str, list[Cell]]) -> None:
    cells = [cell for each in places.values() for cell in each]
    assert len(places) == 8
    assert len(set(cells)) == len(cells)


def test_whatever_stands_in_the_way_all_dirt_can_be_reached(
    places: dict[str, list[Cell]],
) -> None:
    sim = Scene.load("grid_world").build()
    sim.reset(0)
    walls = sim.agents[0].percept["grid"] == 50
    dirt = [cell for name in places if "dirt" in name for cell in places[name]]
    for blocked in product(places["person"], *(places[f"enemy {n}"] for n in (1, 2, 3))):
        grid = np.where(walls, 50, FLOOR)
        for cell in blocked:
            grid[cell] = 100
        # ways lead both ways: from one place to all others is from all to all
        for cell in (*dirt, *places["robot"][1:]):
            assert grid[cell] == FLOOR
        assert reached(grid, places["robot"][0]) >= {*dirt, *places["robot"]}


def reached(grid: np.ndarray, start: Cell) -> set[Cell]:
    """All cells to which there is a way."""
    found, border = {start}, [start]
    while border:
        row, column = border.pop()
        for cell in ((row, column + 1), (row, column - 1), (row + 1, column), (row - 1, column)):
            if grid[cell] == FLOOR and cell not in found:
                found.add(cell)
                border.append(cell)
    return found


def test_the_solvers_search_finds_a_shortest_way() -> None:
    grid = np.full((5, 5), 50)
    grid[1:4, 1:4] = FLOOR
    grid[2, 2] = 50
    grid[3, 3] = DIRTY
    grid[1, 2] = 100
    assert first_step(grid, (1, 1)) == 4
    grid[2, 1] = 150
    assert first_step(grid, (1, 1)) == 0

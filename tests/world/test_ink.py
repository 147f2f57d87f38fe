"""Ink: what pens leave on the floors."""

import math

import numpy as np
import pytest

from ai4u_edu import BoxShape, CircleShape, World
from ai4u_edu.world.ink import (
    BLANK,
    CELL_M,
    INK_COLOURS,
    MAX_TILES,
    TILE_CELLS,
    TILE_M,
    Ink,
    TileKey,
    ink_code,
)

BLUE = ink_code("blue")


def cells(ink: Ink) -> int:
    return sum(int((tile != 0).sum()) for tile in ink.image().tiles.values())


def test_a_stroke_covers_its_width() -> None:
    ink = World().ink
    ink.draw((0.0, 0.0), (0.9, 0.0), 0.0, 0.4, BLUE)
    places = {(0.5, 0.0): 1, (0.5, 0.19): 1, (0.5, 0.21): 0, (1.05, 0.0): 1, (1.2, 0.0): 0}
    assert [ink.at(*place) for place in places] == [BLUE * there for there in places.values()]
    area = 0.9 * 0.4 + math.pi * 0.2**2
    assert cells(ink) * CELL_M**2 == pytest.approx(area, rel=0.05)


def test_a_thin_stroke_has_no_gap() -> None:
    ink = World().ink
    ink.draw((0.0, 0.0), (0.7, 0.33), 0.0, 0.01, BLUE)
    assert all(ink.at(0.7 * share, 0.33 * share) for share in np.linspace(0, 1, 100))


def test_strokes_go_over_the_borders_of_tiles_and_below_zero() -> None:
    ink = World().ink
    ink.draw((-0.3, -0.2), (0.3, 0.2), 0.0, 0.2, BLUE)
    assert set(ink.image().tiles) == {
        TileKey("", column, row) for column in (-1, 0) for row in (-1, 0)
    }
    assert all(ink.at(-0.3 + 0.6 * share, -0.2 + 0.4 * share) for share in np.linspace(0, 1, 50))


def test_ink_is_on_the_floor_that_the_pen_reaches() -> None:
    world = World()
    world.add_floor("low", BoxShape(size=(4, 4)))
    world.add_floor("high", BoxShape(size=(1, 1)), position=(1, 0), top=0.5)
    ink = world.ink
    ink.draw((1.0, 0.0), (1.2, 0.0), 0.0, 0.2, BLUE)  # under the high floor: the pen is not there
    assert not ink
    ink.draw((1.0, 0.0), (1.2, 0.0), 0.5, 0.2, BLUE)
    assert {key.floor for key in ink.image().tiles} == {"high"}
    ink.draw((1.9, 1.5), (1.95, 1.5), 0.0, 0.4, BLUE)  # no ink beyond the edge
    assert ink.at(1.98, 1.5) == BLUE
    assert all(tile[:, -1].max() == 0 for key, tile in ink.image().tiles.items() if key.column == 0)
    ink.draw((5.0, 0.0), (5.1, 0.0), 0.0, 0.2, BLUE)
    assert ink.at(5.05, 0.0) == 0


def test_a_jump_to_another_place_draws_no_line() -> None:
    ink = World().ink
    ink.draw((0.0, 0.0), (3.0, 0.0), 0.0, 0.2, BLUE)
    assert not ink


def test_images_share_tiles_that_stay_as_they_are() -> None:
    ink = World().ink
    ink.draw((0.5, 0.5), (0.6, 0.5), 0.0, 0.2, BLUE)
    ink.draw((5.5, 0.5), (5.6, 0.5), 0.0, 0.2, BLUE)
    before = ink.image()
    assert ink.image() is before
    near, far = TileKey("", 0, 0), TileKey("", 1, 0)
    kept = before.tiles[near].copy()
    ink.draw((0.5, 0.9), (0.6, 0.9), 0.0, 0.2, BLUE)
    after = ink.image()
    assert after.tiles[far] is before.tiles[far]
    assert after.tiles[near] is not before.tiles[near]
    assert (before.tiles[near] == kept).all()
    assert after.digest != before.digest
    ink.draw((0.5, 0.9), (0.6, 0.9), 0.0, 0.2, BLUE)  # the same again
    assert ink.image() is after


def test_wiping() -> None:
    ink = World().ink
    ink.draw((0.0, 0.0), (0.5, 0.0), 0.0, 0.2, BLUE)
    ink.draw((0.0, 0.0), (0.5, 0.0), 0.0, 0.4, ink_code("none"))
    assert cells(ink) == 0
    ink.draw((9.0, 9.0), (9.1, 9.0), 0.0, 0.4, ink_code("none"))
    assert len(ink.image().tiles) == len([key for key in ink.image().tiles if key.column < 2])


def test_memory_is_bounded() -> None:
    ink = World().ink
    side = math.isqrt(MAX_TILES) + 2
    for column in range(side):
        for row in range(side):
            x, y = (column + 0.5) * TILE_M, (row + 0.5) * TILE_M
            ink.draw((x, y), (x, y), 0.0, 0.1, BLUE)
    assert len(ink.image().tiles) == MAX_TILES
    assert all(tile.shape == (TILE_CELLS, TILE_CELLS) for tile in ink.image().tiles.values())
    x = 0.5 * TILE_M
    ink.draw((x, x), (x + 0.3, x), 0.0, 0.1, BLUE)  # where there is some, there may be more
    assert ink.at(x + 0.3, x) == BLUE


def test_a_reset_clears_it_and_a_body_that_is_put_back_does_not() -> None:
    world = World()
    world.add_body("robot", CircleShape(radius=0.3))
    world.ink.draw((0.0, 0.0), (0.5, 0.0), 0.0, 0.2, BLUE)
    world.put_back("robot")
    assert world.ink
    world.reset(1)
    assert not world.ink
    assert world.ink.image() is BLANK
    assert world.ink.digest == 0


def test_every_colour_has_a_code() -> None:
    assert [ink_code(colour) for colour in INK_COLOURS] == list(range(1, len(INK_COLOURS) + 1))

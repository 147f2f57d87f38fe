import numpy as np
import pytest

from ai4u_edu.base.colors import PALETTE, rgb
from ai4u_edu.snapshot.theme import FLOOR, VOID, WALL, Rgb
from ai4u_edu.viewer.scene.light import film, lit, strokes, surfaces

GREYS = {"floor": FLOOR, "void": VOID, "wall": WALL}


@pytest.mark.parametrize("colour", GREYS.values(), ids=GREYS)
def test_greys_come_out_as_they_are_meant(colour: Rgb) -> None:
    (shown,) = 255 * lit(surfaces([colour]) / 255)
    assert shown == pytest.approx(np.array(colour), abs=3)


@pytest.mark.parametrize("name", [name for name in PALETTE if name != "white"])
def test_the_palette_comes_out_close_to_what_is_meant(name: str) -> None:
    """The film can't show the most saturated colours; what is left is a hint of grey."""
    (shown,) = 255 * lit(surfaces([rgb(name)]) / 255)
    assert np.abs(shown - rgb(name)).max() < 60
    assert np.abs(shown - rgb(name)).mean() < 20


def test_lines_take_linear_numbers() -> None:
    assert 255 * film(strokes([WALL])[0] / 255) == pytest.approx(np.array(WALL), abs=6)


def test_batches_keep_their_shape() -> None:
    assert surfaces([FLOOR] * 3).shape == (3, 3)
    assert surfaces([FLOOR]).dtype == np.uint8
    assert strokes(FLOOR).shape == (3,)

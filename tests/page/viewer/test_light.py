import re
from pathlib import Path

import numpy as np
import pytest

from ai4u_edu.base.colors import PALETTE, hex_colour, rgb
from ai4u_edu.page.viewer.scene.light import line_colours, shown_colour, surface_colours, tone_map
from ai4u_edu.snapshot.theme import FLOOR, VOID, WALL, Rgb

GREYS = {"floor": FLOOR, "void": VOID, "wall": WALL}


@pytest.mark.parametrize("colour", GREYS.values(), ids=GREYS)
def test_greys_come_out_as_they_are_meant(colour: Rgb) -> None:
    (shown,) = 255 * shown_colour(surface_colours([colour]) / 255)
    assert shown == pytest.approx(np.array(colour), abs=3)


@pytest.mark.parametrize("name", [name for name in PALETTE if name != "white"])
def test_the_palette_comes_out_close_to_what_is_meant(name: str) -> None:
    """The film can't show the most saturated colours; what is left is a hint of grey."""
    (shown,) = 255 * shown_colour(surface_colours([rgb(name)]) / 255)
    assert np.abs(shown - rgb(name)).max() < 60
    assert np.abs(shown - rgb(name)).mean() < 20


def test_the_page_s_background_is_what_is_around_the_floors() -> None:
    style = Path(__file__).parents[3] / "web" / "styles" / "page" / "page.css"
    rule = re.search(r"canvas\[data-engine\] {\s*background: (\S+);", style.read_text("utf-8"))
    assert rule
    assert rule[1] == hex_colour(VOID)


def test_lines_take_linear_numbers() -> None:
    assert 255 * tone_map(line_colours([WALL])[0] / 255) == pytest.approx(np.array(WALL), abs=6)


def test_batches_keep_their_shape() -> None:
    assert surface_colours([FLOOR] * 3).shape == (3, 3)
    assert surface_colours([FLOOR]).dtype == np.uint8
    assert line_colours(FLOOR).shape == (3,)

import math

import pytest

from ai4u_edu.page.viewer.scene.framing import (
    BANNER_SHARE,
    FIELD_OF_VIEW_RAD,
    PORTRAIT_UNCOVERED_SHARE,
    TALL_M,
    Bounds,
    Frame,
    frame_arena,
    frame_point,
    frame_tilted,
    uncovered_share,
    visible_height,
)

SQUARE = ((-5.0, -5.0), (5.0, 5.0))
WIDE = ((0.0, 0.0), (100.0, 10.0))
TALL = ((-2.0, -40.0), (2.0, 0.0))


def on_screen(shown: Frame, aspect: float, x: float, y: float) -> tuple[float, float]:
    """Return a point's position in the window: 0..1 from the left and from the top."""
    return (
        0.5 + (x - shown.x) / (shown.height * aspect),
        0.5 - (y - shown.y) / shown.height,
    )


@pytest.mark.parametrize("bounds", [SQUARE, WIDE, TALL])
@pytest.mark.parametrize("aspect", [0.46, 0.75, 1.0, 1.2, 2.2])
def test_all_of_the_arena_is_in_the_free_part_of_the_window(bounds: Bounds, aspect: float) -> None:
    shown = frame_arena(bounds, aspect)
    free, above = uncovered_share(aspect), banner_share(aspect)
    for x, y in bounds:
        across, down = on_screen(shown, aspect, x, y)
        assert 0.02 < across < 0.98
        assert above + 0.02 * free < down < above + 0.98 * free


@pytest.mark.parametrize("bounds", [SQUARE, WIDE, TALL])
@pytest.mark.parametrize("aspect", [0.46, 0.75, 1.0, 1.2, 2.2])
def test_a_tilted_arena_is_in_the_free_part_of_the_window(bounds: Bounds, aspect: float) -> None:
    frame, free, above = frame_tilted(bounds, aspect), uncovered_share(aspect), banner_share(aspect)
    (left, low), (right, high) = bounds
    corners = [(x, y, z) for x in (left, right) for y in (low, high) for z in (0.0, TALL_M)]
    places = [frame.on_screen(corner, aspect) for corner in corners]
    for across, up in places:
        assert -0.9 < across < 0.9
        assert 1 - 2 * (above + free) < up < 1 - 2 * above
    spread = (
        max(u for u, _ in places) - min(u for u, _ in places),
        (max(v for _, v in places) - min(v for _, v in places)) / free,
    )
    assert max(spread) > 1.6  # it is as near as can be


@pytest.mark.parametrize("aspect", [0.46, 1.2])
def test_the_arena_fills_the_free_part(aspect: float) -> None:
    shown = frame_arena(SQUARE, aspect)
    free = uncovered_share(aspect)
    assert shown.height * min(aspect, free) == pytest.approx(11.4)


def test_the_keys_have_room_below_the_arena_or_beside_it() -> None:
    keys = 140  # pixels that they are high, with the space below them
    low = on_screen(frame_arena(SQUARE, 957 / 800), 957 / 800, *SQUARE[0])[1]
    assert low * 800 < 800 - keys + 24
    assert uncovered_share(844 / 390) == 1.0


@pytest.mark.parametrize("aspect", [820 / 680, 1024 / 768])
def test_a_goal_in_two_lines_has_room_above_the_arena(aspect: float) -> None:
    shown = frame_arena(SQUARE, aspect)
    _, top = on_screen(shown, aspect, *SQUARE[1])
    assert 680 * top > 16 + 57  # pixels: its place and height


def banner_share(aspect: float) -> float:
    return BANNER_SHARE if 0.8 < aspect < 2.0 else 0.0


def test_a_followed_body_is_in_the_middle_of_the_free_part() -> None:
    shown = frame_point(3.0, 4.0, 9.0, aspect=0.5)
    assert on_screen(shown, 0.5, 3.0, 4.0) == pytest.approx((0.5, PORTRAIT_UNCOVERED_SHARE / 2))
    assert on_screen(frame_point(3.0, 4.0, 9.0, 2.0), 2.0, 3.0, 4.0) == pytest.approx((0.5, 0.5))


def test_the_lens_is_so_long_that_walls_stand_straight() -> None:
    shown = frame_arena(SQUARE, 1.2)
    lean = 5.0 / shown.distance  # how far the top of a 1 m wall at the edge leans outwards, in m
    assert lean / shown.height * 800 < 2  # pixels
    assert shown.near < shown.distance < shown.far


def test_distance_and_height_belong_together() -> None:
    shown = frame_arena(SQUARE, 1.2)
    assert visible_height(shown.distance) == pytest.approx(shown.height)
    assert math.degrees(FIELD_OF_VIEW_RAD) < 5

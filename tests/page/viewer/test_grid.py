import numpy as np
import pytest

from ai4u_edu.page.viewer.scene.geometry import circle
from ai4u_edu.page.viewer.scene.ground import grid_in, grid_step

PLATE = np.array([(5.0, 5.0), (-5.0, 5.0), (-5.0, -5.0), (5.0, -5.0)])


def test_a_plate_has_a_line_every_metre_but_none_on_its_edge() -> None:
    lines = grid_in(PLATE, None, 0.5)
    assert lines.shape == (9 + 9, 2, 3)
    assert (lines[..., 2] == 0.5).all()
    assert np.abs(lines[..., :2]).max() == 5.0


def test_lines_end_at_the_edge_of_a_round_floor() -> None:
    ends = grid_in(circle(3.0, corners=360), None, 0.0)[..., :2].reshape(-1, 2)
    assert np.linalg.norm(ends, axis=1) == pytest.approx(3.0, abs=0.01)


def test_no_line_crosses_a_hole() -> None:
    lines = grid_in(circle(3.0, corners=96), circle(1.5, corners=96), 0.0)
    middles = lines[..., :2].mean(axis=1)
    assert np.linalg.norm(middles, axis=1).min() > 1.5


def test_a_floor_that_is_smaller_than_a_cell_has_no_lines() -> None:
    assert len(grid_in(0.04 * PLATE + 0.5, None, 0.0)) == 0


@pytest.mark.parametrize("width", [0.5, 10, 61, 99, 1234, 20_000])
def test_there_are_never_too_many_lines(width: float) -> None:
    assert width / grid_step(width) <= 60

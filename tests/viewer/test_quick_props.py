"""viser's properties and poses, set with less ado."""

import inspect
import re

import numpy as np
import pytest
from viser import _scene_handles as handles

from ai4u_edu.viewer.backend.quick_props import quick_props, set_pose


@pytest.fixture(autouse=True)
def _quick() -> None:
    assert quick_props()


def test_viser_sets_poses_so() -> None:
    assert handles._set_pose_vector is set_pose
    source = inspect.getsource(handles)
    (replaced,) = re.findall(r"def _set_pose_vector\(.*?\n\n\ndef", source, re.DOTALL)
    wanted = re.findall(r"^    (\w+):", replaced.partition(") -> None:")[0], re.MULTILINE)
    assert wanted == list(inspect.signature(set_pose).parameters)
    assert "if np.allclose(value_arr, current):" in replaced


@pytest.mark.parametrize("old", [0.0, 1.0, -250.0])
@pytest.mark.parametrize("by", [0.0, 0.9e-8, 2e-8, 0.9e-5, 1.5e-5, 1e-3, -0.9e-5, -1.5e-5, np.nan])
def test_a_pose_is_told_if_it_is_another_one_as_viser_sees_it(old: float, by: float) -> None:
    current = np.array([2.0, old, 3.0])
    told: list[object] = []
    new = (2.0, old + by * max(abs(old), 1.0 if by else 0.0), 3.0)
    is_other = not np.allclose(np.asarray(new), current)
    set_pose(current, new, 3, told.append, lambda value: ("moved", value))
    assert bool(told) == is_other
    if is_other:
        assert told == [("moved", pytest.approx(new, nan_ok=True))]
        assert current.tolist() == pytest.approx(list(new), nan_ok=True)


def test_too_few_numbers_are_viser_s_error() -> None:
    with pytest.raises(ValueError, match="length 3"):
        set_pose(np.zeros(3), (1.0, 2.0), 3, print, tuple)

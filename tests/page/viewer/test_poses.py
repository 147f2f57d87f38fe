from typing import Any

import numpy as np
import pytest

from ai4u_edu.page.viewer.scene.bodies import SHADOW_OFFSET_M, DrawnPose, drawn_pose
from ai4u_edu.page.viewer.scene.layers import Layers
from tests.page.viewer.worlds import busy_sim, picture


def robot_at(**changes: Any) -> tuple[DrawnPose, Layers]:
    """Return the drawn pose of the robot (the first body) in a changed state."""
    sim = busy_sim()
    sim.reset(seed=1)
    snapshot = picture(sim)
    layers = Layers.of(snapshot.static_scene)
    return drawn_pose(snapshot.bodies[0]._replace(**changes), snapshot.static_scene, layers), layers


def reach(where: DrawnPose) -> float:
    """Return the distance from the robot to its shadow, seen from above."""
    return float(np.linalg.norm(np.subtract(where.shadow_position, where.position)[:2]))


def test_what_stands_on_the_ground_has_its_shadow_close() -> None:
    where, layers = robot_at()
    assert reach(where) == pytest.approx(SHADOW_OFFSET_M)
    assert where.shadow_position[2] == pytest.approx(layers.shadow)
    assert where.scale == 1.0
    assert where.depth == 0.0


def test_the_shadow_moves_away_from_what_rises() -> None:
    low, layers = robot_at(z=0.5, on_ground=False)
    high, _ = robot_at(z=1.5, on_ground=False)
    assert SHADOW_OFFSET_M < reach(low) < reach(high)
    assert high.shadow_position[2] == pytest.approx(layers.shadow)  # it stays on the floor
    assert high.scale == 1.0


def test_over_the_void_nothing_catches_the_shadow() -> None:
    where, _ = robot_at(x=50.0, z=0.5, on_ground=False)
    assert where.shadow_scale == 0.0
    assert np.isfinite(where.shadow_position).all()


def test_a_shadow_lies_on_what_bears_the_body() -> None:
    where, layers = robot_at(z=1.0, on_ground=True)  # on top of another body
    assert where.shadow_position[2] == pytest.approx(1.0 + layers.shadow)


def test_falling_body_shrinks_and_disappears() -> None:
    half, _ = robot_at(x=50.0, z=-1.0, on_ground=False)
    deep, _ = robot_at(x=50.0, z=-1.9, on_ground=False)
    gone, _ = robot_at(x=50.0, z=-2.1, on_ground=False, fallen=True)
    assert 1.0 > half.scale > deep.scale > gone.scale == 0.0
    assert 0.0 < half.depth < deep.depth <= 1.0
    assert gone.shadow_scale == 0.0


def test_headings_become_quaternions() -> None:
    where, _ = robot_at(heading=np.pi / 2)
    assert where.wxyz == pytest.approx([np.sqrt(0.5), 0, 0, np.sqrt(0.5)])

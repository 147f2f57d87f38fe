import numpy as np
import pytest

from ai4u_edu.runtime.runner import Runner
from ai4u_edu.viewer import Viewer
from ai4u_edu.viewer.scene.actions import Actions, action_marks
from tests.viewer.worlds import busy_sim


def test_nothing_is_drawn_for_doing_nothing() -> None:
    assert len(action_marks((0.0, 0.0, 0.0, 0.0), 0.5)) == 0


def test_an_arrow_points_where_the_body_drives() -> None:
    ahead, back = (action_marks((speed, 0.0, 0.0, 0.0), 0.5) for speed in (1.0, -0.5))
    assert ahead[..., 0].min() > 0.5
    assert back[..., 0].max() < -0.5
    assert np.ptp(ahead[..., 0]) > np.ptp(back[..., 0])


def test_turning_right_bends_clockwise() -> None:
    right = action_marks((0.0, 1.0, 0.0, 0.0), 0.5)
    left = action_marks((0.0, -1.0, 0.0, 0.0), 0.5)
    assert right[:-2, :, 1].min() < -0.4
    assert right[:-2, :, 1].max() <= 1e-9
    assert left[:-2, :, 1].max() > 0.4


def test_a_jump_is_a_ring() -> None:
    ring = action_marks((0.0, 0.0, 1.0, 0.0), 0.5)
    assert np.linalg.norm(ring, axis=2) == pytest.approx(0.725)


def test_the_arrow_turns_with_the_body(viewer: Viewer) -> None:
    sim = busy_sim(controller=lambda _percept: {"move": [1.0, 0.0, 0.0, 0.0]})
    runner = Runner(sim, seed=1)
    sim.agents[0].body.move_to(1.0, 0.0, heading=np.pi / 2)
    runner._tick()
    actions = Actions(viewer.server)
    actions.build(runner.latest.static_scene)
    actions.draw(runner.latest)
    assert actions.lines is not None
    shaft = actions.lines.points[0]
    assert shaft[1, 1] - shaft[0, 1] > 0.4
    assert shaft[:, 0] == pytest.approx([1.0, 1.0], abs=0.05)


def test_other_actions_are_not_drawn(viewer: Viewer) -> None:
    runner = Runner(busy_sim(), seed=1)
    actions = Actions(viewer.server)
    actions.build(runner.latest.static_scene)
    actions.draw(runner.latest)
    assert actions.lines is not None
    assert len(actions.lines.points) == 1  # the stroke that can't be seen


def test_what_has_no_effect_is_not_drawn(viewer: Viewer) -> None:
    def drawn(**powers: float) -> int:
        sim = busy_sim(controller=lambda _percept: {"move": [0.0, 1.0, 1.0, 1.0]})
        for name, value in powers.items():
            setattr(sim.agents[0].bound_blocks.actuators["move"], name, value)
        runner = Runner(sim, seed=1)
        runner._tick()
        actions = Actions(viewer.server)
        actions.build(runner.latest.static_scene)
        actions.draw(runner.latest)
        assert actions.lines is not None
        return len(actions.lines.points) - 1  # without the invisible one

    arrow, bend, ring = 3, 10, 24
    assert drawn() == arrow + bend + ring
    assert drawn(jump_power=0.0) == arrow + bend  # a forward jump still drives
    assert drawn(jump_power=0.0, jump_forward_power=0.0) == bend
    assert drawn(jump_power=0.0, jump_forward_power=0.0, turn_amount=0.0) == 0

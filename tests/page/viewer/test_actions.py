import numpy as np
import pytest

from ai4u_edu import (
    BasicAgent,
    CircleShape,
    ControlRequestor,
    LocalBrain,
    RBMoveActuator,
    World,
)
from ai4u_edu.page.viewer import Viewer
from ai4u_edu.page.viewer.scene.actions import Actions, action_marks
from ai4u_edu.runtime.runner import Runner
from tests.page.viewer.pages import part_of
from tests.page.viewer.worlds import busy_sim


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


def drawn(sim: ControlRequestor) -> Actions:
    """Draw one tick on a viewer of its own."""
    runner = Runner(sim, seed=1)
    runner._tick()
    viewer = Viewer(runner)
    try:
        return part_of(viewer, Actions)
    finally:
        viewer.stop()


def drives(*numbers: float) -> ControlRequestor:
    return busy_sim(controller=lambda _percept: {"move": list(numbers)})


def test_the_arrow_turns_with_the_body() -> None:
    lines = drawn(drives(1.0, 0.0, 0.0, 0.0)).below_bodies["robot"]
    assert lines.name == "/bodies1/0/action"  # this node is moved and turned with the body
    shaft = lines.points[0]
    assert shaft[1, 0] - shaft[0, 0] > 0.4
    assert shaft[:, 1] == pytest.approx([0.0, 0.0])


def test_the_arrows_of_many_agents_turn_with_their_bodies() -> None:
    world, agents = World(seed=1), []
    for number in range(9):
        place = (float(number), 0.0)
        world.add_body(f"{number}", CircleShape(radius=0.4), position=place, heading_deg=90)
        brain = LocalBrain(controller=lambda _percept: {"move": [1.0, 0.0, 0.0, 0.0]})
        agents.append(
            BasicAgent(
                id=f"{number}", body=f"{number}", actuators=[RBMoveActuator()], brains=[brain]
            )
        )
    actions = drawn(ControlRequestor(world, agents))
    assert actions.below_bodies == {}
    assert actions.others is not None
    shafts = actions.others.points[::3]
    assert shafts[:, 1, 1] - shafts[:, 0, 1] == pytest.approx(np.full(9, 0.52), abs=0.01)
    assert shafts[:, 0, 0] == pytest.approx(np.arange(9), abs=0.01)


def test_other_actions_are_not_drawn() -> None:
    assert not drawn(busy_sim()).below_bodies["robot"].visible


def test_actions_without_effect_are_not_drawn() -> None:
    def count(**powers: float) -> int:
        sim = drives(0.0, 1.0, 1.0, 1.0)
        for name, value in powers.items():
            setattr(sim.agents[0].bound_blocks.actuators["move"], name, value)
        lines = drawn(sim).below_bodies["robot"]
        return len(lines.points) if lines.visible else 0

    arrow, bend, ring = 3, 10, 24
    assert count() == arrow + bend + ring
    assert count(jump_power=0.0) == arrow + bend  # a forward jump still drives
    assert count(jump_power=0.0, jump_forward_power=0.0) == bend
    assert count(jump_power=0.0, jump_forward_power=0.0, turn_amount=0.0) == 0

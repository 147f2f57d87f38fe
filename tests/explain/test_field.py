"""Actions and values over the floor, in a copy of the world."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ai4u_edu import RespawnActuator, Scene
from ai4u_edu.base.errors import NameNotFoundError, SetupError
from ai4u_edu.explain import field, value_map
from ai4u_edu.explain.policy import Policy
from ai4u_edu.explain.world_copy import WorldCopy
from tests.explain.planted import linear_network
from tests.explain.worlds import robot_and_box

pytestmark = pytest.mark.needs("train")

BOX = np.array([3.0, 1.0])


def turns_to_box(percept: Any) -> Any:
    return {"move": [0.5, -percept["bearing"][0], 0, 0]}


def test_everywhere_it_turns_to_the_box() -> None:
    sim = robot_and_box(turns_to_box)
    told = field(turns_to_box, sim, columns=6, heading=0.0)
    assert told.poses.shape == (36, 3)
    assert told.components == ("move 0", "move 1", "move 2", "move 3")
    here = told.can_stand.astype(bool)
    away = BOX - told.poses[here, :2]
    np.testing.assert_allclose(
        told.actions[here, 1], -away[:, 1] / np.hypot(*away.T), rtol=1e-5, atol=1e-6
    )
    turned = told.moves[here, 2]
    assert (np.sign(turned) == np.sign(away[:, 1])).all()
    blocked = told.poses[~here, :2]
    assert 1 <= len(blocked) <= 4  # where the box is
    assert (np.abs(blocked - BOX).max(axis=1) < 0.9).all()
    assert np.isnan(told.actions[~here]).all()


def test_the_world_itself_stays_as_it_is() -> None:
    sim = robot_and_box(turns_to_box)
    for _ in range(3):
        sim.step()
    agent, box = sim.agents[0], sim.world["box"]
    box.move_to(2.0, -1.0, heading=0.3)
    before = agent.body.pose, box.pose, agent.percept, agent.steps, sim.world.ticks, agent.brain
    told = field(turns_to_box, sim, np.array([[0.0, 0.0, 0.0], agent.body.pose[:3]]))
    assert before == (
        agent.body.pose,
        box.pose,
        agent.percept,
        agent.steps,
        sim.world.ticks,
        agent.brain,
    )
    # the box stands in the copy where it stands now
    assert told.actions[0, 1] == pytest.approx(1 / np.sqrt(5))


def test_poses_that_face_something() -> None:
    told = field(turns_to_box, robot_and_box(turns_to_box), columns=4, heading="box")
    here = told.can_stand.astype(bool)
    np.testing.assert_allclose(told.actions[here, 1], 0, atol=1e-5)
    with pytest.raises(NameNotFoundError, match="did you mean 'box'"):
        field(turns_to_box, robot_and_box(turns_to_box), heading="bax")


def test_off_the_floor_nobody_can_stand() -> None:
    told = field(turns_to_box, robot_and_box(turns_to_box), np.array([[9.0, 0, 0], [0, 0, 0]]))
    assert told.can_stand.tolist() == [False, True]
    with pytest.raises(SetupError, match="expected 1 to 10000 poses"):
        field(turns_to_box, robot_and_box(turns_to_box), columns=0)


def test_an_actuator_that_chooses_the_place_does_not_get_to() -> None:
    told = field("zoo:box_chase", "box_chase", np.array([[4.0, 4.0, 0.0], [-4.0, -4.0, 0.0]]))
    assert not np.array_equal(told.actions[0], told.actions[1])
    assert (np.hypot(*told.moves[:, :2].T) < 2).all()  # from there, and not from a start
    from ai4u_edu import Scene

    sim = Scene.load("box_chase").build()
    assert any(isinstance(each, RespawnActuator) for each in sim.agents[0].actuators)


def test_it_can_be_followed_and_ended() -> None:
    seen: list[tuple[int, int]] = []

    def told(done: int, count: int) -> None:
        seen.append((done, count))
        if done == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        value_map(turns_to_box, robot_and_box(turns_to_box), columns=4, on_pose=told)
    assert seen == [(1, 16), (2, 16), (3, 16)]


def test_the_critic_of_a_network(tmp_path: Path) -> None:
    path = linear_network(
        tmp_path / "a.onnx",
        {"bearing": np.array([[0, -1, 0, 0], [0.5, 0, 0, 0]])},
        value={"bearing": np.array([[0.0], [2.0]])},
    )
    sim = robot_and_box(turns_to_box)
    told = value_map(path, sim, np.array([[0.0, 1.0, 0.0], [0.0, 1.0, np.pi]]))
    assert told.source == "critic"
    assert told.values.tolist() == pytest.approx([2.0, -2.0])
    # a network that also has a critic still drives
    from ai4u_edu import trained_brain

    sim.agents[0].use_brain(trained_brain(str(path)))
    sim.step()
    assert sim.agents[0].last_action["move"][0] == pytest.approx(0.5 * 3 / np.sqrt(10))


def test_values_by_rollouts_grow_towards_the_goal() -> None:
    poses = np.array([[0.4, 0.0, np.pi], [3.0, 0.0, np.pi]])  # the box is at (-2.39, 0)
    told = value_map("zoo:box_chase", "box_chase", poses)
    assert told.source == "rollouts"
    assert 80 < told.values[1] < told.values[0] <= 100
    with pytest.raises(SetupError, match=r"box_chase.onnx: this network has no critic; export"):
        value_map("zoo:box_chase", "box_chase", poses, source="critic")
    with pytest.raises(SetupError, match="expected a network with a critic"):
        value_map(turns_to_box, "box_chase", poses, source="critic")
    with pytest.raises(SetupError, match="expected 'critic' or 'rollouts', got 'guess'"):
        value_map(turns_to_box, "box_chase", poses, source="guess")


def test_a_copy_of_the_present_moment_has_levels_and_speeds() -> None:
    sim = Scene.load("forage").build()
    sim.reset(2)
    for _ in range(40):
        sim.step()
    energy = sim.agents[0].percept["inside"].tolist()
    apple = sim.world["food 1"]
    apple.leave()
    copy = WorldCopy(sim, Policy(lambda _: {}))
    percept = copy.percept_at(copy.home)
    assert percept is not None
    assert percept["inside"].tolist() == energy
    assert copy.sim.world[apple.name].fallen
    assert copy.sim.world.ticks == sim.world.ticks
    assert copy.agent.steps == 0

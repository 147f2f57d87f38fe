"""Stages on the way to the goal and the time that is left, in the snapshot and the API."""

import pytest

from ai4u_edu import BasicAgent, CircleShape, ControlRequestor, LocalBrain, Scene, World
from ai4u_edu.page.server.api import SnapshotView
from ai4u_edu.snapshot import AgentState, Stages, capture_snapshot


def first_of(sim: ControlRequestor) -> AgentState:
    return capture_snapshot(sim).agents[0]


def test_marks_that_were_passed_are_counted_once_though_two_rewards_count_them() -> None:
    sim = Scene.load("donut").build()
    sim.reset(1)
    marks = tuple(f"mark {number}" for number in range(1, 9))
    assert first_of(sim).stages == (Stages(0, 9, marks, marks, marks),)
    lap = [8, 1, 2, 3, 4, 5, 6, 7, 8]
    for passed, number in enumerate(lap, 1):
        place = sim.world.areas[f"mark {number}"].description.position
        sim.agents[0].body.move_to(*place)
        sim.step()
        ahead = tuple(f"mark {each}" for each in lap[passed:])
        assert first_of(sim).stages == (Stages(passed, 9, marks, ahead, ahead[:1]),)
    assert first_of(sim).succeeded
    sim.reset(2)
    assert first_of(sim).stages[0].passed == 0


def test_the_blocks_of_the_jumper_are_stages() -> None:
    sim = Scene.load("jumper").build()
    sim.reset(1)
    sim.agents[0].body.move_to(7, 0)
    sim.step()
    assert [each[:2] for each in first_of(sim).stages] == [(1, 4)]


def test_bodies_to_collect_are_stages() -> None:
    sim = Scene.load("tag").build()
    sim.reset(1)
    runners = ("runner 1", "runner 2", "runner 3")
    assert first_of(sim).stages == (Stages(0, 3, runners, runners, runners),)
    sim.agents[0].body.move_to(*sim.world["runner 2"].position)
    sim.step()
    left = ("runner 1", "runner 3")
    assert first_of(sim).stages == (Stages(1, 3, runners, left, left),)


def test_a_scene_without_them_has_none() -> None:
    sim = Scene.load("box_chase").build()
    sim.reset(1)
    assert first_of(sim).stages == ()


def test_the_seconds_left_run_down_to_none_at_the_step_limit() -> None:
    sim = Scene.load("sumo").build()
    sim.reset(1)
    assert first_of(sim).seconds_left == pytest.approx(60)
    sim.step()
    assert first_of(sim).seconds_left == pytest.approx(60 - 1 / 12)
    sim.agents[0].max_steps_per_episode = 2
    sim.step()
    assert first_of(sim).seconds_left == 0
    assert first_of(sim).truncated


def test_without_a_limit_there_is_no_time_left() -> None:
    world = World()
    world.add_body("robot", CircleShape(radius=0.5))
    agent = BasicAgent(body="robot", brains=[LocalBrain(controller=lambda percept: {})])
    sim = ControlRequestor(world, [agent])
    sim.reset(1)
    assert first_of(sim).seconds_left is None


def test_the_api_has_both() -> None:
    sim = Scene.load("tag").build()
    sim.reset(1)
    told = SnapshotView.of(capture_snapshot(sim)).model_dump()["agents"][0]
    targets = ["runner 1", "runner 2", "runner 3"]
    assert told["stages"] == [{"passed": 0, "total": 3, "targets": targets}]
    assert told["seconds_left"] == pytest.approx(50)

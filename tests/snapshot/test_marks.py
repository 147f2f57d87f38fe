"""The parts of a robot, where its eyes look, and the corners of floors."""

from dataclasses import replace

import numpy as np
import pytest

from ai4u_edu import (
    BasicAgent,
    BoxShape,
    CapsuleShape,
    CircleShape,
    ControlRequestor,
    LocalBrain,
    PolygonShape,
    Scene,
    World,
)
from ai4u_edu.snapshot import Snapshot, Stages, capture_snapshot
from ai4u_edu.snapshot.marks import floor_outline, look_direction, robot_parts, tread_bars
from ai4u_edu.world import BodyDescription
from tests.page.viewer.worlds import busy_sim, busy_world, picture, static_scene_of

SHAPES: dict[str, tuple[CircleShape | BoxShape | PolygonShape | CapsuleShape, int]] = {
    "round": (CircleShape(radius=0.5), 2),
    "car": (BoxShape(size=(2.5, 1.25)), 4),
    "square": (BoxShape(size=(0.8, 0.8)), 4),
    "wide": (BoxShape(size=(0.5, 2.0)), 4),
    "capsule": (CapsuleShape(length=1, radius=0.3), 0),
    "triangle": (PolygonShape(vertices=((0.6, 0), (-0.3, 0.5), (-0.3, -0.5))), 0),
}


@pytest.mark.parametrize("name", SHAPES)
def test_a_robot_keeps_within_its_outline(name: str) -> None:
    shape, wheels = SHAPES[name]
    parts = robot_parts(BodyDescription(name="robot", shape=shape, height=0.6))
    assert len(parts.wheels) == wheels
    bars = [corner for wheel in parts.wheels for bar in tread_bars(wheel) for corner in bar]
    for x, y in [*parts.shell, *bars]:
        assert shape.contains(0.995 * x, 0.995 * y)
    assert all(2 * wheel.radius < 0.6 for wheel in parts.wheels)


@pytest.fixture
def snapshot() -> Snapshot:
    sim = busy_sim()
    sim.reset(1)
    return picture(sim)


def direction(snapshot: Snapshot, *stages: Stages, x: float = 0.0, heading: float = 0.0) -> float:
    """Return where the robot looks, in degrees."""
    agent = snapshot.agents[0]._replace(stages=stages)
    states = {body.name: body for body in snapshot.bodies}
    states["robot"] = states["robot"]._replace(x=x, heading=heading)
    return float(np.rad2deg(look_direction(snapshot.static_scene, agent, states)))


def test_eyes_look_at_the_target_wherever_the_robot_turns(snapshot: Snapshot) -> None:
    assert direction(snapshot) == 0  # the box is at (3, 0)
    assert direction(snapshot, heading=np.pi / 2) == pytest.approx(-90)
    assert abs(direction(snapshot, x=6.0)) == pytest.approx(180)
    assert direction(snapshot, heading=0.01) == 0  # in steps of ten degrees


def test_eyes_look_at_the_next_stage_first(snapshot: Snapshot) -> None:
    names = ("goal", "box")  # the area goal is at (3, 3)
    assert direction(snapshot, Stages(0, 2, names, names, ("goal",))) == pytest.approx(40)
    assert direction(snapshot, Stages(1, 2, names, ("box",), ("box",))) == 0


def test_without_a_target_eyes_look_at_what_is_sensed_else_ahead() -> None:
    world = World()
    world.add_body("robot", CircleShape(radius=0.4), heading_deg=90)
    agent = BasicAgent(body="robot", brains=[LocalBrain(controller=lambda _percept: {})])
    for sim, is_ahead in (
        (Scene.load("soccer").build(), False),
        (ControlRequestor(world, [agent]), True),
    ):
        sim.reset(1)
        snapshot = capture_snapshot(sim)
        states = {body.name: body for body in snapshot.bodies}
        seen = look_direction(snapshot.static_scene, snapshot.agents[0], states)
        assert (seen == 0.0) == is_ahead


def test_nobody_looks_at_a_target_that_is_gone(snapshot: Snapshot) -> None:
    bodies = tuple(
        body._replace(fallen=body.name == "box", y=2.0 if body.name == "box" else body.y)
        for body in snapshot.bodies
    )
    assert direction(replace(snapshot, bodies=bodies)) == 0


def test_floors_are_rounded_where_nothing_is_beside_them() -> None:
    world = World()
    world.add_floor("left", BoxShape(size=(4, 4)))
    world.add_floor("right", BoxShape(size=(4, 2)), position=(4, 1))
    world.add_area("spot", BoxShape(size=(1, 1)), position=(-1.5, -1.5))
    world.add_body("robot", CircleShape(radius=0.4), tags=("agent",))
    static_scene = static_scene_of(world)
    left, right = (floor_outline(static_scene, floor) for floor in static_scene.floors)
    sharp = {(x, y) for x, y in left.tolist() if abs(x) == abs(y) == 2}
    assert sharp == {(2, 2), (-2, -2)}  # beside the other floor, and under the area
    assert [2, 0] in right.tolist()
    assert [6, 0] not in right.tolist()


def test_round_floors_stay_as_they_are() -> None:
    static_scene = static_scene_of(busy_world())
    _, ring, *_ = static_scene.floors
    assert len(floor_outline(static_scene, ring)) == len(ring.shape.outline())

"""Thumbnails of worlds: what the wall draws is where the world has it, and nothing more is sent."""

import math
from dataclasses import replace

import pytest

from ai4u_edu import BoxShape, CircleShape, ControlRequestor, RingShape, Scene, World
from ai4u_edu.member.thumbnail import MAX_BODIES, Thumbnail, drawing_of, poses_of
from ai4u_edu.snapshot import Snapshot, capture_snapshot
from ai4u_edu.wire.class_link import Drawing, Poses, decode_from_room, encode_from_room
from tests.builders import small_sim, small_world


def snapshot_of(world: World | None = None) -> Snapshot:
    return capture_snapshot(small_sim(world=world))


@pytest.mark.parametrize("name", Scene.names())
def test_each_scene_of_the_library_fits_into_a_message(name: str) -> None:
    sim = Scene.load(name).build()
    sim.reset(1)
    picture = capture_snapshot(sim)
    drawing = drawing_of(picture.static_scene, 1)
    poses = poses_of(picture, drawing)
    for message in (drawing, poses):
        assert decode_from_room(encode_from_room(message)) == message
    assert [body.name for body in drawing.bodies] == [each.name for each in picture.bodies]
    assert sum(body.is_agent for body in drawing.bodies) == len(picture.agents)
    assert len(poses.values) == 4 * len(drawing.bodies)


def test_bodies_are_drawn_in_their_frames_and_placed_by_their_poses() -> None:
    picture = snapshot_of(small_world(plate=20))
    drawing = drawing_of(picture.static_scene, 3)
    robot, box = drawing.bodies
    assert (robot.name, robot.is_agent, box.is_agent) == ("robot", True, False)
    disc, (nose, *eyes) = robot.shapes[0], robot.shapes[-5:]
    assert len({eye.colour for eye in eyes}) == 2
    assert (disc.radius, disc.points) == (0.5, (0.0, 0.0))
    assert nose.points[0] > 0.4  # it points ahead
    assert box.shapes[0].points == (0.5, 0.5, -0.5, 0.5, -0.5, -0.5, 0.5, -0.5)
    (floor,) = drawing.ground
    assert max(floor.points) == 10.0
    assert drawing.number == 3
    assert poses_of(picture, drawing).values == (0, 0, 0, 1, 4, 0, 0, 1)


def test_a_ring_keeps_its_hole_and_numbers_are_rounded() -> None:
    world = small_world(plate=20)
    world.add_area("track", RingShape(inner=2, outer=3), position=(1 / 3, 0))
    world.add_area("spot", CircleShape(radius=1), position=(1 / 3, -1 / 3))
    track, spot = drawing_of(snapshot_of(world).static_scene, 1).ground[1:]
    x, y = track.points[::2], track.points[1::2]
    radii = {round(math.hypot(a - 1 / 3, b), 2) for a, b in zip(x, y, strict=True)}
    assert radii == {2.0, 3.0}
    assert (spot.radius, spot.points) == (1.0, (0.333, -0.333))


def test_a_body_that_fell_is_not_visible() -> None:
    picture = snapshot_of()
    fallen = picture.bodies[1]._replace(fallen=True)
    picture = replace(picture, bodies=(picture.bodies[0], fallen))
    assert poses_of(picture, drawing_of(picture.static_scene, 1)).values[7] == 0


def test_of_too_many_bodies_the_agents_are_drawn() -> None:
    world = World()
    for number in range(MAX_BODIES + 5):
        world.add_body(f"b{number}", BoxShape(size=(0.1, 0.1)), position=(number, 9), kind="static")
    world.add_body("robot", CircleShape(radius=0.5))
    picture = snapshot_of(world)
    drawing = drawing_of(picture.static_scene, 1)
    assert len(drawing.bodies) == MAX_BODIES
    assert drawing.bodies[-1].is_agent
    encode_from_room(poses_of(picture, drawing))


def run(sim: ControlRequestor, ticks: int) -> Snapshot:
    for _ in range(ticks):
        sim.tick()
    return capture_snapshot(sim)


def test_only_what_changed_is_sent() -> None:
    sim = small_sim()
    thumbnail, first = Thumbnail(), capture_snapshot(sim)
    assert [type(each) for each in thumbnail.changes(first)] == [Drawing, Poses]
    assert thumbnail.changes(first) == []
    resting = run(sim, 5)
    assert thumbnail.changes(resting) == []
    trembling = tuple(body._replace(x=body.x + 1e-5, vx=1e-3) for body in resting.bodies)
    assert thumbnail.changes(replace(resting, bodies=trembling)) == []
    sim.world["robot"].move_to(1, 2)
    (poses,) = thumbnail.changes(run(sim, 1))
    assert isinstance(poses, Poses)
    assert poses.values[:2] == (1, 2)
    sim.world.add_body("new", CircleShape(radius=0.5), position=(0, 5))
    drawing, poses = thumbnail.changes(capture_snapshot(sim))
    assert isinstance(drawing, Drawing)
    assert isinstance(poses, Poses)
    assert (drawing.number, poses.drawing, len(poses.values)) == (2, 2, 12)

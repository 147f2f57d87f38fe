"""LocalGridSensor: the image from above, compared with a slow reference."""

import math
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from ai4u_edu import (
    BoxShape,
    CapsuleShape,
    CircleShape,
    LocalGridSensor,
    PolygonShape,
    RingShape,
    SegmentShape,
    World,
)
from ai4u_edu.base.errors import BlockError
from ai4u_edu.blocks.sensors.footprint import footprint
from tests.builders import small_sim, small_world

Picture = npt.NDArray[np.uint8]


def drawn(world: World, **fields: Any) -> Picture:
    sensor = LocalGridSensor(**fields)
    picture: Picture = small_sim([sensor], world=world).agents[0].percept["local_grid"]
    assert sensor.observation_space().contains(picture)
    return picture


def as_text(picture: Picture, channel: int = 0) -> list[str]:
    return ["".join(".#"[cell // 255] for cell in row) for row in picture[:, :, channel]]


def robot_world(heading: float = 0.0, position: tuple[float, float] = (0, 0)) -> World:
    world = World()
    world.add_body(
        "robot", CircleShape(radius=0.4), position=position, heading_deg=heading, tags=("agent",)
    )
    return world


def test_ahead_is_up_and_left_is_left() -> None:
    world = robot_world()
    world.add_body("box", BoxShape(size=(1, 2)), position=(2, 1.5), tags=("target",))
    picture = drawn(world, width=7, height=7, cell_size=1, channels=["target"])
    # cell centres are at whole metres; the box covers 1.5..2.5 m ahead and 0.5..2.5 m to the left
    assert as_text(picture) == [
        ".......",
        ".##....",
        ".......",
        ".......",
        ".......",
        ".......",
        ".......",
    ]


@pytest.mark.parametrize("position", [(0.0, 0.0), (3.0, -2.0)])
def test_the_picture_turns_with_the_agent(position: tuple[float, float]) -> None:
    world = robot_world(90, position)  # it looks along +y; the box lies along +x: to the right
    x, y = position
    world.add_body("box", BoxShape(size=(1, 1)), position=(x + 2, y), tags=("target",))
    picture = drawn(world, width=5, height=5, cell_size=1, channels=["target"])
    assert as_text(picture) == [".....", ".....", "....#", ".....", "....."]


def test_an_even_grid_has_the_agent_between_its_middle_cells() -> None:
    world = robot_world()
    picture = drawn(world, width=4, height=4, cell_size=0.25, channels=["agent"],
                    self_exclude=False)  # fmt: skip
    # centres are 0.125 and 0.375 m off; a corner cell is 0.53 m away, more than the radius of 0.4
    assert as_text(picture) == [".##.", "####", "####", ".##."]


def test_the_agent_itself_is_left_out_but_others_are_not() -> None:
    world = robot_world()
    world.add_body("twin", CircleShape(radius=0.4), position=(2, 0), tags=("agent",))
    picture = drawn(world, width=5, height=5, cell_size=1, channels=["agent"])
    assert as_text(picture) == ["..#..", ".....", ".....", ".....", "....."]


def test_floor_void_and_areas() -> None:
    world = robot_world()
    world.add_floor("plate", BoxShape(size=(3, 3)))
    world.add_area("goal", CircleShape(radius=0.6), position=(1, -1), tags=("goal",))
    picture = drawn(world, width=5, height=5, cell_size=1, channels=["floor", "void", "goal"])
    floor = [".....", ".###.", ".###.", ".###.", "....."]
    assert as_text(picture, 0) == floor
    assert as_text(picture, 1) == [row.translate({35: ".", 46: "#"}) for row in floor]
    assert as_text(picture, 2) == [".....", "...#.", ".....", ".....", "....."]


def test_a_world_without_floors_has_ground_everywhere() -> None:
    picture = drawn(robot_world(), width=3, height=2, channels=["void", "floor"])
    assert as_text(picture, 0) == ["..."] * 2
    assert as_text(picture, 1) == ["###"] * 2


def test_a_floor_shows_in_each_of_its_groups() -> None:
    world = robot_world()
    world.add_floor("ice", BoxShape(size=(2, 2)), tags=("floor", "ice"))
    world.add_floor("mud", BoxShape(size=(2, 2)), position=(2, 0), tags=("mud",))
    picture = drawn(world, width=3, height=3, cell_size=1, channels=["floor", "ice", "mud", "void"])
    assert as_text(picture, 0) == as_text(picture, 1)
    assert as_text(picture, 0) != as_text(picture, 2)
    assert as_text(picture, 3) == ["...", "...", "..."]  # the mud bears as well


def test_a_wall_thinner_than_a_cell_has_no_gaps() -> None:
    world = robot_world()
    wall = SegmentShape(a=(1.3, -4), b=(2.1, 4), thickness=0.01)
    world.add_body("wall", wall, kind="static", tags=("wall",))
    picture = drawn(world, width=9, height=9, cell_size=0.5, channels=["wall"])
    assert all((picture[:, column, 0] > 0).any() for column in range(9))


def test_what_fell_out_of_the_world_and_what_was_removed_is_gone() -> None:
    world = small_world(plate=4)
    world.add_body("wall", BoxShape(size=(1, 1)), position=(-1, 0), kind="static", tags=("wall",))
    sensor = LocalGridSensor(channels=["target", "wall"])
    sim = small_sim([sensor], world=world)
    assert sim.agents[0].percept["local_grid"].any(axis=(0, 1)).tolist() == [True, True]
    for _ in range(120):
        picture = sim.step()["local_grid"]
    assert world["box"].fallen
    assert picture.any(axis=(0, 1)).tolist() == [False, True]
    world.remove("wall")
    assert not sim.step()["local_grid"].any()
    world.add_body("late", CircleShape(radius=0.3), position=(0, 1), tags=("wall",))
    assert sim.step()["local_grid"].any(axis=(0, 1)).tolist() == [False, True]


def test_it_follows_what_moves() -> None:
    world = small_world()
    sim = small_sim(
        [LocalGridSensor(width=9, height=9, cell_size=1, channels=["target"])], world=world
    )
    world["box"].move_to(-2, 3)
    assert as_text(sim.step()["local_grid"]) == ["." * 9] * 6 + [".#......."] + ["." * 9] * 2


def test_stacked_pictures_lie_in_the_channels_oldest_first() -> None:
    world = small_world()
    sensor = LocalGridSensor(
        width=9, height=9, cell_size=1, channels=["target", "agent"], stacked_observations=3
    )
    sim = small_sim([sensor], world=world)
    first = sim.agents[0].percept["local_grid"]
    assert first.shape == (9, 9, 6)
    assert np.array_equal(first, np.tile(first[:, :, :2], 3))
    world["box"].move_to(-2, 3)
    second = sim.step()["local_grid"]
    assert np.array_equal(second[:, :, :4], first[:, :, :4])
    assert not np.array_equal(second[:, :, 4:], first[:, :, 4:])
    third = sim.step()["local_grid"]
    assert np.array_equal(third[:, :, :4], second[:, :, 2:])
    sim.reset()
    assert np.array_equal(sim.agents[0].percept["local_grid"], first)
    assert sensor.observation_space().contains(third)


def test_it_is_a_picture_of_bytes_or_shares() -> None:
    plain, shares = LocalGridSensor(), LocalGridSensor(perception_key="shares", normalized=True)
    agent = small_sim([plain, shares]).agents[0]
    picture, share = agent.percept["local_grid"], agent.percept["shares"]
    assert (picture.shape, picture.dtype, plain.reading_kind()) == ((64, 64, 5), "uint8", "simage")
    assert (share.dtype, shares.reading_kind()) == ("float32", "sfloatarray")
    assert set(np.unique(picture)) == {0, 255}
    assert np.array_equal(picture / 255, share)
    assert shares.observation_space().contains(share)


def test_a_group_named_twice_is_refused() -> None:
    with pytest.raises(BlockError) as caught:
        LocalGridSensor(channels=["wall", "void", "wall"])
    assert str(caught.value) == (
        "LocalGridSensor 'local_grid': channels: expected each group once, got 'wall' twice"
    )


SHAPES: list[Any] = [
    CircleShape(radius=0.7),
    BoxShape(size=(1.4, 0.6)),
    CapsuleShape(length=1.1, radius=0.35),
    PolygonShape(vertices=((1, 0), (0.2, 0.9), (-0.8, 0.4), (-0.9, -0.7), (0.3, -0.8))),
    SegmentShape(a=(-0.9, 0.2), b=(0.7, -0.5), thickness=0.5),
]


def random_world(rng: np.random.Generator) -> World:
    """A world of all shapes at random poses, tagged by number, and three floors with holes."""
    world = World()
    world.add_body(
        "robot",
        CircleShape(radius=0.1),
        kind="static",
        position=tuple(rng.uniform(-2, 2, 2)),
        heading_deg=float(rng.uniform(-180, 180)),
    )
    for number in range(12):
        world.add_body(
            f"thing{number}",
            SHAPES[number % len(SHAPES)],
            kind="static",
            position=tuple(rng.uniform(-4, 4, 2)),
            heading_deg=float(rng.uniform(-180, 180)),
            tags=(f"shape{number % len(SHAPES)}",),
        )
    for number, shape in enumerate((RingShape(inner=1, outer=2.5), *SHAPES[1:4])):
        world.add_floor(
            f"floor{number}",
            shape,
            position=tuple(rng.uniform(-3, 3, 2)),
            heading_deg=float(rng.uniform(-180, 180)),
        )
    return world


def cell_by_cell(
    world: World, channels: list[str], width: int, height: int, cell: float
) -> Picture:
    """Compute the same image slowly: test each shape at each cell's centre."""
    picture = np.zeros((height, width, len(channels)), np.uint8)
    robot = world["robot"]
    cos, sin = math.cos(robot.heading), math.sin(robot.heading)
    for row in range(height):
        for column in range(width):
            ahead, left = ((height - 1) / 2 - row) * cell, ((width - 1) / 2 - column) * cell
            x = robot.position[0] + cos * ahead - sin * left
            y = robot.position[1] + sin * ahead + cos * left
            tags = [
                tag
                for body in world.bodies.values()
                if body.description.shape.contains(*body.to_local(x, y))
                for tag in body.tags
            ]
            tags.append("void" if world.ground(x, y) is None else "floor")
            picture[row, column] = [255 * (channel in tags) for channel in channels]
    return picture


@pytest.mark.parametrize("seed", range(5))
def test_every_cell_is_as_the_shapes_themselves_say(seed: int) -> None:
    world = random_world(np.random.default_rng(seed))
    channels = ["floor", "void", *(f"shape{number}" for number in range(len(SHAPES)))]
    expected = cell_by_cell(world, channels, 29, 24, 0.25)
    picture = drawn(world, width=29, height=24, cell_size=0.25, channels=channels)
    assert np.array_equal(picture, expected)
    assert (expected > 0).any(axis=(0, 1)).sum() >= 5  # there was something to see


@pytest.mark.parametrize("shape", [*SHAPES, RingShape(inner=1, outer=2)])
def test_a_footprint_covers_what_the_shape_covers(shape: Any) -> None:
    parts = footprint(shape)
    for x, y in np.random.default_rng(0).uniform(-2.2, 2.2, (400, 2)):
        inside = any((x - u) ** 2 + (y - v) ** 2 <= r * r for u, v, r in parts.discs)
        inside |= any(all(a * x + b * y <= c for a, b, c in edges) for edges in parts.polygons)
        if parts.hole is not None:
            inside &= x * x + y * y > parts.hole[2] ** 2
        assert inside == bool(shape.contains(x, y)), (x, y)


def test_a_footprint_is_never_thinner_than_asked_for() -> None:
    box: Any = footprint(BoxShape(size=(1, 0.1)), 0.4)
    # to the left, behind, to the right, ahead
    assert [edge[2] for edge in box.polygons[0]] == pytest.approx([0.2, 0.5, 0.2, 0.5])
    disc: Any = footprint(CircleShape(radius=0.1), 0.4)
    assert disc.discs == ((0, 0, 0.2),)
    stick: Any = footprint(SegmentShape(a=(0, 0), b=(2, 0), thickness=0.1), 0.4)
    assert stick.discs == ((0, 0, 0.2), (2, 0, 0.2))
    assert sorted(edge[2] for edge in stick.polygons[0]) == pytest.approx([0, 0.2, 0.2, 2])
    triangle = PolygonShape(vertices=((0.1, 0), (0, 0.1), (-0.1, -0.1)))
    middle: Any = footprint(triangle, 0.4)
    assert middle.discs == ((0, 0, 0.2),)
    assert footprint(triangle).discs == ()

"""Adding bodies is refused inside another one, under a taken name, and in a full world."""

import gc
import weakref

import pytest

from ai4u_edu.base.errors import NameNotFoundError, WorldError
from ai4u_edu.world import BoxShape, CapsuleShape, CircleShape, World, WorldView
from ai4u_edu.world.shapes import BodyShape
from tests.world.samples import SHAPES


def test_an_overlap_is_refused() -> None:
    world = World()
    world.add_body("box", BoxShape(), position=(1, 0))
    with pytest.raises(WorldError) as info:
        world.add_body("robot", CircleShape(radius=0.6))
    assert str(info.value) == (
        "body 'robot': its place (0.0, 0.0) overlaps body 'box' at (1.0, 0.0); move one of them"
    )
    assert list(world.bodies) == ["box"]
    world.add_body("above", CircleShape(radius=0.6), z=1.0)
    world.add_body("ghost", CircleShape(radius=0.6), collision_mask=0)
    world.remove("above")
    world.add_body("robot", CircleShape(radius=0.5), position=(0.0005, 0))


@pytest.mark.parametrize("first", SHAPES, ids=lambda shape: shape.type)
@pytest.mark.parametrize("second", SHAPES, ids=lambda shape: shape.type)
@pytest.mark.parametrize("place", [(0.0, 0.0), (0.05, 0.0), (0.1, 0.05), (0.55, 0.0)])
def test_all_pairs_of_shapes_are_refused(
    first: BodyShape, second: BodyShape, place: tuple[float, float]
) -> None:
    world = World()
    world.add_body("first", first, kind="static")
    with pytest.raises(WorldError, match="overlaps body 'first'"):
        world.add_body("second", second, position=place)
    world.add_body("second", second, position=(2, 0))


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape.type)
def test_one_inside_the_other_is_refused(shape: BodyShape) -> None:
    world = World()
    world.add_body("first", shape)
    for name, radius in (("inside", 0.05), ("around", 5.0)):
        with pytest.raises(WorldError, match="overlaps body 'first'"):
            world.add_body(name, CircleShape(radius=radius), position=(0.02, 0.03))


def test_one_exactly_along_the_other_is_refused() -> None:
    long, short = CapsuleShape(length=2.0, radius=0.3), CapsuleShape(length=0.4, radius=0.1)
    for first, second in ((long, short), (short, long)):
        world = World()
        world.add_body("first", first)
        with pytest.raises(WorldError, match="overlaps body 'first'"):
            world.add_body("second", second, position=(0.9, 0))


def test_immovable_bodies_may_overlap() -> None:
    world = World()
    for i, kind in enumerate(["static", "static", "kinematic"]):
        world.add_body(f"wall {i}", BoxShape(size=(4, 0.2)), kind=kind, heading_deg=60 * i)
    with pytest.raises(WorldError, match="overlaps body 'wall"):
        world.add_body("robot", CircleShape())


def test_the_world_is_full_with_500_bodies() -> None:
    world = World()
    for i in range(500):
        world.add_body(f"ball {i}", CircleShape(radius=0.4), position=(i % 25, i // 25))
    with pytest.raises(WorldError) as info:
        world.add_body("last", CircleShape(), position=(-9, 0))
    assert str(info.value) == (
        "body 'last': the world is full; expected at most 500 bodies; remove some, or build walls "
        "from longer segments"
    )
    world.remove("ball 7")
    world.add_body("last", CircleShape(), position=(-9, 0))


def test_names_are_unique_among_bodies_floors_and_areas() -> None:
    world = World()
    world.add_body("body", CircleShape())
    world.add_floor("floor", BoxShape(size=(9, 9)))
    world.add_area("area", BoxShape())
    for kind in ("body", "floor", "area"):
        article = "an" if kind == "area" else "a"
        message = f"^{kind!r} is already the name of {article} {kind}; names are unique$"
        with pytest.raises(WorldError, match=message):
            world.add_body(kind, CircleShape(), position=(5, 5))
        with pytest.raises(WorldError, match=message):
            world.add_floor(kind, CircleShape())
        with pytest.raises(WorldError, match=message):
            world.add_area(kind, CircleShape())


def test_an_unknown_name_suggests_the_nearest() -> None:
    world = World()
    with pytest.raises(NameNotFoundError, match=r"^no body is named 'box'; there are none$"):
        world["box"]
    world.add_body("robot", CircleShape())
    world.add_body("red box", BoxShape(), position=(3, 0))
    for ask in (world.__getitem__, world.remove, WorldView(world).__getitem__):
        with pytest.raises(NameNotFoundError) as info:
            ask("redbox")
        assert str(info.value) == "no body is named 'redbox'; did you mean 'red box'?"


def test_an_episodes_physics_is_freed_as_soon_as_the_next_one_begins() -> None:
    world = World()
    robot = world.add_body("robot", CircleShape())
    world.add_body("box", CircleShape(), position=(1, 0))
    world.contacts.watch(robot)
    world.tick()
    gc.disable()
    try:
        before = weakref.ref(world.space)
        world.reset()
        assert before() is None
    finally:
        gc.enable()
    world.tick()

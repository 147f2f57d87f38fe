"""A fan that was made once sees all later changes of the world."""

from collections.abc import Callable, Sequence

import pytest

from ai4u_edu.world import Body, BoxShape, CircleShape, RayFan, RayGrid, World

Look = Callable[[], tuple[float, float]]
LOW, HIGH = 1.0, 2.0


def code_of(tags: Sequence[str]) -> float:
    return {(): 0.0, ("low",): LOW, ("high",): HIGH}.get(tuple(tags), 9.0)


@pytest.fixture
def world() -> World:
    """A robot on a table, and a ball before it."""
    world = World()
    world.add_floor("table", BoxShape(size=(12, 12)))
    world.add_body("robot", CircleShape(radius=0.3), kind="kinematic")
    world.add_body("ball", CircleShape(), position=(3, 0), tags=("low",))
    return world


@pytest.fixture(params=["fan", "grid"])
def look(world: World, request: pytest.FixtureRequest) -> Look:
    """Return a function that casts one ray ahead, always with the same caster."""
    caster: RayFan | RayGrid = (
        RayFan(world, [0.0], 20.0, code_of)
        if request.param == "fan"
        else RayGrid(world, [0.0], [0.0], 20.0, code_of)
    )

    def seen() -> tuple[float, float]:
        caster.cast(world["robot"])
        return caster.codes.item(), round(caster.distances.item(), 9)

    return seen


def fall(world: World, body: Body) -> None:
    for _ in range(200):
        world.tick()
    assert body.fallen


def test_after_a_reset(world: World, look: Look) -> None:
    assert look() == (LOW, 2.5)
    world["ball"].move_to(5, 0)
    assert look() == (LOW, 4.5)
    for _ in range(3):
        world.reset()
        assert look() == (LOW, 2.5)
    world.tick()
    assert look() == (LOW, 2.5)


def test_after_bodies_came_and_went(world: World, look: Look) -> None:
    assert look() == (LOW, 2.5)
    world.add_body("post", BoxShape(), kind="static", position=(1.5, 0), tags=("high",))
    assert look() == (HIGH, 1.0)
    world.remove("ball")
    assert look() == (HIGH, 1.0)
    world.remove("post")
    assert look() == (0.0, 0.0)
    world.add_body("ball", CircleShape(), position=(4, 0), tags=("high",))
    assert look() == (HIGH, 3.5)


def test_after_a_fall(world: World, look: Look) -> None:
    ball = world["ball"]
    world.add_body("post", BoxShape(), kind="static", position=(5, 0), tags=("high",))
    assert look() == (LOW, 2.5)
    ball.move_to(8, 0)
    assert look() == (HIGH, 4.5)
    fall(world, ball)
    world.remove("post")
    assert look() == (0.0, 0.0)
    ball.move_to(2, 0)
    assert look() == (LOW, 1.5)


def test_while_something_falls(world: World, look: Look) -> None:
    world["ball"].move_to(8, 0)
    for _ in range(60):
        world.tick()
        ball = world["ball"]
        assert look() == ((LOW, 7.5) if ball.z + 1.0 >= 0.5 else (0.0, 0.0))
    assert ball.z < -1.0


def test_after_a_floor_came() -> None:
    world = World()
    robot = world.add_body("robot", CircleShape(radius=0.3))
    grid = RayGrid(world, [0.0], [-0.5], 20.0, code_of)
    grid.cast(robot)
    assert grid.codes.item() == 9.0, "endless ground"
    world.add_floor("table", BoxShape(size=(1, 1)), tags=("low",))
    grid.cast(robot)
    assert grid.codes.item() == 0.0, "over the edge"
    world.add_floor("wide", CircleShape(radius=9), tags=("low",))
    grid.cast(robot)
    assert grid.codes.item() == LOW

"""Bodies: every shape and kind, their place, and what a body refuses."""

import math
from typing import Any

import pytest

from ai4u_edu.base.errors import WorldError
from ai4u_edu.world import BoxShape, CircleShape, SegmentShape, World
from ai4u_edu.world.contacts import Contacts
from ai4u_edu.world.shapes import BodyShape
from tests.world.samples import SHAPES

NAN, INF = math.nan, math.inf


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape.type)
@pytest.mark.parametrize("kind", ["static", "dynamic", "kinematic"])
def test_every_shape_of_every_kind(shape: BodyShape, kind: str) -> None:
    world = World(damping=1.0)
    body = world.add_body(
        "thing",
        shape,
        kind=kind,
        position=(1, 2),
        heading_deg=90,
        velocity=(0.5, 0.0),
        angular_velocity_deg=90,
        elasticity=0.1,
    )
    assert body.pose == pytest.approx((1, 2, 0, math.pi / 2))
    assert body.moves == (kind == "dynamic")
    for _ in range(60):
        world.tick()
    moved = kind != "static"
    assert body.position == pytest.approx((1.5 if moved else 1.0, 2.0))
    assert body.heading == pytest.approx(-math.pi if moved else math.pi / 2)
    assert body.velocity == ((0.5, 0.0) if moved else (0.0, 0.0))


def test_a_stick_turns_around_its_middle() -> None:
    world = World(damping=1.0)
    stick = world.add_body(
        "stick", SegmentShape(a=(0, 0), b=(3, 0)), position=(1, 2), angular_velocity_deg=90
    )
    for _ in range(60):
        world.tick()
    assert stick.heading == pytest.approx(math.pi / 2)
    assert stick.position == pytest.approx((2.5, 0.5)), "its end, around (2.5, 2)"


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape.type)
def test_every_shape_stops_a_ball_and_is_pushed_by_it(shape: BodyShape) -> None:
    for kind in ("static", "dynamic"):
        world = World(damping=1.0)
        thing = world.add_body("thing", shape, kind=kind)
        ball = world.add_body("ball", CircleShape(radius=0.3), position=(0, 3), mass=3.0)
        ball.set_velocity(0.0, -2.0)
        for _ in range(120):
            world.tick()
        if kind == "static":
            assert thing.position == (0.0, 0.0)
            assert 0.3 < ball.position[1] < 1.0
        else:
            assert thing.position[1] < -0.5


def test_driven_body_stays_outside_a_wall() -> None:
    """The velocity is set anew each tick, as an actuator does."""
    world = World()
    world.add_body("wall", BoxShape(size=(1, 6)), kind="static", position=(3, 0))
    robot = world.add_body("robot", CircleShape(radius=0.5))
    for _ in range(240):
        robot.set_velocity(3.0, 0.0)
        world.tick()
        assert robot.position[0] - 2.0 < 0.08


def test_driving_into_a_pile_keeps_speeds_low() -> None:
    world = World()
    for i in range(25):
        world.add_body(f"box {i}", BoxShape(), position=(i % 5, i // 5))
    robot = world.add_body("robot", CircleShape(), position=(-3, 2.2), mass=5.0)
    for _ in range(240):
        robot.set_velocity(2.0, 0.0)
        world.tick()
        assert all(math.hypot(*body.velocity) < 4.0 for body in world.bodies.values())


@pytest.mark.parametrize(
    ("method", "numbers", "what", "shown"),
    [
        ("set_velocity", (NAN, 1.0), "velocity", "(nan, 1.0)"),
        ("set_velocity", (INF, -INF), "velocity", "(inf, -inf)"),
        ("set_angular_velocity", (INF,), "angular velocity", "(inf,)"),
        ("apply_force", (0.0, NAN), "force", "(0.0, nan)"),
        ("jump", (NAN,), "jump speed", "(nan,)"),
        ("move_to", (INF, 0.0), "place", "(inf, 0.0, 0.0, 0.0)"),
    ],
)
def test_nonfinite_numbers_are_refused(
    method: str, numbers: tuple[float, ...], what: str, shown: str
) -> None:
    world = World()
    robot = world.add_body("robot", CircleShape())
    with pytest.raises(WorldError) as info:
        getattr(robot, method)(*numbers)
    assert str(info.value) == f"{what} of body 'robot': expected finite numbers, got {shown}"
    for _ in range(60):
        world.tick()
    assert robot.pose == (0.0, 0.0, 0.0, 0.0), "nothing came of it"


@pytest.mark.parametrize("option", ["heading", "z"])
def test_a_heading_or_a_height_that_is_not_finite_is_refused(option: str) -> None:
    robot = World().add_body("robot", CircleShape())
    options: dict[str, Any] = {option: NAN}
    with pytest.raises(WorldError, match=r"^place of body 'robot': expected finite numbers"):
        robot.move_to(1.0, 1.0, **options)
    assert robot.position == (0.0, 0.0)


def test_physics_out_of_range_is_told() -> None:
    world = World(ticks_per_second=1)
    robot = world.add_body("robot", CircleShape())
    robot.set_velocity(1.7e308, 0.0)
    world.tick()
    robot.set_velocity(1.7e308, 0.0)
    with pytest.raises(WorldError) as info:
        world.tick()
    assert str(info.value) == (
        "body 'robot' is at (inf, 0.0): the physics went out of range; "
        "are masses or speeds extreme?"
    )


def test_an_error_in_a_collision_handler_is_raised_by_the_tick(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def broken(self: Contacts, a: object, b: object) -> None:
        raise ZeroDivisionError("broken")

    world = World()
    robot = world.add_body("robot", CircleShape())
    world.add_body("ball", CircleShape(), position=(1.0005, 0))
    world.contacts.watch(robot)
    robot.set_velocity(1.0, 0.0)
    with monkeypatch.context() as patched:
        patched.setattr(Contacts, "_touch", broken)
        with pytest.raises(ZeroDivisionError, match=r"^broken$"):
            world.tick()
    world.tick()


def test_a_removed_body_is_gone() -> None:
    world = World(damping=1.0)
    robot = world.add_body("robot", CircleShape())
    world.add_body("ball", CircleShape(), position=(2, 0))
    world.remove("ball")
    robot.set_velocity(3.0, 0.0)
    for _ in range(60):
        world.tick()
    assert robot.position == pytest.approx((3.0, 0.0))
    assert "ball" not in world.bodies
    world.reset()
    assert list(world.bodies) == ["robot"]
    world.add_body("ball", CircleShape(), position=(2, 0))


def test_a_body_is_put_somewhere_at_rest() -> None:
    world = World()
    robot = world.add_body("robot", CircleShape(), velocity=(1, 1), angular_velocity_deg=30)
    robot.apply_force(100.0, 0.0)
    robot.move_to(3, 4, heading=1.0)
    world.tick()
    assert robot.pose == (3.0, 4.0, 0.0, 1.0)
    assert (robot.velocity, robot.angular_velocity) == ((0.0, 0.0), 0.0)

"""Falling, jumping and landing, compared with the exact parabola."""

import math

import pytest

from ai4u_edu.world import Body, BoxShape, CircleShape, World

G = 9.81
RATES = pytest.mark.parametrize("rate", [30, 60, 240])


def on_two_floors(rate: int) -> tuple[World, Body]:
    """A robot on a floor that ends at x = 0; from x = 1 on there is another, 1 m lower."""
    world = World(ticks_per_second=rate, gravity=G, damping=0.05, fall_threshold=-5.0)
    world.add_floor("near", BoxShape(size=(4, 4)), position=(-2, 0))
    world.add_floor("far", BoxShape(size=(10, 4)), position=(6, 0), top=-1.0)
    return world, world.add_body("robot", CircleShape(), position=(-1, 0))


def fly(world: World, body: Body) -> list[tuple[float, float, float]]:
    """Ticks until the body stands; x, z and forward speed after each tick, the last one on the
    ground."""
    path = []
    for _ in range(5000):
        world.tick()
        path.append((body.position[0], body.z, body.velocity[0]))
        if body.on_ground or body.fallen:
            return path
    raise AssertionError("it never came down")


def parabola(ticks: int, dt: float, speed: float) -> float:
    return speed * ticks * dt - 0.5 * G * (ticks * dt) ** 2


@RATES
def test_a_fall_over_an_edge_is_the_parabola(rate: int) -> None:
    world, robot = on_two_floors(rate)
    while robot.on_ground:
        robot.set_velocity(4.0, 0.0)
        before = robot.position[0]
        world.tick()
    assert before <= 0.0 < robot.position[0], "it leaves where its centre does"
    path = [(robot.position[0], robot.z, robot.velocity[0]), *fly(world, robot)]
    *air, (_, last_z, _) = path
    speed = air[0][2]
    assert speed == pytest.approx(4.0 * 0.05**world.dt), "the last tick on the ground damps"
    for ticks, (x, z, forward) in enumerate(air, start=1):
        assert z == pytest.approx(parabola(ticks, world.dt, 0.0), rel=1e-9)
        assert forward == speed, "there is no friction in the air"
        assert x == pytest.approx(air[0][0] + speed * (ticks - 1) * world.dt, abs=1e-12)
        # it left the edge somewhere between two ticks
        since_edge = x / speed
        assert abs(z + 0.5 * G * since_edge**2) <= G * ticks * world.dt * world.dt
    assert last_z == -1.0, "exactly on the floor"
    assert len(path) == math.ceil(math.sqrt(2.0 / G) * rate)


@RATES
@pytest.mark.parametrize("speed", [0.5, 3.0, 7.0])
def test_a_jump_is_the_parabola(rate: int, speed: float) -> None:
    world = World(ticks_per_second=rate, gravity=G, damping=0.001)
    robot = world.add_body("robot", CircleShape())
    robot.set_velocity(3.0, -1.0)
    robot.jump(speed)
    assert not robot.on_ground
    *air, (x, z, forward) = fly(world, robot)
    for ticks, (at, height, kept) in enumerate(air, start=1):
        assert height == pytest.approx(parabola(ticks, world.dt, speed), rel=1e-9, abs=1e-9)
        assert at == pytest.approx(3.0 * ticks * world.dt, abs=1e-12)
        assert kept == 3.0
    flight = 2 * speed / G
    assert len(air) + 1 == math.ceil(round(flight * rate, 9))
    assert abs(x - 3.0 * flight) < 3.0 * world.dt, "less than a tick's way off"
    assert (z, robot.vz, robot.on_ground, forward) == (0.0, 0.0, True, 3.0)
    world.tick()
    assert robot.velocity[0] == pytest.approx(3.0 * 0.001**world.dt), "ground friction is back"


def test_turning_is_damped_on_the_ground_only() -> None:
    world = World(damping=0.001)
    robot = world.add_body("robot", CircleShape())
    robot.jump(2.0)
    robot.set_angular_velocity(1.0)
    fly(world, robot)
    assert robot.angular_velocity == 1.0
    world.tick()
    assert robot.angular_velocity < 0.9


def test_a_gap_is_jumped_and_not_walked_over() -> None:
    world, robot = on_two_floors(60)
    robot.set_velocity(4.0, 0.0)
    robot.jump(5.0)
    lowest = min(z for x, z, _ in fly(world, robot) if x < 1.0)
    assert lowest > -1.0, "it was above the gap all the time"
    assert robot.position[0] > 1.0
    assert (robot.z, robot.on_ground) == (-1.0, True)

    world, robot = on_two_floors(60)
    robot.set_velocity(1.0, 0.0)
    while robot.on_ground:
        robot.set_velocity(1.0, 0.0)
        world.tick()
    fly(world, robot)
    assert robot.fallen


def test_a_jump_starts_from_the_ground_upwards_only() -> None:
    world = World()
    robot = world.add_body("robot", CircleShape())
    for speed in (0.0, -3.0):
        robot.jump(speed)
        assert (robot.on_ground, robot.vz) == (True, 0.0)
    robot.jump(0.01)
    world.tick()
    assert (robot.on_ground, robot.z) == (True, 0.0), "too weak for one tick"


def test_a_speed_set_in_the_air_counts_from_there() -> None:
    world = World(gravity=G)
    robot = world.add_body("robot", CircleShape(), z=4.0)
    assert not robot.on_ground
    for _ in range(6):
        world.tick()
    z = robot.z
    robot.jump(-2.0)
    for ticks in range(1, 7):
        world.tick()
        assert robot.z == pytest.approx(z + parabola(ticks, world.dt, -2.0), rel=1e-9)


def test_without_gravity_nothing_comes_down() -> None:
    world = World(gravity=0.0)
    floating = world.add_body("floating", CircleShape(), z=1.0)
    rising = world.add_body("rising", CircleShape(), position=(3, 0))
    rising.jump(0.5)
    for _ in range(120):
        world.tick()
    assert (floating.z, floating.on_ground) == (1.0, False)
    assert rising.z == pytest.approx(1.0)


@pytest.mark.parametrize("kind", ["static", "kinematic"])
def test_static_and_kinematic_bodies_neither_fall_nor_jump(kind: str) -> None:
    world = World()
    thing = world.add_body("thing", BoxShape(), kind=kind, z=2.0)
    thing.jump(5.0)
    for _ in range(30):
        world.tick()
    assert (thing.z, thing.vz, thing.on_ground) == (2.0, 0.0, True)


def test_a_body_starts_on_the_highest_floor_or_where_it_is_put() -> None:
    world = World()
    world.add_floor("low", BoxShape(size=(4, 4)), top=0.5)
    world.add_floor("high", CircleShape(radius=1), top=2.0)
    assert world.add_body("up", CircleShape(radius=0.2)).z == 2.0
    assert world.add_body("down", CircleShape(radius=0.2), position=(1.5, 0)).z == 0.5
    assert world.add_body("out", CircleShape(radius=0.2), position=(9, 0)).z == 0.0
    given = world.add_body("given", CircleShape(radius=0.2), position=(-1.5, 0), z=1.25)
    assert (given.z, given.on_ground) == (1.25, False)
    assert world.ground(0, 0) == 2.0
    assert world.ground(9, 0) is None
    given.move_to(0, 0.9)
    assert (given.z, given.on_ground) == (2.0, True)

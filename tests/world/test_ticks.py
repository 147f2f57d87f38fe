"""Ticks at one go are the same as one by one, to the last bit, and end where Python has to look."""

import math
import random
from collections.abc import Callable
from typing import Any

import pytest

from ai4u_edu import Scene
from ai4u_edu.base.errors import WorldError
from ai4u_edu.world import Body, BoxShape, CircleShape, Drive, World, rework
from ai4u_edu.world.contacts import Contacts
from ai4u_edu.world.native import ticks as _ticks
from tests.world.one_go import Way, at_one_go, one_by_one, state

pytestmark = pytest.mark.skipif(_ticks.compiled() is None, reason="nothing is compiled here")

OPEN = "box_chase", "jumper", "platform", "push_block"
AHEAD, ROUND = Drive(3.0, 0.0, 0.0), Drive(1.0, 0.0, 2.0)
WAYS = (at_one_go, one_by_one)


def plate(**fields: Any) -> tuple[World, Body]:
    """A robot in the middle of a plate, 4 m from side to side."""
    world = World(**fields)
    world.add_floor("plate", BoxShape(size=(4, 4)))
    robot = world.add_body("robot", CircleShape(radius=0.3), height=1.0, mass=5.0)
    world.contacts.watch(robot)
    return world, robot


def both(happens: Callable[[Way], World]) -> World:
    """The world in which something happened at one go; tick by tick it would be the same."""
    quick, plain = (happens(way) for way in WAYS)
    assert state(quick) == state(plain)
    return quick


@pytest.mark.parametrize("name", Scene.names())
def test_every_scene(name: str) -> None:
    def wander(way: Way, states: list[bytes], counts: list[int]) -> None:
        chance, sim = random.Random(name), Scene.load(name).build(seed=2)
        sim.reset(seed=2)
        world, bodies = sim.world, [agent.body for agent in sim.agents]
        _, (right, _) = world.bounds()
        for turn in range(250):
            if turn % 50 == 49 or any(body.fallen for body in bodies):
                world.reset()
            body = chance.choice(bodies)
            numbers = (chance.choice((0.0, chance.uniform(-6, 6))) for _ in range(3))
            forward, left, turning = numbers
            drive = Drive(forward, left, turning, pushed=chance.random() < 0.2)
            if body.on_ground and chance.random() < 0.1:
                body.jump(chance.uniform(0.5, 4))
            if chance.random() < 0.1:  # somewhere near the right edge of it all
                body.move_to(right - chance.uniform(0.0, 1.0), body.position[1], heading=0.3)
            counts.append(way(world, body, drive, 5))
            states.append(state(world))

    quick: tuple[list[bytes], list[int]] = [], []
    plain: tuple[list[bytes], list[int]] = [], []
    wander(at_one_go, *quick)
    wander(one_by_one, *plain)
    assert quick[0] == plain[0]
    if name not in ("donut", "sumo"):  # they have round floors
        assert quick[1].count(5) > 60
        assert name not in OPEN or any(0 < count < 5 for count in quick[1]), "over an edge"


def test_over_the_edge_in_the_middle() -> None:
    def happens(way: Way) -> World:
        world, robot = plate()
        robot.move_to(1.89, 0.0)
        assert way(world, robot, AHEAD, 5) == (3 if way is at_one_go else 0)
        assert robot.z < 0
        return world

    both(happens)


def test_it_ends_where_the_floor_does_not_where_the_next_one_begins() -> None:
    world, robot = plate()
    world.add_floor("next", BoxShape(size=(4, 4)), position=(4, 0))
    world.add_floor("lower", BoxShape(size=(4, 4)), position=(8, 0), top=-0.5)
    assert world.drive(robot, AHEAD, 50) == 50
    assert robot.position[0] > 2.4, "on the next one"
    assert world.drive(robot, AHEAD, 10) == 10
    assert 0 < world.drive(robot, Drive(30.0, 0.0, 0.0), 50) < 9
    assert not robot.on_ground, "it falls down to the lower one"


def test_nobody_falls_off_unseen() -> None:
    """It is not who drives that goes over the edge."""

    def happens(way: Way) -> World:
        world, robot = plate(damping=1.0)
        ball = world.add_body("ball", CircleShape(radius=0.2), position=(1.8, 1), velocity=(3, 0))
        way(world, robot, Drive(0.0, 0.0, 1.0), 20)
        assert ball.z < -0.1
        return world

    both(happens)


def test_who_leaves_the_world_is_out_at_that_tick() -> None:
    world, robot = plate(fall_threshold=-1e-9)
    robot.move_to(1.89, 0.0)
    assert world.drive(robot, AHEAD, 9) == 3
    assert robot.fallen
    assert world.drive(robot, AHEAD, 9) == 0


def test_a_touch_has_the_tick_at_which_it_was() -> None:
    def happens(way: Way) -> World:
        world, robot = plate(damping=1.0)
        world.add_body(
            "ball", CircleShape(radius=0.2), position=(0.65, 0), elasticity=1.0, mass=0.1
        )
        robot.description = robot.description.model_copy(update={"elasticity": 1.0})
        world.rebuild()
        way(world, robot, Drive(1.0, 0.0, 0.0), 30)
        return world

    world = both(happens)
    assert not world.contacts.of("robot"), "it has bounced off"
    (last,) = world.contacts._last.values()
    assert 5 < last < 25
    assert world.contacts.touched_after("robot", "ball", last - 1)


def test_what_a_handler_raises_is_raised_at_its_tick(monkeypatch: pytest.MonkeyPatch) -> None:
    def touch(self: Contacts, a: Body, b: Body) -> None:
        raise LookupError

    monkeypatch.setattr(Contacts, "_touch", touch)

    def happens(way: Way) -> World:
        world, robot = plate()
        world.add_body("ball", CircleShape(radius=0.2), position=(0.65, 0))
        with pytest.raises(LookupError):
            way(world, robot, AHEAD, 30)
        assert 1 < world.ticks < 10
        assert way(world, robot, AHEAD, 5) == (5 if way is at_one_go else 0), "once is enough"
        return world

    both(happens)


def divide(_arbiter: Any) -> None:
    raise ZeroDivisionError


def test_what_is_raised_between_ticks_comes_with_the_next_one() -> None:
    world, robot = plate()

    def fail() -> None:
        guarded: Any = world.contacts._guard(divide)
        guarded(None, world.space, None)

    fail()
    with pytest.raises(ZeroDivisionError):
        world.drive(robot, AHEAD, 5)
    assert world.ticks == 1
    fail()
    world.reset()
    assert world.drive(robot, AHEAD, 5) == 5, "that was in another episode"


def test_at_the_end_of_a_second_all_is_checked() -> None:
    world = World()
    robot = world.add_body("robot", CircleShape())
    lost = world.add_body("lost", CircleShape(), position=(5, 0))
    assert world.drive(robot, AHEAD, 58) == 58
    lost._pm.velocity = math.nan, 0.0
    with pytest.raises(WorldError, match="'lost' is at"):
        world.drive(robot, AHEAD, 5)
    assert world.ticks == 60
    world.reset()
    assert [world.drive(world["robot"], AHEAD, 70) for _ in range(2)] == [60, 60]


@pytest.mark.parametrize("pushed", [False, True])
@pytest.mark.parametrize("which", range(3))
@pytest.mark.parametrize("number", [math.nan, math.inf])
def test_what_is_refused_is_refused_before_the_tick(
    which: int, number: float, pushed: bool
) -> None:
    forward, left, turning = (number if i == which else 1.0 for i in range(3))
    drive = Drive(forward, left, turning, pushed)

    def happens(way: Way) -> World:
        world, robot = plate()
        with pytest.raises(WorldError, match="expected finite"):
            way(world, robot, drive, 5)
        assert world.ticks == 0
        return world

    both(happens)


def test_a_speed_that_becomes_too_much_is_refused_at_its_tick() -> None:
    def happens(way: Way) -> World:
        world = World()
        robot = world.add_body("robot", CircleShape())
        with pytest.raises(WorldError, match="velocity of body 'robot'"):
            way(world, robot, Drive(1.7e308, -1.7e308, 1.0), 60)
        return world

    assert both(happens).ticks == happens(at_one_go).ticks


@pytest.mark.parametrize("angle", [0.0, -0.0, 3.0, math.pi, -math.pi, -4.0, 1e5, -1e5, 5e-324])
def test_every_heading(angle: float) -> None:
    def happens(way: Way) -> World:
        world, robot = plate()
        robot.move_to(0.0, 0.0, heading=angle)
        way(world, robot, Drive(0.7, -0.3, -2.0), 40)
        return world

    both(happens)


CHANGES: dict[str, Callable[[World, Body], Any]] = {
    "put on another floor": lambda world, robot: robot.move_to(9.0, 0.0),
    "put into the air": lambda world, robot: robot.move_to(0.0, 0.0, z=0.1),
    "raised by hand": lambda world, robot: setattr(robot, "z", 0.3),
    "raised by hand to a floor": lambda world, robot: setattr(robot, "z", 1.0),
    "jumped": lambda world, robot: robot.jump(0.3),
    "somebody else jumped": lambda world, robot: world["box"].jump(1.0),
    "left": lambda world, robot: robot.leave(),
    "come back": lambda world, robot: robot.come_back(),
    "made anew": lambda world, robot: rework(
        world, robot.description.model_copy(update={"shape": CircleShape(radius=0.5)})
    ),
    "a floor more": lambda world, robot: world.add_floor("more", BoxShape(), position=(3, 0)),
    "a floor a hair higher": lambda world, robot: world.add_floor("hair", BoxShape(), top=5e-10),
    "a floor turned": lambda world, robot: world.add_floor("turned", BoxShape(), heading_deg=45),
    "a body more": lambda world, robot: world.add_body("more", CircleShape(), position=(1, 1)),
    "a body less": lambda world, robot: world.remove("box"),
    "a body on another": lambda world, robot: world["box"].move_to(0.2, 0.0, z=1.0),
    "a body gone": lambda world, robot: world["box"].leave(),
    "a body at the edge": lambda world, robot: world["box"].move_to(-1.99, 0.0),
    "held": lambda world, robot: robot.hold(world["box"]),
    "reset": lambda world, robot: world.reset(),
}
FOR_GOOD = [CHANGES[name] for name in ("left", "a floor a hair higher")]
"""After these it goes on tick by tick."""


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_what_has_changed_is_known_at_once(change: Callable[[World, Body], Any]) -> None:
    def happens(way: Way) -> World:
        world, robot = plate()
        world.add_floor("table", BoxShape(size=(4, 4)), position=(9, 0), top=1.0)
        world.add_body("box", BoxShape(), position=(-1, -1), velocity=(-0.5, 0))
        way(world, robot, ROUND, 5)
        change(world, robot)
        for _ in range(40):
            gone = way(world, robot, ROUND, 5)
        assert gone == (5 if way is at_one_go and change not in FOR_GOOD else 0)
        return world

    both(happens)


def test_who_stands_on_a_body_goes_tick_by_tick() -> None:
    def happens(way: Way) -> World:
        world, robot = plate()
        world.add_body("rock", BoxShape(size=(2, 2)), kind="static", height=0.5, position=(0, 9))
        robot.move_to(0.0, 9.0, z=0.5)
        world.tick()
        assert robot.on_ground
        assert way(world, robot, AHEAD, 5) == 0
        way(world, robot, AHEAD, 20)
        assert robot.z < 0.5
        return world

    both(happens)


def test_without_the_compiled_part_nothing_is_done(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(_ticks, "compiled", lambda: None)
    world, robot = plate()
    assert world.drive(robot, AHEAD, 5) == 0
    assert world.ticks == 0


@pytest.mark.parametrize("what", ["_VECT", "_FORMS"])
def test_nothing_compiled_is_used_with_another_pymunk(
    what: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert _ticks._as_expected()
    other = ["y", "x"] if what == "_VECT" else {"cpSpaceStep": "void(*)(struct cpSpace *, float)"}
    monkeypatch.setattr(_ticks, what, other)
    assert _ticks.compiled.__wrapped__() is None

"""A world without height has no cost for it: no Python code for height runs in its ticks."""

from collections.abc import Callable
from typing import Any

import pymunk
import pytest

from ai4u_edu.world import Body, BoxShape, CircleShape, World
from ai4u_edu.world.contacts import Contacts
from ai4u_edu.world.physics import Height
from tests.processes import is_own_thread

Handler = Callable[[pymunk.Arbiter, pymunk.Space, Any], None]


class Calls:
    """Counts of vertical steps and of collision callbacks, in the test's own thread."""

    steps = 0
    handlers = 0


@pytest.fixture
def calls(monkeypatch: pytest.MonkeyPatch) -> Calls:
    counted = Calls()
    step, guard = Height.step, Contacts._guard

    def counting_step(self: Height, dt: float) -> None:
        counted.steps += is_own_thread()
        step(self, dt)

    def counting_guard(self: Contacts, handle: Callable[[pymunk.Arbiter], None]) -> Handler:
        inner = guard(self, handle)

        def counting(arbiter: pymunk.Arbiter, space: pymunk.Space, data: Any) -> None:
            counted.handlers += is_own_thread()
            inner(arbiter, space, data)

        return counting

    monkeypatch.setattr(Height, "step", counting_step)
    monkeypatch.setattr(Contacts, "_guard", counting_guard)
    return counted


def pile() -> tuple[World, Body]:
    """A robot in front of a wall of boxes."""
    world = World()
    for i in range(16):
        world.add_body(f"box {i}", BoxShape(), position=(2 + i % 4 * 1.01, i // 4 * 1.01))
    world.add_body("wall", BoxShape(size=(1, 9)), kind="static", position=(8, 2))
    return world, world.add_body("robot", CircleShape(), position=(0, 1.6), mass=5.0)


def push(world: World, robot: Body, ticks: int = 120) -> None:
    for _ in range(ticks):
        robot.set_velocity(3.0, 0.0)
        world.tick()


def test_a_pile_of_boxes_calls_nothing(calls: Calls) -> None:
    world, robot = pile()
    push(world, robot)
    assert world["box 5"].position[0] > 3.5, "there was something to collide with"
    assert (calls.steps, calls.handlers) == (0, 0)
    world.reset()
    push(world, robot)
    assert (calls.steps, calls.handlers) == (0, 0)


def test_a_watched_body_pays_for_begin_and_separate_only(calls: Calls) -> None:
    world = World()
    robot = world.add_body("robot", CircleShape())
    ball = world.add_body("ball", CircleShape(), position=(2, 0))
    world.contacts.watch(robot)
    push(world, robot)
    assert ball.position[0] > 3.0
    assert calls.handlers == 1, "they met once, and stayed together"
    robot.move_to(-5, 0)
    world.tick()
    assert (calls.steps, calls.handlers) == (0, 2)


def test_after_a_jump_it_is_as_before(calls: Calls) -> None:
    world, robot = pile()
    robot.set_velocity(3.0, 0.0)
    robot.jump(3.0)
    while not robot.on_ground:
        world.tick()
    assert calls.steps > 30
    assert calls.handlers > 0, "it came down against the boxes"
    robot.set_velocity(0.0, 0.0)
    world.tick()
    calls.steps = calls.handlers = 0
    push(world, robot)
    assert (calls.steps, calls.handlers) == (0, 0)


def test_no_callbacks_after_a_body_returns_to_the_ground(calls: Calls) -> None:
    world, robot = pile()
    robot.move_to(-5, 0, z=3.0)
    world.tick()
    assert calls.steps == 1
    robot.move_to(-5, 0)
    world.tick()
    assert calls.steps == 1


def test_no_callbacks_once_a_landed_body_collides(calls: Calls) -> None:
    world = World(damping=1.0)
    world.add_body("low", CircleShape(), height=0.02, position=(3.4, 0))
    robot = world.add_body("robot", CircleShape())
    robot.set_velocity(3.0, 0.0)
    robot.jump(4.55)
    while not robot.on_ground:
        world.tick()
    assert world.contacts.passes(robot)
    world.tick()
    calls.steps = calls.handlers = 0
    for _ in range(60):
        world.tick()
    assert (calls.steps, calls.handlers) == (0, 0)

"""Motion through pymunk's cffi layer gives the same bits as through its public API."""

import math
import random
from typing import Any

import pymunk

from ai4u_edu.world.native import chipmunk as _chipmunk
from ai4u_edu.world.native.chipmunk import MOTION, PUBLIC_MOTION, Motion, step_function


def make_space() -> tuple[pymunk.Space, list[pymunk.Body]]:
    """Boxes of odd shapes in a ring, some of which touch."""
    rng = random.Random(3)
    space = pymunk.Space()
    space.damping = 0.3
    bodies = []
    for i in range(12):
        body = pymunk.Body()
        body.position = 1.2 * math.cos(i), 1.2 * math.sin(i)
        body.angle = rng.uniform(-9, 9)
        corners = [(rng.uniform(0.1, 0.5), rng.uniform(-0.5, 0.5)) for _ in range(3)]
        shape = pymunk.Poly(body, [(-0.3, 0.1), *corners])
        shape.mass, shape.friction = 1 + i / 7, 0.5
        space.add(body, shape)
        bodies.append(body)
    return space, bodies


def drive(way: Motion, tick: Any, bodies: list[pymunk.Body]) -> list[tuple[float, ...]]:
    rng = random.Random(5)
    handles, vector, where = [way.handle(body) for body in bodies], way.vector(), way.vector()
    seen: list[tuple[float, ...]] = []
    for _ in range(120):
        for i, handle in enumerate(handles):
            vector.x, vector.y = rng.uniform(-9, 9), rng.uniform(-9, 9)
            if i % 3 == 0:
                way.apply_force(handle, vector, where)
            elif i % 3 == 1:
                way.set_velocity(handle, vector)
            else:
                way.set_angular_velocity(handle, vector.x)
        tick()
        for handle in handles:
            place = way.position(handle)
            seen.append((place.x, place.y, way.angle(handle)))
    return seen


def test_the_quick_way_is_there_and_gives_exactly_what_the_public_one_gives() -> None:
    assert MOTION is not PUBLIC_MOTION, "with another pymunk it is; here we want to know"
    space, bodies = make_space()
    expected = drive(PUBLIC_MOTION, lambda: space.step(1 / 60), bodies)
    space, bodies = make_space()
    assert drive(MOTION, step_function(space, 1 / 60), bodies) == expected
    assert len(set(expected)) == len(expected)


def test_without_it_ticks_go_the_public_way(monkeypatch: Any) -> None:
    monkeypatch.setattr(_chipmunk, "IS_NATIVE", False)
    space, bodies = make_space()
    slow = drive(PUBLIC_MOTION, step_function(space, 1 / 60), bodies)
    monkeypatch.undo()
    space, bodies = make_space()
    assert drive(MOTION, step_function(space, 1 / 60), bodies) == slow

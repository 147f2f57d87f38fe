"""Motion through pymunk's cffi layer gives the same bits as through its public API."""

import math
import random
from typing import Any

import pymunk

from ai4u_edu.world.native import chipmunk as _chipmunk
from ai4u_edu.world.native.chipmunk import (
    apply_force,
    motion_of,
    public_motion,
    step_function,
)


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


def drive(motion_of: Any, tick: Any, bodies: list[pymunk.Body]) -> list[Any]:
    rng = random.Random(5)
    motions = [motion_of(body) for body in bodies]
    seen: list[Any] = []
    for _ in range(120):
        for i, motion in enumerate(motions):
            x, y = rng.uniform(-9, 9), rng.uniform(-9, 9)
            if i % 3 == 0:
                apply_force(bodies[i], x, y)
            elif i % 3 == 1:
                motion.velocity.x, motion.velocity.y = x, y
            else:
                motion.spin[0] = x
        tick()
        for centre, angle, velocity, spin in motions:
            seen.append((centre.x, centre.y, angle[0], velocity.x, velocity.y, spin[0]))
    return seen


def test_the_quick_way_is_there_and_gives_exactly_what_the_public_one_gives(
    monkeypatch: Any,
) -> None:
    assert _chipmunk.IS_NATIVE, "with another pymunk it is not; here we want to know"
    assert motion_of is not public_motion
    space, bodies = make_space()
    with monkeypatch.context() as patch:
        patch.setattr(_chipmunk, "IS_NATIVE", False)
        expected = drive(public_motion, lambda: space.step(1 / 60), bodies)
    space, bodies = make_space()
    assert drive(motion_of, step_function(space, 1 / 60), bodies) == expected
    assert len(set(expected)) == len(expected)


def test_without_it_ticks_go_the_public_way(monkeypatch: Any) -> None:
    monkeypatch.setattr(_chipmunk, "IS_NATIVE", False)
    space, bodies = make_space()
    slow = drive(public_motion, step_function(space, 1 / 60), bodies)
    monkeypatch.undo()
    space, bodies = make_space()
    assert drive(motion_of, step_function(space, 1 / 60), bodies) == slow

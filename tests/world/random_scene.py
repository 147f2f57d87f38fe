"""A scene with random places, and what tests compare of it."""

import hashlib
import math
from typing import Any

from ai4u_edu.world import (
    Body,
    BoxShape,
    CircleShape,
    World,
)
from tests.world.samples import SHAPES

SEEDS = range(30)


def crowded(seed: int = 0) -> World:
    """A plate on which a robot, obstacles and a goal are somewhere else in each episode."""
    world = World(seed=seed)
    world.add_floor("plate", BoxShape(size=(10, 10)))
    world.add_floor("island", CircleShape(radius=2), position=(20, 0), random={"y": (-5, 5)})
    world.add_area(
        "goal",
        CircleShape(radius=0.5),
        random={"places": [(-4, -4), (4, 4)], "scale": (0.5, 2), "clearance": 1},
    )
    everywhere = {"x": (-5, 5), "y": (-5, 5)}
    world.add_body("robot", CircleShape(radius=0.4), random=everywhere)
    for index, shape in enumerate(SHAPES):
        vary = {**everywhere, "heading_deg": (-180, 180), "scale": (0.6, 1.4), "clearance": 0.2}
        world.add_body(f"obstacle {index}", shape, kind="static", random=vary)
    world.add_body("pillar", BoxShape(size=(2, 2)), kind="static", tags=("wall",))
    return world


def state(world: World) -> list[Any]:
    """Everything that can be random, as it is, in full precision."""
    bodies = [(body.pose, body.sampled) for body in world.bodies.values()]
    return [bodies, world.floors, [area.description for area in world.areas.values()]]


def digest(seed: int) -> str:
    world = crowded()
    for _ in range(3):
        world.reset(seed)
    for _ in range(60):
        world["robot"].apply_force(20, 0)
        world.tick()
    return hashlib.sha256(repr(state(world)).encode()).hexdigest()


def outline(body: Body) -> list[tuple[float, float]]:
    (x, y), cos, sin = body.position, math.cos(body.heading), math.sin(body.heading)
    return [(x + cos * a - sin * b, y + sin * a + cos * b) for a, b in body.sampled.shape.outline()]


def gap(one: Body, other: Body) -> float:
    """About how far two bodies are from each other: negative if they overlap."""

    def inside(points: list[tuple[float, float]], owner: Body) -> bool:
        return any(owner.sampled.shape.contains(*owner.to_local(*point)) for point in points)

    first, second = outline(one), outline(other)
    if inside(first, other) or inside(second, one):
        return -1.0
    return min(
        _distance(point, a, b)
        for points, ends in ((first, second), (second, first))
        for point in points
        for a, b in zip(ends, [*ends[1:], ends[0]], strict=True)
    )


def _distance(p: tuple[float, float], a: tuple[float, float], b: tuple[float, float]) -> float:
    (px, py), (ax, ay), (bx, by) = p, a, b
    dx, dy = bx - ax, by - ay
    t = max(0.0, min(1.0, ((px - ax) * dx + (py - ay) * dy) / max(dx * dx + dy * dy, 1e-18)))
    return math.hypot(px - ax - t * dx, py - ay - t * dy)

"""Random worlds and eyes, for tests that compare two implementations of rays."""

import math
import random
from typing import Any

from ai4u_edu.base.errors import WorldError
from ai4u_edu.world import (
    Body,
    BoxShape,
    CapsuleShape,
    CircleShape,
    PolygonShape,
    RingShape,
    SegmentShape,
    World,
)
from ai4u_edu.world.shapes import BodyShape, RegionShape

SIDE = 5.0
TOPS = (-1.0, 0.0, 0.0, 0.4, 1.0, 2.5)


def make_world(rng: random.Random, *, sticks: bool) -> World:
    """Up to 20 bodies of all shapes and kinds at all heights, with and without floors."""
    world = World()
    flat = rng.random() < 0.3
    for i in range(0 if flat else rng.choice((0, 1, 3, 6))):
        world.add_floor(
            f"floor {i}",
            _region_shape(rng),
            position=_place(rng),
            heading_deg=rng.choice((0.0, rng.uniform(-180, 180))),
            top=rng.choice(TOPS),
            tags=(f"n{100 + i}",),
        )
    world.add_body("eye", CircleShape(radius=0.3), height=0.8, tags=("n1",))
    for i in range(2, rng.randint(4, 22)):
        z: dict[str, Any] = {}
        if not flat and rng.random() < 0.5:
            z = {"z": rng.uniform(-0.5, 1.5)}
        # what moves must not overlap; where it would, the world has one body fewer
        try:
            world.add_body(
                f"body {i}",
                _body_shape(rng, sticks),
                kind=rng.choice(("static", "static", "kinematic", "dynamic")),
                position=_place(rng),
                heading_deg=rng.uniform(-180, 180),
                height=1.0 if flat and rng.random() < 0.5 else rng.uniform(0.2, 3.0),
                collision_layer=rng.choice((1, 2)),
                tags=(f"n{i}",),
                **z,
            )
        except WorldError:
            continue
    return world


def shuffle(world: World, rng: random.Random) -> None:
    """Puts the eye, and now and then something else, somewhere else."""
    bodies: list[Body] = [world["eye"]]
    if rng.random() < 0.1:
        bodies.append(rng.choice(list(world.bodies.values())))
    for body in bodies:
        x, y = _place(rng)
        on_floor = rng.random() < 0.7
        z = None if on_floor else rng.uniform(-1.0, 2.5)
        body.move_to(x, y, heading=rng.uniform(-4, 4), z=z)


def _place(rng: random.Random) -> tuple[float, float]:
    return rng.uniform(-SIDE, SIDE), rng.uniform(-SIDE, SIDE)


def _body_shape(rng: random.Random, sticks: bool) -> BodyShape:
    def length() -> float:
        return rng.uniform(0.2, 2.5)

    shapes: list[BodyShape] = [
        CircleShape(radius=length() / 2),
        BoxShape(size=(length(), length())),
        _polygon(rng),
    ]
    if sticks:
        shapes += [
            CapsuleShape(length=length(), radius=length() / 3),
            SegmentShape(a=(-length(), length()), b=(length(), length()), thickness=length() / 3),
        ]
    return rng.choice(shapes)


def _region_shape(rng: random.Random) -> RegionShape:
    def length() -> float:
        return rng.uniform(3.0, 12.0)

    return rng.choice(
        (
            CircleShape(radius=length()),
            BoxShape(size=(length(), length())),
            _polygon(rng, 6.0),
            CapsuleShape(length=length(), radius=length() / 2),
            RingShape(inner=1.0, outer=1.0 + length()),
        )
    )


def _polygon(rng: random.Random, scale: float = 1.0) -> PolygonShape:
    """Corners on an ellipse, so they are convex and counter-clockwise."""
    turn = rng.uniform(0, 6)
    count = rng.randint(3, 7)
    angles = [2 * math.pi * (i + rng.uniform(0, 0.8)) / count for i in range(count)]
    wide, long = scale * rng.uniform(0.3, 1.5), scale * rng.uniform(0.3, 1.5)
    return PolygonShape(
        vertices=tuple((wide * math.cos(a + turn), long * math.sin(a + turn)) for a in angles)
    )

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


def make_world(chance: random.Random, *, sticks: bool) -> World:
    """Up to 20 bodies of all shapes and kinds at all heights, with and without floors."""
    world = World()
    flat = chance.random() < 0.3
    for i in range(0 if flat else chance.choice((0, 1, 3, 6))):
        world.add_floor(
            f"floor {i}",
            _region_shape(chance),
            position=_place(chance),
            heading_deg=chance.choice((0.0, chance.uniform(-180, 180))),
            top=chance.choice(TOPS),
            tags=(f"n{100 + i}",),
        )
    world.add_body("eye", CircleShape(radius=0.3), height=0.8, tags=("n1",))
    for i in range(2, chance.randint(4, 22)):
        z: dict[str, Any] = {}
        if not flat and chance.random() < 0.5:
            z = {"z": chance.uniform(-0.5, 1.5)}
        # what moves must not overlap; where it would, the world has one body fewer
        try:
            world.add_body(
                f"body {i}",
                _body_shape(chance, sticks),
                kind=chance.choice(("static", "static", "kinematic", "dynamic")),
                position=_place(chance),
                heading_deg=chance.uniform(-180, 180),
                height=1.0 if flat and chance.random() < 0.5 else chance.uniform(0.2, 3.0),
                collision_layer=chance.choice((1, 2)),
                tags=(f"n{i}",),
                **z,
            )
        except WorldError:
            continue
    return world


def shuffle(world: World, chance: random.Random) -> None:
    """Puts the eye, and now and then something else, somewhere else."""
    bodies: list[Body] = [world["eye"]]
    if chance.random() < 0.1:
        bodies.append(chance.choice(list(world.bodies.values())))
    for body in bodies:
        x, y = _place(chance)
        on_floor = chance.random() < 0.7
        z = None if on_floor else chance.uniform(-1.0, 2.5)
        body.move_to(x, y, heading=chance.uniform(-4, 4), z=z)


def _place(chance: random.Random) -> tuple[float, float]:
    return chance.uniform(-SIDE, SIDE), chance.uniform(-SIDE, SIDE)


def _body_shape(chance: random.Random, sticks: bool) -> BodyShape:
    def length() -> float:
        return chance.uniform(0.2, 2.5)

    shapes: list[BodyShape] = [
        CircleShape(radius=length() / 2),
        BoxShape(size=(length(), length())),
        _polygon(chance),
    ]
    if sticks:
        shapes += [
            CapsuleShape(length=length(), radius=length() / 3),
            SegmentShape(a=(-length(), length()), b=(length(), length()), thickness=length() / 3),
        ]
    return chance.choice(shapes)


def _region_shape(chance: random.Random) -> RegionShape:
    def length() -> float:
        return chance.uniform(3.0, 12.0)

    return chance.choice(
        (
            CircleShape(radius=length()),
            BoxShape(size=(length(), length())),
            _polygon(chance, 6.0),
            CapsuleShape(length=length(), radius=length() / 2),
            RingShape(inner=1.0, outer=1.0 + length()),
        )
    )


def _polygon(chance: random.Random, scale: float = 1.0) -> PolygonShape:
    """Corners on an ellipse, so they are convex and counter-clockwise."""
    turn = chance.uniform(0, 6)
    count = chance.randint(3, 7)
    angles = [2 * math.pi * (i + chance.uniform(0, 0.8)) / count for i in range(count)]
    wide, long = scale * chance.uniform(0.3, 1.5), scale * chance.uniform(0.3, 1.5)
    return PolygonShape(
        vertices=tuple((wide * math.cos(a + turn), long * math.sin(a + turn)) for a in angles)
    )

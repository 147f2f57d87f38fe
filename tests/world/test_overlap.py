"""Overlaps of bodies: the same result whichever of the two can move."""

import math
import random
from typing import Any

import pymunk
import pytest

from ai4u_edu import BoxShape, CapsuleShape, CircleShape, World
from ai4u_edu.base.errors import WorldError
from ai4u_edu.world import BodyDescription, PolygonShape, SegmentShape
from tests.benchmarks.many_walls import query
from tests.processes import is_own_thread

SHAPES: list[Any] = [
    CircleShape(radius=0.6),
    BoxShape(size=(1.5, 0.3)),
    CapsuleShape(length=1.0, radius=0.2),
    PolygonShape(vertices=((0.2, 0), (1, 0.5), (0, 1))),
    SegmentShape(a=(0.3, 0), b=(2, 1), thickness=0.1),
]


@pytest.mark.parametrize("seed", range(8))
def test_a_wall_finds_what_the_physics_finds(seed: int) -> None:
    rng = random.Random(seed)
    layers = [(1, 0xFFFFFFFF), (2, 0xFFFFFFFF), (1, 2), (4, 1)]

    def body(name: str, kind: Any) -> BodyDescription:
        layer, mask = rng.choice(layers)
        return BodyDescription(
            name=name,
            kind=kind,
            shape=rng.choice(SHAPES),
            position=(rng.uniform(-2, 2), rng.uniform(-2, 2)),
            heading_deg=rng.uniform(-180, 180),
            z=rng.choice([0.0, 0.5, 1.0, 2.0]),
            collision_layer=layer,
            collision_mask=mask,
        )

    found = []
    for _ in range(20):
        world = World()
        world.add(body("mover", "dynamic"))
        wall = body("wall", rng.choice(["static", "kinematic"]))
        try:
            world.add(wall)
            found.append(False)
            assert query(world, world["wall"]) is None
        except WorldError:
            found.append(True)
            other = World()
            other.add(wall)
            with pytest.raises(WorldError, match="overlaps body 'wall'"):
                other.add(world["mover"].description)
    assert len(found) == 20


def test_walls_on_one_spot_are_not_compared_with_each_other(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    asked: list[Any] = []
    ask = pymunk.Space.shape_query

    def counted(space: pymunk.Space, shape: pymunk.Shape) -> Any:
        asked.extend([shape] * is_own_thread())
        return ask(space, shape)

    monkeypatch.setattr(pymunk.Space, "shape_query", counted)
    world = World()
    world.add_body("robot", CircleShape(radius=0.5), position=(5, 5))
    for number in range(100):
        world.add_body(f"wall {number}", BoxShape(), kind="static")
    assert len(asked) == 1
    with pytest.raises(WorldError, match="overlaps body 'robot'"):
        world.add_body("wall", BoxShape(), kind="static", position=(5, 5.5))
    with pytest.raises(WorldError, match="overlaps body 'wall"):
        world.add_body("box", BoxShape(), position=(math.tau / 10, 0))

"""The comparison of rectangles around forms never misses an overlap."""

import random
from typing import Any

import pymunk
import pytest

from ai4u_edu.world import AreaDescription, BodyDescription, RingShape
from ai4u_edu.world.native import chipmunk as _chipmunk
from ai4u_edu.world.native.chipmunk import contact_distances
from ai4u_edu.world.placement import Places
from tests.world.random_worlds import SIDE, _body_shape, _region_shape


def test_overlapping_shapes_are_near() -> None:
    rng, places = random.Random(3), Places(1)
    met = apart = 0
    for _ in range(3000):
        one, other = (places._form(_thing(rng)).grown(rng.choice((0.0, 0.3))) for _ in "12")
        space = pymunk.Space()
        space.add(*one.solid)
        if space.shape_query(other.solid[1]):
            met += 1
            assert one.near(other)
            assert other.near(one)
        apart += not one.near(other)
    assert met > 300
    assert apart > 1000, "and most of what is apart is told apart"


def test_touching_agrees_with_pymunks_shape_query(monkeypatch: pytest.MonkeyPatch) -> None:
    rng, places = random.Random(4), Places(1)
    pairs = [
        (
            places._form(_thing(rng)).grown(rng.choice((0.0, 0.3))),
            places._form(_thing(rng)),
        )
        for _ in range(3000)
    ]

    def found() -> list[list[float]]:
        return [
            contact_distances(one.solid[1], other.solid[1], other.solid[0])
            for pair in pairs
            for one, other in (pair, pair[::-1])
        ]

    quick = found()
    monkeypatch.setattr(_chipmunk, "IS_NATIVE", False)
    assert quick == found()
    assert sum(bool(each) for each in quick) > 600


def test_noncolliding_bodies_do_not_overlap() -> None:
    places = Places(1)

    def overlap(**fields: Any) -> bool:
        shape = _body_shape(random.Random(1), True)
        one = BodyDescription(name="one", shape=shape, **fields)
        other = BodyDescription(name="other", shape=shape, position=(0.01, 0))
        return places._form(one).overlaps(places._form(other))

    assert overlap()
    assert not overlap(collision_mask=2)
    assert overlap(collision_layer=2)
    assert not overlap(position=(50, 0))


def test_one_above_the_other_is_not_near() -> None:
    places = Places(1)
    shape = _body_shape(random.Random(1), True)
    low, high, higher = (
        places._form(BodyDescription(name="x", shape=shape, z=z)) for z in (0.0, 0.9, 1.0)
    )
    assert low.near(high)
    assert not low.near(higher)


def test_in_a_ring_is_near() -> None:
    places = Places(1)
    ring = places._form(AreaDescription(name="r", shape=RingShape(inner=3, outer=4)))
    inside = places._form(BodyDescription(name="x", shape=_body_shape(random.Random(1), True)))
    assert ring.near(inside)


def _thing(rng: random.Random) -> BodyDescription | AreaDescription:
    place = rng.uniform(-SIDE, SIDE), rng.uniform(-SIDE, SIDE)
    heading = rng.choice((0.0, rng.uniform(-180, 180)))
    if rng.random() < 0.1:
        shape = _region_shape(rng)
        return AreaDescription(name="x", shape=shape, position=place, heading_deg=heading)
    body = _body_shape(rng, True)
    return BodyDescription(name="x", shape=body, position=place, heading_deg=heading)

"""Three implementations of segments give the same bits: compiled, cffi, public."""

import random
from typing import Any

import numpy as np
import pymunk
import pytest

from ai4u_edu import Scene
from ai4u_edu.world import RayFan, RayGrid, rays
from ai4u_edu.world.native import segments as _segments
from ai4u_edu.world.native.chipmunk import shape_key
from ai4u_edu.world.native.segments import CffiSegments, CompiledSegments, Segments
from tests.processes import is_own_thread
from tests.world.random_worlds import SIDE, make_world, shuffle

needs_compiler = pytest.mark.skipif(
    _segments.compiled_cast() is None, reason="nothing is compiled here"
)
WAYS = [
    pytest.param(CompiledSegments, marks=needs_compiler),
    CffiSegments,
]


@pytest.mark.parametrize("way", WAYS)
def test_a_faster_way_gives_exactly_what_the_public_one_gives(way: type[Segments]) -> None:
    rng = random.Random(5)
    met = 0
    for _ in range(40):
        world = make_world(rng, sticks=True)
        quick, public = way(20), Segments(20)
        for _ in range(25):
            shuffle(world, rng)
            x, y = rng.uniform(-SIDE, SIDE), rng.uniform(-SIDE, SIDE)
            accept = world.filter_for(world["eye"], rng.choice((0xFFFFFFFF, 1, 2)))
            reach = rng.choice((0.5, 3.0, 8.0, 30.0))
            turned = np.random.default_rng(rng.randrange(1000)).uniform(-4, 4, 20)
            public.directions[:] = quick.directions[:] = np.array(
                [np.cos(turned), np.sin(turned)]
            ).T
            for each in (quick, public):
                each.cast(world.space, x, y, reach, accept)
            assert quick.alpha.tobytes() == public.alpha.tobytes()
            assert quick.distances.tobytes() == public.distances.tobytes()
            assert quick.shapes() == public.shapes()
            assert set(public.shapes()) <= {0, *map(shape_key, world.owners)}
            met += sum(map(bool, public.shapes()))
    assert met > 5000, "of 20,000"


@pytest.mark.parametrize("way", WAYS)
def test_sensors_read_the_same_in_every_scene(
    way: type[Segments], monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in Scene.names():
        told = []
        for each in (way, Segments):
            monkeypatch.setattr(rays, "make_segments", each)
            told.append(_told(name))
        assert told[0] == told[1], name


def _told(name: str) -> list[bytes]:
    """All that the agents of a scene sense, where nobody drives them and they are pushed about."""
    rng, sim = random.Random(name), Scene.load(name).build(seed=3)
    sim.reset(seed=3)
    told = []
    for _ in range(25):
        for agent in sim.agents:
            if not agent.body.fallen and agent.body.moves:
                agent.body.set_velocity(rng.uniform(-4, 4), rng.uniform(-4, 4))
                agent.body.set_angular_velocity(rng.uniform(-4, 4))
        sim.tick()
        told += [agent.sense().data for agent in sim.agents]
    return told


@needs_compiler
def test_fans_and_grids_see_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    rng, every, asked = random.Random(8), pymunk.Space.segment_query, [0]

    def counting(*args: Any) -> Any:
        asked[0] += is_own_thread()
        return every(*args)

    monkeypatch.setattr(pymunk.Space, "segment_query", counting)
    for _ in range(20):
        world = make_world(rng, sticks=True)
        eye = (0.0, 0.0, rng.uniform(0.1, 1.0))
        angles = [rng.uniform(-4, 4) for _ in range(9)]
        pairs: list[list[Any]] = []
        for way in (CompiledSegments, CffiSegments):
            monkeypatch.setattr(rays, "make_segments", way)
            fan = RayFan(world, angles, 9.0, _code_of, eye=eye)
            pairs.append([fan, RayGrid(world, angles, [0.2, 0.0, -0.3], 9.0, _code_of, eye=eye)])
        for _ in range(20):
            shuffle(world, rng)
            for compiled, quick in zip(*pairs, strict=True):
                times = []
                for caster in (compiled, quick):
                    asked[0] = 0
                    caster.cast(world["eye"])
                    times.append(asked[0])
                # of a grid, what is behind is asked for in C
                assert times[0] == (0 if isinstance(compiled, RayGrid) else times[1])
                assert compiled.codes.tobytes() == quick.codes.tobytes()
                assert compiled.distances.tobytes() == quick.distances.tobytes()


def _code_of(tags: Any) -> float:
    return float(sum(map(len, tags)))


def test_the_quick_way_is_there() -> None:
    """With an unknown pymunk everything works more slowly; the tests must notice."""
    assert isinstance(_segments.make_segments(1), CffiSegments)


def test_the_fastest_way_is_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    if _segments.compiled_cast() is not None:
        assert type(_segments.make_segments(1)) is CompiledSegments
    monkeypatch.setattr(_segments, "compiled_cast", lambda: None)
    assert type(_segments.make_segments(1)) is CffiSegments
    monkeypatch.setattr(_segments, "IS_NATIVE", False)
    assert type(_segments.make_segments(1)) is Segments


@pytest.mark.parametrize(
    "changed",
    [
        {"cpVect": (16, {"y": 0, "x": 8})},
        {"cpVect": (8, {"x": 0, "y": 8})},
        {"cpVect": (16, {"x": 0, "y": 8, "z": 8})},
    ],
)
def test_nothing_compiled_is_used_with_another_pymunk(
    changed: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    assert _segments._is_known()
    monkeypatch.setattr(_segments, "_LAYOUT", changed)
    assert _segments.compiled_cast.__wrapped__() is None


def test_nothing_compiled_is_used_with_another_query(monkeypatch: pytest.MonkeyPatch) -> None:
    name = "cpShapeSegmentQuery"
    form = _segments._QUERIES[name].replace("double", "float")
    monkeypatch.setitem(_segments._QUERIES, name, form)
    assert _segments.compiled_cast.__wrapped__() is None

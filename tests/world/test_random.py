"""Random values of a scene: sampled at each reset, from the seed alone, on free floor."""

import gc
import hashlib
import math
import subprocess
import sys
import weakref
from itertools import combinations
from typing import Any

import pytest

from ai4u_edu.base.errors import ParameterError, WorldError
from ai4u_edu.world import (
    AreaDescription,
    Body,
    BodyDescription,
    BoxShape,
    CircleShape,
    FloorDescription,
    PolygonShape,
    RayFan,
    RingShape,
    SegmentShape,
    Variation,
    World,
    WorldView,
)
from ai4u_edu.world.placement import Places
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


def test_each_episode_is_another_one_and_stays_in_its_ranges() -> None:
    world = crowded()
    seen = []
    for seed in SEEDS:
        world.reset(seed)
        seen.append(repr(state(world)))
        robot, first = world["robot"], world["obstacle 0"]
        assert robot.position != world["robot"].description.position
        assert max(map(abs, robot.position)) <= 5
        assert isinstance(first.sampled.shape, CircleShape)
        assert 0.6 * 0.4 <= first.sampled.shape.radius <= 1.4 * 0.4
        assert math.degrees(first.heading) == pytest.approx(first.sampled.heading_deg)
        assert world["pillar"].position == (0.0, 0.0)
        goal = world.areas["goal"]
        assert (goal.x, goal.y) in {(-4, -4), (4, 4)}
        assert world.floors[1].position[0] == 20
    assert len(set(seen)) == len(SEEDS)


def test_ranges_and_places_are_drawn_whole() -> None:
    world = World()
    places = [(index, 2) for index in range(4)]
    world.add_body("x", CircleShape(), position=(9, -3), random={"x": (-2, 6)})
    world.add_body("p", CircleShape(), random={"places": places, "heading_deg": (0, 90)})
    found, xs, turns = set(), [], []
    for seed in range(200):
        world.reset(seed)
        assert world["x"].position[1] == -3, "what is not random is as described"
        found.add(world["p"].position)
        xs.append(world["x"].position[0])
        turns.append(math.degrees(world["p"].heading))
    assert found == set(places)
    assert -2 <= min(xs) < -1.7
    assert 5.7 < max(xs) <= 6
    assert 0 <= min(turns) < 5
    assert 85 < max(turns) <= 90


def test_what_is_described_is_kept_and_what_is_drawn_holds() -> None:
    world = World()
    vary = {"x": (2, 3), "heading_deg": (90, 90), "scale": (2, 2)}
    box = world.add_body("box", BoxShape(size=(1, 2)), position=(0, 1), random=vary)
    assert box.description.position == (0.0, 1.0)
    assert box.description.shape == BoxShape(size=(1, 2))
    assert box.sampled.shape == BoxShape(size=(2, 4))
    assert box.sampled.random is None
    assert box.position == box.sampled.position
    assert 2 <= box.position[0] <= 3
    fan = RayFan(world, [0.0], 20, lambda tags: 1.0, exclude_self=False)
    eye = world.add_body("eye", CircleShape(radius=0.1), position=(-5, 1), collision_layer=2)
    for seed in range(5):
        world.reset(seed)
        fan._mask = 1
        fan.cast(eye)
        near = fan.distances[0]
        assert near == pytest.approx(box.position[0] + 5 - 2), "turned, its half length is ahead"


@pytest.mark.parametrize(
    ("shape", "twice"),
    [
        (CircleShape(radius=1), CircleShape(radius=2)),
        (BoxShape(size=(1, 2)), BoxShape(size=(2, 4))),
        (
            PolygonShape(vertices=((1, 0), (0, 1), (-1, 0))),
            PolygonShape(vertices=((2, 0), (0, 2), (-2, 0))),
        ),
        (
            SegmentShape(a=(0, 1), b=(2, 3), thickness=0.5),
            SegmentShape(a=(0, 2), b=(4, 6), thickness=1),
        ),
        (RingShape(inner=1, outer=2), RingShape(inner=2, outer=4)),
    ],
)
def test_all_lengths_of_a_shape_are_scaled(shape: Any, twice: Any) -> None:
    assert shape.scaled(2.0) == twice
    assert shape.scaled(1.0) is shape


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


def test_nothing_overlaps_and_what_is_to_be_free_around_it_is_free() -> None:
    world = crowded()
    for seed in SEEDS:
        world.reset(seed)
        goal = world.areas["goal"]
        radius = goal.description.shape.reach
        for body in world.bodies.values():
            nearest = min(math.hypot(x - goal.x, y - goal.y) for x, y in outline(body))
            assert nearest - radius >= 1 - 0.01, (seed, body)
        for one, other in combinations(world.bodies.values(), 2):
            # both directions: also of one that is put after the one that has the clearance
            apart = 0.2 if "obstacle" in one.name + other.name else 0.0
            assert gap(one, other) >= apart - 0.01, (seed, one, other)


def test_without_a_clearance_bodies_may_be_put_side_by_side() -> None:
    def nearest(clearance: float) -> float:
        world = World()
        world.add_body("wall", BoxShape(), kind="static")
        vary = {"x": (-1.6, 1.6), "y": (-0.2, 0.2), "clearance": clearance}
        ball = world.add_body("ball", CircleShape(radius=0.3), random=vary)
        found = []
        for seed in range(60):
            world.reset(seed)
            found.append(abs(ball.position[0]) - 0.5 - 0.3)
        return min(found)

    assert -0.002 < nearest(0) < 0.05
    assert 0.4 - 0.002 < nearest(0.4) < 0.45


def test_everything_stands_wholly_on_floor() -> None:
    world = World()
    world.add_floor("plate", BoxShape(size=(6, 6)))
    world.add_floor("step", BoxShape(size=(2, 2)), top=0.5)
    vary = {"x": (-5, 5), "y": (-5, 5), "heading_deg": (0, 360)}
    box = world.add_body("box", BoxShape(size=(1.8, 0.4)), random=vary)
    heights = set()
    for seed in range(100):
        world.reset(seed)
        heights.add(box.z)
        assert all(world.ground(x, y) == box.z for x, y in outline(box)) or box.z == 0.0
        assert all(world.ground(x, y) is not None for x, y in outline(box))
        assert box.on_ground
    assert heights == {0.0, 0.5}


def test_a_body_finds_its_floor_where_chance_has_put_that() -> None:
    world = World()
    world.add_floor("raft", BoxShape(size=(2, 2)), top=1.0, random={"x": (-50, 50)})
    vary = {"x": (-50, 50)}
    ball = world.add_body("ball", CircleShape(radius=0.2), random=vary)
    for seed in range(20):
        world.reset(seed)
        (raft,) = world.floors
        assert abs(ball.position[0] - raft.position[0]) <= 0.8
        assert ball.z == 1.0
        assert world.ground(*ball.position) == 1.0
        world.tick()
        assert ball.on_ground


def test_who_passes_over_or_under_is_not_in_the_way() -> None:
    world = World()
    world.add_body("roof", BoxShape(size=(4, 4)), kind="static", z=1.5)
    world.add_body("ghost", BoxShape(size=(4, 4)), kind="static", collision_mask=0)
    ball = world.add_body("ball", CircleShape(), random={"x": (-1, 1)})
    assert abs(ball.position[0]) <= 1


def test_the_same_seed_gives_the_same_world_however_it_came_about() -> None:
    fresh = state(crowded(seed=7))
    world = crowded(seed=2)
    world.tick()
    world.reset(7)
    assert state(world) == fresh, "added one by one, or reset"
    world.rebuild()
    assert state(world) == fresh, "and built again in the same episode"
    world.reset()
    later = state(world)
    assert later != fresh
    other = crowded()
    other.reset(world.seeds.seed)
    assert state(other) == later, "any episode comes back from its own seed"


def test_what_is_drawn_depends_on_nothing_but_seed_and_name() -> None:
    def place(*names: str) -> tuple[float, float]:
        world = World(seed=5)
        for name in names:
            world.add_body(name, CircleShape(radius=0.01), random={"x": (-90, 90), "y": (0, 90)})
        return world["a"].position

    assert place("a") == place("b", "a") == place("a", "c", "d")


def test_in_another_process() -> None:
    code = "from tests.world.test_random import digest; print(digest(11))"
    here = digest(11)
    for hash_seed in ("1", "2"):
        there = subprocess.run(
            [sys.executable, "-c", code],
            env={"PYTHONHASHSEED": hash_seed},
            capture_output=True,
            text=True,
            check=True,
        )
        assert there.stdout.strip() == here
    assert digest(12) != here


def test_what_is_fixed_goes_first_wherever_it_stands_in_the_file() -> None:
    vary = Variation(x=(-1.2, 1.2))
    robot = BodyDescription(name="robot", shape=CircleShape(radius=0.4), random=vary)
    wall = BodyDescription(name="wall", shape=BoxShape(size=(0.5, 9)), kind="static")
    world = World()
    world.add_all([robot, wall])
    one_by_one = World()
    one_by_one.add(robot)
    one_by_one.add(wall)
    for seed in SEEDS:
        world.reset(seed)
        assert abs(world["robot"].position[0]) >= 0.25 + 0.4 - 0.001
        assert list(world.bodies) == ["robot", "wall"]
    one_by_one.reset(SEEDS[-1])
    assert state(one_by_one) == state(world)


def test_bounds_are_the_same_in_each_episode_and_hold_everything() -> None:
    world = crowded()
    bounds = world.bounds()
    assert bounds[1][0] == 22, "as far as the island ever is"
    assert bounds[1][1] == 7
    for seed in SEEDS:
        world.reset(seed)
        assert world.bounds() == bounds
        (left, low), (right, high) = bounds
        for body in world.bodies.values():
            for x, y in outline(body):
                assert left <= x <= right
                assert low <= y <= high


@pytest.mark.parametrize(
    ("vary", "expected"),
    [
        ({"x": (-4, 2)}, ((-5, -1), (3, 3))),
        ({"places": [(7, 0), (0, -7)]}, ((-1, -9), (8, 2))),
        ({"scale": (0.5, 3)}, ((-3, -5), (3, 7))),
        ({"heading_deg": (0, 1)}, ((-5**0.5, 1 - 5**0.5), (5**0.5, 1 + 5**0.5))),
        ({"y": (3, 4), "heading_deg": (0, 1), "scale": (1, 2)},
         ((-2 * 5**0.5, 3 - 2 * 5**0.5), (2 * 5**0.5, 4 + 2 * 5**0.5))),
    ],
)  # fmt: skip
def test_bounds_reach_as_far_as_the_ranges(vary: dict[str, Any], expected: Any) -> None:
    world = World()
    world.add_body("box", BoxShape(size=(2, 4)), position=(0, 1), random=vary)
    for corner, there in zip(world.bounds(), expected, strict=True):
        assert corner == pytest.approx(there)


def test_a_wall_beside_its_own_origin_is_in_the_bounds_at_its_smallest() -> None:
    world = World()
    wall = SegmentShape(a=(2, 0), b=(4, 0), thickness=0.2)
    world.add_body("wall", wall, kind="static", random={"scale": (0.5, 2)})
    assert world.bounds()[0][0] == pytest.approx(0.95, abs=0.01)
    assert world.bounds()[1][0] == pytest.approx(8.2, abs=0.01)


def test_who_asks_for_areas_and_floors_gets_them_as_they_are_now() -> None:
    world = World()
    world.add_floor("raft", BoxShape(size=(2, 2)), random={"x": (-9, 9)})
    world.add_area("goal", CircleShape(radius=0.5), random={"x": (-9, 9)})
    view = WorldView(world)
    seen = []
    for seed in range(5):
        generation = view.generation
        world.reset(seed)
        assert view.generation > generation, "what was learnt of them is old"
        (raft,) = view.floors
        goal = view.areas["goal"]
        seen.append((raft.position[0], goal.x))
        assert goal.contains(goal.x, 0.4)
        assert view.ground(raft.position[0] + 0.9, 0) == 0.0
        assert view.ground(raft.position[0] + 1.1, 0) is None
    assert len(set(seen)) == 5


def test_what_comes_in_the_middle_of_an_episode_finds_a_place_among_the_rest() -> None:
    world = World(damping=1.0)
    mover = world.add_body("mover", CircleShape(), velocity=(3, 0))
    for _ in range(60):
        world.tick()
    assert mover.position[0] == pytest.approx(3.0, abs=0.01)
    before = mover.pose
    vary = {"x": (-1, 4), "clearance": 0.5}
    late = world.add_body("late", CircleShape(), random=vary)
    assert mover.pose == before
    assert abs(late.position[0] - 3.0) >= 1.5 - 0.001
    assert world.ticks == 60
    with pytest.raises(WorldError, match=r"^body 'no': found no free place in 1000 draws"):
        world.add_body("no", CircleShape(), random={"x": (2.9, 3.1)})
    assert list(world.bodies) == ["mover", "late"]
    world.reset(4)
    assert mover.position == (0.0, 0.0)


def test_what_comes_late_or_again_leaves_free_what_is_to_be_free() -> None:
    world = World()
    world.add_area("goal", CircleShape(radius=1), random={"x": (-0.1, 0.1), "clearance": 1})
    world.add_body("first", CircleShape(radius=0.1), random={"x": (-4, 4), "clearance": 1})
    late = {"x": (-4, 4)}
    world.tick()
    for index in range(4):
        world.add_body(f"late {index}", CircleShape(radius=0.1), random=late)
    for _ in range(20):
        for name in ("first", "late 0"):
            before = world[name].position
            world.put_back(name)
            assert world[name].position != before
        x, first = world["late 0"].position[0], world["first"].position[0]
        assert abs(x - world.areas["goal"].x) >= 2.1 - 0.001
        assert abs(x - first) >= 1.2 - 0.001


def test_who_is_put_somewhere_by_others_stays_there() -> None:
    world = crowded()
    world["robot"].move_to(-4.5, 4.5)
    assert world["robot"].position == (-4.5, 4.5)


def test_where_there_is_no_room_that_is_told() -> None:
    world = World()
    world.add_floor("plate", BoxShape(size=(4, 4)))
    world.add_body("wall", BoxShape(size=(3, 4)), kind="static", position=(0.5, 0))
    before = state(world)
    vary = {"x": (-2, 2), "y": (-2, 2), "clearance": 0.25}
    with pytest.raises(WorldError) as caught:
        world.add_body("robot", CircleShape(radius=0.5), random=vary)
    told = str(caught.value)
    assert told.startswith(
        "body 'robot': found no free place in 1000 draws (x -2..2, y -2..2, clearance 0.25; "
        "seed 0); in the way: body 'wall' ("
    )
    assert "the end of the floor (" in told
    assert told.endswith(" times); give it wider ranges or less clearance, or make it smaller")
    assert caught.value.thing == "robot"
    assert state(world) == before
    world.tick()
    world.reset()


def test_a_reset_that_finds_no_room_leaves_all_as_it_is() -> None:
    world = World(seed=2)
    world.add_floor("raft", BoxShape(size=(2, 2)), random={"x": (-3, 3)})
    ball = world.add_body("ball", CircleShape(radius=0.9), random={"x": (-1.5, 1.5)})
    told = []
    for seed in range(20):
        world.tick()
        before = (ball.pose, world.floors, world.ticks)
        try:
            world.reset(seed)
        except WorldError as error:
            told.append(f"seed {seed})" in str(error))
            told.append((ball.pose, world.floors, world.ticks) == before)
    assert 10 <= len(told) < 40, "some failed, some did not"
    assert all(told)


def test_an_area_keeps_only_as_much_free_as_it_says() -> None:
    world = World()
    world.add_body("block", BoxShape(size=(2, 2)), kind="static")
    world.add_area("anywhere", RingShape(inner=0.5, outer=1), random={"x": (-0.1, 0.1)})
    vary = {"x": (-6, 6), "clearance": 0.5}
    world.add_area("clear", RingShape(inner=0.5, outer=1), random=vary)
    for seed in SEEDS:
        world.reset(seed)
        assert abs(world.areas["clear"].x) >= 2.5 - 0.001


@pytest.mark.parametrize(
    ("vary", "told"),
    [
        ({"x": (4, -4)}, "x: expected the smaller number first, got [4.0, -4.0]"),
        ({"x": (0, 1), "places": [(0, 0)]},
         "expected either ranges (x, y) or places, got both; leave one out"),
        ({"clearance": 1}, "nothing is drawn; expected at least one of x, y, places, heading_deg, "
         "scale"),
        ({"places": []}, "places: expected at least 1 entries, got []"),
        ({"scale": (0, 1)}, "scale[0]: expected more than 0, got 0"),
        ({"heading": (0, 1)}, "heading: unknown parameter; did you mean 'heading_deg'?"),
        ({"x": (0, 1), "clearance": -1}, "clearance: expected at least 0, got -1"),
    ],
)  # fmt: skip
def test_what_is_wrong_in_a_variation_is_told(vary: dict[str, Any], told: str) -> None:
    with pytest.raises(ParameterError) as caught:
        Variation(**vary)
    assert str(caught.value) == f"Variation: {told}"


def test_a_floor_has_no_clearance() -> None:
    with pytest.raises(ParameterError, match=r"random: a floor has bodies on it; expected no cl"):
        FloorDescription(name="f", shape=BoxShape(), random=Variation(x=(0, 1), clearance=1))


def test_a_world_without_anything_random_pays_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_args: Any) -> None:
        raise AssertionError("somebody looked for a place")

    world = World()
    monkeypatch.setattr("ai4u_edu.world.construction.randomize", refuse)
    monkeypatch.setattr("ai4u_edu.world.randomize.Places", refuse)
    world.add_floor("plate", BoxShape(size=(9, 9)))
    ball = world.add_body("ball", CircleShape())
    world.reset()
    assert ball.sampled is ball.description


def test_once_the_last_random_thing_is_gone_it_pays_nothing_again(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    world = World()
    world.add_body("ball", CircleShape(), random={"x": (0, 1)})
    world.remove("ball")
    monkeypatch.setattr("ai4u_edu.world.construction.randomize", lambda *_args: 1 / 0)
    world.reset()


@pytest.mark.parametrize(
    "wrong",
    [
        BodyDescription(name="robot"),
        AreaDescription(name="pillar", shape=CircleShape()),
        BodyDescription(name="second pillar", shape=BoxShape()),
        BodyDescription(name="huge", shape=CircleShape(radius=30), random=Variation(x=(0, 1))),
    ],
    ids=lambda thing: thing.name,
)
def test_what_can_not_be_added_changes_nothing(wrong: Any) -> None:
    world = crowded()
    before = state(world)
    with pytest.raises(WorldError):
        world.add_all([BodyDescription(name="fine", position=(50, 50)), wrong])
    assert state(world) == before
    world.reset(3)
    assert state(world) == state(crowded(3))


def test_places_are_freed_as_soon_as_they_are_found(monkeypatch: pytest.MonkeyPatch) -> None:
    kept: list[Any] = []
    inner = Places.occupy

    def note(self: Places, *args: Any) -> None:
        inner(self, *args)
        kept.extend([weakref.ref(self), weakref.ref(self._bodies)])

    monkeypatch.setattr(Places, "occupy", note)
    gc.disable()
    try:
        crowded()
    finally:
        gc.enable()
    assert len(kept) > 5
    assert [each for each in kept if each() is not None] == []

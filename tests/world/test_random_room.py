"""Places for things that come during an episode, and errors where there is no room."""

import gc
import weakref
from typing import Any

import pytest

from ai4u_edu.base.errors import WorldError
from ai4u_edu.world import (
    AreaDescription,
    BodyDescription,
    BoxShape,
    CircleShape,
    RingShape,
    Variation,
    World,
)
from ai4u_edu.world.placement import Places
from tests.processes import is_own_thread
from tests.world.random_scene import SEEDS, crowded, state


def test_body_added_during_an_episode_gets_a_free_place() -> None:
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


def test_late_bodies_respect_the_clearance_of_others() -> None:
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


def test_moved_random_body_keeps_its_place() -> None:
    world = crowded()
    world["robot"].move_to(-4.5, 4.5)
    assert world["robot"].position == (-4.5, 4.5)


def test_missing_room_raises_and_changes_nothing() -> None:
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
    "wrong",
    [
        BodyDescription(name="robot"),
        AreaDescription(name="pillar", shape=CircleShape()),
        BodyDescription(name="second pillar", shape=BoxShape()),
        BodyDescription(name="huge", shape=CircleShape(radius=30), random=Variation(x=(0, 1))),
    ],
    ids=lambda thing: thing.name,
)
def test_failed_addition_changes_nothing(wrong: Any) -> None:
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
        if not is_own_thread():
            return
        kept.extend([weakref.ref(self), weakref.ref(self._bodies)])

    monkeypatch.setattr(Places, "occupy", note)
    gc.disable()
    try:
        crowded()
    finally:
        gc.enable()
    assert len(kept) > 5
    assert [each for each in kept if each() is not None] == []

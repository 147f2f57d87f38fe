"""Floors and areas that come, go and are moved in a running world."""

from typing import Any

import pytest

from ai4u_edu import Scene
from ai4u_edu.page.editing import ChangeError
from tests.page.editing.harness import EditorHarness, trace

HOME = {"name": "home", "shape": {"type": "box", "size": [2, 2]}, "position": [4, 4]}
STEP = {"name": "step", "shape": {"type": "box", "size": [3, 3]}, "position": [9, 9], "top": 0.5}


@pytest.fixture
def harness() -> EditorHarness:
    harness = EditorHarness()
    harness.tick(5)
    return harness


def test_an_area_comes_is_moved_and_goes(harness: EditorHarness) -> None:
    robot = harness.world["robot"].pose
    added = harness.done(harness.editor.add_region(HOME, "areas"))
    assert (added.when, added.label) == ("now", "add home")
    assert harness.world.areas["home"].contains(4, 4)
    shown = harness.runner.latest.static_scene.areas
    assert [area.name for area in shown] == ["home"]

    moved = harness.done(harness.editor.move_body("home", -4, 4, 45))
    assert (moved.when, moved.label) == ("now", "move home")
    assert not harness.world.areas["home"].contains(4, 4)
    assert harness.world.areas["home"].contains(-4, 5.3)  # a corner of the turned square

    assert harness.done(harness.editor.remove_body("home")).when == "now"
    assert dict(harness.world.areas) == {}
    for name in ("remove home", "move home", "add home"):
        assert harness.editor.undo_label == name
        harness.done(harness.editor.undo())
    assert harness.editor.scene == harness.scene
    assert harness.world["robot"].pose == robot
    assert harness.world.ticks == 5


def test_a_floor_is_resized_and_later_episodes_have_it(harness: EditorHarness) -> None:
    harness.done(harness.editor.add_region(STEP, "floors"))
    assert harness.world.ground(9, 9) == 0.5
    done = harness.done(
        harness.editor.change_body("step", {"shape": {"type": "box", "size": [1, 1]}})
    )
    assert done.label == "resize step"
    assert harness.world.ground(9, 9) == 0.5
    assert harness.world.ground(10, 10) is None
    harness.done(harness.runner.reset(seed=3))
    assert harness.world.ground(10, 10) is None
    assert trace(harness.runner.sim, 1) == trace(harness.editor.scene.build(), 1)


def test_what_stood_on_a_floor_that_is_taken_away_falls(harness: EditorHarness) -> None:
    harness.done(harness.editor.add_region(STEP, "floors"))
    harness.done(harness.editor.move_body("box", 9, 9))
    assert harness.world["box"].z == 0.5
    harness.done(harness.editor.move_body("step", 20, 20))
    harness.tick(10)
    assert harness.world["box"].z < 0.5
    harness.done(harness.editor.undo())
    assert harness.world.ground(9, 9) == 0.5


def test_the_first_floor_ends_the_endless_ground() -> None:
    harness = EditorHarness()
    noted = harness.done(harness.editor.remove_body("plate")).note
    assert noted == "without a floor the ground is endless"
    assert harness.world.ground(100, 100) == 0.0
    noted = harness.done(harness.editor.undo()).note
    noted = harness.done(harness.editor.remove_body("plate")).note
    noted = harness.done(harness.editor.add_region({**STEP, "position": [0, 0]}, "floors")).note
    assert noted == "the ground was endless; now there is ground on the floors only"


def test_a_random_area_stays_where_chance_put_it_until_it_is_moved(
    harness: EditorHarness,
) -> None:
    random = {**HOME, "random": {"x": [-3, 3], "y": [-3, 3]}}
    harness.done(harness.editor.add_region(random, "areas"))
    harness.done(harness.runner.reset(seed=5))
    area = harness.world.areas["home"]
    place = area.x, area.y
    assert place != (4, 4)
    harness.done(harness.editor.change_body("home", {"colour": "green"}))
    area = harness.world.areas["home"]
    assert (area.x, area.y, area.description.colour) == (*place, "green")


@pytest.mark.parametrize(
    ("kind", "region", "told"),
    [
        ("areas", {**HOME, "name": "box"}, "name: something is named 'box' already"),
        ("floors", {**STEP, "top": "high"}, "top: expected a number, got 'high'"),
        ("areas", {**HOME, "mass": 1}, "mass: unknown parameter"),
    ],
)
def test_bad_regions(
    harness: EditorHarness, kind: Any, region: dict[str, object], told: str
) -> None:
    with pytest.raises(ChangeError) as error:
        harness.done(harness.editor.add_region(region, kind))
    assert told in str(error.value)
    assert harness.editor.scene == harness.scene


def test_an_area_that_a_block_needs_stays() -> None:
    harness = EditorHarness(Scene.load("parking"))
    harness.tick(3)
    needed = [
        area.name
        for area in harness.scene.description.areas
        if area.name in str(harness.scene.description.agents)
    ]
    assert needed
    with pytest.raises(ChangeError, match=r"no (body or )?area"):
        harness.done(harness.editor.remove_body(needed[0]))
    assert needed[0] in harness.world.areas

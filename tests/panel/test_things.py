"""Forms of things, and things that are added to a world."""

from typing import Any

import pytest

from ai4u_edu.base.errors import NameNotFoundError
from ai4u_edu.editing import ChangeError
from ai4u_edu.editing.things import thing_named
from ai4u_edu.panel import new_things
from ai4u_edu.panel.thing_form import (
    KINDS,
    thing_changes,
    thing_fields,
    thing_first,
    thing_problems,
)
from ai4u_edu.world import AreaDescription, CapsuleShape, FloorDescription, RingShape
from tests.editing.harness import EditorHarness


@pytest.fixture
def harness() -> EditorHarness:
    harness = EditorHarness()
    harness.tick(3)
    return harness


def test_a_form_has_what_a_thing_has(harness: EditorHarness) -> None:
    wall = thing_named(harness.editor.state, "wall")
    shown = {field.name: field.shown for field in thing_fields(wall)}
    assert shown["x"] == "-4"
    assert shown["length"] == "0.4"
    assert shown["kind"] == "stands still"
    assert thing_first(wall) == ["x", "y", "heading_deg", "length", "width", "colour"]
    assert set(thing_first(wall)) <= shown.keys()
    plate = thing_named(harness.editor.state, "plate")
    names = [field.name for field in thing_fields(plate)]
    assert "top" in names
    assert "mass" not in names
    ring = AreaDescription(name="ring", shape=RingShape(inner=1, outer=2))
    assert {"inner", "outer", "paint"} <= {field.name for field in thing_fields(ring)}


def test_entries_become_parameters(harness: EditorHarness) -> None:
    wall = thing_named(harness.editor.state, "wall")
    entered: dict[str, Any] = {"x": "-3,5", "y": "4", "length": "3", "kind": KINDS["dynamic"]}
    values = thing_changes(wall, entered | {"colour": "green", "tags": "[wall, red]"})
    assert values == {
        "position": (-3.5, 4),
        "shape": {"type": "box", "size": [3, 4]},
        "kind": "dynamic",
        "colour": "green",
        "tags": ["wall", "red"],
    }
    done = harness.done(harness.editor.change_body("wall", values))
    assert done.when == "now"
    assert harness.world["wall"].position == (-3.5, 4)
    assert harness.world["wall"].description.shape.size == (3, 4)
    stick = FloorDescription(name="stick", shape=CapsuleShape(length=2, radius=1))
    assert thing_changes(stick, {"radius": "2", "length": "2", "heading_deg": "90"}) == {
        "shape": {"type": "capsule", "length": 2.0, "radius": 2},
        "heading_deg": 90,
    }


@pytest.mark.parametrize(
    ("entered", "field"),
    [({"x": "left"}, "x"), ({"heading_deg": "inf"}, "heading_deg"), ({"colur": "red"}, "colur")],
)
def test_unreadable_entries_are_told_with_their_field(
    harness: EditorHarness, entered: dict[str, str], field: str
) -> None:
    with pytest.raises(ChangeError) as error:
        thing_changes(thing_named(harness.editor.state, "wall"), entered)
    assert [problem.path for problem in error.value.problems] == [(field,)]


def test_problems_of_a_shape_are_told_with_their_field(harness: EditorHarness) -> None:
    wall = thing_named(harness.editor.state, "wall")
    values = thing_changes(wall, {"width": "-1"})
    with pytest.raises(ChangeError) as error:
        harness.done(harness.editor.change_body("wall", values))
    assert [problem.path for problem in thing_problems(wall, error.value.problems)] == [("width",)]


@pytest.mark.parametrize("what", new_things.WHATS)
def test_each_kind_of_thing_is_added_where_there_is_room(what: str, harness: EditorHarness) -> None:
    state = harness.editor.state
    new = new_things.describe(what, state, "0")
    place = new_things.place_for(new, harness.runner.latest, 0.1, 0.2)
    assert place is not None
    label = harness.done(new_things.add(harness.editor, new, *place)).label
    assert label == f"add {new.name}"
    names = [thing.name for thing in harness.editor.state.description.things]
    assert new.name in names
    again = new_things.copy_of(new.name, harness.editor.state)
    assert again.kind == new.kind
    assert again.name not in names
    harness.done(new_things.remove(harness.editor, new.name))
    assert harness.editor.scene == harness.scene


def test_only_known_things_are_added(harness: EditorHarness) -> None:
    with pytest.raises(NameNotFoundError, match="'wal' can't be added; did you mean 'wall'"):
        new_things.describe("wal", harness.editor.state, "0")
    with pytest.raises(NameNotFoundError, match="nothing is named 'moon'"):
        new_things.copy_of("moon", harness.editor.state)


def test_a_copy_has_no_place_of_its_own_and_all_else(harness: EditorHarness) -> None:
    copy = new_things.copy_of("box", harness.editor.state)
    assert copy.template == {
        "name": "box 2",
        "shape": {"type": "box", "size": [1.0, 1.0]},
        "tags": ["target"],
    }

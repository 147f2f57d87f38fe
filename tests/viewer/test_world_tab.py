"""The "World" tab, on pages without a browser."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest

from ai4u_edu import Scene
from ai4u_edu.snapshot import capture_snapshot
from ai4u_edu.viewer import Viewer
from ai4u_edu.viewer.panel.body_form import BodyForm
from ai4u_edu.viewer.panel.world_tab import NO_BODY, WorldTab
from ai4u_edu.viewer.scene.new_things import BODY_TEMPLATES, free_position
from tests.editing.harness import TEXT, EditorHarness
from tests.viewer.pages import Page, page, seen, shown, tabs_of, until


@pytest.fixture
def viewer(harness: EditorHarness) -> Iterator[Viewer]:
    viewer = Viewer(harness.runner, editor=harness.editor)
    yield viewer
    viewer.stop()


def tab_of(viewer: Viewer, number: int = 0) -> WorldTab:
    shown(viewer)
    return tabs_of(viewer, WorldTab)[number]


def moving(viewer: Viewer, here: Page, tab: WorldTab) -> None:
    """Switches the handles on."""
    here.change(tab.drag_enabled, True)
    seen(viewer, lambda: tab.handles.node)


def index(harness: EditorHarness, name: str) -> int:
    return [body.name for body in harness.scene.description.bodies].index(name)


def drag(
    here: Page,
    tab: WorldTab,
    node: str,
    instance: int,
    *path: tuple[float, float],
    lets_go: bool = True,
) -> None:
    """Takes something up at the first place and lets go of it at the last."""
    owner = tab.viewer_client.client.scene._owner_id
    phases = ["start", *["update"] * (len(path) - 1), *(["end"] if lets_go else [])]
    for phase, place in zip(phases, (*path, path[-1]), strict=False):
        here.say(
            "SceneNodeDragMessage",
            phase=phase,
            name=node,
            instance_index=instance,
            start_position=(*path[0], 1.0),
            start_screen_pos=(0.5, 0.5),
            end_position=(*place, 1.0),
            end_screen_pos=(0.5, 0.5),
            button="left",
            modifier=None,
            owner=owner,
        )


def chosen(viewer: Viewer, here: Page, tab: WorldTab, name: str) -> BodyForm:
    here.change(tab.body_list, name)
    seen(viewer, lambda: tab.form is not None and tab.form.body.name == name)
    assert tab.form is not None
    return tab.form


def applied(here: Page, form: BodyForm, **values: str) -> None:
    for name, value in values.items():
        box: Any = form.boxes[name]
        here.change(box, value)
        until(lambda: box.value == value)  # noqa: B023
    here.press(form.apply)


def test_there_are_no_handles_until_they_are_asked_for(
    viewer: Viewer, harness: EditorHarness
) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        assert tab.handles.node == ""
        moving(viewer, here, tab)
        here.change(tab.drag_enabled, False)
        seen(viewer, lambda: tab.handles.node == "")


def test_a_wall_is_dragged_while_the_time_stands_still(
    viewer: Viewer, harness: EditorHarness
) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        moving(viewer, here, tab)
        wall = index(harness, "wall")
        drag(here, tab, tab.handles.node, wall, (-4.1, 1), (-3, 1), (-2.1, -1.5))
        # it was taken up off its centre, and keeps to that
        until(lambda: harness.editor.undo_label == "move wall")
        assert harness.world["wall"].position == pytest.approx((-2, -2.5))
        seen(viewer, lambda: "move wall: it applies at once" in tab.status.content)
        described = harness.editor.state.description.bodies[wall]
        assert described.position == pytest.approx((-2, -2.5))
        assert tab.body_list.value == "wall"
        here.change(tab.changes, "Undo")
        until(lambda: harness.world["wall"].position == (-4, 0))


def test_where_it_can_not_stand_it_goes_back(viewer: Viewer, harness: EditorHarness) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        moving(viewer, here, tab)
        drag(here, tab, tab.handles.node, index(harness, "wall"), (-4, 0), (-2, 0), (4, 0))
        seen(viewer, lambda: "overlap" in tab.status.content)
        assert harness.world["wall"].position == (-4, 0)
        assert harness.editor.undo_label == ""


def test_the_knob_turns_what_was_chosen_in_steps(viewer: Viewer, harness: EditorHarness) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        moving(viewer, here, tab)
        chosen(viewer, here, tab, "wall")
        seen(viewer, lambda: tab.handles.knob)
        assert tab.handles.knob is not None
        drag(here, tab, tab.handles.knob.name, 0, (-3, 0), (-3.5, 0.4), (-3.98, 1.03))
        until(lambda: harness.editor.undo_label == "move wall")
        assert harness.world["wall"].heading == pytest.approx(1.5707963)
        assert harness.world["wall"].position == (-4, 0)


def test_a_click_chooses(viewer: Viewer, harness: EditorHarness) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        moving(viewer, here, tab)
        owner = tab.viewer_client.client.scene._owner_id
        here.click(tab.handles.node, index(harness, "box"), owner=owner)
        seen(viewer, lambda: tab.body_list.value == "box")
        assert tab.form is not None
        here.click(tab.handles.node, 77, owner=owner)
        here.change(tab.body_list, NO_BODY)
        seen(viewer, lambda: tab.form is None and tab.handles.knob is None)


def test_a_page_can_drag_what_it_likes(viewer: Viewer, harness: EditorHarness) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        moving(viewer, here, tab)
        before = harness.editor.state
        drag(here, tab, tab.handles.node, 99, (0, 0), (1, 1))
        drag(here, tab, tab.handles.node, -1, (0, 0), (1, 1))
        drag(here, tab, tab.handles.node, 2, (0, 0), (float("nan"), 1), (1, float("inf")))
        drag(here, tab, tab.handles.node, 2, (float("nan"), 0), (1, 1))
        drag(here, tab, tab.handles.node, 2, (0, 0), (1e12, 1), (1, -1e300))
        until(lambda: tab.handles.drag is None)
        for handle in (tab.body_list, tab.new, tab.scene, tab.changes, tab.unsaved_actions):
            here.change(handle, "nonsense")
        here.change(tab.drag_enabled, False)
        seen(viewer, lambda: tab.handles.node == "")
        harness.runner.submit(lambda: None).result(5)  # all that was asked for before is done
        assert harness.editor.state == before
        assert harness.world["wall"].position == (-4, 0)


def test_escape_puts_back_what_is_held(viewer: Viewer, harness: EditorHarness) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        moving(viewer, here, tab)
        node, wall = tab.handles.node, index(harness, "wall")
        drag(here, tab, node, wall, (-4, 0), (-3, 1), lets_go=False)
        seen(viewer, lambda: harness.world["wall"].position == (-3, 1))
        escape = tab.handles.escape
        assert escape is not None
        here.say("CommandTriggerMessage", uuid=escape._impl.uuid)
        until(lambda: harness.world["wall"].position == (-4, 0))
        harness.runner.submit(lambda: None).result(5)
        seen(viewer, lambda: tab.handles.states["wall"].x == -4)
        drag(here, tab, node, wall, (-4, 0), (-2, 2))  # the next time it is held as ever
        until(lambda: harness.editor.undo_label == "move wall")
        assert harness.world["wall"].position == (-2, 2)
        here.say("CommandTriggerMessage", uuid=escape._impl.uuid)  # nothing is held
        here.change(tab.changes, "Undo")
        until(lambda: harness.world["wall"].position == (-4, 0))
        until(lambda: harness.editor.undo_label == "")
        here.change(tab.drag_enabled, False)
        seen(viewer, lambda: tab.handles.escape is None)


def test_a_page_that_vanishes_lets_go_of_what_it_holds(
    viewer: Viewer, harness: EditorHarness
) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        moving(viewer, here, tab)
        drag(here, tab, tab.handles.node, index(harness, "wall"), (-4, 0), (-3, 1), lets_go=False)
        seen(viewer, lambda: harness.world["wall"].position == (-3, 1))
    until(lambda: harness.editor.undo_label == "move wall")
    assert tab.handles.drag is None
    assert not harness.editor.is_dragging
    assert harness.editor.state.description.bodies[index(harness, "wall")].position == (-3, 1)
    harness.editor.undo().result(5)
    assert harness.world["wall"].position == (-4, 0)


def test_what_is_held_while_the_handles_go_is_let_go_of(
    viewer: Viewer, harness: EditorHarness
) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        moving(viewer, here, tab)
        node, wall = tab.handles.node, index(harness, "wall")
        drag(here, tab, node, wall, (-4, 0), (-3, 1), lets_go=False)
        seen(viewer, lambda: harness.world["wall"].position == (-3, 1))
        here.change(tab.drag_enabled, False)
        seen(viewer, lambda: tab.handles.node == "")
        until(lambda: harness.editor.undo_label == "move wall")
        assert tab.handles.drag is None


def test_a_hand_lets_nothing_fall_into_another_scene(
    viewer: Viewer, harness: EditorHarness
) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        moving(viewer, here, tab)
        wall = index(harness, "wall")
        drag(here, tab, tab.handles.node, wall, (-4, 0), (-3, 1), lets_go=False)
        seen(viewer, lambda: harness.world["wall"].position == (-3, 1))
        other = Scene.loads(TEXT.replace("position: [-4, 0]", "position: [-5, 0]"))
        harness.editor.open(other).result(5)
        seen(viewer, lambda: tab.handles.drag is None)
        harness.runner.submit(lambda: None).result(5)
        assert harness.world["wall"].position == (-5, 0)
        assert not harness.editor.is_dragging
        assert harness.editor.undo_label == "open small"


def test_in_the_past_nothing_can_be_taken_up(viewer: Viewer, harness: EditorHarness) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        moving(viewer, here, tab)
        tab.handles.draw(replace(harness.runner.latest, past="episode 1"), "wall", on=True)
        assert tab.handles.node == ""


@pytest.mark.parametrize("word", BODY_TEMPLATES)
def test_things_are_added_where_there_is_room(
    viewer: Viewer, harness: EditorHarness, word: str
) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        name = harness.editor.free_name(BODY_TEMPLATES[word]["name"])
        here.change(tab.new, word)
        until(lambda: name in harness.world.bodies)
        seen(viewer, lambda: tab.form is not None and tab.form.body.name == name)
        assert tab.delete.label == f"Delete {name}"
        assert tab.handles.node  # it can be dragged at once
        here.press(tab.delete)
        until(lambda: name not in harness.world.bodies)
        seen(viewer, lambda: tab.form is None)
        assert not tab.delete.visible


def test_a_thing_comes_where_the_page_looks(viewer: Viewer, harness: EditorHarness) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        camera = tab.viewer_client.client.camera
        for number, place in enumerate([(3.0, 3.0), (-3.0, 4.0)]):
            here.report_camera(position=(*place, 30.0))
            until(lambda place=place: tuple(camera.look_at[:2]) == place)  # type: ignore[misc]
            here.change(tab.new, "Disc")
            name = "disc" if number == 0 else "disc 2"
            until(lambda name=name: name in harness.world.bodies)  # type: ignore[misc]
            assert harness.world[name].position == place
        here.report_camera(position=(50.0, 0.0, 30.0))
        until(lambda: camera.look_at[0] == 50)
        here.change(tab.new, "Disc")
        seen(viewer, lambda: "there is no room" in tab.status.content)


def test_the_body_of_an_agent_stays(viewer: Viewer, harness: EditorHarness) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        chosen(viewer, here, tab, "robot")
        here.press(tab.delete)
        seen(viewer, lambda: "an agent needs its body" in tab.status.content)
        assert "robot" in harness.world.bodies


def test_a_form_changes_place_size_and_looks(viewer: Viewer, harness: EditorHarness) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        form = chosen(viewer, here, tab, "wall")
        applied(here, form, x="-3,5", heading_deg="90")
        seen(viewer, lambda: "move wall: it applies at once" in tab.status.content)
        assert harness.world["wall"].position == (-3.5, 0)
        seen(viewer, lambda: form.boxes["x"].value == "-3.5")
        applied(here, form, length="0.5", width="3", colour="blue", label="gate", y="1")
        seen(viewer, lambda: "change wall: it applies at once" in tab.status.content)
        wall = harness.editor.state.description.bodies[index(harness, "wall")]
        assert wall.shape.model_dump() == {"type": "box", "size": (0.5, 3)}
        assert (wall.colour, wall.label, wall.position) == ("blue", "gate", (-3.5, 1))
        assert harness.world["wall"].position == (-3.5, 1)
        here.change(tab.changes, "Undo")
        seen(viewer, lambda: form.boxes["label"].value == "")
        assert form.boxes["colour"].value == "(none)"


def test_what_is_wrong_is_said_with_its_label(viewer: Viewer, harness: EditorHarness) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        form = chosen(viewer, here, tab, "wall")
        applied(here, form, length="-1")
        seen(viewer, lambda: "length (m): expected more than 0, got -1" in form.message.content)
        applied(here, form, length="0.4", x="left")
        seen(viewer, lambda: "x (m): expected a number" in form.message.content)
        assert "&#x27;left&#x27;" in form.message.content
        assert harness.editor.undo_label == ""
        applied(here, form, x="-4.5")
        seen(viewer, lambda: not form.message.content)


def test_room_is_found_beside_what_there_is_and_never_over_the_void() -> None:
    sim = Scene.loads(TEXT).build()
    sim.reset(1)
    snapshot = capture_snapshot(sim)
    place = free_position(snapshot, BODY_TEMPLATES["Disc"], 0, 0)
    assert place is not None
    assert 1.0 < abs(complex(*place)) < 2  # as near as the robot, at (0, 0), lets it be
    far = free_position(snapshot, BODY_TEMPLATES["Disc"], 5.9, 5.9)
    assert far is not None
    assert max(far) < 5.5  # the plate ends at 6
    assert free_position(snapshot, BODY_TEMPLATES["Disc"], 100, 0) is None

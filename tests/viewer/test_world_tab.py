"""The "World" tab, on pages without a browser."""

import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any
from uuid import uuid4

import pytest

from ai4u_edu import Scene
from ai4u_edu.editing.autosave import Unsaved
from ai4u_edu.editing.scene_store import SceneStore
from ai4u_edu.snapshot import capture_snapshot
from ai4u_edu.viewer import Viewer
from ai4u_edu.viewer.panel.add_menu import BODY_TEMPLATES, free_position
from ai4u_edu.viewer.panel.body_form import BodyForm
from ai4u_edu.viewer.panel.scene_cards import library_cards, stored_cards
from ai4u_edu.viewer.panel.world_tab import NO_BODY, WorldTab
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


def upload(tab: WorldTab, here: Page, name: str, content: bytes) -> None:
    transfer = str(uuid4())
    here.say(
        "FileTransferStartUpload",
        source_component_uuid=tab.upload._impl.uuid,
        transfer_uuid=transfer,
        filename=name,
        mime_type="application/yaml",
        size_bytes=len(content),
        part_count=1,
    )
    here.say(
        "FileTransferPart",
        source_component_uuid=tab.upload._impl.uuid,
        transfer_uuid=transfer,
        part_index=0,
        content=content,
    )


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


def test_the_gallery_has_a_picture_of_every_scene() -> None:
    found = library_cards()
    assert sorted(card.name for card in found) == Scene.names()
    assert max(len(card.png) for card in found) < 10_000
    assert len({card.png for card in found}) == len(found)
    maze = next(card for card in found if card.name == "maze")
    assert "Find the exit of the maze and touch it." in maze.html
    assert "data:image/png;base64," in maze.html


def test_a_scene_is_opened_from_the_gallery(viewer: Viewer, harness: EditorHarness) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        assert not tab.gallery.buttons  # made when it is asked for
        here.change(tab.scene, "Choose a scene")
        until(lambda: len(tab.gallery.buttons) == len(Scene.names()))
        here.press(tab.gallery.buttons["maze"])
        until(lambda: "exit" in harness.world.bodies)
        assert not tab.gallery.buttons
        seen(viewer, lambda: "exit" in tab.body_list.options)
        assert "<b>Maze</b>" in tab.status.content
        here.change(tab.changes, "Undo")
        until(lambda: "box" in harness.world.bodies)


def test_a_scene_is_saved_by_name_and_chosen_again(
    harness: EditorHarness, tmp_path: Path, viewer: Viewer
) -> None:
    with page(viewer) as here:
        assert tab_of(viewer).saving is None  # nowhere to save
    harness.editor.scene_store = SceneStore(tmp_path / "kept")
    left: Unsaved | None = Unsaved(tmp_path / "x", TEXT, None, time.time())
    harness.editor.recovery.unsaved = left
    with page(viewer) as here:
        seen(viewer, lambda: any(tab.saving for tab in tabs_of(viewer, WorldTab)))
        (tab,) = (each for each in tabs_of(viewer, WorldTab) if each.saving)
        window = tab.saving
        assert window is not None
        here.change(tab.scene, "Save")
        until(lambda: window.is_open)
        assert window.name.value == "small"
        for name, told in (("../mine", "expected a name of letters"), ("", "expected a name, got")):
            here.change(window.name, name)
            here.press(window.save)
            until(lambda told=told: told in window.message.content)  # type: ignore[misc]
        here.change(window.name, "Mine")
        here.press(window.save)
        until(lambda: not window.is_open)
        seen(viewer, lambda: "saved as &#x27;Mine&#x27;" in tab.status.content)
        assert not harness.editor.recovery.unsaved
        assert harness.editor.scene_store.load("Mine") == harness.editor.scene
        harness.editor.remove_body("wall").result(5)
        here.change(tab.scene, "Save")
        until(lambda: window.is_open)
        here.change(window.name, "mine")
        here.press(window.save)
        until(lambda: window.save.label == "Replace it")
        assert "wall" in harness.editor.scene_store.load("Mine").dumps()
        here.change(window.name, "other")
        here.press(window.save)  # that is not what was asked about
        until(lambda: not window.is_open)
        assert harness.editor.scene_store.names() == ["Mine", "other"]
        here.change(tab.scene, "Save")
        until(lambda: window.is_open)
        here.change(window.name, "mine")
        here.press(window.save)
        until(lambda: window.save.label == "Replace it")
        here.change(window.name, "other")
        here.press(window.save)  # it is asked about each
        until(lambda: "&#x27;other&#x27; is there already" in window.message.content)
        here.change(window.name, "mine")
        here.press(window.save)
        until(lambda: "&#x27;Mine&#x27; is there already" in window.message.content)
        here.press(window.save)
        until(lambda: not window.is_open)
        assert "wall" not in harness.editor.scene_store.load("Mine").dumps()
        here.change(tab.new, "Disc")
        until(lambda: "disc" in harness.world.bodies)
        here.change(tab.scene, "Choose a scene")
        until(lambda: len(tab.gallery.buttons) == len(Scene.names()))
        here.press(tab.gallery.stored_buttons["Mine"])
        until(lambda: "disc" not in harness.world.bodies)


def test_the_scenes_own_settings_have_a_form(viewer: Viewer, harness: EditorHarness) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        here.press(tab.settings.button)
        seen(viewer, lambda: tab.settings.form)
        form = tab.settings.form
        assert form is not None
        for name, value in {"gravity": "1,6", "title": "On the <moon>"}.items():
            here.change(form.boxes[name], value)
        here.press(form.apply)
        seen(viewer, lambda: "it applies at the next reset" in tab.status.content)
        assert "On the &lt;moon&gt;" in tab.status.content
        assert "waits for the next reset" in tab.status.content
        assert form.boxes["gravity"].value == "1.6"
        assert harness.world.settings.gravity == 9.81
        harness.runner.reset(3).result(5)
        seen(viewer, lambda: "waits for" not in tab.status.content)
        assert harness.world.settings.gravity == 1.6
        here.change(form.boxes["damping"], "2")
        here.press(form.apply)
        seen(viewer, lambda: "damping: expected at most 1, got 2" in form.message.content)
        here.change(tab.changes, "Undo")
        seen(viewer, lambda: form.boxes["gravity"].value == "9.81")


def test_what_is_kept_can_be_spoilt_from_outside(tmp_path: Path) -> None:
    store = SceneStore(tmp_path)
    store.save("good", Scene.loads(TEXT))
    (tmp_path / "bad.yaml").write_text("name: <b>")
    bad, good = stored_cards(store)
    assert good.png
    assert good.title == "good"
    assert "can&#x27;t be read: bad.yaml, line" in bad.html
    assert "<img" not in bad.html
    store.save("good", Scene.load("maze"), over=True)
    assert stored_cards(store)[1].goal == Scene.load("maze").description.goal


def test_a_scene_file_is_opened(viewer: Viewer, harness: EditorHarness) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        upload(tab, here, "mine.yaml", TEXT.replace("[4, 0]", "[3, 3]").encode())
        until(lambda: harness.world["box"].position == (3, 3))


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (TEXT.replace("radius: 0.5", "radius: -1").encode(), "mine.yaml, line 8"),
        (b"name: !!python/object/apply:os.system ['true']", "mine.yaml, line 1"),
        (b"\xff\xfe\x00", "expected a text file"),
        (b"x" * 400_000, "expected at most"),
    ],
)
def test_what_is_no_scene_is_refused(
    viewer: Viewer, harness: EditorHarness, content: bytes, told: str
) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        before = harness.editor.state
        upload(tab, here, "mine.yaml", content)
        seen(viewer, lambda: told in tab.status.content)
        assert 'role="alert"' in tab.status.content
        assert harness.editor.state == before


def test_what_was_left_is_offered_and_can_be_thrown_away(
    viewer: Viewer, harness: EditorHarness, tmp_path: Path
) -> None:
    text = TEXT.replace("[4, 0]", "[3, 3]")
    harness.editor.recovery.unsaved = Unsaved(tmp_path / "x", text, None, time.time())
    with page(viewer) as here:
        tab = tab_of(viewer)
        assert tab.unsaved_actions.visible
        here.change(tab.unsaved_actions, "Discard")
        seen(viewer, lambda: not tab.unsaved_actions.visible)
        assert harness.world["box"].position == (4, 0)
        harness.editor.recovery.unsaved = Unsaved(tmp_path / "x", text, None, time.time())
        seen(viewer, lambda: tab.unsaved_actions.visible)
        here.change(tab.unsaved_actions, "Restore")
        until(lambda: harness.world["box"].position == (3, 3))
        seen(viewer, lambda: not tab.unsaved_actions.visible)


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

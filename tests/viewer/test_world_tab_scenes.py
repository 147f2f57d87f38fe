"""Scenes in the "World" tab: gallery, saving, settings, files and recovery."""

import time
from collections.abc import Iterator
from pathlib import Path
from uuid import uuid4

import pytest

from ai4u_edu import Scene
from ai4u_edu.editing.autosave import Unsaved
from ai4u_edu.editing.scene_cards import library_cards, stored_cards
from ai4u_edu.editing.scene_store import SceneStore
from ai4u_edu.viewer import Viewer
from ai4u_edu.viewer.panel.gallery import card_html
from ai4u_edu.viewer.panel.world_tab import WorldTab
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


def test_the_gallery_has_a_picture_of_every_scene() -> None:
    found = library_cards()
    assert sorted(card.name for card in found) == Scene.names()
    assert max(len(card.png) for card in found) < 10_000
    assert len({card.png for card in found}) == len(found)
    maze = next(card for card in found if card.name == "maze")
    assert "Find the exit of the maze and touch it." in card_html(maze)
    assert "data:image/png;base64," in card_html(maze)


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
    assert "can&#x27;t be read: bad.yaml, line" in card_html(bad)
    assert "<img" not in card_html(bad)
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

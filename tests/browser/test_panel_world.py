"""The panel's tab "World" and its shortcuts, with a fake panel."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, expect

from tests.browser.tab_page import TabPage

BOX = {
    "name": "box",
    "kind": "body",
    "shape": "box",
    "x": 4.0,
    "y": 0.0,
    "heading": 0.0,
    "movable": True,
}
ROBOT = {**BOX, "name": "robot", "kind": "agent", "shape": "circle"}
PLATE = {**BOX, "name": "plate", "kind": "floor", "x": 0.0}
FORM = {
    "name": "box",
    "kind": "body",
    "fields": [
        {"name": "x", "label": "x (m)", "kind": "number", "value": 4.0, "shown": "4"},
        {"name": "y", "label": "y (m)", "kind": "number", "value": 0.0, "shown": "0"},
        {
            "name": "colour",
            "label": "colour",
            "kind": "choice",
            "value": "green",
            "shown": "green",
            "choices": ["(none)", "green", "blue"],
        },
        {"name": "mass", "label": "mass (kg)", "kind": "number", "value": 1.0, "shown": "1"},
    ],
}
SETTINGS = [
    {"name": "title", "label": "title", "kind": "text", "value": "Small"},
    {"name": "gravity", "label": "gravity (m/s^2)", "kind": "number", "value": 9.81},
]
FIELD = [
    {
        "name": "type",
        "label": "kind",
        "kind": "choice",
        "value": "maze",
        "shown": "maze",
        "choices": ["(none)", "maze"],
        "is_first": True,
    },
    {"name": "loops", "label": "loops", "kind": "whole", "value": 0, "is_first": True},
]
NO_FIELD = [{**FIELD[0], "value": None, "shown": "(none)"}]
PART: dict[str, Any] = {
    "bodies": [ROBOT, BOX, PLATE],
    "field": NO_FIELD,
    "form": None,
    "settings": SETTINGS,
    "unsaved": None,
    "can_save": True,
    "undo": {"label": ""},
    "redo": {"label": ""},
    "is_move_mode": False,
    "max_picture_bytes": 2**20,
    "max_scene_bytes": 2**20,
    "is_dragging": False,
    "snap": 0.5,
}
MOVING = {**PART, "is_move_mode": True, "form": FORM}


@pytest.fixture
def tab(chromium: Browser) -> Iterator[TabPage]:
    tab = TabPage(chromium, "panel/world/tab", "WorldTab", "world")
    tab.give(PART)
    yield tab
    tab.close()
    assert tab.errors == []


def chosen(tab: TabPage) -> None:
    """Choose the box, with the handles on."""
    tab.head("box").click()
    tab.give(MOVING)
    tab.sent()


def test_things_are_listed_with_their_places(tab: TabPage) -> None:
    expect(tab.head("robot")).to_contain_text("agent, 4.0 m, 0.0 m")
    expect(tab.head("plate")).to_contain_text("floor, 0.0 m, 0.0 m")
    tab.give({**PART, "bodies": [{**BOX, "x": 2.5}]})
    expect(tab.head("box")).to_contain_text("2.5 m, 0.0 m")
    expect(tab.head("robot")).to_have_count(0)
    tab.give({**PART, "bodies": [{**ROBOT, "is_random": True}]})
    expect(tab.head("robot")).to_contain_text("agent, random place")


def test_a_click_chooses_and_the_form_changes_it(tab: TabPage) -> None:
    tab.head("box").click()
    assert tab.shown["body"] == "box"
    assert tab.sent() == [{"command": "select", "body": "box", "others": []}]
    tab.give({**PART, "form": FORM})
    expect(tab.page.get_by_label("mass (kg)")).to_be_hidden()
    x = tab.page.get_by_label("x (m)")
    x.fill("3,5")
    x.press("Enter")
    tab.page.get_by_label("colour").select_option("blue")
    sent = [each["values"] for each in tab.sent()]
    assert sent[0] == {"x": "3,5"}
    assert sent[-1]["colour"] == "blue"


def test_a_thing_that_is_clicked_in_the_picture_opens(tab: TabPage) -> None:
    tab.page.evaluate(
        """panel.show({body: "plate", others: []});
        panel.dispatchEvent(new CustomEvent("selected", {detail: {body: "plate"}}))"""
    )
    expect(tab.head("plate")).to_have_attribute("aria-expanded", "true")
    assert tab.shown["body"] == "plate"


def test_moving_and_the_grid_are_switched(tab: TabPage) -> None:
    expect(tab.page.get_by_text("Turn on Move things")).to_be_visible()
    tab.page.get_by_role("switch", name="Move things").click()
    (sent,) = tab.sent()
    assert sent == {"command": "move_mode", "on": True, "knob": sent["knob"]}
    tab.give(MOVING)
    expect(tab.page.get_by_text("Esc cancels")).to_be_visible()
    tab.page.get_by_role("switch", name="Snap to grid").click()
    assert tab.sent() == [{"command": "snap", "distance": 0}]
    tab.give({**MOVING, "snap": 0})
    expect(tab.page.get_by_role("switch", name="Snap to grid")).to_have_attribute(
        "aria-checked", "false"
    )


SHORTCUTS: list[tuple[str, dict[str, object]]] = [
    ("ArrowRight", {"command": "nudge", "names": ["box"], "dx": 0.5, "dy": 0, "turn_deg": 0}),
    ("ArrowUp", {"command": "nudge", "names": ["box"], "dx": 0, "dy": 0.5, "turn_deg": 0}),
    ("Alt+ArrowLeft", {"command": "nudge", "names": ["box"], "dx": -0.05, "dy": 0, "turn_deg": 0}),
    ("Shift+ArrowLeft", {"command": "nudge", "names": ["box"], "dx": 0, "dy": 0, "turn_deg": 15}),
    ("Delete", {"command": "remove_bodies", "names": ["box"]}),
    ("Control+d", {"command": "duplicate", "names": ["box"]}),
    ("Control+z", {"command": "undo"}),
    ("Control+y", {"command": "redo"}),
    ("Control+Shift+Z", {"command": "redo"}),
    ("Escape", {"command": "select", "body": None, "others": []}),
]


def test_shortcuts_change_the_chosen_thing(tab: TabPage, subtests: pytest.Subtests) -> None:
    for keys, command in SHORTCUTS:
        with subtests.test(keys):
            if tab.head("box").get_attribute("aria-expanded") != "true":  # at first, and once gone
                chosen(tab)
                tab.page.evaluate("document.activeElement.blur()")
            tab.page.keyboard.press(keys)
            assert tab.sent()[0] == command


def test_shift_selects_several_and_shortcuts_change_all(tab: TabPage) -> None:
    chosen(tab)
    tab.head("robot").click(modifiers=["Shift"])
    select = {"command": "select", "body": "box", "others": ["robot"]}
    assert tab.sent() == [select]
    assert tab.shown["others"] == ["robot"]
    tab.page.evaluate("document.activeElement.blur()")
    tab.page.keyboard.press("ArrowRight")
    tab.page.keyboard.press("Delete")
    names = ["box", "robot"]
    nudge = {"command": "nudge", "names": names, "dx": 0.5, "dy": 0, "turn_deg": 0}
    assert tab.sent()[:2] == [nudge, {"command": "remove_bodies", "names": names}]
    tab.head("box").click()
    tab.head("robot").click(modifiers=["Shift"])
    tab.head("robot").click(modifiers=["Shift"])
    assert tab.sent()[-1] == {"command": "select", "body": "box", "others": []}


def test_shortcuts_leave_texts_and_windows_alone(tab: TabPage) -> None:
    chosen(tab)
    tab.page.get_by_label("x (m)").focus()
    for keys in ("Delete", "ArrowLeft", "Control+z", "Control+d"):
        tab.page.keyboard.press(keys)
    assert [each for each in tab.sent() if each["command"] != "change_body"] == []
    tab.page.get_by_role("button", name="Save").click()
    tab.page.get_by_role("dialog").get_by_role("button", name="Close").focus()
    tab.page.keyboard.press("Delete")
    assert tab.sent() == []


def test_without_a_chosen_thing_only_undo_works(tab: TabPage) -> None:
    for keys in ("Delete", "ArrowLeft", "Escape", "Control+d", "Control+z"):
        tab.page.keyboard.press(keys)
    assert tab.sent() == [{"command": "undo"}]
    tab.head("box").click()
    tab.give({**PART, "form": FORM})
    tab.sent()
    tab.page.evaluate("document.activeElement.blur()")
    tab.page.keyboard.press("ArrowLeft")  # things are not being moved
    assert tab.sent() == []


def test_escape_during_a_drag_is_the_pictures(tab: TabPage) -> None:
    chosen(tab)
    tab.give({**MOVING, "is_dragging": True})
    tab.page.evaluate("document.activeElement.blur()")
    tab.page.keyboard.press("Escape")
    assert tab.shown["body"] == "box"


def test_a_card_copies_and_deletes(tab: TabPage) -> None:
    chosen(tab)
    tab.answer("duplicate", bodies=["box 2"])
    tab.page.get_by_role("button", name="Duplicate").click()
    assert tab.sent()[0] == {"command": "duplicate", "names": ["box"]}
    assert tab.shown["body"] == "box 2"
    tab.head("box").click()
    tab.page.get_by_role("button", name="Delete").click()
    assert {"command": "remove_bodies", "names": ["box"]} in tab.sent()
    assert tab.shown["body"] is None


def test_a_scene_is_saved_and_replaced_only_after_a_question(tab: TabPage) -> None:
    tab.give({"title": "Small"}, "scene")
    tab.page.get_by_role("button", name="Save").click()
    dialog = tab.page.get_by_role("dialog")
    expect(dialog.get_by_label("Name")).to_have_value("Small")
    tab.answer("save_scene", ok=False, code="exists", text="A scene has this name.")
    dialog.get_by_role("button", name="Save").click()
    expect(dialog.get_by_role("alert")).to_have_text("A scene has this name.")
    tab.answer("save_scene", ok=True, text="Saved.")
    dialog.get_by_role("button", name="Replace it").click()
    expect(dialog).to_have_count(0)
    assert [each["over"] for each in tab.sent()] == [False, True]


def test_a_scene_is_downloaded_and_opened(tab: TabPage, tmp_path: Path) -> None:
    tab.answer("download", file="small.yaml", content="name: small\n")
    with tab.page.expect_download() as download:
        tab.page.get_by_role("button", name="Download").click()
    assert download.value.suggested_filename == "small.yaml"
    assert download.value.path().read_text() == "name: small\n"
    file = tmp_path / "mine.yaml"
    file.write_text("name: mine\n")
    with tab.page.expect_file_chooser() as chooser:
        tab.page.get_by_role("button", name="Open a file").click()
    chooser.value.set_files(file)
    tab.page.wait_for_function("panel.sent.some(each => each.command === 'load_text')")
    assert tab.sent()[-1] == {"command": "load_text", "name": "mine.yaml", "text": "name: mine\n"}


def test_a_picture_is_laid_on_the_ground(tab: TabPage, tmp_path: Path) -> None:
    file = tmp_path / "mat.png"
    file.write_bytes(b"png")
    with tab.page.expect_file_chooser() as chooser:
        tab.page.get_by_role("button", name="Lay a picture on the ground").click()
    chooser.value.set_files(file)
    tab.page.wait_for_function("panel.sent.some(each => each.command === 'lay_picture')")
    assert tab.sent()[-1] == {"command": "lay_picture", "name": "mat.png", "text": "png"}
    large = tmp_path / "large.png"
    large.write_bytes(bytes(2**20 + 1))
    with tab.page.expect_file_chooser() as chooser:
        tab.page.get_by_role("button", name="Lay a picture on the ground").click()
    chooser.value.set_files(large)
    notice = tab.page.wait_for_function("panel.notices.at(-1)").json_value()
    assert notice.startswith("error: large.png: expected a picture of at most 1 MB, got 1.0 MB")
    assert "lay_picture" not in [each["command"] for each in tab.sent()]


def test_a_scene_that_is_larger_than_the_world_takes_is_not_sent(
    tab: TabPage, tmp_path: Path
) -> None:
    file = tmp_path / "large.yaml"
    file.write_bytes(bytes(2**20 + 1))
    with tab.page.expect_file_chooser() as chooser:
        tab.page.get_by_role("button", name="Open a file").click()
    chooser.value.set_files(file)
    notice = tab.page.wait_for_function("panel.notices.at(-1)").json_value()
    assert notice.startswith("error: large.yaml: expected a scene file (YAML) of at most 1 MB")
    assert "load_text" not in [each["command"] for each in tab.sent()]


def test_an_unsaved_scene_is_offered(tab: TabPage) -> None:
    expect(tab.page.get_by_role("button", name="Restore")).to_be_hidden()
    tab.give({**PART, "unsaved": {"when": "06:26"}})
    expect(tab.page.get_by_text("You have an unsaved scene from 06:26.")).to_be_visible()
    tab.page.get_by_role("button", name="Restore").click()
    tab.page.get_by_role("button", name="Discard").click()
    assert [each["command"] for each in tab.sent()] == ["restore", "discard"]


def test_settings_of_the_scene_change(tab: TabPage) -> None:
    tab.page.get_by_text("Scene settings").click()
    gravity = tab.page.get_by_label("gravity (m/s^2)")
    gravity.fill("1.6")
    gravity.press("Enter")
    assert tab.sent() == [{"command": "change_settings", "values": {"gravity": "1.6"}}]


def test_a_field_by_chance_is_chosen_and_drawn_again(tab: TabPage) -> None:
    tab.page.get_by_text("Field by chance").click()
    expect(tab.page.get_by_role("button", name="New field")).to_be_hidden()
    tab.page.get_by_label("kind").select_option("maze")
    assert tab.sent() == [{"command": "change_field", "values": {"type": "maze"}}]
    tab.give({**PART, "field": FIELD})
    loops = tab.page.get_by_label("loops")
    loops.fill("3")
    loops.press("Enter")
    tab.page.get_by_role("button", name="New field").click()
    assert tab.sent() == [
        {"command": "change_field", "values": {"loops": "3"}},
        {"command": "new_start"},
    ]


@pytest.mark.parametrize(("is_touch", "smallest"), [(False, 28), (True, 40)])
def test_controls_are_large_enough_and_have_names(
    chromium: Browser, is_touch: bool, smallest: float
) -> None:
    size = (390, 844)
    options: dict[str, Any] = {"has_touch": is_touch, "is_mobile": is_touch}
    tab = TabPage(chromium, "panel/world/tab", "WorldTab", "world", size=size, **options)
    tab.give({**PART, "unsaved": {"when": "06:26"}, "field": FIELD})
    tab.page.get_by_text("Field by chance").click()
    chosen(tab)
    assert tab.small_controls(smallest) == []
    assert tab.unnamed_controls() == []
    tab.close()

"""The palette under the world: dragging, clicking and keys, with a fake panel."""

from collections.abc import Iterator
from functools import partial
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, expect

from tests.browser.fake_panel import Json
from tests.browser.panel_page import PanelPage, panel_page, panel_room
from tests.page.server.rooms import Room

PIXEL = "data:image/gif;base64,R0lGODlhAQABAAAAACH5BAEKAAEALAAAAAABAAEAAAICTAEAOw=="
THINGS = ("wall", "box", "ball", "target", "lamp", "area", "floor", "agent")
ITEMS = [{"name": name, "title": name.capitalize(), "url": PIXEL, "side_m": 2.0} for name in THINGS]
FOUND = ["cube", "robot"]
"""Things that each frame finds; a click finds the first one."""
WIDE_M = 20.0
"""Width and height of the ground that the picture shows, with (0, 0) in the middle (m)."""
MATRIX = [WIDE_M, 0, -WIDE_M / 2, 0, -WIDE_M, WIDE_M / 2, 0, 0, 1]


@pytest.fixture(scope="module")
def room() -> Iterator[Room]:
    with panel_room() as room:
        yield room


@pytest.fixture
def desk(chromium: Browser, room: Room) -> Iterator[PanelPage]:
    with panel_page(chromium, room) as page:
        build(page)
        yield page


def build(page: PanelPage, tab: str = "World", **answers: Json) -> None:
    """Open a tab that builds the world."""
    page.panel.replies |= {
        "palette": lambda _: {"items": ITEMS},
        "ground": lambda _: {"matrix": MATRIX},
        "add_body": lambda message: {"bodies": [message["template"]], "text": "Added it."},
        "find_things": lambda message: {"names": FOUND[: len(message["corners"])]},
        "duplicate": lambda message: {"bodies": [f"{name} 2" for name in message["names"]]},
        "paste": lambda _: {"bodies": ["cube 2"]},
    }
    page.panel.change("world", snap=0.5)
    page.tab(tab).click()
    expect(page.page.locator(".ai4u-palette-entry")).to_have_count(len(THINGS))


def entry(page: PanelPage, title: str) -> Locator:
    return page.page.get_by_role("group", name="Things to add").get_by_role("button", name=title)


def at(page: PanelPage, x: float, y: float) -> tuple[float, float]:
    """Return where the picture shows a place (m) in the window (px)."""
    box: Any = page.page.locator("#root").bounding_box()
    across, down = 0.5 + x / WIDE_M, 0.5 - y / WIDE_M
    return box["x"] + across * box["width"], box["y"] + down * box["height"]


def added(page: PanelPage) -> Json:
    """Return the arguments of the command that adds the only thing."""
    page.until(lambda: page.panel.commands("add_body"))
    (command,) = page.panel.commands("add_body")
    return command


def ghost(page: PanelPage) -> Locator:
    return page.page.locator(".ai4u-ghost")


def is_move_mode(page: PanelPage) -> bool:
    """Return True if the latest command lets things be moved."""
    commands = page.panel.commands("move_mode")
    return bool(commands and commands[-1]["on"])


def selected(page: PanelPage) -> list[str]:
    """Return the names of the selected things that the page said last."""
    last = (page.panel.commands("select") or [{"body": None, "others": []}])[-1]
    return [last["body"], *last["others"]] if last["body"] else []


def tool(page: PanelPage, name: str) -> Locator:
    bar = page.page.get_by_role("toolbar", name="Selected things")
    return bar.get_by_role("button", name=name)


def is_aligned(page: PanelPage, command: Json) -> bool:
    return command in page.panel.commands("align")


def start_drag(page: PanelPage, title: str) -> None:
    box: Any = entry(page, title).bounding_box()
    page.page.mouse.move(box["x"] + 10, box["y"] + 10)
    page.page.mouse.down()
    page.page.mouse.move(*at(page, 0, 0), steps=3)


def test_a_thing_is_dragged_out_and_snaps_to_the_grid(desk: PanelPage) -> None:
    start_drag(desk, "Wall")
    desk.until(lambda: desk.panel.commands("ground"))
    desk.page.mouse.move(*at(desk, 3.1, -1.9))
    desk.page.mouse.up()
    assert added(desk) == {"template": "wall", "x": 3, "y": -2}
    desk.until(lambda: desk.panel.shown["body"] == "wall")
    expect(ghost(desk)).to_have_count(0)


def test_a_quick_drop_waits_for_the_map(desk: PanelPage) -> None:
    start_drag(desk, "Box")
    desk.page.mouse.up()
    assert added(desk) == {"template": "box", "x": 0, "y": 0}


def test_dropped_beside_the_picture_it_is_put_away(desk: PanelPage) -> None:
    start_drag(desk, "Box")
    expect(ghost(desk)).to_be_visible()
    box: Any = entry(desk, "Ball").bounding_box()
    desk.page.mouse.move(box["x"], box["y"] + 10)
    desk.page.mouse.up()
    expect(ghost(desk)).to_have_count(0)
    assert desk.panel.commands("add_body") == []


def test_a_click_takes_it_and_the_next_one_places_it(desk: PanelPage) -> None:
    entry(desk, "Target").click()
    expect(entry(desk, "Target")).to_have_attribute("aria-pressed", "true")
    desk.page.mouse.move(*at(desk, 2.2, 2.2))
    expect(ghost(desk)).to_be_visible()
    desk.page.keyboard.down("Alt")  # any place
    desk.page.mouse.click(*at(desk, 2.2, 2.2))
    desk.page.keyboard.up("Alt")
    command = added(desk)
    assert (command["x"], command["y"]) == pytest.approx((2.2, 2.2), abs=0.05)
    expect(entry(desk, "Target")).to_have_attribute("aria-pressed", "false")


def test_it_is_put_away_by_a_second_click_or_escape(desk: PanelPage) -> None:
    for _ in range(2):
        entry(desk, "Target").click()
    expect(entry(desk, "Target")).to_have_attribute("aria-pressed", "false")
    entry(desk, "Target").click()
    desk.page.keyboard.press("Escape")
    expect(entry(desk, "Target")).to_have_attribute("aria-pressed", "false")
    desk.page.mouse.click(*at(desk, 0, 0))
    assert desk.panel.commands("add_body") == []


def test_the_keyboard_takes_moves_and_places_it(desk: PanelPage) -> None:
    entry(desk, "Lamp").press("Enter")
    expect(ghost(desk)).to_be_visible()
    for key in ("ArrowRight", "ArrowRight", "ArrowUp", "Alt+ArrowUp"):
        desk.page.keyboard.press(key)
    said = desk.page.locator(".ai4u-palette .ai4u-hidden-text")
    expect(said).to_have_text("Lamp: 1 m right, 0.55 m up.")
    desk.page.keyboard.press("Enter")
    assert added(desk) == {"template": "lamp", "x": 1, "y": 0.55}
    expect(said).to_have_text("Added it.")
    expect(entry(desk, "Lamp")).to_be_focused()


def test_a_refusal_is_said(desk: PanelPage) -> None:
    desk.panel.replies["add_body"] = lambda _: {"type": "failed", "text": "There is no floor."}
    entry(desk, "Box").click()
    desk.page.mouse.click(*at(desk, 9, 9))
    expect(desk.page.get_by_role("alert").get_by_text("There is no floor.")).to_be_visible()


def test_it_is_there_while_a_tab_builds_the_world(desk: PanelPage) -> None:
    palette = desk.page.get_by_role("region", name="Add to the world")
    desk.until(lambda: is_move_mode(desk))
    desk.tab("Drive").click()
    expect(palette).to_be_hidden()
    desk.until(lambda: not is_move_mode(desk))
    desk.tab("Build").click()
    expect(palette).to_be_visible()
    assert set(desk.panel.shown["tabs"]) == {"blocks", "world"}
    desk.button("Fold the panel").click()
    expect(palette).to_be_hidden()
    root: Any = desk.page.locator("#root").bounding_box()
    assert root["height"] == 720


def test_who_does_not_move_things_keeps_it_so(desk: PanelPage) -> None:
    desk.panel.change("world", is_move_mode=True)
    desk.page.get_by_role("switch", name="Move things").click()
    desk.page.get_by_role("switch", name="Snap to grid").click()
    desk.tab("Drive").click()
    desk.panel.received.clear()
    desk.tab("World").click()
    desk.until(lambda: desk.panel.commands("snap"))
    assert not is_move_mode(desk)
    assert desk.panel.commands("snap")[-1] == {"distance": 0}


def test_on_a_phone_a_tap_takes_it_and_the_next_one_places_it(
    chromium: Browser, room: Room
) -> None:
    options: Json = {"width": 390, "height": 844, "has_touch": True, "is_mobile": True}
    with panel_page(chromium, room, **options) as phone:
        phone.button("Open the panel").tap()
        build(phone)
        for title in THINGS:
            box: Any = entry(phone, title).bounding_box()
            assert box["x"] >= 0
            assert box["x"] + box["width"] <= 390
            assert min(box["width"], box["height"]) >= 40
        entry(phone, "Ball").tap()
        phone.until(lambda: phone.panel.commands("ground"))
        phone.page.touchscreen.tap(*at(phone, 4, 5))
        assert added(phone) == {"template": "ball", "x": 4, "y": 5}


def pull_frame(page: PanelPage) -> None:
    page.page.mouse.move(*at(page, -5, 5))
    page.page.mouse.down()
    page.page.mouse.move(*at(page, 5, -5), steps=3)
    expect(page.page.locator(".ai4u-frame")).to_be_visible()
    page.page.mouse.up()


def test_shift_pulls_a_frame_around_things(desk: PanelPage) -> None:
    expect(tool(desk, "Put into a row")).to_be_hidden()
    desk.page.keyboard.down("Shift")
    pull_frame(desk)
    desk.until(lambda: selected(desk) == ["cube", "robot"])
    (frame,) = desk.panel.commands("find_things")
    assert [pytest.approx(corner, abs=0.1) for corner in frame["corners"]] == [
        [-5, 5],
        [5, 5],
        [5, -5],
        [-5, -5],
    ]
    desk.page.mouse.click(*at(desk, 1, 1))  # the first of them, which is let go
    desk.until(lambda: selected(desk) == ["robot"])
    desk.page.keyboard.up("Shift")
    expect(desk.page.locator(".ai4u-frame-layer")).to_have_count(0)


def test_tools_change_all_that_is_selected(desk: PanelPage) -> None:
    tool(desk, "Select several").click()
    pull_frame(desk)
    expect(desk.page.get_by_text("2 things selected")).to_be_visible()
    names = ["cube", "robot"]
    for name, how in (("a row", "row"), ("a column", "column"), ("Space evenly", "spread")):
        tool(desk, name).click()
        desk.until(partial(is_aligned, desk, {"names": names, "how": how}))
    tool(desk, "Duplicate").click()
    desk.until(lambda: selected(desk) == ["cube 2", "robot 2"])
    tool(desk, "Delete").click()
    desk.until(lambda: desk.panel.commands("remove_bodies") == [{"names": ["cube 2", "robot 2"]}])
    desk.until(lambda: selected(desk) == [])
    desk.page.mouse.click(*at(desk, 1, 1))  # the mode goes on
    desk.until(lambda: selected(desk) == ["cube"])
    tool(desk, "Select several").click()
    expect(desk.page.locator(".ai4u-frame-layer")).to_have_count(0)


def test_what_is_copied_is_pasted_where_the_pointer_is(desk: PanelPage) -> None:
    tool(desk, "Select several").click()
    desk.page.mouse.click(*at(desk, 1, 1))
    desk.until(lambda: selected(desk) == ["cube"])
    desk.page.keyboard.press("Control+c")
    desk.page.mouse.move(*at(desk, -4, 2))
    desk.page.keyboard.press("Control+v")
    desk.until(lambda: desk.panel.commands("paste"))
    assert desk.panel.commands("copy") == [{"names": ["cube"]}]
    (place,) = desk.panel.commands("paste")
    assert (place["x"], place["y"]) == pytest.approx((-4, 2), abs=0.1)
    desk.until(lambda: selected(desk) == ["cube 2"])
    tool(desk, "Paste").click()
    desk.until(lambda: desk.panel.commands("paste")[1:] == [{}])

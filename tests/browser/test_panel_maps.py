"""Maps over the floor and "If it stood here" in the Drive tab, with a fake socket."""

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, expect

from tests.browser.fake_panel import Json
from tests.browser.panel_page import PanelPage, panel_page, panel_room
from tests.browser.schemes import SCHEMES
from tests.browser.test_panel_accessibility import findings
from tests.page.server.rooms import Room

pytestmark = pytest.mark.browser

MAPS: Json = {
    "type": "part",
    "name": "maps",
    "agent": "0",
    "problem": "",
    "faced": ["box", "home"],
    "field": {"done": 50, "count": 200, "seconds": 12.3},
    "values": None,
}
VALUES: Json = {
    "done": 100,
    "count": 100,
    "seconds": 12.3,
    "low": -0.5,
    "high": 98.2,
    "words": "The colours are the points of one try from there.",
    "colours": ["#00224e", "#fee838"],
}


@pytest.fixture(scope="module")
def room() -> Iterator[Room]:
    with panel_room() as room:
        yield room


@pytest.fixture(scope="module", params=SCHEMES)
def warm(chromium: Browser, room: Room, request: pytest.FixtureRequest) -> Iterator[PanelPage]:
    with panel_page(chromium, room, height=1000, color_scheme=request.param) as page:
        yield page


@pytest.fixture
def desk(warm: PanelPage) -> PanelPage:
    """A page with nothing remembered, of an agent that a network drives."""
    warm.reset()
    warm.panel.let_network_drive()
    return warm


def test_a_person_is_not_asked_for_reasons(desk: PanelPage) -> None:
    sections = [
        desk.page.locator("summary", has_text=title)
        for title in ("Why?", "What if it stood somewhere else?")
    ]
    for each in sections:
        expect(each).to_be_visible()
    (agent,) = desk.panel.parts["scene"]["agents"]
    desk.panel.change("scene", agents=[agent | {"driver": "You", "is_person": True}])
    for each in sections:
        expect(each).to_be_hidden()


def test_maps_over_the_floor(desk: PanelPage) -> None:
    arrows = desk.page.get_by_role("switch", name="Arrows: where it would go")
    colours = desk.page.get_by_role("switch", name="Colours: good and bad places")
    bar = desk.page.get_by_role("progressbar", name="Arrows")
    legend = desk.page.get_by_role("list", name="Arrows")
    arrows.click()
    desk.until(lambda: desk.panel.commands("maps"))
    assert desk.panel.commands("maps") == [{"field": True, "values": False, "facing": ""}]
    expect(bar).to_be_visible()
    expect(legend).to_be_hidden()
    desk.panel.send(MAPS)
    expect(desk.page.get_by_text("50 of 200 places")).to_be_visible()
    expect(legend.get_by_role("listitem")).to_have_text(
        ["turns left", "goes straight", "turns right"]
    )
    desk.page.get_by_label("Facing").select_option("box")
    desk.until(lambda: desk.panel.commands("maps")[-1]["facing"] == "box")
    desk.panel.send(MAPS | {"field": MAPS["field"] | {"done": 200}})
    expect(bar).to_be_hidden()
    expect(desk.page.get_by_text("as it is now (12.3 s)")).to_be_visible()
    colours.click()
    desk.until(lambda: desk.panel.commands("maps")[-1]["values"])
    desk.panel.send(MAPS | {"values": VALUES})
    expect(desk.page.locator(".ai4u-map-scale")).to_have_text(re.compile("^.0.5098.2$"))
    expect(desk.page.get_by_text("Yellow: starting here ends well.")).to_be_visible()
    assert findings(desk.page, ".ai4u-maps") == []
    desk.button("Cancel: arrows").press("Enter")
    desk.until(lambda: not desk.panel.commands("maps")[-1]["field"])
    expect(arrows).to_have_attribute("aria-checked", "false")
    expect(arrows).to_be_focused()
    desk.panel.send(MAPS | {"field": None, "problem": "A person drives."})
    expect(desk.page.get_by_text("A person drives.")).to_be_visible()
    desk.panel.drop()
    desk.until(lambda: len(desk.panel.commands("maps")) == 5)
    assert desk.panel.commands("maps")[-1] == {"field": False, "values": True, "facing": "box"}
    assert desk.problems == []


def test_if_it_stood_here(desk: PanelPage) -> None:
    def reply(message: Json) -> Json:
        pose = {name: message.get(name, 1.5) for name in ("x", "y", "heading_deg")}
        turn = {"name": "turn", "low": -1, "high": 1, "has_effect": True, "now": 0.1}
        action = [turn | {"then": pose["x"] / 10}]
        return {**pose, "can_stand": pose["x"] < 5, "action": action}

    desk.panel.replies["elsewhere"] = reply
    switch = desk.page.get_by_role("switch", name="Try another place")
    switch.click()
    hint = desk.page.get_by_text("Press Pause, then drag the purple robot.")
    expect(hint).to_be_visible()
    assert desk.panel.commands("elsewhere") == []
    desk.panel.change("run", is_paused=True)
    x = desk.page.get_by_label("x (m)")
    expect(x).to_have_value("1.5")
    expect(hint).to_be_hidden()
    assert desk.panel.commands("elsewhere") == [{}]
    # with the keyboard
    x.press("ArrowUp")
    row = desk.page.locator(".ai4u-elsewhere .ai4u-bar-row")
    expect(row).to_have_text(re.compile("^turn0.10 . 0.16$"))
    assert desk.panel.commands("elsewhere")[-1] == {"x": 1.6, "y": 1.5, "heading_deg": 1.5}
    x.fill("7")
    expect(desk.page.get_by_text("It can't stand there")).to_be_visible()
    expect(row).to_be_hidden()
    assert findings(desk.page, ".ai4u-elsewhere") == []
    # dragged in the world
    desk.panel.send({"type": "stand_in", "x": -2.0, "y": 3.0, "heading_deg": 90})
    expect(x).to_have_value("-2")
    expect(row).to_have_text(re.compile("^turn0.10 . .0.20$"))
    assert desk.panel.commands("elsewhere")[-1] == {"x": -2, "y": 3, "heading_deg": 90}
    desk.button("Where it stands").click()
    expect(x).to_have_value("1.5")
    desk.panel.change("run", is_paused=False)
    desk.until(lambda: desk.panel.commands("hide_elsewhere"))
    expect(x).to_be_hidden()
    expect(hint).to_be_visible()
    assert desk.problems == []


def test_who_can_not_be_asked_about_another_place(desk: PanelPage) -> None:
    desk.panel.change("run", is_paused=True)
    text = "A person drives."
    desk.panel.replies["elsewhere"] = lambda _: {"type": "failed", "text": text, "problems": []}
    switch = desk.page.get_by_role("switch", name="Try another place")
    switch.click()
    expect(desk.page.get_by_role("alert").filter(has_text=text)).to_be_visible()
    expect(switch).to_have_attribute("aria-checked", "false")
    expect(desk.page.get_by_label("x (m)")).to_be_hidden()

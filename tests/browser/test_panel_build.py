"""The panel's tab "Build", with a fake panel."""

from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, expect

from tests.browser.tab_page import TabPage

RAYS = {
    "path": ["sensors", 0],
    "title": "Ray sensor",
    "class": "LinearRayCastingSensor",
    "icon": "rays",
    "reads": "nearest 1.2 m",
    "is_on": True,
    "can_up": False,
    "can_down": True,
    "children": [],
}
BUMPER = {
    **RAYS,
    "path": ["sensors", 1],
    "title": "Bumper",
    "class": "TouchSensor",
    "icon": "touch",
    "reads": "-1",
    "is_on": False,
    "can_up": True,
    "can_down": False,
}
BOTH = {
    **RAYS,
    "path": ["rewards", 0],
    "title": "All of these",
    "class": "AndRewardFunc",
    "icon": "row",
    "reads": "0",
    "adds": [{"title": "Reward", "kind": "rewards", "parent": ["rewards", 0, "children"]}],
    "children": [
        {
            **RAYS,
            "path": ["rewards", 0, "children", 0],
            "title": "Reach the target",
            "class": "TouchRewardFunc",
            "icon": "target",
            "reads": "",
        }
    ],
}
FORM = {
    "path": ["sensors", 0],
    "summary": "Distances of what a level fan of rays hits: a laser scanner.",
    "fields": [
        {"name": "eye", "label": "eye (m)", "kind": "number", "value": 0.5, "hint": "eye: height"},
        {
            "name": "number_of_rays",
            "label": "number of rays",
            "kind": "whole",
            "value": 15,
            "is_first": True,
        },
        {"name": "target", "label": "target", "kind": "choice", "value": "box", "choices": ["box"]},
        {"name": "return_code", "label": "return code", "kind": "switch", "value": True},
    ],
}
PART: dict[str, Any] = {
    "agent": "0",
    "driver": "brain:0",
    "kinds": {"sensors": [RAYS, BUMPER], "actuators": [], "rewards": [BOTH], "brains": []},
    "settings": [
        {"name": "skip_frame", "label": "skip frame", "kind": "whole", "value": 4},
        {"name": "priority", "label": "priority", "kind": "whole", "value": 0},
    ],
    "form": None,
    "undo": {"label": ""},
    "redo": {"label": ""},
}
DRIVERS = [
    {"name": "brain:0", "title": "Keys W, A, S, D", "reason": ""},
    {"name": "network:zoo:box_chase", "title": "Trained network", "reason": ""},
    {
        "name": "keys:StrikerController",
        "title": "Striker",
        "reason": "It needs a sensor with the name ball.",
    },
]
GALLERY = [
    {
        "class": "BearingSensor",
        "title": "Direction to ...",
        "question": "Where is ...?",
        "summary": "[sine, cosine] of the angle to the target.",
        "picture": "bearing",
        "reason": "",
    },
    {
        "class": "TouchSensor",
        "title": "Bumper",
        "question": "What do I touch?",
        "summary": "+1 while the agent touches the target, else -1.",
        "picture": "touch",
        "reason": "",
    },
    {
        "class": "LineSensor",
        "title": "Line sensor",
        "question": "What do I touch?",
        "summary": "A row of eyes that look down at the ground.",
        "picture": "line",
        "reason": "It needs an area. Add one in the World tab first.",
    },
]


@pytest.fixture
def tab(chromium: Browser) -> Iterator[TabPage]:
    tab = TabPage(chromium, "panel/build/tab", "BuildTab", "blocks")
    tab.answer("drivers", items=DRIVERS)
    tab.give(PART)
    tab.page.wait_for_function("panel.sent.length === 1")
    assert tab.sent() == [{"command": "drivers"}]
    yield tab
    tab.close()
    assert tab.errors == []


def commands(tab: TabPage) -> list[dict[str, Any]]:
    """Return the commands since the last call, without the request for drivers.

    The tab sends that some time after a change of the blocks.
    """
    return [sent for sent in tab.sent() if sent["command"] != "drivers"]


def card(tab: TabPage, title: str) -> Any:
    return tab.page.locator("article").filter(has_text=title).last


def test_blocks_are_cards_with_what_they_read(tab: TabPage) -> None:
    expect(card(tab, "Ray sensor")).to_contain_text("nearest 1.2 m")
    expect(card(tab, "Bumper")).to_contain_text("off")
    expect(tab.page.get_by_text("It can't do anything yet.")).to_be_visible()
    expect(tab.page.get_by_text("LinearRayCastingSensor")).to_be_hidden()
    tab.give({**PART, "kinds": {**PART["kinds"], "sensors": [{**RAYS, "reads": "nearest 0.4 m"}]}})
    expect(card(tab, "Ray sensor")).to_contain_text("nearest 0.4 m")
    expect(card(tab, "Bumper")).to_have_count(0)


def test_a_click_opens_the_form_with_the_fields_that_matter(tab: TabPage) -> None:
    tab.head("Ray sensor").click()
    assert tab.shown["block"] == ["sensors", 0]
    tab.give({**PART, "form": FORM})
    rays = tab.page.get_by_label("number of rays")
    expect(rays).to_have_value("15")
    expect(tab.page.get_by_label("eye (m)")).to_be_hidden()
    card(tab, "Ray sensor").get_by_text("More", exact=True).click()
    expect(tab.page.get_by_label("eye (m)")).to_be_visible()
    commands(tab)
    rays.fill("9")
    rays.press("Enter")
    (change,) = commands(tab)
    assert change == {
        "command": "change_block",
        "path": ["sensors", 0],
        "values": {"number_of_rays": "9"},
    }


def test_a_problem_is_told_below_its_field(tab: TabPage) -> None:
    tab.head("Ray sensor").click()
    tab.give({**PART, "form": FORM})
    problem = {"path": ["number_of_rays"], "text": "expected at least 1, got -3"}
    tab.answer("change_block", ok=False, text="That can't be.", problems=[problem])
    rays = tab.page.get_by_label("number of rays")
    rays.fill("-3")
    rays.press("Enter")
    expect(tab.page.get_by_role("alert").filter(has_text="at least 1")).to_be_visible()
    tab.give({**PART, "form": FORM})
    expect(rays).to_have_value("-3")


def test_blocks_are_switched_ordered_copied_and_deleted(tab: TabPage) -> None:
    tab.page.get_by_role("button", name="Turn on Bumper").click()
    tab.head("Bumper").click()
    expect(tab.page.get_by_role("button", name="Move down Bumper")).to_be_disabled()
    tab.answer("move_block", path=["sensors", 0])
    tab.page.get_by_role("button", name="Move up Bumper").click()
    assert commands(tab) == [
        {"command": "switch_block", "path": ["sensors", 1], "on": True},
        {"command": "move_block", "path": ["sensors", 1], "by": -1},
    ]
    assert tab.shown["block"] == ["sensors", 0]
    moved = [{**BUMPER, "path": ["sensors", 0]}, {**RAYS, "path": ["sensors", 1]}]
    tab.give({**PART, "kinds": {**PART["kinds"], "sensors": moved}})
    tab.page.get_by_role("button", name="Duplicate Bumper").click()
    tab.page.get_by_role("button", name="Delete Bumper").click()
    assert [sent["command"] for sent in commands(tab)] == ["duplicate_block", "remove_block"]
    assert tab.shown["block"] is None


def test_a_keyboard_reorders_too(tab: TabPage) -> None:
    bumper = tab.head("Bumper")
    bumper.focus()
    bumper.press("Alt+ArrowDown")
    bumper.press("Alt+ArrowUp")
    assert [sent["by"] for sent in commands(tab)] == [-1]


def test_parts_of_a_block_have_cards_of_their_own(tab: TabPage) -> None:
    tab.head("All of these").click()
    tab.head("Reach the target").click()
    assert tab.shown["block"] == ["rewards", 0, "children", 0]
    form = {**FORM, "path": ["rewards", 0, "children", 0], "fields": FORM["fields"][:1]}
    tab.give({**PART, "form": form})
    expect(tab.page.get_by_label("eye (m)")).to_be_visible()
    expect(tab.head("All of these")).to_have_attribute("aria-expanded", "true")


def test_the_gallery_asks_questions_and_gives_reasons(tab: TabPage) -> None:
    tab.answer("gallery", items=GALLERY)
    tab.answer("add_block", path=["sensors", 2])
    tab.page.get_by_role("button", name="Add a sensor").click()
    gallery = tab.page.get_by_role("dialog")
    expect(gallery.get_by_role("heading", name="Where is ...?")).to_be_visible()
    expect(gallery.locator("svg.ai4u-picture")).to_have_count(3)
    line = gallery.get_by_role("button", name="Line sensor")
    expect(line).to_be_hidden()
    gallery.get_by_text("Not for this robot (1)").click()
    expect(line).to_contain_text("It needs an area.")
    expect(line).to_have_attribute("aria-disabled", "true")
    line.click(force=True)
    expect(gallery).to_be_visible()
    gallery.get_by_role("button", name="Bumper").click()
    expect(gallery).to_have_count(0)
    assert commands(tab) == [
        {"command": "gallery", "kind": "sensors"},
        {"command": "add_block", "class": "TouchSensor", "parent": ["sensors"]},
    ]
    assert tab.shown["block"] == ["sensors", 2]


def test_a_block_is_added_into_another_one(tab: TabPage) -> None:
    tab.answer("gallery", items=GALLERY)
    tab.head("All of these").click()
    card(tab, "All of these").get_by_role("button", name="Reward", exact=True).click()
    tab.page.get_by_role("dialog").get_by_role("button", name="Bumper").click()
    assert commands(tab)[-1]["parent"] == ["rewards", 0, "children"]


def test_drivers_are_tried_again_after_a_change_only(tab: TabPage) -> None:
    tab.give({**PART, "kinds": {**PART["kinds"], "sensors": [{**RAYS, "reads": "nearest 0.4 m"}]}})
    tab.page.wait_for_function("panel.sent.length === 1")
    assert tab.sent() == [{"command": "drivers"}]
    tab.give({**PART, "kinds": {**PART["kinds"], "sensors": [{**RAYS, "reads": "nearest 0.1 m"}]}})
    # real time: however busy a page is, this timer ends after a shorter one that began before
    tab.page.evaluate("new Promise((done) => setTimeout(done, 400))")
    assert tab.sent() == []


def test_drivers_of_another_scene_are_not_offered(tab: TabPage) -> None:
    options = tab.page.get_by_label("Driven by").locator("option")
    expect(options).to_have_count(len(DRIVERS))
    tab.answer("drivers", items=DRIVERS[:1])
    shown = options.first.evaluate(  # at once: the drivers of the new scene come soon
        """(option) => {
          const box = option.parentElement;
          panel.give("scene", { scene: "donut" });
          return [...box.options].map((each) => each.text);
        }"""
    )
    assert shown == ["…"]
    expect(options).to_have_text([DRIVERS[0]["title"]])
    assert tab.sent() == [{"command": "drivers"}]
    tab.page.evaluate("panel.give('scene', { scene: 'donut', title: 'Donut' })")
    assert options.all_inner_texts() == [DRIVERS[0]["title"]]


def test_a_driver_is_chosen_and_one_that_can_not_drive_is_grey(tab: TabPage) -> None:
    driver = tab.page.get_by_label("Driven by")
    expect(driver).to_have_value("brain:0")
    striker = driver.locator("option", has_text="Striker")
    expect(striker).to_be_disabled()
    expect(striker).to_contain_text("It needs a sensor with the name ball.")
    group = driver.locator("optgroup")
    expect(group).to_have_attribute("label", "Not for this robot")
    expect(group.locator("option")).to_have_count(1)
    tab.answer("driver", ok=False, text="It can't.")
    driver.select_option("network:zoo:box_chase")
    assert commands(tab) == [{"command": "driver", "name": "network:zoo:box_chase"}]
    expect(driver).to_have_value("brain:0")


@pytest.mark.parametrize(("pointer", "smallest"), [("fine", 28), ("coarse", 40)])
def test_controls_are_large_enough_and_have_names(
    chromium: Browser, pointer: str, smallest: float
) -> None:
    is_touch = pointer == "coarse"
    tab = TabPage(
        chromium,
        "panel/build/tab",
        "BuildTab",
        "blocks",
        size=(390, 844),
        has_touch=is_touch,
        is_mobile=is_touch,
    )
    tab.answer("drivers", items=DRIVERS)
    tab.give(PART)
    tab.head("Ray sensor").click()
    tab.give({**PART, "form": FORM})
    tab.page.get_by_text("Robot settings").click()
    assert tab.small_controls(smallest) == []
    assert tab.unnamed_controls() == []
    tab.close()

"""The teacher's wall in the browser: order, filter, keyboard, and what it sends and doesn't."""

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Locator, Page, expect

from tests.browser.schemes import SCHEMES
from tests.browser.wall_data import CODE, MARKUP, class_message, name_of, race
from tests.browser.wall_server import WallServer, wall_server
from tests.chromium import close_page, quick_page, until_on
from tests.waiting import until

pytestmark = pytest.mark.browser

COUNT = 12
GRAVE = {"serious", "critical"}
ABOUT_TESTS = ("Failed to load resource", "WebSocket connection", "Canvas2D: Multiple readback")
"""Beginnings of messages of the browser about tests."""
STAND_STILL = "() => { const now = performance.now(); performance.now = () => now; }"
"""Page script: the time by which a page counts stands still."""
REAL_NAME = "Ada Lovelace-Byron"


@pytest.fixture(scope="module")
def server() -> Iterator[WallServer]:
    with wall_server(COUNT) as server:
        yield server


@pytest.fixture
def school(server: WallServer) -> WallServer:
    """Return the server of a class in which nothing has happened yet."""
    server.reset()
    return server


@pytest.fixture(scope="module")
def opened(chromium: Browser, server: WallServer) -> Iterator[Page]:
    page = quick_page(chromium)
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.on("console", lambda line: errors.append(line.text))
    page.goto(f"{server.url}teacher")
    yield page
    close_page(page)
    assert [each for each in errors if not each.startswith(ABOUT_TESTS)] == []


@pytest.fixture
def page(opened: Page, school: WallServer) -> Page:
    """Return the teacher's page of that class."""
    opened.mouse.move(5, 5)
    opened.evaluate("document.querySelectorAll('dialog').forEach((each) => each.close())")
    opened.evaluate("document.querySelector('#gone').open = false")
    opened.evaluate("document.activeElement.blur()")
    opened.get_by_role("tab", name="Wall").click()
    opened.get_by_role("button", name="All", exact=False).first.click()
    opened.get_by_label("Sort").select_option("help")
    # its own state may look like that of the test before: it is there once another one is gone
    school.push({**school.state, "problem": "Of no test"})
    expect(opened.locator("#status")).to_have_text("Of no test")
    school.push(school.state)
    school.draw()
    expect(opened.locator("#status")).not_to_have_text("Of no test")
    expect(cards(opened)).to_have_count(COUNT)
    opened.evaluate(FIRST_IS_STOP)
    return opened


FIRST_IS_STOP = """() =>
    document.querySelectorAll("#wall button").forEach((each, at) => (each.tabIndex = at ? -1 : 0))
"""
"""The first card is the stop of the Tab key, as in a page that was just opened."""


def cards(page: Page) -> Locator:
    return page.get_by_role("list", name="Rooms").get_by_role("button")


def names(page: Page) -> list[str]:
    return page.locator(".ai4u-room-name").all_inner_texts()


def rooms_with(**changes: Any) -> list[dict[str, Any]]:
    """Return all rooms without need of help, but the last one changed."""
    rooms = class_message(COUNT)["rooms"]
    calm = [room | {"help": 0, "why": "", "status": "driving"} for room in rooms]
    return [*calm[:-1], calm[-1] | changes]


def test_who_needs_help_comes_first_but_not_under_the_pointer(
    page: Page, school: WallServer
) -> None:
    school.send(rooms=rooms_with(help=70, why="fell 8 times", status="fell"))
    last = name_of(COUNT)
    expect(page.locator(".ai4u-room-name").first).to_have_text(last)
    expect(cards(page).first).to_contain_text("fell 8 times")
    label = f"{last}, fell, solved before, fell 8 times, Box chase"
    expect(page.get_by_role("button", name=label)).to_be_visible()

    second = names(page)[1]
    page.evaluate(STAND_STILL)  # a pointer that rests holds the order for a while only
    cards(page).nth(1).hover()
    school.send(rooms=rooms_with())
    expect(page.get_by_text("fell 8 times")).to_have_count(0)
    assert names(page)[:2] == [last, second]
    page.evaluate("delete performance.now")
    page.mouse.move(5, 5)
    school.send(rooms=rooms_with())
    expect(page.locator(".ai4u-room-name").first).not_to_have_text(last)
    assert names(page) == sorted(names(page))

    page.get_by_label("Sort").select_option("name")
    school.send(rooms=rooms_with(help=90, why="fell 9 times"))
    expect(page.get_by_text("fell 9 times")).to_have_count(1)
    assert names(page) == sorted(names(page))


def test_cards_keep_their_places_when_a_strip_appears(
    chromium: Browser, school: WallServer
) -> None:
    school.state = class_message(4)
    page = quick_page(chromium, 1400, 900)
    page.goto(f"{school.url}teacher")
    expect(cards(page)).to_have_count(4)
    page.evaluate("document.fonts.ready.then(() => 0)")
    columns = "getComputedStyle(document.querySelector('#wall ul')).gridTemplateColumns.split(' ')"
    before = page.evaluate(columns)
    assert len(before) == 2
    school.send(attention={"kind": "pause", "message": "Look", "ends_in": 0.0}, race=race(3))
    expect(page.get_by_role("button", name="End race")).to_be_visible()
    page.evaluate(
        "() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)))"
    )
    assert len(page.evaluate(columns)) == len(before)
    close_page(page)


def test_filters_count_and_keep(page: Page, school: WallServer) -> None:
    school.send(rooms=rooms_with(status="asleep"))
    page.get_by_role("button", name="Asleep 1").click()
    expect(cards(page)).to_have_count(1)
    page.get_by_role("button", name="Needs help 0").click()
    expect(cards(page)).to_have_count(0)
    expect(page.get_by_text("No room now: “Needs help”.")).to_be_visible()


def test_a_room_is_reached_and_sent_out_by_keyboard(page: Page, school: WallServer) -> None:
    page.get_by_label("Size").focus()
    page.keyboard.press("Tab")
    expect(cards(page).first).to_be_focused()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowLeft")
    expect(cards(page).nth(1)).to_be_focused()
    name = names(page)[1]
    page.keyboard.press("Enter")
    seat = next(seat for seat in school.state["seats"] if seat["name"] == name)
    dialog = page.get_by_role("dialog", name=name)
    look_in = dialog.get_by_role("link", name="Look in")
    expect(look_in).to_have_attribute("href", f"./r/{seat['room']}/")
    dialog.get_by_role("button", name=f"Send out {name}").press("Enter")
    question = page.get_by_role("dialog", name=f"Send {name} out?")
    question.get_by_role("button", name="Send out").press("Enter")
    expect(dialog).to_have_count(0)
    kick = {"do": "kick", "seat": seat["number"]}
    until(lambda: school.commands == [kick])
    expect(cards(page).nth(1)).to_be_focused()

    page.keyboard.press("Enter")
    dialog.get_by_role("button", name=f"Rename {name}").press("Enter")
    page.get_by_label("Calm Owl").check()
    page.get_by_role("button", name="Rename", exact=True).click()
    expect(page.get_by_role("dialog")).to_have_count(0)
    assert school.commands == [kick, {**kick, "do": "rename", "name": "Calm Owl"}]


def test_a_ban_sets_a_new_code_unless_the_teacher_keeps_it(page: Page, school: WallServer) -> None:
    name = names(page)[0]
    seat = next(seat["number"] for seat in school.state["seats"] if seat["name"] == name)
    for keeps in (False, True):
        cards(page).first.click()
        page.get_by_role("button", name=f"Ban {name}").click()
        if keeps:
            page.get_by_label("Keep the code").check()
        page.get_by_role("button", name="Ban", exact=True).click()
        expect(page.get_by_role("dialog")).to_have_count(0)
        assert school.commands[-1] == {"do": "ban", "seat": seat, "new_code": not keeps}


def test_a_seat_is_forgotten_with_its_real_name(page: Page, school: WallServer) -> None:
    here, gone = school.state["seats"][0], {**school.state["seats"][1], "state": "banned"}
    school.send(seats=[here, gone, *school.state["seats"][2:]])
    load_names(page, f"{here['name']},Ada Lovelace\n{gone['number']},Grace Hopper\n9,Alan Turing\n")
    page.get_by_text("No longer here (1)").click()
    page.get_by_role("button", name=f"Forget {gone['name']}").click()
    question = page.get_by_role("dialog", name=f"Forget {gone['name']}?")
    question.get_by_role("button", name="Cancel").click()
    assert school.commands == []
    page.get_by_role("button", name=f"Forget {gone['name']}").click()
    question.get_by_role("button", name="Forget").click()
    page.get_by_role("button", name="Ada Lovelace").click()
    page.get_by_role("button", name=f"Forget {here['name']}").click()
    page.get_by_role("button", name="Forget", exact=True).click()
    expect(page.get_by_role("dialog")).to_have_count(0)
    forgotten = [{"do": "forget seat", "seat": seat["number"]} for seat in (gone, here)]
    assert school.commands == forgotten
    # the class answers that the seat is forgotten, and then its name is, too
    stored = "JSON.parse(localStorage.getItem('ai4u-real-names'))"
    until_on(page, lambda: page.evaluate(stored) == {"9": "Alan Turing"})


def load_names(page: Page, table: str) -> None:
    """Load real names in the teacher's page, from lines of a table."""
    page.get_by_role("button", name="Real names…").click()
    file = {"name": "class.csv", "mimeType": "text/csv", "buffer": table.encode()}
    dialog = page.get_by_role("dialog", name="Real names")
    dialog.get_by_label("Table").set_input_files(file)  # type: ignore[arg-type]
    dialog.get_by_role("button", name="Load").click()


def test_the_teacher_gets_a_code_for_a_seat_that_is_gone(page: Page, school: WallServer) -> None:
    gone = {**school.state["seats"][0], "state": "banned"}
    school.answer = {"code": "KVBTM", "minutes": 5}
    school.send(seats=[gone, *school.state["seats"][1:]])
    page.get_by_text("No longer here (1)").click()
    page.get_by_role("button", name=f"Code for {gone['name']}").click()
    expect(page.get_by_role("heading", name=f"Code for {gone['name']}: KVBTM")).to_be_visible()
    assert school.commands == [{"do": "move code", "seat": gone["number"]}]


def test_programs_of_a_room_are_read_as_text(page: Page, school: WallServer) -> None:
    source = f"# {MARKUP}\n\ndef decide(percept):\n    return {{'move': [1, 0]}}\n"
    facts = {"scene": MARKUP, "agent": "0", "age": 130.0}
    school.programs = [
        {"seat": 1, "name": MARKUP, "source": source, **facts},
        {"seat": 2, "name": "Calm Owl", "source": None},
    ]
    name = names(page)[0]
    cards(page).first.click()
    page.get_by_role("button", name="Code", exact=True).click()
    dialog = page.get_by_role("dialog", name=f"Code: {name}")
    shown = dialog.get_by_label(f"Program of {MARKUP}")
    expect(shown).to_be_visible()
    assert shown.text_content() == source
    heads = dialog.get_by_role("heading", level=3)
    expect(heads).to_have_text(
        [f"{MARKUP} {MARKUP} · changed 2 minutes ago", "Calm Owl no program yet"]
    )
    assert dialog.locator("img, textarea, input, [contenteditable]").count() == 0
    assert findings(page) == []

    school.programs[1] |= {"source": "pass\n", "scene": "maze", "agent": "1", "age": 0.2}
    dialog.get_by_role("button", name="Refresh").click()
    expect(heads.last).to_have_text("Calm Owl Corner maze · robot 1 · changed just now")
    school.problem = "The class's file can't be read."
    dialog.get_by_role("button", name="Refresh").click()
    expect(dialog.get_by_role("alert").first).to_have_text("The class's file can't be read.")
    expect(shown).to_be_visible()
    dialog.get_by_role("button", name="Close").click()


def test_mistakes_in_programs_come_first_and_all_programs_are_seen(
    page: Page, school: WallServer
) -> None:
    text = f"nothing is called {MARKUP!r}"
    school.programs = [
        {"seat": seat, "name": "", "source": source, "scene": "maze", "agent": "0", "age": 5.0}
        for seat, source in ((1, "# first\ndef decide(percept):\n    return x\n"), (2, "pass\n"))
    ]
    why = f"program stopped: line 3: {text}"
    first, second = (seat["name"] for seat in school.state["seats"][:2])
    rooms = rooms_with(status="mistake", help=92, why=why)
    rooms[0], rooms[-1] = {**rooms[0], "seats": [1]}, rooms[-1]
    mistakes = {
        "kind": "unknown-name",
        "title": "A name that has no value",
        "count": 4,
        "seats": [1],
        "examples": [text],
        "guide": "Is it spelled the same?",
    }
    run = {"state": "mistake", "text": text, "line": 3}
    running = {"state": "running", "text": "", "line": 0}
    school.send(rooms=rooms, runs={"1": run, "2": running}, program_mistakes=[mistakes])
    expect(cards(page).first).to_contain_text(why)
    expect(cards(page).first).to_contain_text("program stopped")
    page.get_by_role("tab", name="Programs (1 stopped)").click()
    board = page.get_by_role("tabpanel", name="Programs")
    expect(board.get_by_role("article")).to_contain_text(["Is it spelled the same?"])
    expect(board.get_by_role("article")).to_contain_text([first])
    glances = board.get_by_role("listitem")
    expect(glances).to_have_count(2)
    expect(glances.first).to_contain_text(f"line 3: {text}")
    expect(glances.first.locator("[data-mistake]")).to_have_text("    return x")
    expect(glances.last).to_contain_text(second)
    expect(glances.last).to_contain_text("runs")
    assert findings(page) == []
    glances.first.get_by_role("button").click()
    expect(page.get_by_role("dialog", name=f"Code: {first}")).to_be_visible()
    page.get_by_role("dialog").get_by_role("button", name="Close").click()
    page.get_by_role("tab", name="Wall").click()


def test_a_click_counts_though_a_program_stops_before_it_is_let_go(
    page: Page, school: WallServer
) -> None:
    school.programs = [
        {"seat": seat, "name": "", "source": "pass\n", "scene": "maze", "agent": "0", "age": 5.0}
        for seat in (1, 2)
    ]
    first, second = (seat["name"] for seat in school.state["seats"][:2])
    page.get_by_role("tab", name="Programs").click()
    glances = page.get_by_role("tabpanel", name="Programs").get_by_role("listitem")
    expect(glances).to_contain_text([first, second])
    glances.first.hover()
    page.mouse.down()
    stopped = {"state": "mistake", "text": "nothing is called x", "line": 1}
    school.send(runs={"2": stopped})
    expect(page.get_by_role("tab", name="Programs (1 stopped)")).to_be_visible()
    page.mouse.up()
    dialog = page.get_by_role("dialog", name=f"Code: {first}")
    expect(dialog).to_be_visible()
    dialog.get_by_role("button", name="Close").click()
    expect(glances).to_contain_text([second, first])
    page.get_by_role("tab", name="Wall").click()


def test_attention_is_begun_shown_and_ended(page: Page, school: WallServer) -> None:
    page.get_by_role("button", name="Attention…").click()
    dialog = page.get_by_role("dialog", name="Attention")
    dialog.get_by_label("Blank all").check()
    dialog.get_by_role("textbox", name="Message").fill("Eyes to the front")
    dialog.get_by_label("How long").select_option(label="for 2 minutes")
    school.problem = "This class has ended."
    dialog.get_by_role("button", name="Begin").click()
    expect(dialog.get_by_role("alert")).to_have_text("This class has ended.")
    school.problem = ""
    dialog.get_by_role("button", name="Begin").click()
    expect(dialog).to_have_count(0)
    wanted = {"kind": "blank", "message": "Eyes to the front", "seconds": 120}
    assert school.commands[-1] == {"do": "attention", **wanted}

    school.send(attention={"kind": "blank", "message": "Eyes to the front", "ends_in": 100.0})
    expect(page.locator("#held")).to_contain_text("All screens are blank.“Eyes to the front” Ends")
    page.get_by_role("button", name="End attention").click()
    until(lambda: len(school.commands) == 3)
    assert school.commands[-1] == {"do": "attention", "kind": "", "message": "", "seconds": 0}


def test_scenes_are_assigned_to_chosen_rooms_and_raced(page: Page, school: WallServer) -> None:
    page.get_by_role("button", name="Assign a scene…").click()
    dialog = page.get_by_role("dialog", name="Assign a scene")
    expect_picture(dialog, "Box chase from above")
    dialog.get_by_label("Which scene").select_option(label="Corner maze")
    expect_picture(dialog, "Corner maze from above")
    expect(dialog.get_by_role("button", name="Assign")).to_be_in_viewport()
    dialog.get_by_label("Some rooms").check()
    dialog.get_by_role("button", name="Assign").click()
    expect(dialog.get_by_role("alert")).to_have_text("Choose at least one room.")
    dialog.get_by_label(name_of(2), exact=True).check()
    dialog.get_by_role("button", name="Assign").click()
    expect(dialog).to_have_count(0)
    wanted = {"rooms": ["room2"], "scene": "maze", "seed": None, "same_seed": True}
    assert school.commands == [{"do": "assign", **wanted}]

    page.get_by_role("button", name="Assign a scene…").click()
    dialog.get_by_label("A lesson").check()
    expect_picture(dialog, "Box chase from above")
    dialog.get_by_label("Which lesson").select_option(label="03 Build an agent")
    expect(dialog.get_by_role("img")).to_have_count(0)
    dialog.get_by_text("More: start and program").click()
    dialog.get_by_label("Starting program (Python)").fill("def decide(percept):\n    return {}\n")
    dialog.get_by_role("button", name="Assign").click()
    expect(dialog).to_have_count(0)
    lesson = {"rooms": "all", "scene": {"lesson": "03"}, "seed": None, "same_seed": True}
    program = "def decide(percept):\n    return {}\n"
    assert school.commands[-1] == {"do": "assign", **lesson, "program": program}

    page.get_by_role("button", name="Assign a scene…").click()
    dialog.get_by_label("A mission").check()
    dialog.get_by_label("Which mission").select_option(label="Sense: Who sees what?")
    dialog.get_by_role("button", name="Assign").click()
    expect(dialog).to_have_count(0)
    mission = {"rooms": "all", "scene": {"mission": "sense-1"}, "seed": None, "same_seed": True}
    assert school.commands[-1] == {"do": "assign", **mission}

    page.get_by_role("button", name="Race…").click()
    dialog = page.get_by_role("dialog", name="Race")
    dialog.get_by_label("My own file").check()
    file = {"name": "own.yaml", "mimeType": "text/yaml", "buffer": b"title: Mine\nbodies: []\n"}
    dialog.get_by_label("Scene file (YAML)").set_input_files(file)  # type: ignore[arg-type]
    dialog.get_by_label("Seed").fill("7")
    dialog.get_by_role("button", name="Start the countdown").click()
    expect(dialog).to_have_count(0)
    scene = {"yaml": "title: Mine\nbodies: []\n"}
    start = {"scene": scene, "seed": 7, "countdown": 10, "hide_board": False}
    assert school.commands[-1] == {"do": "race", **start}
    refused = {**race(1)["board"][0], "outcome": "refused", "why": "another seed"}
    school.send(race={**race(2), "board": [*race(2)["board"], refused]})
    strip = page.locator("#running-race")
    expect(strip).to_contain_text(f"1. {name_of(3)} 12.4 s   2. {name_of(4)} 14.1 s   Refused")
    page.get_by_role("button", name="End race").click()
    until(lambda: school.commands[-1] == {"do": "end race"})


def expect_picture(dialog: Locator, text: str) -> None:
    """Expect one picture with this text, which is really there."""
    picture = dialog.get_by_role("img")
    expect(picture).to_have_accessible_name(text)
    until(lambda: picture.evaluate("each => each.naturalWidth") == 400)


def test_the_teacher_sees_who_is_where_in_the_missions(page: Page, school: WallServer) -> None:
    card = page.locator("button.ai4u-room").filter(has_text=name_of(4))
    expect(card).to_contain_text("First drive 2/4")
    expect(card).to_have_accessible_name(re.compile("First drive 2/4"))
    card.click()
    dialog = page.get_by_role("dialog", name=name_of(4))
    expect(dialog).to_contain_text("First drive 2/4, for 6 minutes, It fell.")
    dialog.get_by_role("button", name="Close").click()
    page.get_by_role("tab", name="Progress").click()
    table = page.get_by_role("region", name="Missions")
    expect(table.get_by_role("columnheader")).to_have_text(
        ["Missions", "First drive", "Round the ring"]
    )
    row = table.get_by_role("row", name=name_of(3))
    expect(row).to_contain_text("1 done · now First drive 3/4")
    expect(row.get_by_role("img", name="2 of 3 stars")).to_be_visible()
    expect(table.get_by_role("row", name=name_of(4))).to_contain_text("1/4")
    last = school.state["mission_places"]["3"] | {"step": 3, "is_done": True}
    school.send(mission_places={"3": last})
    expect(row).to_contain_text("now First drive ✓")


def test_real_names_are_shown_and_never_sent(page: Page, school: WallServer) -> None:
    requests: list[str] = []
    page.on("request", lambda each: requests.append(f"{each.url} {each.post_data} {each.headers}"))
    load_names(page, f'name,real name\n"{name_of(1)}","{REAL_NAME}"\n2;Grace Hopper\n')
    expect(page.get_by_role("button", name=f"{name_of(1)}, {REAL_NAME}")).to_be_visible()
    page.get_by_role("button", name="Grace Hopper").click()
    page.get_by_role("button", name="Show to all").click()
    page.get_by_role("tab", name="Progress").click()
    expect(page.get_by_role("row", name=REAL_NAME).first).to_be_visible()
    stars = page.get_by_role("region", name="Stars of programs")
    expect(stars.get_by_role("columnheader")).to_have_text(
        ["Stars of programs", "Box chase", "Corner maze"]
    )
    expect(stars.get_by_role("row", name=name_of(3))).to_contain_text("★★★★☆☆")
    expect(stars.get_by_role("img", name="2 of 3 stars")).to_be_visible()
    until(lambda: school.commands != [])
    assert requests
    assert [each for each in requests if "Hopper" in each or "Lovelace" in each] == []
    assert "Lovelace" not in json.dumps(school.commands)

    page.get_by_role("button", name="Real names…").click()
    page.get_by_role("button", name="Forget all real names").click()
    page.get_by_role("button", name="Close").click()
    expect(page.get_by_text(REAL_NAME)).to_have_count(0)
    stored = page.evaluate("JSON.stringify({...localStorage})")
    assert "Lovelace" not in stored


def test_everything_is_forgotten_only_after_export_and_code(page: Page, school: WallServer) -> None:
    page.get_by_role("button", name="End class…").click()
    dialog = page.get_by_role("dialog", name="End class")
    forget = dialog.get_by_role("button", name="Forget everything")
    forget.click()
    expect(dialog.get_by_role("alert")).to_contain_text("Export first")
    dialog.get_by_label("I have the file").check()
    dialog.get_by_label("Type the code").fill("wrong")
    forget.click()
    expect(dialog.get_by_role("alert")).to_contain_text(CODE)
    assert school.commands == []
    dialog.get_by_label("Type the code").fill(CODE.lower())
    forget.click()
    expect(dialog).to_have_count(0)
    assert school.commands == [{"do": "forget"}]


def test_text_is_never_html_and_a_lost_connection_is_told(page: Page, school: WallServer) -> None:
    state = class_message(COUNT)
    state["seats"][0]["name"] = MARKUP
    state["misconceptions"][0]["sentence"] = MARKUP
    state["rooms"][0]["scene"] = MARKUP
    school.send(**state)
    expect(page.get_by_role("button", name=MARKUP)).to_have_count(1)
    page.get_by_role("tab", name="Misconceptions").click()
    expect(page.locator("#view-mistakes").get_by_text(MARKUP).first).to_be_visible()
    assert page.locator("img").count() == 1  # the QR code

    page.context.set_offline(True)
    expect(page.get_by_role("alert").first).to_contain_text("The class can't be reached.")
    page.context.set_offline(False)
    expect(page.locator("#status")).to_be_empty()
    connections = school.connections
    school.drop()
    until_on(page, lambda: school.connections > connections)
    expect(page.locator("#status")).to_be_empty()
    expect(cards(page)).to_have_count(0)  # of the hidden tab
    page.get_by_role("tab", name="Wall").click()
    expect(cards(page)).to_have_count(COUNT)


def test_worlds_are_drawn_where_their_cards_are(page: Page, school: WallServer) -> None:
    """The canvas has a picture in each card, and moves."""
    drawn = """() => {
        const canvas = document.querySelector("#wall canvas");
        const at = canvas.getBoundingClientRect();
        const scale = canvas.width / at.width;
        return [...document.querySelectorAll(".ai4u-room-picture")].map((each) => {
            const box = each.getBoundingClientRect();
            const place = [box.left - at.left, box.top - at.top, box.width, box.height];
            const data = canvas.getContext("2d").getImageData(...place.map((x) => x * scale)).data;
            let sum = 0;
            for (let i = 0; i < data.length; i += 1) sum = (31 * sum + data[i]) % 1000003;
            return data[4 * Math.floor(data.length / 8) + 3] && sum;
        });
    }"""
    until(lambda: 0 not in page.evaluate(drawn))
    first = page.evaluate(drawn)
    moving = [room["status"] == "driving" for room in school.state["rooms"]]
    assert any(moving)
    until(lambda: sum(a != b for a, b in zip(first, page.evaluate(drawn), strict=True)) >= 3)


@pytest.mark.parametrize("scheme", SCHEMES)
def test_the_pages_have_no_grave_finding(
    chromium: Browser, school: WallServer, scheme: Any, tmp_path: Path
) -> None:
    school.state = class_message(
        COUNT,
        race=race(3),
        attention={"kind": "pause", "message": "Look", "ends_in": 0.0},
        shown={"kind": "race", "room": ""},
    )
    page = quick_page(chromium, color_scheme=scheme)
    page.goto(f"{school.url}teacher")
    expect(cards(page)).to_have_count(COUNT)
    found = {"wall": findings(page)}
    for tab in ("Progress", "Misconceptions", "Programs"):
        page.get_by_role("tab", name=tab).click()
        found[tab] = findings(page)
    page.get_by_role("button", name="Assign a scene…").click()
    found["dialog"] = findings(page)
    for name in ("projector", "check", "privacy", "join"):
        page.goto(f"{school.url}{name}")
        page.wait_for_load_state("networkidle") if name == "check" else None
        found[name] = findings(page)
    assert {name: each for name, each in found.items() if each} == {}
    close_page(page)


def findings(page: Page) -> list[str]:
    """Return axe-core's grave findings in a page."""
    return [
        f"{each['id']}: {each['help']}: {[node['html'][:160] for node in each['nodes']]}"
        for each in Axe().run(page).response["violations"]
        if each["impact"] in GRAVE
    ]


def test_the_projector_follows_the_teacher(chromium: Browser, school: WallServer) -> None:
    page = quick_page(chromium)
    page.goto(f"{school.url}projector")
    expect(page.locator("#code")).to_have_text(CODE)
    expect(page.get_by_text(f"{COUNT} students are here")).to_be_visible()
    names = page.get_by_role("list", name="Students who are here").get_by_role("listitem")
    expect(names).to_have_count(COUNT)
    expect(names.first).to_have_text(name_of(1))
    school.send(shown={"kind": "room", "room": "room5"})
    expect(page.locator("#wall li")).to_have_count(1)
    expect(page.locator("#wall")).to_contain_text(name_of(5))
    page.evaluate(STAND_STILL)
    school.send(shown={"kind": "race", "room": ""}, race=race(0, "countdown", 8.0))
    expect(page.get_by_role("timer")).to_have_text("8")
    page.evaluate("() => { const now = performance.now() + 1000; performance.now = () => now; }")
    expect(page.get_by_role("timer")).to_have_text("7")
    school.send(race=race(9))
    expect(page.locator("#board li")).to_have_count(9)
    expect(page.locator("#board li").first).to_contain_text("12.4 s")
    expect(page.locator("#race .ai4u-podium")).to_be_hidden()
    school.send(race=race(9, "over"))
    steps = page.locator("#race .ai4u-podium > li")
    expect(steps).to_contain_text(["12.4 s", "14.1 s", "15.8 s"])
    expect(steps.first).to_contain_text(name_of(3))
    expect(page.locator("#board li")).to_have_count(6)
    expect(page.locator("#board li").first).to_contain_text("17.5 s")
    expect(page.get_by_role("button", name="Sound")).to_have_attribute("aria-pressed", "false")
    school.send(race={**race(9), "is_board_hidden": True})
    expect(page.locator("#board li")).to_have_count(0)
    school.send(shown={"kind": "board", "room": ""})
    expect(page.locator("#wall li")).to_have_count(COUNT)
    expect(page.locator("#wall [data-help]")).to_have_count(0)
    close_page(page)

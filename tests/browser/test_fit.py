"""The pages in Portuguese, in a wide and a narrow window: nothing is cut, nothing is English."""

from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, expect

from ai4u_edu.locale import LIBRARY, Catalogue
from ai4u_edu.missions.mission import library_missions
from tests.browser.fit import cut_texts, english_texts
from tests.browser.panel_page import CANVAS
from tests.browser.wall_data import handed_in, race, tournament
from tests.browser.wall_server import WallServer, wall_server
from tests.chromium import new_page
from tests.playing import Played, played

pytestmark = pytest.mark.browser

LANGUAGE = "pt_BR"
BROWSER: dict[str, Any] = {"locale": "pt-BR", "extra_http_headers": {"Accept-Language": "pt-BR"}}
SIZES = pytest.mark.parametrize(("width", "height"), [(1280, 800), (390, 844)])
TABS = ("Dirigir", "Montar", "Mundo", "Código", "Passado", "Ensinar")
OPEN_CARDS = """(tab) => [...tab.querySelectorAll(".ai4u-card-head[aria-expanded=false]")]
  .slice(0, 6).forEach((head) => head.click())"""
OPEN_MISSION = """(mission) => { // as another page of the same person does it
  localStorage["ai4u-mission-"] = JSON.stringify(mission);
  dispatchEvent(new StorageEvent("storage", { key: "ai4u-mission-" }));
}"""
CLASS_STATES = {
    "projector": {"shown": {"kind": "race", "room": ""}, "race": race(9)},
    "teacher": {"tournament": tournament(6), "handed_in": handed_in(7)},
}


@pytest.fixture(scope="module")
def server() -> Iterator[Played]:
    with played("box_chase", "--seed", "1") as server:
        yield server


@pytest.fixture(scope="module")
def school() -> Iterator[WallServer]:
    with wall_server(12) as school:
        yield school


def opened(chromium: Browser, server: Played, width: int, height: int) -> Page:
    """Return the page of a world, as a Portuguese browser shows it."""
    page = new_page(chromium, width, height, reduced_motion="reduce", **BROWSER)
    CANVAS.serve(page, server.url)
    page.goto(server.url)
    return page


def check(page: Page) -> None:
    page.evaluate("document.fonts.ready.then(() => 0)")
    assert page.evaluate("document.documentElement.scrollWidth - innerWidth") <= 0
    assert cut_texts(page) == []
    assert english_texts(page, LANGUAGE) == set()


@SIZES
def test_all_tabs(
    chromium: Browser, server: Played, width: int, height: int, subtests: pytest.Subtests
) -> None:
    page = opened(chromium, server, width, height)
    page.locator(".ai4u-panel [role=tab][aria-selected=true]").wait_for(state="attached")
    opener = page.get_by_role("button", name="Abrir o painel", exact=True)
    if opener.count():
        opener.click()
    for tab in TABS:
        with subtests.test(tab=tab):
            page.get_by_role("tab", name=tab, exact=True).click()
            shown = page.get_by_role("tabpanel", name=tab, exact=True)
            expect(shown).to_be_visible()
            shown.evaluate(OPEN_CARDS)
            check(page)
    with subtests.test("details"):
        page.get_by_role("button", name="Detalhes", exact=True).click()
        check(page)
    with subtests.test("help"):
        page.get_by_role("button", name="Ajuda", exact=True).first.click()
        check(page)
    page.context.close()


def longest_steps(count: int) -> list[tuple[str, int]]:
    """Return mission and number of the steps with the longest sentences, and the longest title."""
    texts, missions = Catalogue(LANGUAGE, LIBRARY), library_missions().by_name
    steps = [
        (len(texts.message(step.say)), name, number)
        for name, mission in missions.items()
        for number, step in enumerate(mission.steps)
    ]
    title = max(missions, key=lambda name: len(texts.message(missions[name].title)))
    return [*((name, number) for _length, name, number in sorted(steps)[-count:]), (title, 0)]


@SIZES
def test_mission_card(
    chromium: Browser, server: Played, width: int, height: int, subtests: pytest.Subtests
) -> None:
    page = opened(chromium, server, width, height)
    card = page.get_by_role("region", name="Missão", exact=True)
    card.wait_for()
    for mission, step in longest_steps(3):
        title = Catalogue(LANGUAGE, LIBRARY).message(library_missions().by_name[mission].title)
        for is_hidden in (False, True):
            with subtests.test(mission=mission, is_hidden=is_hidden):
                page.evaluate(
                    OPEN_MISSION, {"mission": mission, "step": step, "isHidden": is_hidden}
                )
                expect(card).to_contain_text(title)
                check(page)
    page.context.close()


@SIZES
@pytest.mark.parametrize("name", ["join", "check", "privacy", "projector", "teacher"])
def test_class_pages(
    chromium: Browser,
    school: WallServer,
    name: str,
    width: int,
    height: int,
    subtests: pytest.Subtests,
) -> None:
    school.reset()
    school.state |= CLASS_STATES.get(name, {})
    page = new_page(chromium, width, height, **BROWSER)
    page.goto(f"{school.url}{name}")
    page.locator("h1, h2").first.wait_for(state="attached")
    check(page)
    for tab in page.get_by_role("tab").all():
        with subtests.test(tab=tab.inner_text()):
            tab.click()
            check(page)
    page.context.close()

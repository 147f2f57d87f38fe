"""Networks of the tab "Teach" that are handed in to a class, in the page."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from ai4u_edu.blocks.brains import zoo
from ai4u_edu.teach.networks import FOLDER, KeptNetwork, NetworkFolder
from tests.browser.plain_page import CLASS_ROOM, WITHOUT_VISER
from tests.browser.teach_tab import teach_tab
from tests.chromium import new_page
from tests.classroom.served_class import ServedClass, served_class
from tests.classroom.test_trainings import folder_of

pytestmark = [pytest.mark.browser, pytest.mark.slow]


@pytest.fixture(scope="module")
def school(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServedClass]:
    with served_class(tmp_path_factory.mktemp("class")) as school:
        yield school


def keep_network(folder: Path, scene: str = "box_chase") -> None:
    network = zoo.network_of(scene).read_bytes()
    about = KeptNetwork(number=0, title="My best one", agent="0", how="learned from 5 drives")
    NetworkFolder(folder).add(scene, network, about)


def student(chromium: Browser, school: ServedClass, locale: str) -> Page:
    """Return the page of a student who has a network."""
    seat = school.joined()
    keep_network(folder_of(school, seat) / FOLDER)
    page = new_page(chromium, locale=locale)
    WITHOUT_VISER.serve(page, CLASS_ROOM)
    for name, value in seat.client.cookies.items():
        page.context.add_cookies([{"name": name, "value": value, "url": school.url}])
    page.goto(seat.address)
    return page


def open_card(page: Page, tab: str) -> Locator:
    page.get_by_role("tab", name=tab, exact=True).click()
    card = page.get_by_role("article").filter(has_text="My best one")
    card.locator("[aria-expanded]").click()
    return card


@pytest.mark.parametrize(
    ("locale", "tab", "hand_in", "told"),
    [
        ("en-US", "Teach", "Hand in", "can play"),
        ("pt-BR", "Ensinar", "Entregar", "pode jogar"),
    ],
)
def test_a_network_is_handed_in_from_its_card(
    chromium: Browser, school: ServedClass, locale: str, tab: str, hand_in: str, told: str
) -> None:
    page = student(chromium, school, locale)
    open_card(page, tab).get_by_role("button", name=hand_in, exact=True).click()
    dialog = page.get_by_role("dialog", name=f"{hand_in} My best one")
    expect(dialog.locator("input[type=file]")).to_be_hidden()
    dialog.get_by_role("button", name=hand_in, exact=True).click()
    expect(dialog.get_by_role("listitem")).to_contain_text(told)
    page.context.close()


def test_outside_a_class_no_network_is_handed_in(chromium: Browser, tmp_path: Path) -> None:
    keep_network(tmp_path / FOLDER)
    with teach_tab(chromium, tmp_path) as (tab, _):
        card = tab.get_by_role("article").filter(has_text="My best one")
        card.locator("[aria-expanded]").click()
        expect(card.get_by_role("button", name="Download")).to_be_visible()
        expect(card.get_by_role("button", name=re.compile("Hand in"))).to_be_hidden()

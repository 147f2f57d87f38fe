"""A class in the browser: a teacher and two students, each in a context of their own."""

import re
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, WebSocketRoute, expect

from tests.browser.plain_page import CLASS_ROOM
from tests.browser.served_viser import PLAIN, connected
from tests.chromium import new_page
from tests.classroom.served_class import CODE, ServedClass, served_class
from tests.waiting import until

pytestmark = [pytest.mark.browser, pytest.mark.slow]


@pytest.fixture(scope="module")
def school(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServedClass]:
    with served_class(tmp_path_factory.mktemp("class")) as served:
        yield served


def join(page: Page, school: ServedClass, query: str = "") -> str:
    """Join by keyboard, and return the name that was chosen."""
    page.goto(school.url + query)
    name = page.locator("#names label").nth(1)
    if not query:
        expect(page.locator("#code")).to_be_focused()
        page.keyboard.type(f"{CODE[:2].lower()} {CODE[2:]}")
    name.click()
    chosen = name.inner_text()
    page.keyboard.press("Enter")
    connected(page)
    return chosen


def agent_of(page: Page) -> dict[str, Any]:
    snapshot = page.evaluate("fetch('api/snapshot').then((answer) => answer.json())")
    agent: dict[str, Any] = snapshot["agents"][0]
    return agent


@pytest.mark.nightly
def test_students_join_drive_and_come_back(chromium: Browser, school: ServedClass) -> None:
    teacher = new_page(chromium)
    teacher.goto(f"{school.url}teacher?token={school.token}")
    expect(teacher.locator("#code")).to_have_text(CODE)
    assert "token" not in teacher.url
    ada, ben = new_page(chromium), new_page(chromium, 390, 844)
    names = [join(ada, school), join(ben, school, f"?code={CODE}")]
    for name in names:
        expect(teacher.get_by_text(name, exact=True)).to_be_visible()
    expect(teacher.locator("#count")).to_have_text("(2)")

    start = agent_of(ben)["pose"]
    before = agent_of(ada)["pose"]
    ada.keyboard.down("KeyW")
    until(lambda: agent_of(ada)["pose"] != before)
    ada.keyboard.up("KeyW")
    assert agent_of(ben)["pose"] == start

    room = ada.url
    ada.goto(school.url)  # a seat's browser is led to its room
    connected(ada)
    assert re.sub(r"\?.*", "", ada.url) == re.sub(r"\?.*", "", room)
    for page in (ada, ben, teacher):
        page.context.close()


def test_a_mistake_is_told_and_nothing_typed_is_lost(
    chromium: Browser, school: ServedClass
) -> None:
    page = new_page(chromium)
    page.goto(school.url)
    page.locator("#code").fill("ZZZZZ")
    page.get_by_role("button", name="Join", exact=True).click()
    expect(page.get_by_role("alert")).to_have_text(
        "This code is not right. Look at the board again."
    )
    expect(page.locator("#code")).to_have_value("ZZZZZ")
    page.context.close()


def test_whoever_is_sent_out_is_told(chromium: Browser, school: ServedClass) -> None:
    teacher, ada = new_page(chromium), new_page(chromium)
    PLAIN.serve(ada, CLASS_ROOM)
    name = join(ada, school)
    teacher.goto(f"{school.url}teacher?token={school.token}")
    teacher.get_by_role("button", name=name).click()
    teacher.get_by_role("button", name=f"Send out {name}").click()
    question = teacher.get_by_role("dialog", name=f"Send {name} out?")
    question.get_by_role("button", name="Cancel").click()
    expect(question).to_have_count(0)
    expect(ada.get_by_role("dialog")).to_have_count(0)
    teacher.get_by_role("button", name=name).click()
    teacher.get_by_role("button", name=f"Send out {name}").click()
    question.get_by_role("button", name="Send out").click()
    left = ada.get_by_role("dialog", name="This world is closed for you now")
    expect(left).to_contain_text("Your teacher has sent you out; ask before you join again.")
    teacher.get_by_text("No longer here").click()  # others may have gone, too
    expect(teacher.get_by_role("listitem").filter(has_text=name)).to_contain_text("sent out")
    ada.unroute_all()
    left.get_by_role("link", name="start page").click()
    expect(ada.get_by_role("heading", name="Join the class")).to_be_visible()
    for page in (ada, teacher):
        page.context.close()


def test_whoever_is_banned_while_the_page_opens_is_told(
    chromium: Browser, school: ServedClass
) -> None:
    ben = new_page(chromium)
    PLAIN.serve(ben, CLASS_ROOM)
    name = join(ben, school)
    (seat,) = (each for each in school.state()["seats"] if each["name"] == name)

    def ban(socket: WebSocketRoute) -> None:
        assert school.command("ban", seat=seat["number"]).status_code == 200
        socket.connect_to_server()

    ben.route_web_socket(re.compile("/ws/input"), ban)
    ben.reload()
    left = ben.get_by_role("dialog", name="This world is closed for you now")
    expect(left).to_contain_text("You have no place in this class now")
    left.get_by_role("link", name="start page").click()
    expect(ben.get_by_role("heading", name="Join the class")).to_be_visible()
    ben.context.close()

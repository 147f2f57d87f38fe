"""A whole class in the browser: a teacher and three students, from the first code to the end."""

import io
import os
import re
import signal
import zipfile
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, BrowserContext, Locator, Page, expect

from tests.browser.kept_port import kept_port
from tests.browser.plain_page import CLASS_ROOM
from tests.browser.served_viser import PLAIN, connected
from tests.chromium import new_page
from tests.classroom.served_class import CODE, ServedClass, served_class
from tests.waiting import until

pytestmark = [pytest.mark.browser, pytest.mark.slow]


class Day:
    """A class with its teacher's page and the students' pages."""

    def __init__(self, chromium: Browser, school: ServedClass) -> None:
        self.chromium, self.school = chromium, school
        self.teacher = new_page(chromium)
        self.students: dict[str, Page] = {}

    def open_teachers_page(self) -> None:
        self.teacher.goto(f"{self.school.url}teacher?token={self.school.token}")
        expect(self.teacher.locator("#code")).to_have_text(CODE)

    def page(self) -> Page:
        """Return a page for a student, without viser, which takes most of a page's time."""
        page = new_page(self.chromium, 700, 600)
        PLAIN.serve(page, CLASS_ROOM)
        return page

    def join(self) -> None:
        """Open a page and join."""
        page = self.page()
        page.goto(f"{self.school.url}?code={CODE}")
        name = page.locator("#names label").first.inner_text()
        page.get_by_role("button", name="Join", exact=True).click()
        connected(page)
        self.students[name] = page

    def card(self, name: str) -> Locator:
        return self.teacher.locator("button.ai4u-room").filter(has_text=name)

    def dialog(self, button: str, yes: str, **chosen: str) -> None:
        """Open a dialog of the teacher's, choose from its lists, and send it."""
        self.teacher.get_by_role("button", name=button).click()
        dialog = self.teacher.locator("dialog.ai4u-form")
        for label, value in chosen.items():
            dialog.get_by_label(label.replace("_", " ")).select_option(value)
        dialog.get_by_role("button", name=yes, exact=True).click()
        expect(dialog).to_have_count(0)

    def close(self) -> None:
        for page in (self.teacher, *self.students.values()):
            page.context.close()


def test_a_class_from_the_first_code_to_the_end(chromium: Browser, tmp_path: Path) -> None:
    with kept_port() as port:
        with served_class(tmp_path, "--port", str(port)) as school:
            day = Day(chromium, school)
            before_it_is_killed(day)
            os.kill(school.process.pid, signal.SIGKILL)
        with served_class(tmp_path, "--port", str(port)) as school:
            day.school = school
            after_it_was_killed(day, tmp_path)


def before_it_is_killed(day: Day) -> None:
    day.open_teachers_page()
    for _ in range(3):
        day.join()
    everybody_drives(day)
    another_scene_comes(day)
    nobody_escapes_a_blank_screen(day)
    the_teacher_looks_in(day)
    a_closed_browser_comes_back_to_its_seat(day)


def after_it_was_killed(day: Day, folder: Path) -> None:
    everybody_is_still_there(day)
    a_race_has_a_board(day)
    the_export_opens(day)
    after_forgetting_nothing_is_left(day, folder)
    day.close()


def everybody_drives(day: Day) -> None:
    for name, page in day.students.items():
        page.keyboard.down("KeyA")
        expect(day.card(name)).to_contain_text("driving")
        page.keyboard.up("KeyA")


def another_scene_comes(day: Day) -> None:
    day.dialog("Assign a scene…", "Assign", Which_scene="maze")
    for name, page in day.students.items():
        expect(page).to_have_title(re.compile("Maze"))
        expect(day.card(name)).to_contain_text("Maze")


def nobody_escapes_a_blank_screen(day: Day) -> None:
    teacher = day.teacher
    teacher.get_by_role("button", name="Attention…").click()
    dialog = teacher.locator("dialog.ai4u-form")
    dialog.get_by_label("Blank all").check()
    dialog.get_by_role("textbox", name="Message").fill("<b>Look</b> here")
    dialog.get_by_label("How long").select_option("600")
    dialog.get_by_role("button", name="Begin").click()
    first, *_ = pages = [*day.students.values()]
    for page in pages:
        expect(blank(page)).to_contain_text("<b>Look</b> here")
        expect(blank(page)).to_contain_text(re.compile(r"\d:\d\d|10:00"))
    first.keyboard.press("Escape")
    first.reload()
    expect(blank(first)).to_be_visible()
    expect(blank(teacher)).to_have_count(0)
    teacher.get_by_role("button", name="End attention").click()
    for page in pages:
        expect(blank(page)).to_be_hidden()


def blank(page: Page) -> Locator:
    return page.locator("dialog.ai4u-blank")


def the_teacher_looks_in(day: Day) -> None:
    name, student = next(iter(day.students.items()))
    day.card(name).click()
    with day.teacher.context.expect_page() as opened:
        day.teacher.get_by_role("link", name="Look in").click()
    inside = opened.value
    expect(inside).to_have_title(re.compile("Maze"))
    assert inside.url.partition("?")[0] == student.url.partition("?")[0]
    inside.close()
    day.teacher.get_by_role("button", name="Close").click()


def a_closed_browser_comes_back_to_its_seat(day: Day) -> None:
    name, page = next(iter(day.students.items()))
    room, cookies = page.url.partition("?")[0], page.context.cookies()
    page.context.close()
    again = day.page()
    add_cookies(again.context, cookies)
    again.goto(day.school.url)
    connected(again)
    assert again.url.partition("?")[0] == room
    expect(again.locator(".ai4u-class-self")).to_have_text(name)
    day.students[name] = again


def add_cookies(context: BrowserContext, cookies: Any) -> None:
    context.add_cookies(cookies)


def everybody_is_still_there(day: Day) -> None:
    day.open_teachers_page()
    for name, page in day.students.items():
        page.reload()
        connected(page)
        expect(page.locator(".ai4u-class-self")).to_have_text(name)
        expect(page).to_have_title(re.compile("Maze"))
        expect(day.card(name)).to_be_visible()


def a_race_has_a_board(day: Day) -> None:
    day.dialog("Race…", "Start the countdown", Which_scene="box_chase", Countdown="5")
    name, page = next(iter(day.students.items()))
    expect(page).to_have_title(re.compile("Box chase"))
    state: dict[str, Any] = {}

    def has_begun() -> bool:
        state.update(day.school.state())
        return bool(state["race"]) and state["race"]["phase"] == "running"

    until(has_begun)
    page.bring_to_front()
    page.keyboard.down("KeyW")  # over the edge: a result, too
    until(lambda: day.school.state()["race"]["board"])
    page.keyboard.up("KeyW")
    (row,) = day.school.state()["race"]["board"]
    assert (row["name"], row["outcome"]) == (name, "fell")
    expect(day.teacher.get_by_text(name).first).to_be_visible()
    day.teacher.get_by_role("button", name="End race").click()
    until(lambda: day.school.state()["race"]["phase"] == "over")


def the_export_opens(day: Day) -> None:
    with day.teacher.expect_download() as download:
        day.teacher.locator("#export").click()
    data = Path(download.value.path()).read_bytes()
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        assert archive.testzip() is None
        names = archive.namelist()
        assert {"progress.csv", "results.html"} <= {name.rpartition("/")[2] for name in names}
        assert sum(name.endswith(".yaml") for name in names) >= len(day.students)


def after_forgetting_nothing_is_left(day: Day, folder: Path) -> None:
    tokens = [
        each["value"]
        for page in day.students.values()
        for each in page.context.cookies()
        if each["name"].startswith("ai4u_edu_seat")
    ]
    assert len(tokens) == len(day.students)
    day.teacher.get_by_role("button", name="End class…").click()
    dialog = day.teacher.locator("dialog.ai4u-form")
    dialog.get_by_label("I have the file, or need none").check()
    dialog.get_by_label(f"Type the code {CODE} to confirm").fill(CODE)
    dialog.get_by_role("button", name="Forget everything").click()
    expect(dialog).to_have_count(0)
    left = [each for each in folder.rglob("*") if each.is_file()]
    for file in left:
        data = file.read_bytes()
        for secret in (*tokens, *day.students):
            assert secret.encode() not in data, f"{secret} is in {file}"
    assert not any(file.suffix == ".yaml" for file in left)

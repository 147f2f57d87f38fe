"""Two students of a class run different programs, with real Python; the teacher sees both."""

import re

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.code_page import set_limits
from tests.browser.test_class_programs import teachers_page
from tests.browser.test_code_drives import CodeTab
from tests.chromium import DRAW_NOTHING, new_page
from tests.classroom.served_class import ServedClass, Student, served_class
from tests.code_sheet import programs_in_docs
from tests.waiting import LIMIT_MS, until

pytestmark = [pytest.mark.browser, pytest.mark.nightly]

TURN = "# of Blue Otter\ndef decide(percept):\n    return {'move': [0, 0.3, 0, 0]}\n"


def tab_of(chromium: Browser, student: Student) -> CodeTab:
    """Open a student's page at the tab "Code"."""
    page = new_page(chromium, 1000, 900)
    page.add_init_script(DRAW_NOTHING)
    cookies = [
        {"name": name, "value": value, "url": str(student.client.base_url)}
        for name, value in student.client.cookies.items()
    ]
    page.context.add_cookies(cookies)  # type: ignore[arg-type]  # a TypedDict of playwright
    page.goto(student.address)
    page.get_by_role("tab", name="Code").wait_for()
    set_limits(page)
    tab = CodeTab(page)
    expect(tab.editor).to_contain_text("def decide")
    return tab


def program_shown(teacher: Page, school: ServedClass, name: str) -> str:
    """Return the program of a student as the teacher's page shows it."""
    teacher.goto(f"{school.url}teacher")
    teacher.locator("button.ai4u-room").filter(has_text=name).click()
    teacher.get_by_role("button", name="Code", exact=True).click()
    return teacher.get_by_label(f"Program of {name}").text_content() or ""


def test_the_teacher_sees_both(chromium: Browser, tmp_path_factory: pytest.TempPathFactory) -> None:
    patient = ("--receive-timeout", str(round(LIMIT_MS)))
    with served_class(tmp_path_factory.mktemp("class"), *patient) as school:
        ada, ben = school.joined(name="Red Fox"), school.joined(name="Blue Otter")
        first, second = tab_of(chromium, ada), tab_of(chromium, ben)
        chase = programs_in_docs()[0]
        first.write(chase)
        second.write(TURN)
        second.press("Run")
        expect(second.state).to_contain_text(re.compile(r"Runs\s*decision \d"))
        first.press("Run")
        expect(first.state).to_contain_text("Goal reached")
        expect(second.state).to_contain_text("Runs")
        until(lambda: school.state()["stars"] == {"1": {"box_chase": 1}})
        first.press("Test")
        expect(first.state).to_contain_text("10 of 10 reached the goal")
        until(lambda: school.state()["stars"] == {"1": {"box_chase": 3}})

        teacher = teachers_page(chromium, school)
        driver = {each["id"]: each["driver"] for each in school.state()["rooms"]}
        assert set(driver.values()) != {""}
        assert program_shown(teacher, school, "Red Fox") == chase
        assert program_shown(teacher, school, "Blue Otter") == TURN
        teacher.goto(f"{school.url}teacher")
        teacher.get_by_role("tab", name="Progress").click()
        row = teacher.get_by_role("region", name="Stars of programs").get_by_role("row")
        expect(row.filter(has_text="Red Fox")).to_contain_text("★★★")
        expect(row.filter(has_text="Blue Otter")).to_have_count(0)

        another = tab_of(chromium, ada)  # another device of the same student
        stars = another.page.locator(".ai4u-code-state .ai4u-stars")
        expect(stars).to_have_attribute("aria-label", "3 of 3 stars")
        for page in (first.page, second.page, another.page, teacher):
            page.context.close()

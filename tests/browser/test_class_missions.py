"""Missions in a class: a teacher and two students, and a crash of the class in the middle."""

import os
import re
import signal
import textwrap
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.browser.kept_port import kept_port
from tests.browser.plain_page import CLASS_ROOM
from tests.browser.served_viser import PLAIN, connected
from tests.browser.test_class_day import Day
from tests.browser.test_missions import press_until_done
from tests.classroom.served_class import served_class
from tests.waiting import until

pytestmark = [pytest.mark.browser, pytest.mark.slow]

HOW_TO = Path(__file__).parents[2] / "docs" / "how-to" / "write-a-mission.md"


def test_missions_in_a_class(chromium: Browser, tmp_path: Path) -> None:
    with kept_port() as port:
        with served_class(tmp_path, "--port", str(port)) as school:
            day = Day(chromium, school)
            day.open_teachers_page()
            for _ in range(2):
                day.join()
            (_, ada), (ben_name, ben) = day.students.items()
            for page in (ada, ben):  # so that no banner covers the panel of a page without viser
                page.set_viewport_size({"width": 1300, "height": 800})
            one_begins_on_the_map(day, ada)
            the_other_one_is_given_a_mission(day, ben_name, ben)
            os.kill(school.process.pid, signal.SIGKILL)
            school.process.wait()
            a_step_is_done_while_the_class_is_away(ada)
        with served_class(tmp_path, "--port", str(port)) as school:
            day.school = school
            the_class_hears_of_it_later(day, ada)
            another_device_has_it_too(day, ada)
            day.close()


def test_a_mission_of_the_teachers_own(chromium: Browser, tmp_path: Path) -> None:
    """The one of the how-to, from its file to the wall."""
    folder = tmp_path / "missions"
    folder.mkdir()
    file = folder / "stop-early.yaml"
    file.write_text(first_yaml(HOW_TO), encoding="utf-8")
    with served_class(tmp_path / "class", "--missions", str(folder)) as school:
        day = Day(chromium, school)
        day.open_teachers_page()
        day.join()
        ((name, page),) = day.students.items()
        page.set_viewport_size({"width": 1300, "height": 800})
        page.get_by_role("link", name="Missions: learn step by step").click()
        page.locator("summary", has_text="My class").click()
        page.get_by_role("button", name=re.compile("^Stop early")).click()
        connected(page)
        expect(card(page)).to_contain_text("Step 1 of 2")
        expect(day.card(name)).to_contain_text("Stop early 1/2")
        page.bring_to_front()
        page.locator("canvas").first.click()
        page.keyboard.down("KeyD")  # a circle, in which no wall holds it up
        press_until_done(page, "KeyW")
        page.keyboard.up("KeyD")
        until(lambda: school.state()["mission_progress"] == {"1": {"stop-early": [1, 0]}})
        page.get_by_role("button", name="Next", exact=True).click()
        expect(day.card(name)).to_contain_text("Stop early 2/2")
        changed = file.read_text(encoding="utf-8").replace("Stop in front of", "Halt before")
        file.write_text(changed, encoding="utf-8")
        expect(page.locator(".ai4u-mission-say")).to_contain_text("Halt before a wall")
        day.close()


def first_yaml(page: Path) -> str:
    """Return the first YAML file that a page of the docs shows."""
    found = re.search(
        r"^( *)```yaml\n(.*?)^ *```", page.read_text("utf-8"), re.DOTALL | re.MULTILINE
    )
    assert found is not None
    return textwrap.dedent(found[2])


def one_begins_on_the_map(day: Day, page: Page) -> None:
    page.get_by_role("link", name="Missions: learn step by step").click()
    page.get_by_role("button", name=re.compile("First drive, the next one")).click()
    connected(page)
    expect(page.get_by_text("Step 1 of 4")).to_be_visible()
    drive(page, "KeyW")
    name = page.locator(".ai4u-class-self strong").inner_text()
    until(lambda: day.school.state()["mission_progress"] == {"1": {"drive-1": [1, 0]}})
    expect(day.card(name)).to_contain_text("First drive 1/4")
    page.get_by_role("button", name="Next", exact=True).click()
    expect(page.get_by_text("Step 2 of 4")).to_be_visible()
    expect(day.card(name)).to_contain_text("First drive 2/4")


def drive(page: Page, key: str) -> None:
    page.bring_to_front()
    page.locator("canvas").first.click()
    press_until_done(page, key)


def the_other_one_is_given_a_mission(day: Day, name: str, page: Page) -> None:
    teacher = day.teacher
    teacher.get_by_role("button", name="Assign a scene…").click()
    dialog = teacher.locator("dialog.ai4u-form")
    dialog.get_by_label("A mission").check()
    dialog.get_by_label("Which mission").select_option("sense-1")
    dialog.get_by_label("Some rooms").check()
    dialog.get_by_label(name, exact=True).check()
    dialog.get_by_role("button", name="Assign", exact=True).click()
    expect(dialog).to_have_count(0)
    expect(card(page).get_by_role("heading")).to_be_visible()
    expect(page.locator(".ai4u-mission-say")).to_be_visible()
    title = card(page).get_by_role("heading").inner_text()
    expect(day.card(name)).to_contain_text(f"{title} 1/")
    expect(card(page).get_by_role("button", name=re.compile("^Open "))).to_be_hidden()
    card(page).get_by_role("button", name="Show everything").click()
    page.get_by_role("button", name="Leave the mission").click()
    expect(day.card(name)).not_to_contain_text(f"{title} 1/")
    page.reload()
    connected(page)
    expect(page.get_by_role("link", name="Missions: learn step by step")).to_be_visible()


def card(page: Page) -> Locator:
    return page.get_by_role("region", name="Mission")


def a_step_is_done_while_the_class_is_away(page: Page) -> None:
    """The room is gone with the class, so another window of this browser stands for it."""
    page.evaluate(
        """() => {
          const key = Object.keys(localStorage).find((name) => name.startsWith("ai4u-missions-"));
          localStorage[key] = JSON.stringify({ "drive-1": { steps: 2, stars: 0 } });
        }"""
    )


def the_class_hears_of_it_later(day: Day, page: Page) -> None:
    def told() -> Any:
        return day.school.state()["mission_progress"].get("1")

    connected(page)
    page.reload()
    until(lambda: told() == {"drive-1": [2, 0]})
    expect(page.get_by_text("Step 2 of 4")).to_be_visible()
    day.open_teachers_page()
    day.teacher.get_by_role("tab", name="Progress").click()
    expect(day.teacher.get_by_role("region", name="Missions")).to_contain_text("2/4")


def another_device_has_it_too(day: Day, page: Page) -> None:
    there = day.page()
    PLAIN.serve(there, CLASS_ROOM)
    there.context.add_cookies(page.context.cookies())  # type: ignore[arg-type]  # the same fields
    there.set_viewport_size({"width": 1300, "height": 800})
    there.goto(day.school.url)
    connected(there)
    there.get_by_role("link", name="Missions: learn step by step").click()
    begun = there.get_by_role("button", name=re.compile("First drive, the next one"))
    expect(begun).to_contain_text("2 of 4 steps")
    begun.click()
    connected(there)
    expect(there.get_by_text("Step 3 of 4")).to_be_visible()
    there.context.close()

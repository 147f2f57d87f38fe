"""A class that learns: four students and a teacher, whose program is killed twice in the middle."""

import os
import re
import signal
from contextlib import suppress
from itertools import pairwise
from pathlib import Path

import psutil
import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from ai4u_edu.learn.small.ppo import PpoSettings
from ai4u_edu.learn.training.run import Run
from ai4u_edu.teach.practice import FOLDER as PRACTICES
from tests.browser.kept_port import kept_port
from tests.browser.plain_page import CLASS_ROOM, WITHOUT_VISER
from tests.chromium import new_page
from tests.classroom.served_class import ServedClass, served_class
from tests.classroom.test_trainings import driver, folder_of, learner, process_of
from tests.waiting import LIMIT_S, until

pytestmark = [pytest.mark.browser, pytest.mark.nightly]

STUDENTS = 4


class Student:
    """A student's page with the tab Teach, in a room with five drives."""

    def __init__(self, chromium: Browser, school: ServedClass) -> None:
        seat = driver(school)
        self.folder = folder_of(school, seat)
        self.page: Page = new_page(chromium)
        WITHOUT_VISER.serve(self.page, CLASS_ROOM)
        for name, value in seat.client.cookies.items():
            self.page.context.add_cookies([{"name": name, "value": value, "url": school.url}])
        self.page.goto(seat.address)
        self.page.get_by_role("tab", name="Teach").click()
        self.tab = self.page.get_by_role("tabpanel", name="Teach")

    def card(self, how: str) -> Locator:
        """Return the card of the network that was made so."""
        return self.tab.get_by_role("article").filter(has_text=how)

    def practise(self) -> None:
        """Practise for long, and never reach the goal, so that it doesn't end by itself."""
        worth = self.tab.get_by_role("group", name="Worth of each reward")
        worth.get_by_label("touch").fill("-1")
        expect(self.tab.get_by_label("Begin with")).to_have_value("1")
        self.tab.get_by_label("Length").select_option("131072")
        self.tab.get_by_role("button", name="Practise", exact=True).click()


class Teacher:
    """The teacher's page."""

    def __init__(self, chromium: Browser, school: ServedClass) -> None:
        self.page = new_page(chromium)
        self.page.goto(f"{school.url}teacher?token={school.token}")

    def open_card(self, state: str) -> None:
        """Open the dialog of the card that says so."""
        card = self.page.locator("button.ai4u-room").filter(has_text=re.compile(state))
        card.first.click()


def kill(school: ServedClass, learning: psutil.Process) -> None:
    """Kill the class's program without a warning; its learner ends with it."""
    os.kill(school.process.pid, signal.SIGKILL)
    with suppress(psutil.Error):  # it is gone already
        learning.resume()  # a halted process keeps the signal of its parent's end waiting
    assert psutil.wait_procs([learning], LIMIT_S)[1] == []


def test_nothing_is_lost_when_a_class_is_killed_while_it_learns(
    chromium: Browser, tmp_path: Path
) -> None:
    with kept_port() as port:
        options = ("--port", str(port))
        with served_class(tmp_path, *options) as school:
            students = [Student(chromium, school) for _ in range(STUDENTS)]
            process = all_learn(students, school)
            kill(school, process)
        with served_class(tmp_path, *options) as school:
            for student in students:
                card = student.card("learned from 5 drives")
                expect(card.get_by_text("drives", exact=True)).to_be_visible()
            run, process = two_practise(students, school)
            kill(school, process)
            before = run.checks()
        with served_class(tmp_path, *options) as school:
            until(lambda: len(run.checks()) > len(before))
            process_of(school, "practice_process").suspend()  # else it may be over too soon
            after = run.checks()
            assert after[: len(before)] == before
            gaps = {later.steps - earlier.steps for earlier, later in pairwise(after)}
            assert gaps == {PpoSettings().check_every}  # nothing is learned twice or left out
            teacher = Teacher(chromium, school)
            the_teacher_stops_both(students, teacher)
            the_teacher_hands_a_network_out(students, teacher)
            assert school.command("forget").status_code == 200
            assert not (tmp_path / "rooms").exists()
        for page in (teacher.page, *(student.page for student in students)):
            page.context.close()


def all_learn(students: list[Student], school: ServedClass) -> psutil.Process:
    """Let all press Learn, and return the process that learns for the first of them, halted."""
    first, *others = students
    first.tab.get_by_role("button", name="Learn from 5 drives").click()
    process = learner(school)
    for place, student in enumerate(others, 2):
        student.tab.get_by_role("button", name="Learn from 5 drives").click()
        expect(student.tab.get_by_text(f"Your place in the line: {place}.")).to_be_visible()
    return process


def two_practise(students: list[Student], school: ServedClass) -> tuple[Run, psutil.Process]:
    """Let two practise; return the training of the first, and its process, which is halted."""
    first, second, *_ = students
    first.practise()
    process = process_of(school, "practice_process")
    (folder,) = (first.folder / PRACTICES).glob("*.practice")
    run = Run(folder / "run")
    until(lambda: len(run.checks()) > 0)
    process.suspend()  # else it may be over too soon
    second.practise()
    expect(second.tab.get_by_text("Your place in the line: 1.")).to_be_visible()
    return run, process


def the_teacher_stops_both(students: list[Student], teacher: Teacher) -> None:
    first, second, *_ = students
    for student, state in ((second, "waits to practise"), (first, "practises, [0-9]+% done")):
        teacher.open_card(state)
        teacher.page.get_by_role("button", name="Stop learning").click()
        expect(student.tab.get_by_text("your teacher has stopped it")).to_be_visible()
    expect(first.card("practised for")).to_be_visible()


def the_teacher_hands_a_network_out(students: list[Student], teacher: Teacher) -> None:
    teacher.open_card("learned: [0-9]+% alike")
    teacher.page.get_by_role("button", name="Networks").click()
    dialog = teacher.page.get_by_role("dialog", name="Networks")
    dialog.get_by_role("button", name="Hand out Network 1 of Box chase").click()
    expect(dialog.get_by_text("The other rooms get a copy of Network 1.")).to_be_visible()
    until(lambda: sum(student.card("From your teacher").count() for student in students) == 3)

"""Programs of a class in the browser: kept, on another device, read by the teacher, handed out."""

import json
import re
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, Page, Request, expect

from tests.browser.code_editor import WithEditor
from tests.browser.code_tab import CodePage
from tests.browser.fake_code import serve_fakes
from tests.browser.plain_page import CLASS_ROOM, WITHOUT_VISER
from tests.browser.wall_data import MARKUP
from tests.chromium import new_page, until_on
from tests.classroom.served_class import CODE, ServedClass, Student, served_class
from tests.classroom.test_programs import of_room
from tests.waiting import until

pytestmark = [pytest.mark.browser, pytest.mark.slow]

PROGRAM = f"# {MARKUP}\ndef decide(percept):\n    return {{}}\n"
SCENE, AGENT = "box_chase", "0"


@pytest.fixture
def school(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServedClass]:
    with served_class(tmp_path_factory.mktemp("class")) as served:
        yield served


class Desk(WithEditor):
    """A student's device, with the tab "Code" open and a Python that is not one."""

    def __init__(self, chromium: Browser, student: Student) -> None:
        self.page = new_page(chromium, 1000, 900)
        WITHOUT_VISER.serve(self.page, CLASS_ROOM)
        self.sent: list[Any] = []
        """Programs that were sent."""
        self.page.on("request", self._note)
        serve_fakes(self.page)
        cookies = [
            {"name": name, "value": value, "url": str(student.client.base_url)}
            for name, value in student.client.cookies.items()
        ]
        self.page.context.add_cookies(cookies)  # type: ignore[arg-type]  # a TypedDict of playwright
        self.page.goto(student.address)
        self.open()

    def _note(self, request: Request) -> None:
        if request.method == "PUT":
            self.sent.append(json.loads(request.post_data or "{}"))

    def open_tab(self) -> None:
        self.page.get_by_role("tab", name="Code").click()

    def open(self) -> None:
        self.open_tab()
        expect(self.editor).to_contain_text("def decide")

    @property
    def runs(self) -> Locator:
        return self.page.get_by_label("Earlier runs").locator("option")

    @property
    def offer(self) -> Locator:
        return self.page.get_by_role("button", name="Take the program from your teacher")

    def is_told(self, words: str) -> None:
        told = self.page.locator("p[role=status]").filter(has_text=words)
        expect(told).to_be_visible()

    def close(self) -> None:
        self.page.context.close()


def kept(school: ServedClass, student: Student) -> Any:
    """Return the program that the class has of a student, which the teacher sees."""
    room = student.room.split("/")[2]
    (program,) = of_room(school, room, school.token).json()["programs"]
    return program["source"]


def teachers_page(chromium: Browser, school: ServedClass) -> Page:
    teacher = new_page(chromium)
    teacher.goto(f"{school.url}teacher?token={school.token}")
    expect(teacher.locator("#code")).to_have_text(CODE)
    return teacher


def test_a_program_is_kept_goes_on_elsewhere_and_is_read(
    chromium: Browser, school: ServedClass
) -> None:
    ada = school.joined(name="Red Fox")
    first = Desk(chromium, ada)
    assert kept(school, ada) is None
    first.write(PROGRAM)
    first.is_told("Kept in the class.")
    assert kept(school, ada) == PROGRAM
    assert [(each["scene"], each["agent"]) for each in first.sent] == [(SCENE, AGENT)]

    second = Desk(chromium, ada)
    second.is_told("This is your program from the class.")
    assert second.text == PROGRAM
    newer = PROGRAM + "# of the second device\n"
    second.write(newer)
    second.page.get_by_role("button", name="Run", exact=True).click()
    second.is_told("Kept in the class.")
    until(lambda: kept(school, ada) == newer)
    second.close()

    first.page.get_by_role("button", name="Run", exact=True).click()
    assert first.text == PROGRAM  # not taken away while it runs
    first.page.reload()
    first.open()
    first.is_told("This is your program from the class.")
    assert first.text == newer
    first.runs.first.wait_for(state="attached")
    first.page.get_by_label("Earlier runs").select_option(index=1)
    assert first.text == PROGRAM  # the one of this device is kept
    first.is_told("Kept in the class.")
    until(lambda: kept(school, ada) == PROGRAM)

    teacher = teachers_page(chromium, school)
    teacher.locator("button.ai4u-room").filter(has_text="Red Fox").click()
    teacher.get_by_role("button", name="Code", exact=True).click()
    shown = teacher.get_by_label("Program of Red Fox")
    expect(shown).to_be_visible()
    assert shown.text_content() == PROGRAM
    expect(teacher.get_by_role("heading", name="Red Fox Box chase · changed")).to_be_visible()
    teacher.goto(f"{school.url}projector?token={school.token}")
    expect(teacher.locator("#code")).to_have_text(CODE)
    expect(teacher.get_by_role("button", name="Code", exact=True)).to_have_count(0)
    first.close()
    teacher.context.close()


def test_named_programs_go_on_at_another_device(chromium: Browser, school: ServedClass) -> None:
    ada = school.joined(name="Red Fox")
    first = Desk(chromium, ada)
    first.write(PROGRAM)
    first.is_told("Kept in the class.")
    first.page.get_by_role("button", name="New program").click()
    named = f"{PROGRAM}# of the second program\n"
    first.write(named)
    first.is_told("Kept in the class.")
    until(lambda: kept(school, ada) == named)

    second = Desk(chromium, ada)
    programs = second.page.get_by_label("Program", exact=True)
    expect(programs.locator("option")).to_have_text(["Program 1", "Program 2"])
    expect(second.editor).not_to_contain_text("of the second program")
    programs.select_option("Program 2")
    expect(second.editor).to_contain_text("of the second program")
    second.page.get_by_role("button", name="Delete this program").click()
    second.page.get_by_role("dialog").get_by_role("button", name="Delete").click()
    expect(programs.locator("option")).to_have_text(["Program 1"])
    until(lambda: kept(school, ada) == PROGRAM)
    for desk in (first, second):
        desk.close()


def test_a_mistake_reaches_the_teacher_and_goes_with_the_next_run(
    chromium: Browser, school: ServedClass
) -> None:
    ada = school.joined(name="Red Fox")
    desk = Desk(chromium, ada)
    desk.write(PROGRAM)
    mistake = {"ok": False, "kind": "unknown-name", "text": "nothing is called 'x'", "line": 3}
    desk.page.evaluate(
        """(mistake) => {
            fake.decided = fake.decide;
            fake.decide = () => ({ ...mistake, printed: "", lines: [], variables: {} });
            const begun = { step: 0, episode: 1, terminated: false, truncated: false };
            fake.percepts.push({ ...begun, values: {} });
        }""",
        mistake,
    )
    teacher = teachers_page(chromium, school)
    desk.page.get_by_role("button", name="Run", exact=True).click()
    card = teacher.locator("button.ai4u-room").filter(has_text="Red Fox")
    expect(card).to_contain_text("program stopped: line 3: nothing is called 'x'")
    teacher.get_by_role("tab", name="Programs (1 stopped)").click()
    glance = teacher.locator(".ai4u-glance").filter(has_text="Red Fox")
    expect(glance.locator("[data-mistake]")).to_have_text("    return {}")
    desk.page.evaluate("fake.decide = fake.decided")
    desk.page.evaluate(
        "fake.give({ step: 0, episode: 2, values: {}, terminated: false, truncated: false })"
    )
    desk.page.get_by_role("button", name="Run", exact=True).click()
    expect(glance).to_contain_text("runs")
    expect(teacher.get_by_role("tab", name="stopped")).to_have_count(0)
    desk.close()
    teacher.context.close()


def test_a_device_whose_clock_is_set_back_saves_its_program(
    chromium: Browser, school: ServedClass
) -> None:
    ada = school.joined(name="Red Fox")
    desk = Desk(chromium, ada)
    desk.page.evaluate("(() => { const now = Date.now; Date.now = () => now() + 3.2e10; })()")
    desk.write(PROGRAM)
    desk.is_told("Kept in the class.")
    desk.page.reload()  # the clock of the page is right again
    desk.open()
    assert desk.text == PROGRAM
    later = f"{PROGRAM}# later\n"
    desk.write(later)
    desk.page.get_by_role("button", name="Run", exact=True).click()
    until(lambda: kept(school, ada) == later)
    desk.is_told("Kept in the class.")
    desk.close()


@pytest.mark.nightly
def test_without_network_it_stays_here_and_is_saved_later(
    chromium: Browser, school: ServedClass
) -> None:
    ben = school.joined(name="Blue Otter")
    desk = Desk(chromium, ben)
    desk.page.route(re.compile("/api/program"), lambda route: route.abort())
    desk.write(PROGRAM)
    desk.is_told("The class can't be reached.")
    assert kept(school, ben) is None
    desk.page.unroute_all()
    serve_fakes(desk.page)
    desk.is_told("Kept in the class.")
    assert kept(school, ben) == PROGRAM
    desk.page.evaluate("window.setTimeout = () => 0")  # no timer of this page saves it
    desk.write("# the end")
    desk.page.reload()  # saved while the page is closed
    until(lambda: kept(school, ben) == "# the end")
    desk.open_tab()
    desk.write("x" * 100_001)
    desk.is_told("100000 characters")
    assert kept(school, ben) == "# the end"
    desk.close()


@pytest.mark.nightly
def test_a_newer_program_of_another_device_is_kept_beside_this_one(
    chromium: Browser, school: ServedClass
) -> None:
    ada = school.joined(name="Red Fox")
    desk = Desk(chromium, ada)
    desk.page.route(re.compile("/api/program"), lambda route: route.abort())
    desk.write(PROGRAM)
    desk.is_told("The class can't be reached.")
    newer = f"{PROGRAM}# of another device"
    body = {"scene": SCENE, "agent": AGENT, "source": newer, "base": 0, "device": "other"}
    assert ada.client.put("api/program", json=body).status_code == 200
    desk.page.unroute_all()
    serve_fakes(desk.page)
    desk.is_told("The class has a newer program of yours, from another device.")
    assert (desk.text, kept(school, ada)) == (PROGRAM, newer)
    expect(desk.runs.filter(has_text="4 lines")).to_have_count(1)
    desk.page.get_by_label("Earlier runs").select_option(index=1)
    assert desk.text == newer
    desk.close()


@pytest.mark.nightly
def test_a_teachers_program_is_offered_and_replaces_nothing(
    chromium: Browser, school: ServedClass
) -> None:
    ada, eve = school.joined(name="Red Fox"), school.joined(name="Calm Owl")
    desk, other = Desk(chromium, ada), Desk(chromium, eve)
    desk.write(PROGRAM)
    expect(desk.offer).to_be_hidden()
    teacher = teachers_page(chromium, school)
    teacher.get_by_role("button", name="Assign a scene…").click()
    dialog = teacher.get_by_role("dialog", name="Assign a scene")
    dialog.get_by_label("Which scene").select_option("box_chase")
    given = "# from the teacher\ndef decide(percept):\n    return {}\n"
    dialog.get_by_text("More: start and program").click()
    dialog.get_by_label("Starting program (Python)").fill(given)
    dialog.get_by_role("button", name="Assign").click()

    expect(desk.offer).to_be_visible()
    assert desk.text == PROGRAM
    expect(other.editor).to_contain_text("# from the teacher")
    expect(other.offer).to_be_hidden()
    desk.offer.click()
    assert desk.text == given
    expect(desk.offer).to_be_hidden()
    desk.write(given + "# and more\n")
    expect(desk.offer).to_be_hidden()
    expect(desk.runs.filter(has_text="lines")).to_have_count(2)
    desk.page.get_by_label("Earlier runs").select_option(index=2)
    assert desk.text == PROGRAM
    desk.page.get_by_label("Earlier runs").select_option(label="From your teacher")
    assert desk.text == given

    assert school.command("assign", rooms="all", scene="maze").status_code == 200
    expect(other.page).to_have_title(re.compile("Maze"))
    expect(other.editor).not_to_contain_text("# from the teacher")
    for each in (desk, other):
        each.close()
    teacher.context.close()


def test_without_a_class_nothing_is_sent(chromium: Browser) -> None:
    tab = CodePage(chromium)
    tab.page.clock.install()
    sent: list[str] = []
    tab.page.on("request", lambda request: sent.append(request.url))
    tab.write(PROGRAM)
    tab.press("Run")
    expect(tab.state).to_contain_text("The program gets the robot")
    tab.page.clock.fast_forward("01:00:00")  # longer than any pause after which a class gets it
    tab.page.evaluate("fetch('web/code/run.js')")  # requests are told in their order
    until_on(tab.page, lambda: sent[-1:] and sent[-1].endswith("code/run.js"))
    assert [each for each in sent if not each.endswith(".js")] == []
    tab.page.context.close()  # with its clock

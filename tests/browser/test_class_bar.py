"""A student's page in a class: who is here, the teacher's message, the blank screen, a race."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, expect
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import JSONResponse, Response
from starlette.routing import Route
from starlette.types import ASGIApp, Receive, Scope, Send

from ai4u_edu import WASDRBMoveController
from ai4u_edu.member import ClassMember
from ai4u_edu.page.server.app import RoomMount
from ai4u_edu.page.server.class_feed import ROLE_HEADER, SEAT_HEADER
from ai4u_edu.wire.class_link import (
    VERSION,
    Assignment,
    Attention,
    ClassSettings,
    CurrentRace,
    FromClass,
    LinkWelcome,
    People,
    Person,
    RaceRow,
    Switches,
)
from tests.browser.contrast import low_contrasts
from tests.browser.fit import cut_texts, english_texts
from tests.browser.plain_page import ASKED
from tests.browser.sent_frames import SentFrames
from tests.browser.served_viser import PLAIN, centre, connected, driver_status
from tests.builders import small_sim
from tests.chromium import close_page, new_page, quick_page
from tests.member.fake_link import FakeLink
from tests.page.server.rooms import Clock, Room, SharedServer, served
from tests.page.server.rooms import Page as RawPage
from tests.waiting import until

pytestmark = pytest.mark.browser

FOX = Person(1, "Red Fox", "#d55e00", True)
OWL = Person(2, "<b>Blue</b> Owl", "#0072b2", True)
HARE = Person(3, "Green Hare", "#009e73", False)
END = Attention("", "", 0.0)


class AsSeat:
    """Adds the headers with which a class passes requests on."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app
        self.role, self.seat = "student", 1
        self.is_code_open = True

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        own = [(ROLE_HEADER, self.role), (SEAT_HEADER, str(self.seat))]
        headers = [*scope["headers"], *((name.encode(), text.encode()) for name, text in own)]
        await self._app({**scope, "headers": headers}, receive, send)


@dataclass
class RoomOfClass:
    """A room in a class whose messages a test sends."""

    room: Room
    member: ClassMember
    entrance: AsSeat
    chromium: Browser
    clock: Clock
    """Clock of the member."""
    asked: list[str] = field(default_factory=list)
    pages: list[Page] = field(default_factory=list)
    sent: list[SentFrames] = field(default_factory=list)
    """Messages of each page."""

    def tell(self, *messages: FromClass) -> None:
        assert isinstance(self.member.link, FakeLink)
        for message in messages:
            self.member.link.receive(message)

    def page(self, *, stands_still: bool = False, **options: Any) -> Page:
        """Open a page.

        Args:
            stands_still: the page's time goes on only as the test says.
        """
        make = new_page if stands_still else quick_page
        headers = {**ASKED, "Accept-Language": str(options.get("locale", "en-US"))}
        page = make(self.chromium, reduced_motion="reduce", extra_http_headers=headers, **options)
        if stands_still:
            page.clock.install(time=0)
            page.clock.pause_at(3_600_000)
        self.pages.append(page)
        self.sent.append(SentFrames(page))
        page.on("request", lambda request: self.asked.append(request.url))
        page.goto(f"{self.room.url}r/a1/")
        connected(page)
        return page

    @property
    def x(self) -> float:
        return self.room.runner.latest.bodies[0].x


@pytest.fixture
def school(chromium: Browser, shared_server: SharedServer) -> Iterator[RoomOfClass]:
    found: list[ClassMember] = []
    entrances: list[AsSeat] = []

    async def move_code(request: Request) -> Response:
        if request.method == "GET":
            return JSONResponse({"is_open": entrances[0].is_code_open})
        return JSONResponse({"code": "K7QPM", "minutes": 5})

    def wrap(app: ASGIApp) -> ASGIApp:
        routes = [
            RoomMount("/r/a1", app=PLAIN.app(app)),
            Route("/api/move-code", move_code, methods=["GET", "POST"]),
        ]
        entrances.append(AsSeat(Starlette(routes=routes)))
        return entrances[0]

    class Feed:
        """The member is made after the app."""

        @property
        def version(self) -> int:
            return found[0].view.version if found else 0

        def event(self, role: str, seat: int) -> dict[str, Any] | None:
            return found[0].view.event(role, seat)

    sim = small_sim(controller=WASDRBMoveController())
    with served(sim, wrap=wrap, server=shared_server, class_feed=Feed()) as room:
        clock = Clock()
        found.append(ClassMember(room.runner, None, FakeLink, title="A room", clock=clock))
        found[0].start()
        school = RoomOfClass(room, found[0], entrances[0], chromium, clock)
        yield school
        for page in school.pages:
            close_page(page)
        found[0].stop()


OURS = ".ai4u-class-bar, .ai4u-dock, dialog"
"""Selector of our parts of the page: others stand for viser's."""


@pytest.mark.parametrize(("width", "height"), [(1280, 800), (390, 844)])
def test_its_portuguese_texts_fit(school: RoomOfClass, width: int, height: int) -> None:
    page = school.page(width=width, height=height, locale="pt-BR", stands_still=True)
    people = People((FOX, OWL, HARE), has_teacher=True)
    work = Assignment("a1", "Two wires", "", None, "05 Two wires")
    school.tell(LinkWelcome(VERSION, "", ""), people, work)
    race = CurrentRace("r1", "running", 0.0, "maze", 1, ())
    school.member.view.set_race(race, school.clock(), 4.5)
    bar = page.get_by_role("region", name="Turma", exact=True)
    expect(bar).to_contain_text("4.50 s")
    assert cut_texts(page) == []
    assert english_texts(page, "pt_BR") <= {"Name"}, "a label of what stands for viser's page"
    school.member.view.set_race(None, 0.0, None)
    school.tell(Attention("", "Olhem para o quadro, por favor", 300.0))
    expect(bar).to_contain_text("Olhem para o quadro")
    assert cut_texts(page) == []
    assert english_texts(page, "pt_BR") <= {"Name"}, "a label of what stands for viser's page"


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_its_controls_can_be_read_in_all_states(school: RoomOfClass, scheme: Any) -> None:
    page = school.page(color_scheme=scheme)
    # viser is left out, which sets it
    page.evaluate("each => (document.documentElement.dataset.mantineColorScheme = each)", scheme)
    school.tell(LinkWelcome(VERSION, "", ""), People((FOX, OWL, HARE)))
    bar = page.get_by_role("region", name="Class")
    expect(bar.get_by_role("button").first).to_be_visible()
    assert low_contrasts(page, controls=2, within=OURS) == []
    bar.get_by_role("button").first.click()
    page.locator("dialog[open]").wait_for()
    assert low_contrasts(page, controls=2, within=OURS) == []


def test_a_bar_says_who_is_here_and_what_the_teacher_says(school: RoomOfClass) -> None:
    page = school.page(stands_still=True)
    bar = page.get_by_role("region", name="Class")
    expect(bar).to_have_count(0)
    assert not any("/api/" in url for url in school.asked)
    school.tell(LinkWelcome(VERSION, "", ""), People((FOX, OWL, HARE)))
    expect(bar.locator("strong")).to_have_text("Red Fox")
    expect(bar.get_by_role("listitem")).to_have_text(["<b>Blue</b> Owl", "Green Hare(not here)"])
    assert bar.locator("b").count() == 0
    school.tell(People((FOX, OWL, HARE), has_teacher=True))
    expect(bar).to_contain_text("Your teacher looks in")
    school.tell(People((FOX, OWL, HARE)))
    expect(bar).not_to_contain_text("Your teacher looks in")
    school.tell(Assignment("a1", "Two wires", "", None, "05 Two wires"))
    expect(bar).to_contain_text("Lesson 05 Two wires")
    school.tell(Attention("", "Five <i>minutes</i> left", 300.0))
    expect(bar.get_by_role("status")).to_have_text("Five <i>minutes</i> left")
    expect(bar.get_by_role("timer")).to_have_text("5:00")
    page.clock.run_for(1000)
    expect(bar.get_by_role("timer")).to_have_text("4:59")
    expect(bar.get_by_role("link", name="My work")).to_have_attribute("href", "../../api/my-work")
    bar.get_by_role("button", name="Other device").click()
    expect(page.get_by_role("dialog")).to_contain_text("K7QPM")
    expect(page.get_by_role("dialog")).to_contain_text("5 minutes")
    with page.expect_response("**/api/move-code"):
        page.clock.run_for(3000)
    expect(page.get_by_role("dialog")).to_have_count(1)
    school.entrance.is_code_open = False  # the other device has used it
    page.clock.run_for(3000)
    expect(page.get_by_role("dialog")).to_have_count(0)


def test_a_page_makes_sounds_once_the_teacher_turns_them_on(school: RoomOfClass) -> None:
    page = school.page()
    mute = page.get_by_role("button", name="Turn the sound off")
    expect(mute).to_have_count(0)
    school.tell(LinkWelcome(VERSION, "", ""), People((FOX,)), ClassSettings(Switches(sound=True)))
    expect(mute).to_be_visible()
    school.tell(ClassSettings(Switches()))
    expect(mute).to_have_count(0)


def test_a_blank_screen_keeps_focus_and_keys_whatever_is_pressed(school: RoomOfClass) -> None:
    page = school.page()
    school.tell(LinkWelcome(VERSION, "", ""), People((FOX,)))
    page.keyboard.down("KeyW")
    until(lambda: school.x > 0.1)
    school.tell(Attention("blank", "Listen <u>now</u>", 0.0))
    blank = page.get_by_role("alertdialog", name="Look at your teacher")
    expect(blank).to_be_visible()
    expect(blank).to_contain_text("Listen <u>now</u>")
    until(lambda: school.room.runner.latest.waiting == "teacher")
    x = school.x
    page.keyboard.up("KeyW")
    school.sent[0].take()
    for key in ("Escape", "Escape", "Escape", "Tab", "Enter", "KeyW", "KeyR", "KeyN"):
        page.keyboard.press(key)
    expect(blank).to_be_visible()
    expect(blank).to_be_focused()
    page.reload()
    connected(page)
    expect(blank).to_be_visible()
    page.keyboard.press("KeyW")
    assert school.sent[0].take() == []
    assert school.x == x
    school.tell(END)
    expect(blank).to_have_count(0)
    page.keyboard.down("KeyW")
    until(lambda: school.x > x)
    page.keyboard.up("KeyW")


def test_whoever_else_drives_is_called_by_name(school: RoomOfClass) -> None:
    page = school.page()
    school.tell(LinkWelcome(VERSION, "", ""), People((FOX, OWL)))
    school.entrance.seat = 2
    with RawPage(f"{school.room.url}r/a1/ws/input") as other:
        other.send("take")
        expect(driver_status(page)).to_have_text("<b>Blue</b> Owl drives")


def test_the_teachers_own_page_is_not_blanked(school: RoomOfClass) -> None:
    school.entrance.role = "teacher"
    school.tell(LinkWelcome(VERSION, "", ""), People((FOX,)), Attention("blank", "Listen", 0.0))
    page = school.page()
    bar = page.get_by_role("region", name="Class")
    expect(bar).to_contain_text("Teacher")
    expect(page.locator(".ai4u-banner")).to_contain_text("You have stopped all worlds")
    expect(page.get_by_role("alertdialog")).to_have_count(0)
    expect(bar.get_by_role("link", name="My work")).to_have_count(0)


def test_a_pause_has_a_banner_and_leaves_what_stands_on_the_page_readable(
    school: RoomOfClass,
) -> None:
    page = school.page(width=390, height=844)
    school.tell(LinkWelcome(VERSION, "", ""), People((FOX, OWL, HARE)))
    school.tell(Attention("pause", "Hands off, all of you: look at the board in front", 600.0))
    banner = page.locator(".ai4u-banner")
    expect(banner).to_contain_text("Hands off")
    expect(driver_status(page)).to_have_text("The world stands still")
    for name in ("My work", "Other device"):
        expect(page.get_by_text(name, exact=True)).to_have_count(1)
    boxes = [page.locator(each).bounding_box() for each in (".ai4u-class-bar", ".ai4u-banner")]
    bar, below = (box for box in boxes if box is not None)
    assert bar["x"] + bar["width"] <= 390
    assert bar["y"] + bar["height"] <= below["y"]
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    page.keyboard.down("KeyW")  # drawn before the key's event is over
    assert page.locator(".ai4u-keycap[data-held]").count() == 0
    page.keyboard.up("KeyW")
    assert school.sent[0].take() == []


def test_a_race_counts_down_and_shows_the_own_best_first(school: RoomOfClass) -> None:
    page = school.page(stands_still=True)
    board = (RaceRow("<b>Blue</b> Owl", "#0072b2", "goal", 3.21, "x"),)
    view = school.member.view
    school.tell(LinkWelcome(VERSION, "", ""), People((FOX,)))
    race = CurrentRace("r1", "countdown", 2.0, "maze", 1, ())
    view.set_race(race, school.clock() + 2.0, None)
    countdown = page.locator(".ai4u-countdown")
    for text in ("2", "1", "Go!"):
        expect(countdown).to_be_visible()
        expect(countdown).to_have_text(text)
        page.clock.run_for(1000)
    expect(countdown).to_be_hidden()
    race = CurrentRace("r1", "running", 0.0, "maze", 1, board)
    view.set_race(race, school.clock(), 4.5)
    bar = page.get_by_role("region", name="Class")
    expect(bar).to_contain_text("your best: 4.50 s")
    bar.get_by_role("button", name="Board").click()
    expect(bar.locator("ol li")).to_have_text(["<b>Blue</b> Owl3.21 s"])
    left, _ = centre(bar.locator("ol"))
    assert 0 < left < 1280
    view.set_race(None, 0.0, None)
    expect(bar.get_by_role("button", name="Board")).to_have_count(0)

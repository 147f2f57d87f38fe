"""Thumbs on a phone and on tablets: a stick at the left, buttons at the right."""

import itertools

import pytest
from playwright.sync_api import CDPSession, Locator, Page, expect

from ai4u_edu import DiscreteActuator, DiscreteArrowController, LocalBrain
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks.keyboard import Stick
from tests.browser.served_viser import (
    ServedViser,
    centre,
    connected,
    driver_status,
    frames,
    hide_panel,
)
from tests.builders import small_sim, still
from tests.chromium import until_on
from tests.waiting import LIMIT_S, until

pytestmark = pytest.mark.browser

SIZES = {"phone": (390, 844), "tablet": (1024, 768), "upright": (768, 1024), "flat": (844, 390)}
FINGER = 44
"""Pixels that a finger needs."""


class Fingers:
    """Fingers on a page, by name; each is where it was put last."""

    def __init__(self, page: Page) -> None:
        self._session: CDPSession = page.context.new_cdp_session(page)

    def touch(self, kind: str, **fingers: tuple[float, float]) -> None:
        points = [{"x": x, "y": y, "id": ord(name)} for name, (x, y) in fingers.items()]
        self._session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})


def stick_of(page: Page) -> Locator:
    return page.locator(".ai4u-stick")


def pushed(site: ServedViser) -> Stick:
    return site.room.sim.agents[0].keyboard.stick()


def button(page: Page, name: str) -> Locator:
    return page.locator(f".ai4u-keycap[data-action={name}]")


@pytest.fixture
def phone(site: ServedViser) -> Page:
    return site.page(width=390, height=844, touch=True)


def test_the_stick_drives_by_halves_and_rests_when_let_go(site: ServedViser, phone: Page) -> None:
    fingers, (x, y) = Fingers(phone), centre(stick_of(phone))
    expect(driver_status(phone)).to_have_text("Move the stick to drive")
    fingers.touch("touchStart", a=(x, y))
    fingers.touch("touchMove", a=(x, y - 25))
    until(lambda: 0.3 < pushed(site).forward < 0.8)
    expect(driver_status(phone)).to_have_text("You're driving")
    until(lambda: site.pose()[0] > 0.1)
    assert site.pose()[1] == 0, "a push that is nearly straight is straight"
    fingers.touch("touchMove", a=(x + 4, y - 300))
    until(lambda: pushed(site) == Stick(1, 0))
    fingers.touch("touchMove", a=(x + 200, y))
    until(lambda: pushed(site) == Stick(0, 1))
    until(lambda: site.pose()[2] < -0.1)
    fingers.touch("touchMove", a=(x - 100, y + 100))
    until(lambda: pushed(site) == Stick(-1, -1))
    fingers.touch("touchEnd")
    until(lambda: pushed(site) == Stick())


def test_the_other_thumb_jumps_and_slides_meanwhile(site: ServedViser, phone: Page) -> None:
    fingers, (x, y) = Fingers(phone), centre(stick_of(phone))
    jump, leap = (centre(button(phone, name)) for name in ("jump", "jump_forward"))
    fingers.touch("touchStart", a=(x, y - 55))
    fingers.touch("touchStart", a=(x, y - 55), b=jump)
    until(lambda: (site.room.held, pushed(site)) == (["Space"], Stick(1, 0)))
    fingers.touch("touchMove", a=(x, y + 100), b=leap)
    until(lambda: (site.room.held, pushed(site)) == (["KeyJ"], Stick(-1, 0)))
    fingers.touch("touchEnd", a=(x, y + 100))
    until(lambda: pushed(site) == Stick())
    assert site.room.held == ["KeyJ"]
    fingers.touch("touchCancel")
    until(lambda: site.room.held == [])


def test_a_page_that_is_put_away_lets_go_of_its_stick(site: ServedViser, phone: Page) -> None:
    fingers, (x, y) = Fingers(phone), centre(stick_of(phone))
    fingers.touch("touchStart", a=(x, y - 55))
    until(lambda: pushed(site) == Stick(1, 0))
    phone.evaluate("window.dispatchEvent(new Event('blur'))")
    until(lambda: pushed(site) == Stick())


def test_a_push_takes_an_agent_over_and_let_go_gives_it_back(
    site: ServedViser, phone: Page
) -> None:
    agent = site.room.sim.agents[0]
    script = LocalBrain(controller=still)
    site.room.runner.submit(lambda: agent.use_brain(script)).result(LIMIT_S)
    expect(driver_status(phone)).to_contain_text("A script drives")
    fingers, (x, y) = Fingers(phone), centre(stick_of(phone))
    fingers.touch("touchStart", a=(x, y - 55))
    until(lambda: site.pose()[0] > 0.1)
    fingers.touch("touchEnd")
    phone.get_by_role("button", name="Let go").tap()
    until(lambda: agent.brain is script)


def test_all_is_in_reach_and_nothing_in_the_way(site: ServedViser) -> None:
    page = site.page(has_viser=True, touch=True, wait=False)
    connected(page)
    hide_panel(page)
    for width, height in SIZES.values():
        page.set_viewport_size({"width": width, "height": height})
        frames(page)
        problems: list[str] = []

        def is_well_laid_out() -> bool:
            problems[:] = misplaced(page, width, height)  # noqa: B023
            return not problems  # noqa: B023

        try:
            until_on(page, is_well_laid_out)  # viser moves its canvas in its own time
        except AssertionError:
            pytest.fail(f"{width} x {height}: {problems}")


def misplaced(page: Page, width: int, height: int) -> list[str]:
    """Return what is wrong: stick and keys must be large, apart and free, and the world free."""
    problems: list[str] = []

    def check(name: str, is_right: object) -> None:
        if not is_right:
            problems.append(name)

    things = [
        stick_of(page),
        *page.locator(".ai4u-keycap").all(),
        page.get_by_role("button", name="Help"),
    ]
    boxes = []
    for thing in things:
        box = thing.bounding_box()
        assert box is not None
        check(
            f"{thing}: smaller than a finger", min(box["width"], box["height"]) >= min(FINGER, 40)
        )
        left, top = box["x"], box["y"]
        right, bottom = left + box["width"], top + box["height"]
        check(f"{thing}: beyond the sides", 0 <= left < right <= width)
        check(f"{thing}: not in the lower half", 0.47 * height <= top < bottom <= height)
        boxes.append((left, top, right, bottom))
        hit = "([x, y]) => document.elementFromPoint(x, y).closest('section.ai4u-dock') !== null"
        middle = [(left + right) / 2, (top + bottom) / 2]
        check(f"{thing}: something lies over it", page.evaluate(hit, middle))
    for one, other in itertools.combinations(boxes, 2):
        apart = one[2] <= other[0] or other[2] <= one[0] or one[3] <= other[1] or other[3] <= one[1]
        check(f"{one} and {other} lie over each other", apart)
    scene = page.locator("#root canvas").first.bounding_box()
    assert scene is not None
    edge = scene["x"] + scene["width"]
    check("keys over the panel", all(right <= edge for _, _, right, _ in boxes))
    free = """([x, y]) => {
        const part = document.elementFromPoint(x, y);
        return part.tagName === "CANVAS" || !!part.closest(".mantine-Notification-root");
    }"""
    for across, down in itertools.product((0.1, 0.3, 0.5, 0.7, 0.9), (0.15, 0.3, 0.45)):
        x = scene["x"] + across * scene["width"]
        check(f"the world is covered at {across}, {down}", page.evaluate(free, [x, down * height]))
    return problems


class TestOneThingAtATime:
    """Four buttons for an agent with whole actions only: one cell or turn for each tap."""

    @pytest.fixture
    def sim(self) -> ControlRequestor:
        return small_sim(
            controller=DiscreteArrowController(), actuators=[DiscreteActuator(turn_amount=2)]
        )

    def test_fingers_press_keys_and_slide_between_them(self, site: ServedViser) -> None:
        page = site.page(width=390, height=844, touch=True)
        expect(stick_of(page)).to_have_count(0)
        expect(driver_status(page)).to_have_text("Tap a key to drive")
        fingers = Fingers(page)
        up, right, restart = (centre(button(page, each)) for each in ("up", "right", "restart"))
        fingers.touch("touchStart", a=up)
        until(lambda: site.room.held == ["ArrowUp"])
        fingers.touch("touchMove", a=right)
        until(lambda: site.room.held == ["ArrowRight"])
        until(lambda: site.pose()[2] < -0.1)
        episode = site.room.runner.latest.episode
        fingers.touch("touchStart", a=right, b=restart)
        until(lambda: site.room.runner.latest.episode > episode)
        fingers.touch("touchCancel")
        until(lambda: site.room.held == [])


def test_a_mouse_has_keys_and_no_stick(site: ServedViser) -> None:
    page = site.page(width=1024, height=768)
    expect(stick_of(page)).to_have_count(0)
    expect(button(page, "forward").locator("kbd")).to_be_visible()
    page.context.new_cdp_session(page).send(
        "Emulation.setTouchEmulationEnabled", {"enabled": True, "maxTouchPoints": 5}
    )
    expect(stick_of(page)).to_be_visible()  # a keyboard that was taken off a tablet
    expect(button(page, "forward")).to_have_count(0)

"""The missions of the island "Teach", done in a real page: by keys, and by networks that learn."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from ai4u_edu.missions.mission import library_missions
from ai4u_edu.snapshot import BodyState
from ai4u_edu.teach import background
from tests.browser.plain_page import WITHOUT_VISER
from tests.chromium import new_page, until_on
from tests.page.panel.rooms import PanelRoom
from tests.teach.driving import teaching_room
from tests.waiting import LIMIT_S

pytestmark = pytest.mark.browser

SIZE = 1366, 768
NEARLY_AHEAD, AHEAD = 0.6, 0.25
"""Angles (rad) to a place within which a person drives on, and turns no more."""


class Person:
    """Sees the card, the buttons and the picture of a page, and has keys and a mouse."""

    def __init__(self, page: Page, room: PanelRoom) -> None:
        self.page, self._room = page, room
        self._held: set[str] = set()

    @property
    def card(self) -> Locator:
        return self.page.get_by_role("region", name="Mission")

    @property
    def is_done(self) -> bool:
        return self.card.locator(".ai4u-mission-done").is_visible()

    def press(self, name: str) -> None:
        """Press the lit button of a name, which can be seen without scrolling."""
        lit = self.page.locator("[data-ai4u-lit]", has_text=name).first
        expect(lit).to_be_in_viewport()
        lit.click()

    def sees(self, name: str) -> BodyState:
        bodies = {body.name: body for body in self._room.runner.latest.bodies}
        return bodies[name]

    def drive(self, x: float, y: float) -> None:
        """Hold the keys that bring the robot closer to a place, for a moment."""
        robot = self.sees("robot")
        angle = math.remainder(math.atan2(y - robot.y, x - robot.x) - robot.heading, math.tau)
        turn = {"a" if angle > 0 else "d"} if abs(angle) > AHEAD else set()
        self._hold(turn | ({"w"} if abs(angle) < NEARLY_AHEAD else set()))

    def drive_to_box(self) -> None:
        """Touch the box, from as many starts as the step asks for."""

        def go() -> bool:
            if self.is_done:
                return True
            agent = self._room.runner.latest.agents[0]
            if agent.terminated or agent.truncated:
                self._hold(set())
                self.page.locator(".ai4u-panel").get_by_role("button", name="New start").click()
                expect(self.page.locator(".ai4u-banner[data-kind=goal]")).to_have_count(0)
            box = self.sees("box")
            self.drive(box.x, box.y)
            return False

        until_on(self.page, go)
        self._hold(set())

    def drive_until_done(self, x: float, y: float) -> None:
        def go() -> bool:
            self.drive(x, y)
            return self.is_done

        until_on(self.page, go)
        self._hold(set())

    def go_on(self) -> None:
        """Wait until the step is done, and press Next."""
        expect(self.card.locator(".ai4u-mission-done")).to_be_visible()
        self.card.get_by_role("button", name="Next", exact=True).click()

    def _hold(self, keys: set[str]) -> None:
        for key in sorted(self._held - keys):
            self.page.keyboard.up(key)
        for key in sorted(keys - self._held):
            self.page.keyboard.down(key)
        self._held = keys


@contextmanager
def person(chromium: Browser, folder: Path, mission: str) -> Iterator[Person]:
    """Open a mission in its scene; no script of the page may fail."""
    page, problems = new_page(chromium, *SIZE), list[str]()
    page.on("pageerror", lambda error: problems.append(str(error)))
    patch = pytest.MonkeyPatch()
    patch.setattr(background, "NICENESS", 0)  # else a busy machine gives the learners no time
    scene = library_missions().get(mission).scene
    with teaching_room(folder, scene) as room:
        WITHOUT_VISER.serve(page, room.url)
        kept = f'{{"mission": "{mission}", "step": 0}}'
        page.add_init_script(f"localStorage['ai4u-mission-'] ??= '{kept}'")
        page.goto(room.url)
        expect(page.get_by_text("Step 1 of")).to_be_visible()
        room.runner.resume().result(LIMIT_S)
        yield Person(page, room)
        page.context.close()
    patch.undo()
    assert problems == []


def test_a_network_learns_from_three_drives(chromium: Browser, tmp_path: Path) -> None:
    with person(chromium, tmp_path, "teach-1") as ada:
        ada.drive_to_box()
        ada.go_on()
        ada.press("Teach")
        ada.go_on()
        ada.press("Learn from")
        expect(ada.card).to_contain_text("✓ Nobody wrote its policy")


@pytest.mark.nightly
def test_a_network_learns_by_rewards(chromium: Browser, tmp_path: Path) -> None:
    with person(chromium, tmp_path, "teach-2") as ada:
        ada.press("Teach")
        ada.go_on()
        ada.page.get_by_label("Begin with").select_option("A new network")
        ada.page.get_by_label("Length").select_option("Medium")
        ada.press("Practise")
        ada.go_on()
        expect(ada.card).to_contain_text("✓ Nobody showed it anything")


@pytest.mark.nightly
def test_a_network_is_corrected(chromium: Browser, tmp_path: Path) -> None:
    with person(chromium, tmp_path, "teach-3") as ada:
        ada.drive_to_box()
        ada.go_on()
        ada.press("Teach")
        ada.press("Learn from 1 drive")
        ada.go_on()
        ada.drive_to_box()
        ada.go_on()
        ada.press("Learn from")
        expect(ada.card).to_contain_text("✓ You taught it by correcting it")


@pytest.mark.nightly
def test_a_network_is_paid_for_nonsense(chromium: Browser, tmp_path: Path) -> None:
    with person(chromium, tmp_path, "teach-4") as ada:
        ada.drive_until_done(-0.5, -3.5)  # the mark with the number 1
        ada.go_on()
        ada.press("Teach")
        worth = ada.page.get_by_role("group", name="Worth of each reward")
        for name, number in (("checkpoints", "0"), ("lap", "0"), ("on the line", "10")):
            worth.get_by_label(name).fill(number)
        ada.press("Practise")
        ada.go_on()
        ada.card.get_by_role("button", name="To see the line, wherever it stands").click()
        expect(ada.card).to_contain_text("✓ It does what the reward says")


@pytest.mark.nightly
def test_networks_are_compared(chromium: Browser, tmp_path: Path) -> None:
    with person(chromium, tmp_path, "teach-1") as ada:
        ada.drive_to_box()
        ada.go_on()
        ada.press("Teach")
        ada.go_on()
        ada.press("Learn from")
        expect(ada.card).to_contain_text("✓ Nobody wrote its policy")
    with person(chromium, tmp_path, "teach-5") as ada:
        ada.press("Teach")
        ada.go_on()
        ada.press("Network 1")
        ada.press("Let it drive")
        ada.go_on()
        ada.card.get_by_role("button", name="Nobody knows: 3 starts are too few").click()
        ada.go_on()
        expect(ada.card).to_contain_text("✓ You chose it by what it did")


@pytest.mark.nightly
def test_a_network_plays_against_itself(chromium: Browser, tmp_path: Path) -> None:
    with person(chromium, tmp_path, "teach-6") as ada:
        ada.page.keyboard.down("s")
        expect(ada.card.locator(".ai4u-mission-done")).to_be_visible()
        ada.page.keyboard.up("s")
        ada.go_on()
        ada.card.get_by_role("button", name="Next", exact=True).click()  # to win takes a person
        ada.press("Teach")
        ada.card.get_by_role("button", name="Next", exact=True).click()  # nothing to learn from
        ada.page.get_by_label("Against").select_option("Itself")
        ada.press("Practise")
        ada.go_on()
        expect(ada.card).to_contain_text("Step 5 of 5")

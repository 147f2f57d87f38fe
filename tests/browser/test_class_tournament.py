"""A tournament from the first network to the standings: two students, a teacher, a projector."""

import re
from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Page, expect

from ai4u_edu.wire.class_link import Ack, HandedInNetwork
from tests.browser.served_viser import PLAIN, connected
from tests.chromium import new_page
from tests.classroom.link_client import RawLink, key
from tests.classroom.served_class import CODE, ServedClass, served_class
from tests.games.tournament.bad_networks import INPUTS, few_outputs
from tests.learn.training.networks import network

pytestmark = [pytest.mark.browser, pytest.mark.slow, pytest.mark.nightly]


def test_two_students_hand_in_and_the_projector_shows_who_won(
    chromium: Browser, tmp_path: Path
) -> None:
    good, bad = network(tmp_path / "mine.onnx", INPUTS), tmp_path / "bad.onnx"
    few_outputs(bad)
    with served_class(tmp_path / "class") as school:
        teacher, projector, ada = new_page(chromium), new_page(chromium), new_page(chromium)
        teacher.goto(f"{school.url}teacher?token={school.token}")
        teacher.get_by_role("tab", name="Tournament").click()
        teacher.get_by_role("button", name="Tournament…").click()
        dialog = teacher.get_by_role("dialog")
        dialog.get_by_label("Scene").select_option("sumo")
        dialog.get_by_role("button", name="Collect networks").click()

        name = join(ada, school)
        hand_in_by_page(ada, bad, good)
        ben = school.joined(name="Blue Otter")
        with RawLink(school, ben) as link:  # as a notebook does
            link.send(HandedInNetwork(key(), "sumo", "", "ben.onnx", good.read_bytes()))
            link.next(Ack)
        board = teacher.get_by_role("tabpanel", name="Tournament")
        for student in (name, "Blue Otter"):
            row = board.get_by_role("row").filter(has_text=student)
            expect(row).to_contain_text("can play")
        teacher.get_by_role("button", name="Show on the projector").click()
        projector.goto(f"{school.url}projector?token={school.token}")
        shown = projector.get_by_role("region", name="Tournament")
        expect(shown).to_contain_text("2 players so far")
        teacher.get_by_role("button", name="Start…").click()
        teacher.get_by_role("dialog").get_by_role("button", name="Start", exact=True).click()
        standings = shown.get_by_role("table", name="Standings")
        for student in (name, "Blue Otter"):
            expect(standings).to_contain_text(student)
        expect(shown).to_contain_text("4 of 4 games. It is over.")
        a_game_can_be_watched(teacher)
        teacher.get_by_role("button", name=re.compile("Game . to the projector")).first.click()
        frame = projector.frame_locator("#game iframe")
        expect(frame.get_by_role("heading", name=re.compile("Sumo: "))).to_be_visible()
        expect(frame.locator("#play")).to_have_attribute("aria-pressed", "true")
        expect(frame.locator("#play")).to_be_hidden()
        for page in (teacher, projector, ada):
            page.context.close()


def join(page: Page, school: ServedClass) -> str:
    PLAIN.serve(page, re.compile(r"/r/[\w-]+/(\?.*)?$"))
    page.goto(f"{school.url}?code={CODE}")
    name = page.locator("#names label").first.inner_text()
    page.get_by_role("button", name="Join", exact=True).click()
    connected(page)
    return name


def hand_in_by_page(page: Page, bad: Path, good: Path) -> None:
    page.get_by_role("button", name="Hand in").click()
    dialog = page.get_by_role("dialog", name="Hand in a network")
    scene = dialog.get_by_role("combobox", name=re.compile("^Scene"))
    expect(scene).to_have_value("sumo")
    send = dialog.get_by_role("button", name="Hand in")
    send.click()
    expect(dialog.get_by_role("alert")).to_contain_text("Choose the .onnx file")
    for file, told in ((bad, "was not taken: "), (good, "can play")):
        dialog.get_by_label("Network (.onnx)").set_input_files(file)
        send.click()
        item = dialog.get_by_role("listitem").filter(has_text=file.name)
        expect(item).to_contain_text(told)
    expect(dialog.get_by_role("listitem")).to_have_count(1)
    found = Axe().run(page, context="dialog").response["violations"]
    assert [each["id"] for each in found if each["impact"] in {"serious", "critical"}] == []
    dialog.get_by_role("button", name="Close").click()


def a_game_can_be_watched(teacher: Page) -> None:
    with teacher.context.expect_page() as opened:
        teacher.get_by_role("link", name=re.compile("Watch game")).first.click()
    game = opened.value
    expect(game.locator("canvas").first).to_be_visible()
    game.close()
    with teacher.context.expect_page() as opened:
        teacher.get_by_role("link", name="Report").click()
    expect(opened.value.get_by_role("heading", name="Standings")).to_be_visible()

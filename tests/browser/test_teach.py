"""The tab "Teach" in a real page: drives, a button, and a network that drives."""

import re
from pathlib import Path

import pytest
from playwright.sync_api import Browser, expect

from ai4u_edu.blocks.brains import zoo
from ai4u_edu.recording.episode import encode
from ai4u_edu.teach.drives import DriveFolder
from ai4u_edu.teach.network_score import NetworkScore
from ai4u_edu.teach.networks import KeptNetwork, NetworkFolder
from tests.browser.plain_page import CLASS_ROOM, WITHOUT_VISER
from tests.browser.served_viser import record_texts
from tests.browser.teach_tab import teach_tab
from tests.chromium import new_page, until_on
from tests.classroom.served_class import served_class
from tests.classroom.test_trainings import driver, learn, learner, page_of
from tests.teach.driving import SEEDS, drive
from tests.waiting import until

pytestmark = pytest.mark.browser


def test_a_robot_learns_from_the_chosen_drives_and_drives(
    chromium: Browser, tmp_path: Path
) -> None:
    folder = DriveFolder(tmp_path / "drives")
    for seed in SEEDS:
        folder.add(drive(seed))
    with teach_tab(chromium, tmp_path) as (tab, _):
        page = tab.page
        drives = tab.get_by_role("group", name="Drives to learn from")
        expect(drives.get_by_role("checkbox", checked=True)).to_have_count(len(SEEDS))
        more = tab.get_by_text("drive again")
        expect(more).to_be_hidden()
        for number in range(5, len(SEEDS) + 1):
            drives.get_by_role("checkbox", name=re.compile(f"^Drive {number} ")).uncheck()
        expect(more).to_contain_text("1 more drive makes it learn well.")
        for number in range(5, len(SEEDS) + 1):
            drives.get_by_role("checkbox", name=re.compile(f"^Drive {number} ")).check()
        drives.get_by_role("checkbox", name=re.compile("^Drive 1 ")).uncheck()
        texts = record_texts(page, ".ai4u-banner")
        tab.get_by_role("button", name=f"Learn from {len(SEEDS) - 1} drives").click()
        result = tab.get_by_role("status").filter(has_text="It acts like you in")
        expect(result).to_contain_text("It drives now.")
        expect(result).to_be_in_viewport()
        until_on(page, lambda: any("It has learned from you, and" in each for each in texts()))
        expect(tab.get_by_text("Does it go wrong somewhere?")).to_be_visible()
        expect(tab.get_by_text("Its mistakes while it learns")).to_be_visible()
        expect(tab.get_by_label("Begin with")).to_have_value("1")
        card = tab.get_by_role("article")
        expect(card).to_contain_text(f"learned from {len(SEEDS) - 1} drives")
        expect(card.get_by_text("drives", exact=True)).to_be_visible()
        expect(tab.get_by_role("img", name="The error")).to_be_visible()

        card.get_by_role("button", name="Network 1").click()
        tab.get_by_role("button", name="Rename").click()
        page.get_by_role("textbox", name="Name").fill("Racer")
        page.get_by_role("dialog").get_by_role("button", name="Rename").click()
        expect(card.get_by_role("button", name="Racer")).to_be_visible()
        with page.expect_download() as download:
            tab.get_by_role("button", name="Download").click()
        assert download.value.suggested_filename == "box_chase-1.onnx"
        network = tmp_path / "networks" / "box_chase-1.onnx"
        assert Path(download.value.path()).read_bytes() == network.read_bytes()

        tab.get_by_role("button", name="Why?").click()
        expect(page.get_by_role("tabpanel", name="Drive")).to_be_visible()
        page.get_by_role("tab", name="Teach").click()
        drives.get_by_role("button", name="Delete drive 2", exact=True).click()
        expect(drives.get_by_role("checkbox")).to_have_count(len(SEEDS) - 1)


def test_a_robot_practises_for_rewards_until_it_is_stopped(
    chromium: Browser, tmp_path: Path
) -> None:
    with teach_tab(chromium, tmp_path) as (tab, _):
        page = tab.page
        touch = tab.get_by_role("group", name="Worth of each reward").get_by_label("touch")
        touch.fill("")
        tab.get_by_role("button", name="Practise").click()
        expect(page.get_by_text("Each reward needs a number")).to_be_visible()
        touch.fill("-1")  # it never reaches the goal, and does not end early
        expect(tab.get_by_label("Against")).to_be_hidden()
        tab.get_by_label("Length").select_option("Long")
        tab.get_by_role("button", name="Practise").click()
        expect(tab.get_by_role("progressbar", name="Practice")).to_be_visible()
        expect(tab.get_by_role("button", name="Practise")).to_be_hidden()
        pause = tab.get_by_role("button", name="Pause the practice")
        expect(pause).to_be_visible()
        tab.get_by_label("Begin with").focus()
        page.keyboard.press("Tab")
        page.keyboard.press("Enter")
        expect(tab.get_by_role("button", name="Go on with the practice")).to_be_focused()
        page.keyboard.press("Enter")
        expect(pause).to_be_focused()
        tab.get_by_role("button", name="Stop").click()
        expect(tab.get_by_text("The practice was stopped.")).to_be_visible()
        expect(tab.get_by_role("button", name="Practise")).to_be_enabled()


def test_a_slider_shows_how_a_network_got_better(chromium: Browser, tmp_path: Path) -> None:
    about = KeptNetwork(0, "", "0", "practised for 8192 decisions", facts=("Seed: 0.",))
    replays = {decisions: encode(drive(1)) for decisions in (0, 1024, 8192)}
    NetworkFolder(tmp_path / "networks").add("box_chase", b"not asked to drive", about, replays)
    with teach_tab(chromium, tmp_path) as (tab, room):
        page = tab.page
        tab.get_by_role("article").get_by_role("button", name="Network 1").click()
        expect(tab.get_by_text("Seed: 0.")).to_be_visible()
        expect(tab.get_by_text("Made on")).to_be_visible()
        tab.get_by_role("button", name="Delete", exact=True).focus()
        page.keyboard.press("Tab")
        expect(tab.get_by_role("slider", name="How it got better")).to_be_focused()
        page.keyboard.press("ArrowRight")
        expect(tab.get_by_text("after 1,024 decisions", exact=True)).to_be_visible()
        until(lambda: room.runner.latest.past)
        page.get_by_role("button", name="Back to live").click()
        until(lambda: not room.runner.latest.past)
        page.get_by_role("tab", name="Past").click()
        expect(page.get_by_text("network 1 after 1,024 decisions").first).to_be_visible()


def test_a_robot_practises_against_the_side_that_was_chosen(
    chromium: Browser, tmp_path: Path
) -> None:
    with teach_tab(chromium, tmp_path, scene="sumo") as (tab, _):
        against = tab.get_by_label("Against")
        expect(against).to_have_value("player")
        expect(against.get_by_role("option")).to_have_text(["The scene's player", "Itself"])
        against.select_option("Itself")
        tab.get_by_role("button", name="Practise", exact=True).click()
        card = tab.get_by_role("article")
        expect(card).to_contain_text(
            re.compile("decisions against itself, won [0-9]+% of its games")
        )
        expect(tab.get_by_text(re.compile("It wins [0-9]+% of its games"))).to_be_visible()
        expect(against.get_by_role("option")).to_have_count(3)
        against.select_option("Network 1")
        tab.get_by_label("Length").select_option("Long")
        tab.get_by_role("button", name="Practise", exact=True).click()
        expect(tab.get_by_role("progressbar", name="Practice")).to_be_visible()
        tab.get_by_role("button", name="Stop").click()
        expect(tab.get_by_text("The practice was stopped.")).to_be_visible()


def test_networks_are_opened_compared_and_deleted(chromium: Browser, tmp_path: Path) -> None:
    about = KeptNetwork(0, "First", "0", "learned", score=NetworkScore.of(7, 8, has_all=True))
    NetworkFolder(tmp_path / "networks").add("box_chase", b"not asked to drive", about)
    with teach_tab(chromium, tmp_path) as (tab, _):
        page = tab.page
        with page.expect_file_chooser() as chooser:
            tab.get_by_role("button", name="Open a file").click()
        chooser.value.set_files(zoo.network_of("box_chase"))
        cards = tab.get_by_role("article")
        expect(cards).to_have_count(2)
        card = cards.filter(has_text="opened from the file box_chase.onnx")
        card.get_by_role("button", name="box_chase").click()
        expect(card.get_by_text("It reaches the goal from all 8 starts.")).to_be_visible()
        card.get_by_role("button", name="Compare").click()
        dialog = page.get_by_role("dialog", name="Compare networks")
        expect(dialog.get_by_role("combobox", name="With")).to_have_value("1")
        expect(dialog.get_by_role("row", name="Goal")).to_have_text(re.compile("100%.*88%"))
        dialog.get_by_role("button", name="Close").click()
        card.get_by_role("button", name="Let it drive").click()
        expect(card.get_by_text("drives", exact=True)).to_be_visible()
        card.get_by_role("button", name="Delete").click()
        question = page.get_by_role("dialog", name="Delete box_chase?")
        question.get_by_role("button", name="Cancel").click()
        expect(cards).to_have_count(2)
        card.get_by_role("button", name="Delete").click()
        question.get_by_role("button", name="Delete").click()
        expect(cards).to_have_count(1)


@pytest.mark.slow
def test_a_student_in_a_class_waits_for_a_turn_and_gets_the_network(
    chromium: Browser, tmp_path: Path
) -> None:
    page, problems = new_page(chromium), list[str]()
    page.on("pageerror", lambda error: problems.append(str(error)))
    WITHOUT_VISER.serve(page, CLASS_ROOM)
    with served_class(tmp_path) as served:
        ada, ben = driver(served), driver(served)
        for name, value in ben.client.cookies.items():
            page.context.add_cookies([{"name": name, "value": value, "url": served.url}])
        with page_of(ada) as hers:
            learn(hers)
            process = learner(served)
            page.goto(ben.address)
            page.get_by_role("tab", name="Teach").click()
            tab = page.get_by_role("tabpanel", name="Teach")
            button = tab.get_by_role("button", name="Learn from 5 drives")
            button.click()
            expect(tab.get_by_text("Your place in the line: 2.")).to_be_visible()
            expect(button).to_be_disabled()
            process.resume()
            expect(tab.get_by_text("It acts like you in")).to_contain_text("drives now")
            expect(tab.get_by_role("article").get_by_text("drives", exact=True)).to_be_visible()
            expect(tab.get_by_role("button", name="Practise")).to_be_visible()
            expect(tab.get_by_role("heading", name="Try many")).to_be_visible()
        page.goto(f"{served.url}teacher?token={served.token}")
        cards = page.get_by_role("button", name=re.compile("learned: [0-9]+% alike"))
        expect(cards).to_have_count(2)
        page.context.close()
    assert problems == []

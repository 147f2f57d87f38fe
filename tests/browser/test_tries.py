""" "Try many" in a real page: a number, values, a plot and a table."""

from pathlib import Path

import pytest
from playwright.sync_api import Browser, expect

from tests.browser.code_page import WORLD_WAITS, set_limits
from tests.browser.served_viser import ready
from tests.browser.teach_tab import teach_tab
from tests.browser.test_code_drives import CodeTab
from tests.browser.test_play import MIDDLE, agent
from tests.chromium import new_page
from tests.code_sheet import programs_in_docs
from tests.playing import played
from tests.waiting import until

pytestmark = pytest.mark.browser


def test_values_are_tried_and_shown(chromium: Browser, tmp_path: Path) -> None:
    with teach_tab(chromium, tmp_path) as (tab, room):
        page = tab.page
        tab.get_by_role("heading", name="Try many").click()
        expect(tab.get_by_text("You drive this robot by keys.")).to_be_visible()
        start = tab.get_by_role("button", name="Try", exact=True)
        expect(start).to_be_disabled()
        room.editor.set_driver("0", "network:zoo:box_chase").result()
        expect(start).to_be_enabled()

        tab.get_by_label("Part", exact=True).select_option("move")
        tab.get_by_label("Number", exact=True).select_option(label="move amount (m/s)")
        expect(tab.get_by_text("It is 5 now. It can be at least 0, at most 100.")).to_be_visible()
        tab.get_by_label("Values", exact=True).fill("5, x")
        tab.get_by_label("Starts", exact=True).fill("2")
        start.click()
        expect(page.get_by_text("expected numbers with commas between")).to_be_visible()
        tab.get_by_label("Values", exact=True).fill("5, 0.5")
        start.focus()
        page.keyboard.press("Enter")
        expect(tab.get_by_text("4 episodes, the same starts with each value.")).to_be_visible()
        rows = tab.get_by_role("table", name="move: move amount (m/s)").get_by_role("row")
        expect(rows).to_have_count(3)
        expect(rows.nth(1)).to_contain_text("2 of 2")
        expect(rows.nth(1)).to_contain_text("34% and 100%")
        plot = tab.get_by_role("img", name="Share of starts that reached the goal")
        expect(plot).to_be_visible()
        with page.expect_download() as download:
            tab.get_by_role("button", name="Save the table as CSV").click()
        assert download.value.suggested_filename == "box_chase-0.move.move_amount.csv"
        assert Path(download.value.path()).read_text().startswith("0.move.move_amount,episodes")


def test_the_program_of_the_page_is_tried(chromium: Browser) -> None:
    with played("box_chase", "--seed", MIDDLE, *WORLD_WAITS) as server:
        page = new_page(chromium)
        page.goto(server.url)
        ready(page)
        set_limits(page)
        code = CodeTab(page)
        code.write(programs_in_docs()[0])
        page.get_by_role("tab", name="Teach").click()
        tab = page.get_by_role("tabpanel", name="Teach")
        tab.get_by_role("heading", name="Try many").click()
        tab.get_by_label("Driver", exact=True).select_option(label="My program in the tab Code")
        tab.get_by_label("Part", exact=True).select_option("move")
        tab.get_by_label("Number", exact=True).select_option(label="move amount (m/s)")
        tab.get_by_label("Values", exact=True).fill("5, 4")
        tab.get_by_label("Starts", exact=True).fill("2")
        tab.get_by_role("button", name="Try", exact=True).click()
        expect(tab.get_by_text("4 episodes, the same starts with each value.")).to_be_visible()
        rows = tab.get_by_role("table", name="move: move amount (m/s)").get_by_role("row")
        expect(rows).to_have_count(3)
        for row in (1, 2):
            expect(rows.nth(row)).to_contain_text("of 2")
        until(lambda: "Remote" not in agent(server)["brain"])
        page.context.close()

"""The frame of the panel: place, tabs, focus, notices, connection; against a fake socket."""

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Route, expect

from tests.browser.panel_page import PanelPage, panel_page, panel_room
from tests.browser.served_viser import record_texts, recorded_holds
from tests.page.server.rooms import Room

pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def room() -> Iterator[Room]:
    with panel_room() as room:
        yield room


@pytest.fixture(scope="module")
def warm(chromium: Browser, room: Room) -> Iterator[PanelPage]:
    with panel_page(chromium, room) as page:
        yield page


@pytest.fixture
def desk(warm: PanelPage) -> PanelPage:
    """A page with nothing remembered."""
    warm.reset()
    return warm


def test_the_page_tells_what_it_looks_at(desk: PanelPage) -> None:
    assert desk.panel.shown | {"agent": "0"} == {
        "type": "show",
        "agent": "0",
        "tabs": ["agent"],
        "block": None,
        "body": None,
        "others": [],
        "episode": None,
    }
    page_id = desk.page.evaluate("ai4uPageId")
    assert f"page={page_id}" in desk.panel.urls[0]


def test_tabs_open_with_arrow_keys(desk: PanelPage) -> None:
    desk.page.get_by_role("tab", name="Drive").focus()
    desk.page.keyboard.press("Tab")
    desk.page.keyboard.press("Shift+Tab")
    desk.page.keyboard.press("End")
    past = desk.page.get_by_role("tab", name="Past")
    expect(past).to_have_attribute("aria-selected", "true")
    expect(past).to_be_focused()
    desk.until(lambda: desk.panel.shown["tabs"] == ["past"])
    desk.page.keyboard.press("ArrowRight")
    expect(desk.page.get_by_role("tab", name="Drive")).to_be_focused()
    assert desk.page.get_by_role("tabpanel").count() == 1


def test_tabs_of_what_cannot_be_done_here_are_hidden(desk: PanelPage) -> None:
    desk.panel.change("scene", can_edit=False, has_past=False)
    expect(desk.page.get_by_role("tab")).to_have_text(["Drive", "Code"])


def test_a_click_gives_the_keys_back_to_the_world(desk: PanelPage, room: Room) -> None:
    desk.button("Pause").click()
    desk.until(lambda: desk.panel.commands("pause") == [{}])
    expect(desk.page.locator("body")).to_be_focused()
    desk.page.keyboard.down("KeyW")
    desk.until(lambda: room.held == ["KeyW"])
    desk.page.keyboard.up("KeyW")


def test_keys_type_in_a_field_until_enter(desk: PanelPage, room: Room) -> None:
    desk.button("Details").click()
    seed = desk.page.get_by_label("Seed", exact=True)
    seed.click()
    with recorded_holds(room) as holds:
        desk.page.keyboard.press("ControlOrMeta+a")
        desk.page.keyboard.type("w")
        desk.page.keyboard.press("ControlOrMeta+a")
        desk.page.keyboard.type("42")
        desk.page.keyboard.press("Enter")
        desk.until(lambda: desk.panel.commands("seed") == [{"seed": "42"}])
        desk.page.keyboard.down("KeyD")
        desk.until(lambda: room.held == ["KeyD"])
        assert not any("KeyW" in codes for codes in holds)
    desk.page.keyboard.up("KeyD")


def test_a_failure_is_an_alert_and_a_result_a_status(desk: PanelPage) -> None:
    desk.panel.replies["try_again"] = lambda _: {"type": "failed", "text": "No world."}
    desk.panel.replies["lock_seed"] = lambda _: {"text": "Seed locked."}
    desk.panel.send({"type": "note", "level": "error", "text": "Something is wrong."})
    alert = desk.page.locator(".ai4u-notice[role=alert]")
    expect(alert).to_have_text("Something is wrong.")
    desk.button("Try again").click()
    expect(alert).to_have_text("No world.")
    desk.button("Details").click()
    before = desk.button("Pause").bounding_box()
    results = record_texts(desk.page, ".ai4u-notice[role=status]")
    desk.page.get_by_role("switch", name="Lock").click()
    desk.until(lambda: "Seed locked." in results())
    expect(alert).to_be_empty()
    assert desk.button("Pause").bounding_box() == before


def test_details_are_remembered(desk: PanelPage) -> None:
    decision = desk.button("One decision")
    expect(decision).to_be_hidden()
    desk.button("Details").click()
    expect(decision).to_be_visible()
    desk.page.reload()
    expect(decision).to_be_visible()


def test_sections_remember_that_they_are_folded(desk: PanelPage) -> None:
    needs = desk.page.locator("details", has_text="energy")
    needs.locator("summary").click()
    expect(desk.page.get_by_text("energy")).to_be_hidden()
    # a browser reports it a moment later
    desk.page.wait_for_function("Object.values(localStorage).includes('false')")
    desk.page.reload()
    expect(desk.page.get_by_role("heading", name="Needs")).to_be_visible()
    expect(desk.page.get_by_text("energy")).to_be_hidden()


def test_the_panel_can_be_folded_and_resized(desk: PanelPage) -> None:
    panel = desk.page.locator(".ai4u-panel")
    handle = desk.page.get_by_role("separator", name="Size of the panel")
    handle.focus()
    desk.page.keyboard.press("Tab")
    desk.page.keyboard.press("Shift+Tab")
    desk.page.keyboard.press("ArrowLeft")
    expect(panel).to_have_css("width", "360px")
    for _ in range(20):
        desk.page.keyboard.press("ArrowRight")
    expect(panel).to_have_css("width", "280px")
    desk.page.reload()
    expect(panel).to_have_css("width", "280px")
    desk.button("Fold the panel").click()
    expect(desk.button("Pause")).to_be_hidden()
    desk.button("Open the panel").click()
    expect(desk.button("Pause")).to_be_visible()


def test_the_tab_code_takes_almost_half_of_the_window(desk: PanelPage) -> None:
    panel = desk.page.locator(".ai4u-panel")
    handle = desk.page.get_by_role("separator", name="Size of the panel")
    desk.tab("Code").click()
    expect(panel).to_have_css("width", "576px")  # 45% of 1280
    expect(handle).to_have_attribute("aria-valuenow", "45")
    handle.focus()
    desk.page.keyboard.press("Tab")
    desk.page.keyboard.press("Shift+Tab")
    desk.page.keyboard.press("ArrowLeft")
    expect(panel).to_have_css("width", "640px")
    desk.tab("Drive").click()
    expect(panel).to_have_css("width", "340px")
    desk.page.reload()
    desk.tab("Code").click()
    expect(panel).to_have_css("width", "640px")


def test_above_the_tab_code_the_rows_are_folded_into_one(desk: PanelPage) -> None:
    top = desk.page.locator(".ai4u-panel-top")
    more = desk.button("Goal, score and camera")
    expect(more).to_be_hidden()
    desk.tab("Code").click()
    expect(more).to_have_attribute("aria-expanded", "false")
    for name in ("Pause", "Try again", "New start"):
        expect(desk.button(name)).to_be_visible()
    expect(desk.button("Arena")).to_be_hidden()
    box = top.bounding_box()
    assert box
    assert box["height"] <= 48
    more.click()
    expect(desk.button("Arena")).to_be_visible()
    desk.page.reload()
    expect(desk.button("Arena")).to_be_visible()
    more.click()
    expect(desk.button("Arena")).to_be_hidden()
    desk.tab("Drive").click()
    expect(desk.button("Arena")).to_be_visible()


def test_it_connects_again_and_looks_at_the_same(desk: PanelPage) -> None:
    desk.page.get_by_role("tab", name="Past").click()
    desk.until(lambda: desk.panel.shown["tabs"] == ["past"])
    desk.panel.received.clear()
    desk.panel.drop()
    desk.until(lambda: len(desk.panel.urls) == 2)
    desk.until(lambda: any(each["type"] == "show" for each in desk.panel.received))
    assert desk.panel.shown["tabs"] == ["past"]
    desk.button("Pause").click()
    desk.until(lambda: desk.panel.commands("pause") == [{}])


@pytest.mark.parametrize(("width", "height"), [(844, 390), (390, 844), (568, 320)])
def test_on_phones_it_is_folded_at_first_and_leaves_the_stick(
    chromium: Browser, room: Room, width: int, height: int
) -> None:
    with panel_page(chromium, room, width=width, height=height, has_touch=True) as phone:
        expect(phone.button("Pause")).to_be_hidden()
        phone.button("Open the panel").tap()
        for name in ("Pause", "Fold the panel"):
            expect(phone.button(name)).to_be_in_viewport(ratio=1)
        panel = phone.page.locator(".ai4u-panel").bounding_box()
        stick = phone.page.locator(".ai4u-stick").bounding_box()
        assert panel
        assert stick
        is_beside = stick["x"] + stick["width"] <= panel["x"]
        assert is_beside or stick["y"] >= panel["y"] + panel["height"]
        assert stick["y"] + stick["height"] <= height


@pytest.mark.parametrize(("width", "height"), [(390, 844), (844, 390), (568, 320)])
def test_a_tab_that_is_chosen_on_a_phone_fills_the_panel(
    chromium: Browser, room: Room, width: int, height: int
) -> None:
    with panel_page(chromium, room, width=width, height=height, has_touch=True) as phone:
        phone.button("Open the panel").click()
        for name in ("Build", "Past"):
            phone.tab(name).click()
            gap = """tabs => tabs.getBoundingClientRect().top
                - document.querySelector(".ai4u-panel-body").getBoundingClientRect().top"""
            phone.until(lambda: phone.page.get_by_role("tablist").evaluate(gap) < 1)  # noqa: B023


def test_the_drivers_line_is_one_line_beside_the_open_panel_of_a_phone(
    chromium: Browser, room: Room
) -> None:
    with panel_page(chromium, room, width=844, height=390, has_touch=True) as phone:
        phone.button("Open the panel").click()
        row = phone.page.locator(".ai4u-row")
        row.evaluate("row => (row.parentElement.style.right = '356px')")  # as beside a canvas
        phone.page.locator(".ai4u-row [role=status]").evaluate(
            "line => line.firstChild.textContent = 'Page 12 of the other classroom drives'"
        )
        places = row.locator(":scope > :visible").evaluate_all(
            "all => all.map(each => Math.round(each.getBoundingClientRect().bottom))"
        )
        assert len(set(places)) == 1, places
        assert row.evaluate("row => row.querySelector('.ai4u-driver').offsetHeight") <= 40
        assert row.evaluate("row => row.scrollWidth <= row.clientWidth")


def test_the_banner_of_a_folded_phone_is_below_the_world(chromium: Browser, room: Room) -> None:
    with panel_page(chromium, room, width=390, height=844, has_touch=True) as phone:
        banner = phone.page.locator(".ai4u-banners").first.bounding_box()
        dock = phone.page.locator(".ai4u-dock").bounding_box()
        assert banner
        assert dock
        assert 844 / 2 < banner["y"] + banner["height"] < dock["y"]


def test_a_tab_whose_script_failed_to_load_tries_again(chromium: Browser, room: Room) -> None:
    with panel_page(chromium, room) as page:
        page.page.evaluate(
            """async () => {
                const own = [...document.scripts].find(({ src }) => src.endsWith("/main.js")).src;
                const { limits } = await import(new URL("../shared/limits.js", own));
                limits.retryMs = 1;
            }"""
        )
        asked: list[str] = []

        def fail_twice(route: Route) -> None:
            asked.append(route.request.url)
            if len(asked) <= 2:
                route.abort()
            else:
                route.continue_()

        page.page.route("**/panel/past/tab.js", fail_twice)
        page.tab("Past").click()
        expect(page.page.get_by_role("button", name="Current episode")).to_be_visible()
        assert len(asked) == 3
        expect(page.page.locator(".ai4u-notice[role=alert]")).to_be_empty()

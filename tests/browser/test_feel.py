"""Gamepads, keys of one's own, help, taking over, another world; and that all of it can be read."""

import re
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from ai4u_edu import (
    BasicAgent,
    CircleShape,
    DiscreteActuator,
    DiscreteArrowController,
    LocalBrain,
    RBMoveActuator,
    WASDRBMoveController,
    World,
)
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks.keyboard import Stick
from tests.browser.fit import loaded_fonts
from tests.browser.served_viser import (
    SPEED,
    ServedViser,
    connected,
    driver_status,
    frames,
    ready,
    recorded_holds,
    viser_heard,
)
from tests.builders import small_sim
from tests.chromium import new_page
from tests.playing import Played, played
from tests.waiting import LIMIT_S, until

pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def zoo() -> Iterator[Played]:
    with played("box_chase", "--brain", "zoo", "--seed", "1") as server:
        yield server


def agent_of(site: ServedViser) -> BasicAgent:
    return site.room.sim.agents[0]


def cap(page: Page, action: str) -> Locator:
    return page.locator(f".ai4u-keycap[data-action={action}]")


def binding(page: Page, action: str) -> Locator:
    return page.locator(f".ai4u-binding[data-action={action}]")


def pushed(site: ServedViser) -> Stick:
    return agent_of(site).keyboard.stick()


# -- gamepads ------------------------------------------------------------------------------------

PAD = """() => {
    const pad = {index: 0, connected: true, mapping: "standard", axes: [0, 0, 0, 0]};
    pad.buttons = Array.from({length: 17}, () => ({pressed: false, value: 0}));
    window.pad = pad;
    navigator.getGamepads = () => [null, pad.connected ? pad : null];
    window.dispatchEvent(new Event("gamepadconnected"));
}"""


def with_pad(site: ServedViser) -> Page:
    page = site.page()
    page.evaluate(PAD)
    return page


def press(page: Page, button: int, *, down: bool = True) -> None:
    page.evaluate("([button, down]) => pad.buttons[button].pressed = down", [button, down])


def test_a_gamepad_drives_by_halves_jumps_and_restarts(site: ServedViser) -> None:
    page = with_pad(site)
    page.evaluate("pad.axes = [0.05, -0.6]")
    until(lambda: 0.4 < pushed(site).forward < 0.7 and pushed(site).turn == 0)
    until(lambda: site.pose()[0] > 0.1)
    expect(driver_status(page)).to_have_text("You're driving")
    page.evaluate("pad.axes = [1, 0]")
    until(lambda: pushed(site) == Stick(0, 1))
    page.evaluate("pad.axes = [0, 0.1]")
    until(lambda: pushed(site) == Stick())
    for button, code in ((0, "Space"), (1, "KeyJ"), (12, "KeyW"), (15, "KeyD")):
        press(page, button)
        until(lambda code=code: site.room.held == [code])  # type: ignore[misc]
        press(page, button, down=False)
        until(lambda: site.room.held == [])
    episode = site.room.runner.latest.episode
    press(page, 9)
    until(lambda: site.room.runner.latest.episode == episode + 1)


def test_a_gamepad_that_is_unplugged_lets_go(site: ServedViser) -> None:
    page = with_pad(site)
    page.evaluate("pad.axes = [0, -1]")
    press(page, 0)
    until(lambda: (site.room.held, pushed(site)) == (["Space"], Stick(1, 0)))
    page.evaluate("pad.connected = false; dispatchEvent(new Event('gamepaddisconnected'))")
    until(lambda: (site.room.held, pushed(site)) == ([], Stick()))


class TestOneThingAtATime:
    """An agent that takes no halves."""

    @pytest.fixture
    def sim(self) -> ControlRequestor:
        return small_sim(
            controller=DiscreteArrowController(), actuators=[DiscreteActuator(turn_amount=2)]
        )

    def test_the_stick_of_a_gamepad_is_a_key_there(self, site: ServedViser) -> None:
        page = with_pad(site)
        for axes, code in (([0, -1], "ArrowUp"), ([0.9, 0.2], "ArrowRight")):
            page.evaluate("axes => pad.axes = axes", axes)
            until(lambda code=code: site.room.held == [code])  # type: ignore[misc]
        page.evaluate("pad.axes = [0.2, 0]")
        until(lambda: site.room.held == [])


# -- keys of one's own ---------------------------------------------------------------------------


def give(page: Page, action: str, code: str) -> None:
    """Gives an action another key, in the help."""
    if not page.locator(".ai4u-help").is_visible():
        page.keyboard.press("?")
    binding(page, action).click()
    expect(binding(page, action)).to_have_text("Press a key …")
    page.keyboard.press(code)


def test_a_key_of_ones_own_drives_and_is_remembered(site: ServedViser) -> None:
    page = site.page()
    give(page, "forward", "KeyI")
    expect(binding(page, "forward")).to_have_text("I")
    page.keyboard.press("Escape")
    for _ in range(2):
        expect(cap(page, "forward").locator("kbd")).to_have_text("I")
        page.keyboard.down("KeyW")
        page.keyboard.down("KeyI")
        until(lambda: site.room.held == ["KeyW"])  # what the agent knows as forward
        page.keyboard.up("KeyI")
        until(lambda: site.room.held == [])
        page.keyboard.up("KeyW")
        page.reload()
        ready(page)
    page.keyboard.press("?")
    page.get_by_role("button", name="Reset keys").click()
    expect(binding(page, "forward")).to_have_text("W or ↑")
    page.keyboard.press("Escape")
    page.keyboard.down("KeyW")
    until(lambda: site.room.held == ["KeyW"])


def test_a_key_that_another_action_has_is_said_and_both_have_one(site: ServedViser) -> None:
    page = site.page()
    give(page, "forward", "KeyR")
    told = page.locator(".ai4u-status")
    expect(told).to_have_text("R was “restart”, which is W, ↑ now.")
    expect(binding(page, "restart")).to_have_text("W or ↑")
    give(page, "jump", "KeyA")  # of two keys one is left
    expect(told).to_have_text("A was “left”, which is ← now.")
    give(page, "jump", "Tab")
    expect(binding(page, "jump")).to_have_text("Press a key …")
    page.keyboard.press("F5")
    expect(told).to_have_text("F5 is needed elsewhere; press another key.")
    expect(binding(page, "jump")).to_have_text("A")
    episode = site.room.runner.latest.episode
    page.keyboard.press("Escape")
    page.keyboard.press("KeyW")
    until(lambda: site.room.runner.latest.episode == episode + 1)


def test_escape_leaves_a_key_as_it_was_and_the_help_open(site: ServedViser) -> None:
    page = site.page()
    give(page, "jump", "Escape")
    expect(binding(page, "jump")).to_have_text("Space or U")
    expect(page.locator(".ai4u-help")).to_be_visible()


@pytest.mark.parametrize(
    "storage",
    [
        "Object.defineProperty(window, 'localStorage', {get() { throw new Error('forbidden'); }})",
        'localStorage.setItem(\'ai4u-keys\', \'{"at up": 5, "jump": ["<b>"]}\')',
    ],
)
def test_where_nothing_can_be_remembered_keys_can_be_changed_all_the_same(
    site: ServedViser, storage: str
) -> None:
    page = site.page(prepare=lambda page: page.add_init_script(storage))
    expect(cap(page, "forward").locator("kbd")).to_have_text("W")
    give(page, "forward", "KeyI")
    page.keyboard.press("Escape")
    page.keyboard.down("KeyI")
    until(lambda: site.room.held == ["KeyW"])


# -- help ----------------------------------------------------------------------------------------


def test_help_opens_on_a_question_mark_and_takes_the_keys(site: ServedViser) -> None:
    page = site.page(has_viser=True)
    camera = site.camera()
    page.keyboard.down("KeyW")
    until(lambda: site.room.held == ["KeyW"])
    page.keyboard.press("?")
    dialog = page.get_by_role("dialog", name="Help")
    expect(dialog).to_be_visible()
    until(lambda: site.room.held == [])
    page.keyboard.up("KeyW")
    with recorded_holds(site.room) as holds:
        for code in ("KeyA", "KeyQ"):
            page.keyboard.down(code)
            frames(page, 5)  # viser moves its camera with each frame while a key is held
            page.keyboard.up(code)
        expect(dialog).to_contain_text("To change one, click it and press another key.")
        page.keyboard.press("Escape")
        expect(dialog).to_be_hidden()
        page.keyboard.down("KeyD")
        until(lambda: site.room.held == ["KeyD"])
        assert not any("KeyA" in codes for codes in holds)
    page.keyboard.up("KeyD")
    viser_heard(site, page)
    assert site.camera() == camera


def test_the_focus_stays_in_the_help_and_comes_back(site: ServedViser) -> None:
    page = site.page()
    ask = page.get_by_role("button", name="Help")
    ask.focus()
    page.keyboard.press("Enter")
    inside = (
        "document.activeElement === document.body || !!document.activeElement.closest('dialog')"
    )
    seen = set()
    for key in ["Tab"] * 14 + ["Shift+Tab"] * 4:
        page.keyboard.press(key)
        assert page.evaluate(inside)
        seen.add(page.evaluate("document.activeElement.dataset.action"))
    assert {"forward", "restart"} <= seen
    page.keyboard.press("Escape")
    expect(ask).to_be_focused()
    page.get_by_role("button", name="Help").click()
    page.get_by_role("button", name="Close").click()
    expect(page.get_by_role("dialog")).to_be_hidden()


def test_a_question_mark_in_a_text_is_one(site: ServedViser) -> None:
    page = site.page()
    text = page.get_by_role("textbox").first
    text.click()
    page.keyboard.type("why?")
    expect(text).to_have_value("why?")
    expect(page.get_by_role("dialog")).to_have_count(0)


# -- for everybody -------------------------------------------------------------------------------

CONTRAST = """() => {
    const canvas = document.createElement("canvas").getContext("2d", {willReadFrequently: true});
    const rgba = (text) => {
        canvas.clearRect(0, 0, 1, 1);
        canvas.fillStyle = text;
        canvas.fillRect(0, 0, 1, 1);
        const [r, g, b, a] = canvas.getImageData(0, 0, 1, 1).data;
        return [r, g, b, a / 255];
    };
    const over = ([r, g, b, a], under) => [r, g, b].map((c, i) => a * c + (1 - a) * under[i]);
    const light = (c) => c.map((v) => v / 255)
        .map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4))
        .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
    const found = [];
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    for (let node = walker.nextNode(); node; node = walker.nextNode()) {
        const part = node.parentElement;
        if (!node.data.trim() || !part.checkVisibility()) continue;
        if (!part.closest(".ai4u-dock, .ai4u-banners, .ai4u-help, .ai4u")) continue;
        if (getComputedStyle(part).fontSize === "0px") continue;
        const grounds = [];
        for (let each = part; each; each = each.parentElement) {
            grounds.unshift(rgba(getComputedStyle(each).backgroundColor));
        }
        let worst = Infinity;
        for (const world of [[0, 0, 0], [255, 255, 255]]) { // whatever lies below
            const ground = grounds.reduce((under, colour) => over(colour, under), world);
            const ink = over(rgba(getComputedStyle(part).color), ground);
            const [low, high] = [light(ink), light(ground)].sort((a, b) => a - b);
            worst = Math.min(worst, (high + 0.05) / (low + 0.05));
        }
        found.push([node.data.trim().slice(0, 40), worst]);
    }
    return found;
}"""


LIGHTNESS = r"""name => {
    const part = document.querySelector(name);
    return getComputedStyle(part).backgroundColor.match(/[\d.]+/g).slice(0, 3).map(Number);
}"""
SCHEME = "data-mantine-color-scheme"


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_all_that_is_written_can_be_read(site: ServedViser, scheme: str) -> None:
    def dress(page: Page) -> None:
        # a colour that is still on its way can be any
        page.emulate_media(color_scheme=scheme, reduced_motion="reduce")  # type: ignore[arg-type]

    dimmed = "color: var(--mantine-color-dimmed)"
    site.inner.gui.add_html(f"<div class='ai4u'><small style='{dimmed}'>dimmed</small></div>")
    query = "?darkMode" if scheme == "dark" else ""
    page = site.page(query, has_viser=True, prepare=dress, wait=False)
    connected(page)
    page.get_by_text("dimmed").wait_for(state="attached")
    expect(page.locator("html")).to_have_attribute(SCHEME, scheme)
    is_dark = max(page.evaluate(LIGHTNESS, ".ai4u-keycap")) < 80
    assert is_dark == (scheme == "dark"), "as its address says"
    other = site.page()
    other.keyboard.down("KeyW")
    expect(driver_status(page)).to_have_text("Another page drives")
    found = page.evaluate(CONTRAST)
    other.keyboard.up("KeyW")
    page.get_by_role("button", name="Take over").click()
    expect(driver_status(page)).to_have_text("You're driving")
    found += page.evaluate(CONTRAST)
    site.room.runner.pause().result(LIMIT_S)
    expect(page.locator(".ai4u-banner", has_text="Paused")).to_be_visible()
    found += page.evaluate(CONTRAST)
    page.keyboard.press("?")
    binding(page, "jump").click()
    found += page.evaluate(CONTRAST)
    texts = {text for text, _ in found}
    assert {
        "You're driving",
        "Take over",
        "forward",
        "Resume",
        "Help",
        "Press a key …",
    } <= texts
    assert [(text, ratio) for text, ratio in found if ratio < 4.5] == []


def dark(page: Page) -> Locator:
    """Return the panel's switch that makes the page dark."""
    connected(page)
    return page.get_by_role("switch", name="Dark", exact=True)


def test_it_is_dark_where_the_system_is_until_somebody_says_otherwise(
    chromium: Browser, zoo: Played
) -> None:
    page = new_page(chromium, color_scheme="dark", reduced_motion="reduce")
    page.goto(zoo.url)
    expect_dark(page, is_dark=True)
    for part in (".ai4u-keycap", ".ai4u-driver", ".ai4u-panel"):
        until(lambda: max(page.evaluate(LIGHTNESS, part)) < 80)  # noqa: B023
    dark(page).click()
    expect_dark(page, is_dark=False)
    until(lambda: min(page.evaluate(LIGHTNESS, ".ai4u-keycap")) > 180)
    page.reload()  # it is remembered, against the system's wish
    expect_dark(page, is_dark=False)
    page.context.close()


@pytest.mark.nightly
def test_dark_is_remembered_against_a_light_system(chromium: Browser, zoo: Played) -> None:
    page = new_page(chromium, color_scheme="light", reduced_motion="reduce")
    page.goto(zoo.url)
    expect_dark(page, is_dark=False)
    dark(page).click()
    page.reload()
    expect_dark(page, is_dark=True)
    page.context.close()


def expect_dark(page: Page, *, is_dark: bool) -> None:
    """Wait until the switch and the page have the colours."""
    state, scheme = ("true", "dark") if is_dark else ("false", "light")
    expect(dark(page)).to_have_attribute("aria-checked", state)
    expect(page.locator("html")).to_have_attribute(SCHEME, scheme)


NAMELESS = """() => [...document.querySelectorAll(
    "input:not([type=hidden]), textarea, button:not([hidden], [type=submit]), [role=slider]"
)].filter((part) => part.type === "file" || part.checkVisibility()).filter((part) => {
    const name = part.ariaLabel || part.labels?.[0]?.textContent
        || (part.tagName === "BUTTON" && part.textContent.trim());
    return !name && part.ariaHidden !== "true" && part.tabIndex >= 0;
}).map((part) => part.outerHTML.slice(0, 200))"""


def test_all_that_can_be_used_has_a_name(chromium: Browser, zoo: Played) -> None:
    page = new_page(chromium, height=1200)
    page.goto(zoo.url)
    connected(page)
    page.keyboard.press("KeyR")  # there is a past then
    page.get_by_role("button", name="Details", exact=True).click()
    for tab, last in {
        "Drive": "One decision",
        "Build": "Add a sensor",
        "World": "Open a file",
        "Past": "Open a recording",
    }.items():
        page.get_by_role("tab", name=tab).click()
        page.get_by_role("button", name=last, exact=True).wait_for()
        until(lambda: page.evaluate(NAMELESS) == [])
    page.context.close()


def test_who_wants_no_motion_has_none(site: ServedViser) -> None:
    def calm(page: Page) -> None:
        page.emulate_media(reduced_motion="reduce")

    moves = """() => [...document.querySelectorAll(".ai4u-dock *, .ai4u-banner, .ai4u-help *")]
        .map((part) => getComputedStyle(part))
        .filter((style) => style.animationName !== "none" || parseFloat(style.transitionDuration))
        .length"""
    assert site.page().evaluate(moves) > 0
    assert site.page(prepare=calm).evaluate(moves) == 0


def test_everything_is_reached_by_tab_has_a_name_and_shows_the_focus(
    site: ServedViser,
) -> None:
    page = site.page()
    page.get_by_role("button", name="Press me").focus()
    reached: list[list[str]] = []
    for _ in range(40):
        page.keyboard.press("Tab")
        reached.append(
            page.evaluate(
                """() => {
                    const part = document.activeElement;
                    const style = getComputedStyle(part);
                    const name = part.ariaLabel || part.textContent;
                    return [part.dataset.action ?? part.className, name, style.outlineStyle];
                }"""
            )
        )
    ours = {what: (name, ring) for what, name, ring in reached}
    for what in ("forward", "backward", "left", "right", "jump", "jump_forward", "restart"):
        name, ring = ours[what]
        assert re.fullmatch(r"[a-z ]+ \(.+\)", name)
        assert ring == "solid"
    assert ours["ai4u-round-button"] == ("Help", "solid")


# -- taking over ---------------------------------------------------------------------------------


def spin(_percept: Any) -> dict[str, Any]:
    return {"move": [0, -0.5, 0, 0]}


class TestScripted:
    """An agent that turns round and round, until somebody drives."""

    @pytest.fixture
    def sim(self) -> ControlRequestor:
        world = World()
        world.add_body("robot", CircleShape(radius=0.5))
        return small_sim(
            world=world, controller=spin, actuators=[RBMoveActuator(move_amount=SPEED)]
        )

    def test_a_key_takes_over_and_let_go_gives_back(self, site: ServedViser) -> None:
        page = site.page()
        expect(driver_status(page)).to_have_text("A script drives \u2013 press W to take over")
        before = site.room.runner.latest.episode
        page.keyboard.press("KeyR")
        until(lambda: site.room.runner.latest.episode == before + 1)
        expect(driver_status(page)).to_have_text("A script drives \u2013 press W to take over")
        page.keyboard.down("KeyW")
        until(lambda: site.room.held == ["KeyW"])
        expect(driver_status(page)).to_have_text("You're driving")
        until(lambda: site.room.runner.latest.agents[0].action["move"] == (1, 0, 0, 0))
        page.keyboard.up("KeyW")
        until(lambda: site.room.runner.latest.agents[0].action["move"] == (0, 0, 0, 0))
        page.get_by_role("button", name="Let go").click()
        expect(driver_status(page)).to_have_text("A script drives \u2013 press W to take over")
        until(lambda: site.room.runner.latest.agents[0].action["move"][1] == -0.5)

    def test_a_click_takes_over_and_a_closed_page_gives_back(self, site: ServedViser) -> None:
        page = site.page()
        page.get_by_role("button", name="Take over").click()
        expect(driver_status(page)).to_have_text("You're driving")
        page.context.close()
        until(lambda: site.room.runner.latest.agents[0].action["move"][1] == -0.5)


def test_a_network_of_the_zoo_is_taken_over_and_goes_on(zoo: Played, site: ServedViser) -> None:
    page = new_page(site.chromium)
    page.goto(zoo.url)
    connected(page)

    def action() -> list[float]:
        move: list[float] = zoo.snapshot()["agents"][0]["action"].get("move", [])
        return move[:2]  # nothing after a reset

    expect(driver_status(page)).to_have_text("A network drives \u2013 press W to take over")
    page.keyboard.press("KeyR")
    page.keyboard.down("KeyS")
    until(lambda: action()[:1] < [-0.3] and action()[1:] == [0])  # at a beginner's speed
    expect(driver_status(page)).to_have_text("You're driving")
    page.keyboard.up("KeyS")
    page.keyboard.press("KeyR")
    page.locator(".ai4u-dock").get_by_role("button", name="Let go").click()
    expect(driver_status(page)).to_have_text("A network drives \u2013 press W to take over")
    until(lambda: action() not in ([], [-1, 0], [0, 0]))
    page.context.close()


# -- another world -------------------------------------------------------------------------------


def worlds_robot(site: ServedViser) -> BasicAgent:
    world = World()
    world.add_body("other", CircleShape(radius=0.5))
    world.add_body("robot", CircleShape(radius=0.5), position=(3, 0))
    agents = [
        BasicAgent(
            body=body,
            id=agent_id,
            actuators=[RBMoveActuator(move_amount=2)],
            brains=[LocalBrain(controller=WASDRBMoveController(), skip_frame=0)],
        )
        for body, agent_id in (("other", "1"), ("robot", "0"))
    ]
    site.room.runner.replace_sim(ControlRequestor(world, agents)).result(LIMIT_S)
    return agents[1]


@pytest.mark.parametrize("query", ["", "?agent=0"])
def test_a_page_follows_into_another_world(site: ServedViser, query: str) -> None:
    page = site.page(query)
    page.keyboard.down("KeyW")
    until(lambda: site.room.held == ["KeyW"])
    expect(driver_status(page)).to_have_text("You're driving")
    new = worlds_robot(site)
    expect(driver_status(page)).to_have_text("Press a key to drive")
    page.keyboard.up("KeyW")
    page.keyboard.down("KeyW")
    until(lambda: new.keyboard.held() == {"KeyW"})
    until(lambda: new.body.position[0] > 3.1)


# -- nobody else is asked ------------------------------------------------------------------------


def test_the_whole_page_comes_from_here(zoo: Played, site: ServedViser) -> None:
    page = new_page(site.chromium)
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    page.on("websocket", lambda socket: asked.append(socket.url))
    page.goto(zoo.url)
    connected(page)
    page.keyboard.press("?")
    page.keyboard.press("Escape")
    page.keyboard.press("KeyW")
    expect(driver_status(page)).to_contain_text("You're driving")
    page.keyboard.press("KeyR")
    page.get_by_role("tab", name="Past").click()
    card = page.locator(".ai4u-tabpanel:visible article")
    card.first.wait_for()  # all parts of the page are there and work
    assert loaded_fonts(page) == ["Atkinson Hyperlegible Next"]
    here = zoo.url.split("//")[1].rstrip("/")
    elsewhere = [url for url in asked if url.split("//")[-1].split("/")[0] != here]
    assert [url for url in elsewhere if not url.startswith(("blob:", "data:"))] == []
    assert len([url for url in asked if "/web-" in url]) >= 10
    sizes = page.evaluate(
        "performance.getEntriesByType('resource').concat(performance.getEntriesByType('navigation'))"
        ".map(each => each.transferSize)"
    )
    assert sum(sizes) < 1_200_000, "bytes at the first load, besides the pictures of the world"
    page.context.close()

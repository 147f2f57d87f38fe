"""The button "Test" of the tab "Code": a fake Python and world for its logic, and a real room."""

from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.code_page import WORLD_WAITS, set_limits
from tests.browser.code_tab import PROGRAM, CodePage
from tests.browser.fake_panel import PARTS
from tests.browser.schemes import SCHEMES
from tests.browser.served_viser import ready
from tests.browser.test_code_drives import CodeTab as RealTab
from tests.browser.test_panel_accessibility import findings
from tests.browser.test_play import MIDDLE, agent
from tests.chromium import new_page
from tests.code_sheet import programs_in_docs
from tests.playing import played
from tests.waiting import until

pytestmark = pytest.mark.browser

STAND_IN = """
const { CodeTest } = await import("./web/code/test.js");
const log = [];
const world = { max: 0, restored: 0, closed: 0, connected: 0, finished: 0 };
const setup = {
  success: "touch", maxSteps: 100, connectError: null, resetError: null,
  decide: () => ({ ok: true, values: {} }), terms: () => ({ touch: 100 }), last: 3,
  isTruncated: () => false, reward: 1, isStuck: () => false, ticks: 60,
};
class Client {
  get welcome() {
    const { success, maxSteps } = setup;
    return { success, maxSteps, ticksPerSecond: 60, readings: [], outputs: [] };
  }
  async reset(seed) {
    if (setup.resetError) throw Object.assign(new Error("no"), { code: setup.resetError });
    log.push(["reset", seed]);
    this.seed = seed;
    [this.step, this.episode] = [0, (this.episode ?? 0) + 1];
  }
  async act(values) { this.step += 1; }
  async sense() {
    if (setup.isStuck(this)) return new Promise(() => {});
    const isEnd = this.step === setup.last;
    const isTruncated = isEnd && setup.isTruncated(this.seed);
    return {
      values: {}, episode: this.episode, step: this.step, tick: 7 + this.step * setup.ticks,
      reward: this.step ? setup.reward : 0, terms: isEnd ? setup.terms(this.seed) : {},
      terminated: isEnd && !isTruncated, truncated: isTruncated,
    };
  }
  close() { world.closed += 1; }
}
const engine = {
  load: async (source) => { log.push(["load", source]); return { ok: true }; },
  begin: async () => { log.push(["begin"]); return { ok: true }; },
  decide: async (percept, number) => setup.decide(number),
  finish: () => { world.finished += 1; },
};
const parts = {
  warm: async () => engine,
  speed: { max: async () => { world.max += 1; }, restore: () => { world.restored += 1; } },
  connect: async (options) => {
    world.connected += 1;
    if (setup.connectError) throw Object.assign(new Error("no"), { code: setup.connectError });
    log.push(["connect", options]);
    return new Client();
  },
  outcome: async () => "fell",
};
"""
"""A world whose episodes take three decisions, and a Python that decides at once."""


@pytest.fixture(scope="module")
def page(chromium: Browser) -> Iterator[Page]:
    tab = CodePage(chromium)
    yield tab.page
    tab.close()


def results(
    page: Page,
    setting: str = "",
    then: str = "await running;",
    draw: str = "const test = new CodeTest(parts);",
) -> dict[str, Any]:
    """Run a test with the stand-ins, and return what there is at its end.

    Args:
        setting: statements before it.
        then: statements while it runs.
        draw: makes the test.
    """
    end = 'let end; test.addEventListener("end", ({ detail }) => (end = detail));'
    run = f'{draw} {end} const running = test.run("source", "0"); {then}'
    got = "return { rows: test.rows, failure: test.failure, isOn: test.isOn, end, log, world };"
    found: dict[str, Any] = page.evaluate(f"async () => {{ {STAND_IN} {setting} {run} {got} }}")
    return found


def test_each_of_ten_seeds_is_driven_once(page: Page) -> None:
    found = results(page)
    seeds = [row["seed"] for row in found["rows"]]
    assert len(set(seeds)) == 10
    assert all(0 <= seed < 10**6 for seed in seeds)
    assert found["log"][0] == ["connect", {"agent": "0", "mode": "lockstep"}]
    start = [["load", "source"], None, ["begin"]]
    expected = [each or ["reset", seed] for seed in seeds for each in start]
    assert found["log"][1:] == expected, "no start depends on what the one before has left"
    assert found["rows"][9] == {
        "number": 10,
        "seed": seeds[9],
        "outcome": "goal",
        "decisions": 3,
        "seconds": 3,
        "reward": 3,
    }
    assert (found["end"]["reason"], found["failure"], found["isOn"]) == ("tested", None, False)
    assert found["world"] == dict.fromkeys(found["world"], 1)
    assert [row["seed"] for row in results(page)["rows"]] != seeds


def test_the_goal_is_counted_as_evaluate_does(page: Page) -> None:
    draw = "const test = new CodeTest({ ...parts, draw: () => [1, 2, 3] });"
    setting = (
        "setup.terms = (seed) => (seed === 1 ? { touch: 1 } : {});"
        "setup.isTruncated = (seed) => seed === 3;"
    )
    found = results(page, setting, draw=draw)
    assert [row["outcome"] for row in found["rows"]] == ["goal", "fell", "time"]
    assert found["failure"] == 2


def test_an_end_that_pays_is_the_goal_of_a_scene_that_names_none(page: Page) -> None:
    found = results(page, "setup.success = '';")
    assert {row["outcome"] for row in found["rows"]} == {"goal"}
    found = results(page, "setup.success = ''; setup.reward = -1;")
    assert {row["outcome"] for row in found["rows"]} == {"fell"}


def test_an_episode_without_a_limit_ends_after_a_minute(page: Page) -> None:
    found = results(page, "setup.maxSteps = 0; setup.last = 9e9; setup.ticks = 600;")
    assert {(row["outcome"], row["decisions"], row["seconds"]) for row in found["rows"]} == {
        ("time", 6, 60)
    }


def test_stop_ends_it_at_once(page: Page) -> None:
    stuck = """
      const { promise: isStuck, resolve } = Promise.withResolvers();
      setup.isStuck = ({ step }) => step === 2 && (resolve(), true);
    """
    found = results(page, stuck, "await isStuck; test.stop();")
    assert (found["end"]["reason"], found["isOn"]) == ("stopped", False)
    assert found["world"] == dict.fromkeys(found["world"], 1)
    assert {row["outcome"] for row in found["rows"]} == {""}


def test_stop_before_the_world_answers_closes_the_connection(page: Page) -> None:
    late = """
      const { connect } = parts;
      const asked = [1, 2].map(() => Promise.withResolvers());
      const answers = [];
      parts.connect = async (options) => {
        const { promise, resolve } = Promise.withResolvers();
        asked[answers.push(resolve) - 1].resolve();
        await promise;
        return connect(options);
      };
    """
    stopped_twice = """
      await asked[0].promise;
      test.stop();
      const again = test.run("source", "0");
      await asked[1].promise;
      test.stop();
      for (const answer of answers) answer();
      await Promise.all([running, again]);
    """
    found = results(page, late, stopped_twice)
    ends = dict.fromkeys(("restored", "closed", "connected", "finished"), 2)
    assert found["world"] == {"max": 0, **ends}


@pytest.mark.parametrize("late", ["connectError", "resetError"])
def test_a_world_of_several_agents_is_told(page: Page, late: str) -> None:
    code = {"connectError": "lockstep_refused", "resetError": "seed_refused"}[late]
    found = results(page, f"setup.{late} = '{code}';")
    assert found["end"]["reason"] == "lost"
    assert "for the other robots of this world, too" in found["end"]["text"]
    assert found["world"]["restored"] == 1


def test_a_mistake_ends_it_at_its_line(page: Page) -> None:
    answer = "{ ok: false, text: 'nothing is called x', line: 2, kind: 'unknown-name' }"
    found = results(
        page,
        f"setup.decide = (number) => (number === 2 ? {answer} : {{ ok: true, values: {{}} }});",
    )
    assert (found["end"]["reason"], found["end"]["line"]) == ("mistake", 2)
    assert found["end"]["text"] == "nothing is called x"
    assert (found["rows"][0]["outcome"], found["rows"][1]["outcome"]) == ("mistake", "")
    assert found["failure"] == found["rows"][0]["seed"]
    assert found["world"]["restored"] == found["world"]["closed"] == 1


def test_the_speed_comes_back_also_after_a_lost_connection(page: Page) -> None:
    script = """async () => {
      const { WorldSpeed } = await import("./web/code/speed.js");
      const sent = [];
      const panel = new EventTarget();
      let run = { speed: 0.5 };
      let ok = true;
      panel.part = () => run;
      panel.send = async (command, { speed }) => { sent.push(speed); return { ok }; };
      const told = (speed) => {
        run = { speed };
        panel.dispatchEvent(new CustomEvent("part:run", { detail: run }));
      };
      const speed = new WorldSpeed(panel);
      await speed.restore();
      await speed.max();
      told("max");
      ok = false;
      await speed.restore();
      await speed.restore();
      ok = true;
      panel.dispatchEvent(new Event("connected"));
      told("max");
      await speed.max(); // before the page knows that it is back
      await speed.restore();
      told(0.5);
      panel.dispatchEvent(new Event("connected"));
      return sent;
    }"""
    assert page.evaluate(script) == ["max", 0.5, 0.5, "max", 0.5]


def test_the_outcome_is_the_worlds_word_for_this_episode(page: Page) -> None:
    script = """async () => {
      const { outcomeOf } = await import("./web/code/speed.js");
      const panel = new EventTarget();
      let run = { result: "time", decision: 4, seed: "12" };
      panel.part = () => run;
      const word = outcomeOf(panel, { step: 5 }, 12);
      panel.dispatchEvent(new Event("part:run"));
      run = { result: "fell", decision: 5, seed: "12" };
      panel.dispatchEvent(new Event("part:run"));
      return [await word, await outcomeOf(panel, { step: 6 }, 12)];
    }"""
    assert page.evaluate(script) == ["fell", "over"]


# -- the tab ---------------------------------------------------------------------------------------


@pytest.fixture
def tab(chromium: Browser) -> Iterator[CodePage]:
    tab = CodePage(chromium)
    yield tab
    tab.close()
    assert tab.errors == []


def with_results(tab: CodePage) -> None:
    """Press Test in a world in which the first start fails, and the others reach the goal."""
    tab.give({**PARTS["run"], "speed": 2}, "run")
    tab.write(PROGRAM)
    tab.page.evaluate(
        """() => {
          const values = { box: [0.5, 2] };
          const percept = { values, reward: 0, terms: {}, tick: 0, truncated: false };
          for (let episode = 1; episode <= 10; episode += 1) {
            fake.percepts.push({ ...percept, episode, step: 0, terminated: false });
            const terms = { touch: episode === 1 ? 0 : 100 };
            const isLate = episode === 1;
            fake.percepts.push({
              ...percept, episode, step: 1, tick: 6, terms, terminated: !isLate, truncated: isLate,
            });
          }
        }"""
    )
    tab.press("Test")
    expect(tab.state).to_contain_text("9 of 10 reached the goal.")


def test_the_tab_shows_a_table(tab: CodePage) -> None:
    with_results(tab)
    table = tab.page.get_by_role("table", name="9 of 10 reached the goal.")
    assert table.get_by_role("columnheader").all_inner_texts() == [
        "No.",
        "Seed",
        "End",
        "Decisions",
        "Time",
    ]
    assert table.get_by_role("rowheader").all_inner_texts() == [str(n) for n in range(1, 11)]
    ends = table.locator("tbody td:nth-child(3)").all_inner_texts()
    assert ends == ["time is up"] + ["goal"] * 9
    assert table.locator("tbody td:nth-child(5)").all_inner_texts() == ["0.1 s"] * 10
    sent = tab.sent()
    assert sent == [{"command": "speed", "speed": "max"}, {"command": "speed", "speed": 2}]


def test_a_row_begins_its_start(tab: CodePage) -> None:
    with_results(tab)
    tab.sent()
    again = tab.page.locator(".ai4u-code-test tbody button").nth(2)
    again.focus()
    tab.page.keyboard.press("Enter")
    assert tab.sent() == [{"command": "seed", "seed": again.inner_text()}]
    tab.page.locator(".ai4u-code-test tbody tr").nth(4).locator("td").nth(3).click()
    (command,) = tab.sent()
    assert command["seed"] == tab.page.locator(".ai4u-code-test button").nth(4).inner_text()


def test_the_first_failure_can_be_watched(tab: CodePage) -> None:
    with_results(tab)
    resets = len(tab.calls("reset"))
    tab.sense()
    tab.sense()
    tab.press("Watch the first failure")
    expect(tab.state).to_contain_text("Runs")
    assert tab.calls("connect")[-1] == [{"agent": "0", "mode": "realtime"}]
    seed = int(tab.page.locator(".ai4u-code-test button").first.inner_text())
    assert tab.calls("reset")[resets:] == [[seed]]
    tab.press("Stop")


def test_who_drives_ends_the_test(tab: CodePage) -> None:
    tab.press("Test")
    expect(tab.state).to_contain_text("Tests the program")
    tab.page.evaluate(
        """() => {
          panel.driver = { hello: { instead: "Your program" } };
          panel.dispatchEvent(new CustomEvent("driver"));
        }"""
    )
    expect(tab.mistake).to_have_text("You're driving, so the test was ended.")
    assert tab.page.evaluate("fake.closed") == 1


@pytest.mark.parametrize("scheme", SCHEMES)
def test_it_fits_a_phone_and_has_no_grave_finding(chromium: Browser, scheme: str) -> None:
    tab = CodePage(chromium, size=(390, 844), scheme=scheme, has_touch=True, is_mobile=True)
    with_results(tab)
    assert tab.small_controls(40) == []
    assert tab.unnamed_controls() == []
    assert tab.page.evaluate("document.documentElement.scrollWidth") <= 390
    assert findings(tab.page, ".ai4u-panel") == []
    tab.close()


# -- a real room -----------------------------------------------------------------------------------


@pytest.mark.nightly
def test_the_program_of_the_docs_is_tested_in_a_real_world(chromium: Browser) -> None:
    options = ("--seed", MIDDLE, "--time-scale", "2", *WORLD_WAITS)
    with played("box_chase", *options) as server:
        page = new_page(chromium)
        page.goto(server.url)
        ready(page)
        set_limits(page)
        tab = RealTab(page)
        tab.write(programs_in_docs()[0])
        tab.press("Test")
        expect(tab.state).to_contain_text("Tests the program")
        until(lambda: server.snapshot()["time_scale"] != 2)
        tab.press("Stop")
        expect(tab.state).to_contain_text("the robot is yours")
        until(lambda: server.snapshot()["time_scale"] == 2)
        until(lambda: "Remote" not in agent(server)["brain"])
        page.keyboard.press("Escape")
        page.keyboard.press("KeyW")
        expect(page.locator(".ai4u-row .ai4u-driver")).to_contain_text("You're driving")
        tab.press("Test")
        expect(tab.state).to_contain_text("of 10 reached the goal")
        until(lambda: server.snapshot()["time_scale"] == 2)
        rows = page.locator(".ai4u-code-test tbody tr")
        expect(rows).to_have_count(10)
        for row in rows.all():
            seed, end, decisions, seconds = row.locator("td").all_inner_texts()
            assert seed.isdecimal()
            assert end in ("goal", "fell", "time is up")
            assert int(decisions) > 0
            assert seconds != "0.0 s"
        page.context.close()

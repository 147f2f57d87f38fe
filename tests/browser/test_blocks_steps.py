"""The five steps of blocks: each is done by its program in a real maze, not by the one before."""

import json
from collections.abc import Iterator
from functools import cache
from typing import Any

import pytest
from playwright.sync_api import Browser

from ai4u_edu import LocalBrain, Percept, Scene
from ai4u_edu.program import Program
from tests.browser.blocks_steps import PROGRAMS
from tests.browser.tab_page import TabPage
from tests.page.panel.rooms import panel_room
from tests.waiting import LIMIT_S

pytestmark = pytest.mark.browser

SEED = 4
DECISIONS = (60, 80, 320, 320, 1000)
"""Decisions in which the step of that number, from 0, is done; the last one: most of an episode."""
KEPT = "localStorage['ai4u-blocks-steps'] ?? '0'"
SCRIPT = """async ([part, programs]) => {
  const { agentBlocks } = await import("./web/blocks/agent.js");
  const { pythonOf } = await import("./web/blocks/python.js");
  const { BlockSteps } = await import("./web/blocks/steps.js");
  panel.parts.scene = { scene: "maze", can_edit: true };
  window.makeSteps = (done) => {
    localStorage["ai4u-blocks-steps"] = done;
    window.steps?.element.remove();
    const open = (scene) => panel.send("open_scene", { name: scene, is_saved: false });
    window.steps = new BlockSteps(panel, open);
    steps.setAgent(part);
    document.body.append(steps.element);
  };
  return programs.map((state) => pythonOf(state, agentBlocks(part)).text);
}"""


@pytest.fixture(scope="module")
def tab(chromium: Browser) -> Iterator[TabPage]:
    tab = TabPage(chromium, "panel/past/tab", "PastTab", "past")
    yield tab
    tab.close()
    assert tab.errors == []


@pytest.fixture(scope="module")
def sources(tab: TabPage) -> list[str]:
    """Texts of the steps' programs in Python."""
    with panel_room("maze") as room, room.page() as page:
        page.show("0", "agent")
        part = page.part("python")
    sources: list[str] = tab.page.evaluate(SCRIPT, [part, PROGRAMS])
    return sources


@cache
def driven(source: str, seed: int, decisions: int) -> list[dict[str, Any]]:
    """Return what a program saw and did in the maze."""
    program = Program.load(source, limit_s=LIMIT_S)
    sim = Scene.load("maze").build()
    seen: list[dict[str, Any]] = []

    def decide(percept: Percept) -> dict[str, list[float]]:
        values = {"vision": percept["vision"].tolist()}
        action = program.decide(values)
        seen.append({"percept": values, "action": action})
        return action

    sim.agents[0].use_brain(LocalBrain(controller=decide))
    sim.reset(seed)
    program.begin()
    for _ in range(decisions):
        sim.step()
        if sim.agents[0].done:
            break
    return seen


def done_after(tab: TabPage, seen: list[dict[str, Any]], done: int) -> int:
    """Return how many steps are done after a run, if ``done`` were before."""
    script = """([seen, done]) => {
      makeSteps(done);
      steps.begin();
      for (const each of seen) steps.note(each);
      return localStorage["ai4u-blocks-steps"];
    }"""
    return int(json.loads(tab.page.evaluate(script, [seen, done])))


@pytest.mark.parametrize(
    "seed", [SEED, *(pytest.param(each, marks=pytest.mark.nightly) for each in range(12))]
)
def test_a_step_is_done_when_the_robot_does_it(tab: TabPage, sources: list[str], seed: int) -> None:
    for step in range(4):
        seen = driven(sources[step], seed, DECISIONS[step])
        assert done_after(tab, seen, step) == step + 1
        assert done_after(tab, seen, step + 1) == step + 1


def test_the_last_step_counts_starts(tab: TabPage, sources: list[str]) -> None:
    tab.page.evaluate("makeSteps(4)")
    test = """goals => steps.tested(
      [...Array(10).keys()].map((each) => ({ outcome: each < goals ? "goal" : "time" })))"""
    tab.page.evaluate(test, 7)
    assert tab.page.evaluate(KEPT) == "4"
    assert "7 of 10 starts" in tab.page.inner_text(".ai4u-steps-progress")
    tab.page.evaluate(test, 8)
    assert tab.page.evaluate(KEPT) == "5"
    assert "All five steps are done" in tab.page.inner_text(".ai4u-steps-status")
    reached = driven(sources[4], SEED, DECISIONS[4])
    assert len(reached) < 1000


def test_elsewhere_the_maze_is_offered(tab: TabPage, sources: list[str]) -> None:
    assert sources
    tab.page.evaluate("makeSteps(0)")
    tab.give({"scene": "box_chase", "can_edit": True}, "scene")
    tab.page.get_by_role("button", name="Open the maze").click()
    assert tab.sent() == [{"command": "open_scene", "name": "maze", "is_saved": False}]
    tab.give({"scene": "maze", "can_edit": True}, "scene")
    tab.page.get_by_role("button", name="Step 4: Follow a wall").click()
    assert "Keep one hand on the wall" in tab.page.inner_text(".ai4u-steps-text")

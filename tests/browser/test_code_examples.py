"""The examples of the tab "Code": each drives as it says, and is taken as blocks or as Python."""

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Browser, expect

from ai4u_edu import LocalBrain, Percept, Scene
from ai4u_edu.program import Program
from tests.browser.code_tab import CodePage
from tests.browser.fake_panel import PARTS
from tests.page.panel.rooms import panel_room
from tests.waiting import LIMIT_S

pytestmark = pytest.mark.browser

SCENES = {
    "square": "forage",
    "follow": "line_follow",
    "avoid": "maze",
    "wall": "maze",
    "memory": "maze",
}
SOURCE = """async ([name, part]) => {
  const { EXAMPLES, exampleProgram } = await import("./web/code/examples.js");
  const example = EXAMPLES.find((each) => each.name === name);
  return [example.scene, (await exampleProgram(example, part))?.python ?? null];
}"""
REACH_M = 12.0
"""Length of a ray in the maze."""


@dataclass
class Drive:
    """Places, headings and percepts of a program, decision by decision."""

    places: list[tuple[float, float]] = field(default_factory=list)
    headings: list[float] = field(default_factory=list)
    percepts: list[dict[str, Any]] = field(default_factory=list)
    actions: list[list[float]] = field(default_factory=list)

    @property
    def metres(self) -> float:
        """Length of the way."""
        return sum(math.dist(*pair) for pair in zip(self.places, self.places[1:], strict=False))

    def nearest(self, rays: slice) -> list[float]:
        """Return the smallest distance of some rays in the maze (m)."""
        return [
            REACH_M * min(each or 1 for each in percept["vision"][1::2][rays])
            for percept in self.percepts
        ]


def drive(scene: str, source: str, seed: int, decisions: int) -> Drive:
    program = Program.load(source, limit_s=LIMIT_S)
    sim = Scene.load(scene).build()
    agent, way = sim.agents[0], Drive()

    def decide(percept: Percept) -> dict[str, list[float]]:
        values = {key: np.asarray(percept[key]).tolist() for key in percept}
        action = program.decide(values)
        way.percepts.append(values)
        way.actions.append(action["move"])
        return action

    agent.use_brain(LocalBrain(controller=decide))
    sim.reset(seed)
    program.begin()
    for _ in range(decisions):
        way.places.append(agent.body.position)
        way.headings.append(agent.body.heading)
        sim.step()
    return way


def check(name: str, way: Drive) -> None:
    """Check that a drive is what an example promises."""
    if name == "square":
        turned = np.degrees(np.unwrap(way.headings))
        assert turned[0] - turned[-1] == pytest.approx(360, abs=20)
        assert math.dist(way.places[0], way.places[-1]) < 0.6
        assert way.metres > 6
    elif name == "follow":
        seen = [max(percept["line"]) > 0.2 for percept in way.percepts]
        assert sum(seen) > 0.95 * len(seen)
        assert way.metres > 12
    elif name == "avoid":
        assert min(way.nearest(slice(5, 8))) > 0.5
        assert way.metres > 10
    elif name == "wall":
        beside = way.nearest(slice(0, 5))
        assert np.median(beside) == pytest.approx(0.8, abs=0.3)
        assert way.metres > 15
    else:
        turns = [turn for _, turn, *_ in way.actions if turn]
        sides = [
            turn > 0 for turn, before in zip(turns, [0, *turns], strict=False) if turn != before
        ]
        assert len(sides) >= 3
        assert all(side != before for side, before in zip(sides[1:], sides, strict=False))


@pytest.fixture(scope="module")
def sources(chromium: Browser) -> dict[str, str]:
    """The Python of each example for the robot of its scene."""
    parts = {}
    for scene in set(SCENES.values()):
        with panel_room(scene) as room, room.page() as page:
            page.show("0", "agent")
            parts[scene] = page.part("python")
    with CodePage.opened(chromium) as tab:
        made = {name: tab.page.evaluate(SOURCE, [name, parts[SCENES[name]]]) for name in SCENES}
    assert {name: scene for name, (scene, _) in made.items()} == SCENES
    return {name: source for name, (_, source) in made.items()}


@pytest.mark.parametrize("name", SCENES)
def test_an_example_drives_as_it_says(sources: dict[str, str], name: str) -> None:
    for seed in range(3):
        check(name, drive(SCENES[name], sources[name], seed, 128 if name == "square" else 300))


def give_scene(tab: CodePage, scene: str, part: dict[str, Any]) -> None:
    """Send the parts of a scene, in the order in which a world sends them."""
    tab.give({**PARTS["scene"], "scene": scene}, "scene")
    tab.give(PARTS["agent"])
    tab.give({**PARTS["python"], **part}, "python")


def test_an_example_is_a_new_program_in_its_scene(chromium: Browser) -> None:
    with CodePage.opened(chromium) as tab, panel_room("maze") as room, room.page() as page:
        page.show("0", "agent")
        maze = {name: page.part("python")[name] for name in ("sensors", "actuators")}
        programs = tab.page.get_by_label("Program", exact=True)
        tab.write("x = 1")
        tab.page.get_by_role("button", name="Avoid walls").click()
        assert tab.sent() == [{"command": "open_scene", "name": "maze", "is_saved": False}]
        give_scene(tab, "maze", maze)
        expect(programs).to_have_value("Avoid walls")
        expect(tab.editor).to_contain_text("if 12 * nearest")
        tab.press("Blocks")
        tab.page.get_by_role("button", name="Follow a wall").click()
        expect(programs).to_have_value("Follow a wall")
        expect(tab.page.locator(".blocklySvg .blocklyBlockCanvas")).to_contain_text("distance")
        assert tab.sent() == []
        give_scene(tab, "box_chase", {})
        expect(programs).to_have_value("Program 1")
        assert tab.text == "x = 1"


def test_where_no_scene_can_be_opened_an_example_says_where_it_is_for(chromium: Browser) -> None:
    with CodePage.opened(chromium) as tab:
        tab.give({**PARTS["scene"], "can_edit": False}, "scene")
        example = tab.page.get_by_role("button", name="Avoid walls")
        expect(example).to_contain_text("Only in the scene Maze")
        example.focus()  # it is not disabled, so that its reason can be read
        tab.page.keyboard.press("Enter")
        assert tab.sent() == []

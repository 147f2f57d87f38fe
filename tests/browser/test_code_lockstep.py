"""A program of a student makes the same episode in the page and as a local brain, bit for bit.

The page is real: Python in its worker, the protocol, and a world in lockstep.
"""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page

from ai4u_edu import Scene
from ai4u_edu.learn.training.policies import entrant
from tests.browser.code_page import WORLD_WAITS, code_page
from tests.playing import Played, played
from tests.program.solutions import entry_of, solution
from tests.program.test_same_everywhere import for_page

pytestmark = [pytest.mark.browser, pytest.mark.slow]

SEED = 3
DRIVE = """
async ([source, seed, agent]) => {
  const client = await RemoteClient.connect({ agent, mode: "lockstep" });
  const { outputs, welcome: { readings } } = client;
  const told = (answer) => {
    if (!answer.ok) throw new Error(answer.text);
    return answer;
  };
  await client.reset(seed);
  told(await engine.load(source, { outputs, readings }));
  told(await engine.begin());
  const steps = [];
  for (let percept = await client.sense(); ; ) {
    const { values, reward, terms, terminated, truncated, step } = percept;
    const said = { values, reward, terms, terminated, truncated, step, action: null };
    steps.push(said);
    if (terminated || truncated) break;
    said.action = told(await engine.decide(values, step + 1)).values;
    await client.act(said.action);
    percept = await client.sense();
  }
  await client.close();
  const words = new Map([[Infinity, "inf"], [-Infinity, "-inf"], [NaN, "nan"]]);
  const word = (each) => (Object.is(each, -0) ? "-0" : (words.get(each) ?? each));
  return JSON.stringify(steps, (_, each) => word(each));
}
"""
CHEAP = "box_chase"
REST = [pytest.param(name, marks=pytest.mark.nightly) for name in Scene.names() if name != CHEAP]


@pytest.fixture(scope="module")
def server() -> Iterator[Played]:
    options = ("--lockstep", "--seeded-resets", "--time-scale", "100", *WORLD_WAITS)
    with played(CHEAP, *options) as server:
        yield server


@pytest.fixture(scope="module")
def page(chromium: Browser, server: Played) -> Iterator[Page]:
    page = code_page(chromium, server.url)
    page.evaluate("engine.warm()")
    yield page
    page.context.close()


@pytest.mark.parametrize("name", [CHEAP, *REST])
def test_the_episodes_are_the_same(name: str, page: Page, server: Played, tmp_path: Path) -> None:
    if name != CHEAP:
        server.open(name)
    source = solution(name)
    file = tmp_path / "program.py"
    file.write_text(source)
    scene = Scene.load(name)
    sim = scene.build()
    agent = sim.agents[0]
    agent.use_brain(entrant(f"{file}:{entry_of(name)}").brain(agent))
    sim.reset(SEED)

    steps: list[dict[str, Any]] = json.loads(page.evaluate(DRIVE, [source, SEED, agent.id]))
    assert len(steps) > 10
    for number, step in enumerate(steps):
        assert (step["step"], agent.steps) == (number, number)
        assert step["values"] == {key: for_page(agent.percept[key]) for key in agent.percept}
        assert (step["terminated"], step["truncated"]) == (agent.terminated, agent.truncated)
        if number:
            assert step["reward"] == agent.ledger.finished[0]
            assert step["terms"] == agent.ledger.finished[1]
        if step["action"] is None:
            break
        sim.step()
        actuators = agent.bound_blocks.actuators
        action = {each: actuators[each].accept(given) for each, given in step["action"].items()}
        assert action == agent.last_action
    assert agent.done
    terms = agent.ledger.episode_terms
    assert terms.get(str(scene.description.success), 0) > 0, "the program solves the scene"

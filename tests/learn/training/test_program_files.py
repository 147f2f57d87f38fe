"""Files for ``--brain FILE.py:NAME``: those that the page could run, and others."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

from ai4u_edu import ControlRequestor, LocalBrain, Scene
from ai4u_edu.base.errors import BlockError, SetupError
from ai4u_edu.cli.main import app
from ai4u_edu.learn.training import policies
from ai4u_edu.learn.training.evaluating import evaluate
from ai4u_edu.learn.training.policies import ProgramController, entrant
from tests.waiting import LIMIT_S

AHEAD = "def decide(percept):\n    return {'move': [percept['orientation'].max(), 0, 0, 0]}\n"
COUNTER = """
from ai4u_edu import Controller

class Counter(Controller):
    step: float = 0.1

    def on_reset(self, agent, view):
        self.count = 0

    def get_action(self, percept):
        self.count += 1
        return {"move": [self.step * self.count, 0, 0, 0]}
"""


@pytest.fixture(autouse=True)
def _patient(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let no program be ended because the machine is busy."""
    monkeypatch.setattr(policies, "CALL_LIMIT_S", LIMIT_S)


def built(tmp_path: Path, source: str, entry: str = "decide") -> ControlRequestor:
    file = tmp_path / "mine.py"
    file.write_text(source)
    who = entrant(f"{file}:{entry}")
    sim = Scene.load("box_chase").build()
    agent = sim.agents[0]
    agent.use_brain(who.brain(agent))
    sim.reset(1)
    return sim


def controller(sim: ControlRequestor) -> Any:
    brain = sim.agents[0].brain
    assert isinstance(brain, LocalBrain)
    return brain.controller


def test_a_program_gets_plain_numbers(tmp_path: Path) -> None:
    sim = built(tmp_path, AHEAD)
    assert isinstance(controller(sim), ProgramController)
    wanted = round(max(sim.agents[0].percept["orientation"].tolist()), 9)
    sim.step()
    assert sim.agents[0].last_action["move"][0] == wanted


def test_a_controller_is_reset_at_each_episode(tmp_path: Path) -> None:
    sim = built(tmp_path, COUNTER, "Counter")
    assert isinstance(controller(sim), ProgramController)
    for _ in range(2):
        speeds = []
        for _ in range(3):
            sim.step()
            speeds.append(sim.agents[0].last_action["move"][0])
        assert speeds == [0.1, 0.2, 0.3]
        sim.reset(2)


def test_no_episode_of_an_evaluation_depends_on_the_one_before(tmp_path: Path) -> None:
    file = tmp_path / "mine.py"
    file.write_text(
        "calls = 0\n\n"
        "def decide(percept):\n"
        "    global calls\n"
        "    calls += 1\n"
        "    return {'move': [0.1 * (calls % 7), 0.01, 0, 0]}\n"
    )
    who, scene = entrant(f"{file}:decide"), Scene.load("box_chase")
    first, second = evaluate(who, scene, [3, 4]).episodes
    (alone,) = evaluate(who, scene, [4]).episodes
    assert first.length % 7, "the second one would go on in the middle"
    assert second == alone


@pytest.mark.parametrize(
    ("source", "entry"),
    [
        ("import numpy as np\n" + AHEAD, "decide"),
        ("from ai4u_edu import Command\n" + AHEAD, "decide"),
        (COUNTER.replace("self.count = 0", "self.count = agent.steps"), "Counter"),
    ],
)
def test_other_files_run_as_they_are(tmp_path: Path, source: str, entry: str) -> None:
    sim = built(tmp_path, source, entry)
    assert not isinstance(controller(sim), ProgramController)
    sim.step()
    assert 0 < abs(sim.agents[0].last_action["move"][0]) <= 1


def test_numpy_gets_arrays(tmp_path: Path) -> None:
    source = "import numpy as np\nseen = []\ndef decide(percept):\n    seen.append(percept)\n"
    sim = built(tmp_path, source + "    return {}\n")
    sim.step()
    (percept,) = controller(sim).function.__globals__["seen"]
    assert isinstance(percept["orientation"], np.ndarray)


def test_each_agent_has_a_program_of_its_own(tmp_path: Path) -> None:
    file = tmp_path / "mine.py"
    file.write_text("n = 0\ndef decide(percept):\n    global n\n    n += 1\n    return {}\n")
    who = entrant(f"{file}:decide")
    sim = Scene.load("box_chase").build()
    sim.reset(1)
    first, second = (who.brain(sim.agents[0]) for _ in range(2))
    assert isinstance(first, LocalBrain)
    assert isinstance(second, LocalBrain)
    first.decide(sim.agents[0].percept)
    programs = [brain.controller.program for brain in (first, second)]  # type: ignore[union-attr]  # both are ProgramControllers
    assert [program.variables().get("n", "0") for program in programs] == ["1", "0"]


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ("pass", r"mine\.py, line 2: Your function returned nothing \(None\)"),
        ("return {'mov': [1, 0, 0, 0]}", r"mine\.py, line 2: the robot can't do 'mov'; "),
        ("return {'move': [1]}", r"mine\.py, line 2: action 'move': expected 4 numbers, got 1"),
        ("percept['visoin']", r"mine\.py, line 2: there is no sensor called 'visoin'; did"),
    ],
)
def test_mistakes_in_decisions(tmp_path: Path, body: str, message: str) -> None:
    sim = built(tmp_path, f"def decide(percept):\n    {body}\n")
    with pytest.raises(BlockError, match=message):
        sim.step()


def test_a_decision_that_never_ends_is_ended(tmp_path: Path) -> None:
    sim = built(tmp_path, "def decide(percept):\n    while True:\n        pass\n")
    controller(sim).program.trace.limit_s = 0.2
    message = r"mine\.py, line [23]: Your code has been running for 0\.2 seconds"
    with pytest.raises(BlockError, match=message):
        sim.step()


@pytest.mark.parametrize(
    ("source", "message"),
    [
        ("def decide(percept)\n    pass", r"mine\.py, line 1: A colon \(:\) is missing"),
        ("def decide():\n    pass", r"mine\.py, line 1: decide must take one value, the percept"),
        ("def decid(percept):\n    pass", r"mine\.py has no 'decide'; did you mean 'decid'"),
        ("class decide:\n    pass", r"mine\.py, line 1: the class decide has no get_action"),
        ("decide = 1", r"mine\.py, line 1: 'decide' is no function"),
        ("# -*- coding: nothing -*-", r"mine\.py: expected a text of Python in UTF-8"),
    ],
)
def test_mistakes_in_files(tmp_path: Path, source: str, message: str) -> None:
    file = tmp_path / "mine.py"
    file.write_text(source)
    with pytest.raises(SetupError, match=message):
        entrant(f"{file}:decide")


def test_the_command_tells_a_mistake(tmp_path: Path) -> None:
    file = tmp_path / "mine.py"
    file.write_text("def decide(percept):\n    return {'move': [1, 0]}\n")
    told = CliRunner().invoke(
        app, ["evaluate", "box_chase", "--brain", f"{file}:decide", "--episodes", "1"]
    )
    assert "mine.py, line 2: action 'move': expected 4 numbers, got 2" in str(told.exception)

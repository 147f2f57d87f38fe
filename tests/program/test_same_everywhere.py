"""A program decides in the page's worker as it does with ``--brain``, bit for bit."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import ai4u_edu.program
from ai4u_edu import BasicAgent, Percept, Scene
from ai4u_edu.learn.training.policies import entrant
from ai4u_edu.program import host
from tests.program.solutions import entry_of, solution

DTYPES = {"float32": "<f4", "int32": "<i4", "uint8": "|u1", "bool": "|b1"}
FEW = ["box_chase", "line_follow", "maze", "grid_world", "jumper"]
"""Scenes with different kinds of readings and actions."""
REST = [name for name in Scene.names() if name not in FEW]
IN_A_PAGE = """
import json, sys
sys.path.insert(0, sys.argv[1])
from ai4u_edu.program import host
source = '''
from ai4u_edu import Controller

class Ahead(Controller):
    speed: float = 0.1
    def get_action(self, percept):
        return {"move": [self.speed, percept["x"]]}
'''
outputs = {"move": [["-inf", -1], ["inf", 1]]}
print(host.load(json.dumps({"source": source, "outputs": outputs, "readings": ["x"]})))
print(host.begin())
print(host.decide(json.dumps({"percept": {"x": 0.5}, "decision": 1})))
print({"numpy", "pydantic", "ai4u_edu.base"} & {*sys.modules})
"""


def for_page(value: Any) -> Any:
    """Return a value as JavaScript writes it: whole numbers lose their point."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, list | tuple):
        return [for_page(each) for each in value]
    if isinstance(value, float):
        if str(value) in ("-0.0", "inf", "-inf", "nan"):
            return "-0" if value == 0 else str(value)
        return int(value) if value.is_integer() else value
    return value


def dtypes(percept: Percept) -> dict[str, str]:
    slots = percept.layout.slots
    return {key: DTYPES[slots[key].dtype.name] if key in slots else "" for key in percept}


def told(text: str) -> dict[str, Any]:
    answer: dict[str, Any] = json.loads(text)
    assert answer["ok"], answer
    return answer


def load_in_page(source: str, agent: BasicAgent) -> None:
    actuators = agent.bound_blocks.actuators.items()
    said = {
        "source": source,
        "outputs": {name: for_page(actuator.limits()) for name, actuator in actuators},
        "readings": dtypes(agent.percept),
    }
    told(host.load(json.dumps(said)))
    told(host.begin())


@pytest.mark.parametrize(
    "name", [*FEW, *(pytest.param(name, marks=pytest.mark.nightly) for name in REST)]
)
def test_decisions_are_the_same(name: str, tmp_path: Path) -> None:
    source = solution(name)
    file = tmp_path / f"{name}.py"
    file.write_text(source)
    scene = Scene.load(name)
    sim = scene.build()
    agent = sim.agents[0]
    agent.use_brain(entrant(f"{file}:{entry_of(name)}").brain(agent))
    sim.reset(3)
    load_in_page(source, agent)
    while not agent.done:
        percept = {key: for_page(agent.percept[key]) for key in agent.percept}
        answer = told(host.decide(json.dumps({"percept": percept, "decision": agent.steps})))
        sim.step()
        actuators = agent.bound_blocks.actuators
        given = {each: actuators[each].accept(values) for each, values in answer["values"].items()}
        assert given == agent.last_action
    terms = agent.ledger.episode_terms
    assert terms.get(str(scene.description.success), 0) > 0, "the program solves the scene"


def test_zeros_keep_their_sign() -> None:
    source = (
        "import math\ndef decide(percept):\n    return {'move': [math.atan2(percept['x'], -1)]}"
    )
    said = {"source": source, "outputs": {"move": [[-9], [9]]}, "readings": {"x": "<f4"}}
    told(host.load(json.dumps(said)))
    values = [
        told(host.decide(json.dumps({"percept": {"x": x}, "decision": 1})))["values"]["move"]
        for x in (0, "-0")
    ]
    assert values == [[3.141592654], [-3.141592654]]


def test_texts_are_never_numbers() -> None:
    source = (
        "def decide(percept):\n    return {'move': [len(percept['words'][0] + percept['word'])]}"
    )
    readings = {"words": "", "word": ""}
    said = {"source": source, "outputs": {"move": [[-9], [9]]}, "readings": readings}
    told(host.load(json.dumps(said)))
    percept = {"words": ["inf"], "word": "nan"}
    answer = told(host.decide(json.dumps({"percept": percept, "decision": 1})))
    assert answer["values"] == {"move": [6.0]}


def test_the_package_needs_only_the_standard_library(tmp_path: Path) -> None:
    """The page has the package without the rest of ai4u_edu."""
    copy = tmp_path / "ai4u_edu" / "program"
    copy.mkdir(parents=True)
    for file in Path(ai4u_edu.program.__file__).parent.glob("*.py"):
        (copy / file.name).write_text(file.read_text())
    command = [sys.executable, "-I", "-S", "-c", IN_A_PAGE, str(tmp_path)]
    run = subprocess.run(command, capture_output=True, text=True, check=True)
    lines = run.stdout.splitlines()
    assert json.loads(lines[2])["values"] == {"move": [0.1, 0.5]}
    assert lines[3] == "set()"

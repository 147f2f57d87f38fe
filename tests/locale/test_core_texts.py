"""Sentences of the core in the pseudo-locale, in which English that nobody marked stays plain."""

import re
from typing import Any

import pytest

from ai4u_edu import LocalBrain
from ai4u_edu.base.errors import AI4UError, text_of
from ai4u_edu.blocks import RBMoveActuator, Sensor, TouchSensor
from ai4u_edu.check import check_sensor
from ai4u_edu.explain import (
    LIMITS,
    axes_of_agent,
    explained,
    groups_of_agent,
    middle_of,
    occlusion,
    sentence,
)
from ai4u_edu.locale import PSEUDO, Catalogue, reader
from ai4u_edu.scenes import Scene

ROBOT = "bodies: [{name: robot, shape: {type: circle, radius: 0.5}}]\n"
BROKEN = {
    "a colon is missing": "name test\nbodies: []",
    "a list and not a mapping": "- name: test",
    "a bracket is open": "name: [test",
    "an unknown field": "name: test\nbodys: []",
    "a number is text": ROBOT.replace("0.5", "wide"),
    "a number is too small": ROBOT.replace("0.5", "-1"),
    "no such shape": ROBOT.replace("circle", "cirkle"),
    "no such block": ROBOT + "agents: [{body: robot, sensors: [{type: TouchSenso}]}]",
    "no such body": ROBOT + "agents: [{body: robot, sensors: [{type: TouchSensor, target: bx}]}]",
    "no brain": ROBOT + "agents: [{body: robot, brains: []}]",
    "the same name twice": f"name: test\n{ROBOT}areas: [{{name: robot, shape: "
    "{type: circle, radius: 1}}]",
}
"""Scene files with a mistake each."""


@pytest.mark.parametrize("text", BROKEN.values(), ids=BROKEN)
def test_scene_errors_are_marked(text: str) -> None:
    with pytest.raises(AI4UError) as raised:
        Scene.loads(text, name="test.yaml")
    assert plain_words(text_of(raised.value)) == []


@pytest.mark.parametrize(
    "values",
    [
        {"target": "box", "delay": -1},
        {"target": "box", "noise": "much"},
        {"targt": "box"},
        {},
    ],
)
def test_parameter_errors_are_marked(values: dict[str, Any]) -> None:
    with pytest.raises(AI4UError) as raised:
        TouchSensor(**values)
    assert plain_words(text_of(raised.value)) == []


def test_action_errors_are_marked() -> None:
    sim = Scene.load("box_chase").build(brains=lambda _: LocalBrain(controller=lambda _: {}))
    sim.reset(0)
    actuator = next(iter(sim.agents[0].bound_blocks.actuators.values()))
    assert isinstance(actuator, RBMoveActuator)
    for values in ([0.0], "go", [float("nan")] * 4):
        with pytest.raises(AI4UError) as raised:
            actuator.accept(values)
        assert plain_words(text_of(raised.value)) == []


def test_note_of_a_block_is_translated_with_the_error() -> None:
    class Broken(Sensor):
        """A sensor that divides by zero."""

        def on_setup(self, agent: object, view: object) -> None:
            raise ZeroDivisionError

    report = check_sensor(Broken())
    assert "while Broken 'broken' of agent '0' was set up" in str(report)
    with reader(PSEUDO):
        assert plain_words(str(report)) == []


def test_report_of_a_check_is_in_the_readers_language() -> None:
    report = check_sensor(TouchSensor(target="box"), decisions=5)
    assert "passed" in str(report)
    with reader(PSEUDO):
        assert plain_words(str(report)) == []


def test_reasons_for_an_action_are_marked() -> None:
    sim = Scene.load("box_chase").build(brains=lambda _: LocalBrain(controller=_ahead))
    sim.reset(0)
    agent = sim.agents[0]
    groups = groups_of_agent(agent)
    told = occlusion(_ahead, agent.percept, baseline=middle_of(agent), groups=groups)
    axes = axes_of_agent(agent, ["move"])
    assert " because " in sentence(told, axes)
    for text in (sentence(told, axes), explained(told, axes), LIMITS):
        assert plain_words(text) == []


def _ahead(percept: Any) -> dict[str, list[float]]:
    return {"move": [float(percept["orientation"][0]), 0, 0, 0]}


def plain_words(text: str) -> list[str]:
    """Return the words of a sentence that are plain English in the pseudo-locale.

    Values keep their letters: names in quotes and of files, code, parameters and classes.
    """
    shown = Catalogue(PSEUDO).translate(text) if text.isascii() else text
    shown = re.sub(r"'[^']*'|\"[^\"]*\"|\n    .*", "", shown)
    english = {"expected", "got", "and", "known", "are", "the", "did", "mean", "agent", "was"}
    return [word for word in re.findall(r"\b[a-z]{3,}\b", shown) if word in english]

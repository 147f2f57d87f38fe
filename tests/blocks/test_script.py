"""ScriptController: a Python function as a controller."""

from typing import Any

import pytest

from ai4u_edu import LocalBrain, Percept, Scene, ScriptController
from ai4u_edu.base.errors import ParameterError, SceneError
from tests.builders import small_sim


def test_the_function_gets_each_percept_and_its_answer_is_the_action() -> None:
    seen: list[Percept] = []

    def ahead(percept: Percept) -> dict[str, Any]:
        seen.append(percept)
        return {"move": [len(seen) / 10, 0, 0, 0]}

    sim = small_sim(brains=[LocalBrain(controller=ScriptController(function=ahead))])
    agent = sim.agents[0]
    for decision in range(1, 4):
        before = agent.percept
        sim.step()
        assert seen[-1] is before
        assert agent.last_action["move"] == (decision / 10, 0, 0, 0)
    assert agent.body.position[0] > 0


def test_a_brain_takes_the_bare_function_too() -> None:
    def still(_percept: Percept) -> dict[str, Any]:
        return {}

    controller = LocalBrain(controller=still).controller
    assert isinstance(controller, ScriptController)
    assert controller.function is still


def test_what_is_no_function_is_refused() -> None:
    with pytest.raises(ParameterError, match=r"^ScriptController: function: "):
        ScriptController(function=5)  # type: ignore[arg-type]


def test_no_scene_file_can_name_one() -> None:
    text = """
name: x
bodies: [{name: robot}]
agents: [{body: robot, brains: [{type: LocalBrain, controller: {type: ScriptController}}]}]
"""
    with pytest.raises(SceneError, match="unknown type of controller 'ScriptController'"):
        Scene.loads(text)

"""Agents that are added to a scene and removed from it."""

import pytest

from ai4u_edu import Scene
from ai4u_edu.base.errors import NameNotFoundError
from ai4u_edu.page.editing import ChangeError
from tests.page.editing.harness import EditorHarness, trace

SECOND = {"name": "robot 2", "shape": {"type": "circle", "radius": 0.5}, "position": [0, 4]}


@pytest.fixture
def harness() -> EditorHarness:
    harness = EditorHarness()
    harness.tick(5)
    return harness


def test_an_agent_comes_with_blocks_of_its_own_and_goes(harness: EditorHarness) -> None:
    seed = harness.world.seeds.seed
    added = harness.done(harness.editor.add_agent(SECOND, "0"))
    assert (added.when, added.label) == ("now", "add robot 2")
    agents = harness.runner.sim.agents
    assert [(agent.id, agent.body.name) for agent in agents] == [("0", "robot"), ("1", "robot 2")]
    assert list(agents[1].percept) == list(agents[0].percept)
    assert (harness.world.seeds.seed, harness.world.ticks) == (seed, 0)
    harness.tick(30)
    assert trace(harness.runner.sim, 1) == trace(harness.editor.scene.build(), 1)

    harness.done(harness.editor.undo())
    assert [agent.id for agent in harness.runner.sim.agents] == ["0"]
    harness.done(harness.editor.redo())
    harness.done(harness.editor.remove_agent("1"))
    assert harness.editor.undo_label == "remove robot 2"
    assert list(harness.world.bodies) == ["robot", "box", "wall"]
    assert harness.editor.scene == harness.scene
    assert harness.editor.is_as_opened


def test_the_scene_counts_as_changed_after_undo_and_redo(harness: EditorHarness) -> None:
    harness.done(harness.editor.add_agent(SECOND, "0"))
    harness.done(harness.editor.undo())
    assert harness.editor.is_as_opened
    harness.done(harness.editor.redo())
    assert not harness.editor.is_as_opened


def test_the_only_agent_stays(harness: EditorHarness) -> None:
    with pytest.raises(ChangeError, match="it is the only agent; a scene needs one"):
        harness.done(harness.editor.remove_agent("0"))
    with pytest.raises(NameNotFoundError, match="no agent has the id '7'"):
        harness.done(harness.editor.remove_agent("7"))
    with pytest.raises(ChangeError, match="overlaps body 'box'"):
        harness.done(harness.editor.add_agent({**SECOND, "position": [4, 0]}, "0"))
    assert len(harness.runner.sim.agents) == 1
    assert harness.editor.undo_label == ""


def test_a_copy_does_not_begin_in_the_place_of_the_other() -> None:
    harness = EditorHarness(Scene.load("box_chase"))
    kinds = [each["type"] for each in harness.scene.description.agents[0]["actuators"]]
    assert "RespawnActuator" in kinds
    harness.done(harness.editor.add_agent(SECOND, "0"))
    copied = harness.editor.state.agent("1")["actuators"]
    assert [each["type"] for each in copied] == [k for k in kinds if k != "RespawnActuator"]
    harness.done(harness.runner.reset(seed=4))
    harness.tick(10)

"""An agent's and a scene's own settings: forms, changes, and when they apply."""

import pytest

from ai4u_edu.page.editing import ChangeError
from ai4u_edu.page.editing.settings import agent_form, scene_form
from tests.page.editing.harness import EditorHarness


def test_the_forms_come_from_the_declarations() -> None:
    description = EditorHarness().editor.state.description
    agent = {field.name: field for field in agent_form(description.agents[0])}
    assert list(agent)[:3] == ["skip_frame", "repeat_action", "max_steps_per_episode"]
    assert (agent["skip_frame"].value, agent["skip_frame"].kind) == (0, "whole")
    assert "every ``skip_frame + 1`` ticks" in agent["skip_frame"].hint
    assert agent["skip_frame"].limits == "at least 0, at most 10000"
    assert agent["repeat_action"].kind == "switch"
    assert agent["max_steps_per_episode"].value == 0
    scene = {field.name: field for field in scene_form(description)}
    assert scene["gravity"].label == "gravity (m/s^2)"
    assert scene["gravity"].shown == "9.81"
    assert "nothing pulls in the plane" in scene["gravity"].hint
    later = {name for name, field in (agent | scene).items() if "next reset" in field.note}
    world = {"ticks_per_second", "damping", "gravity", "fall_threshold"}
    assert later == {"priority", "spread_decisions"} | world
    assert scene["spread_decisions"].kind == "switch"
    assert set(scene) >= {"title", "goal", "damping", "ticks_per_second", "fall_threshold"}


def test_an_agents_settings_apply_at_the_next_decision_and_can_be_undone() -> None:
    harness = EditorHarness()
    values = {"skip_frame": 2, "max_steps_per_episode": 7, "reward_scale": 2.5}
    outcome = harness.done(harness.editor.change_agent("0", values))
    assert (outcome.when, outcome.label) == ("next decision", "change agent 0")
    assert harness.agent.brain.skip_frame == 2
    assert (harness.agent.max_steps_per_episode, harness.agent.reward_scale) == (7, 2.5)
    brain = harness.editor.state.agent("0")["brains"][0]
    assert brain["skip_frame"] == 2
    assert brain["controller"]["type"] == "ReplayController"
    harness.done(harness.editor.undo())
    assert harness.agent.brain.skip_frame == 0
    assert (harness.agent.max_steps_per_episode, harness.agent.reward_scale) == (0, 1)


def test_priority_changes_at_the_next_reset() -> None:
    harness = EditorHarness()
    outcome = harness.done(harness.editor.change_agent("0", {"priority": 3}))
    assert outcome.when == "next reset"
    assert harness.agent.priority == 0
    harness.done(harness.runner.reset(5))
    harness.done(harness.runner.submit(lambda: None))
    assert harness.agent.priority == 3


def test_a_worlds_settings_apply_at_the_next_reset_and_its_words_at_once() -> None:
    harness = EditorHarness()
    before = harness.world
    outcome = harness.done(harness.editor.change_settings({"gravity": 1.6, "goal": "Jump high."}))
    assert (outcome.when, outcome.label) == ("next reset", "change the scene")
    assert harness.runner.sim.goal == "Jump high."
    assert harness.world is before
    assert "gravity: 1.6" in harness.editor.text()
    harness.done(harness.runner.reset(5))
    harness.done(harness.runner.submit(lambda: None))
    assert harness.world.settings.gravity == 1.6
    assert not harness.editor.waits_for_reset
    harness.done(harness.editor.change_settings({"gravity": None}))
    assert "gravity" not in harness.editor.text()
    harness.done(harness.editor.undo())
    harness.done(harness.editor.undo())
    assert harness.editor.state.description == harness.scene.description
    harness = EditorHarness()
    assert harness.done(harness.editor.change_settings({"title": "Moon"})).when == "now"


def test_agents_take_turns_from_the_next_reset_on() -> None:
    harness = EditorHarness()
    outcome = harness.done(harness.editor.change_settings({"spread_decisions": True}))
    before = harness.runner.sim.spread_decisions
    harness.done(harness.runner.reset(5))
    harness.done(harness.runner.submit(lambda: None))
    assert (outcome.when, before) == ("next reset", False)
    assert harness.runner.sim.spread_decisions
    harness.done(harness.editor.change_settings({"spread_decisions": None}))
    assert "spread_decisions" not in harness.editor.text()


def test_whether_the_world_waits_for_a_key_applies_at_once() -> None:
    harness = EditorHarness()
    field = {each.name: each for each in scene_form(harness.editor.state.description)}
    assert (field["wait_for_key"].kind, field["wait_for_key"].value) == ("switch", True)
    outcome = harness.done(harness.editor.change_settings({"wait_for_key": False}))
    assert (outcome.when, harness.runner.sim.wait_for_key) == ("now", False)
    harness.done(harness.editor.undo())
    assert harness.runner.sim.wait_for_key


@pytest.mark.parametrize(
    ("values", "told"),
    [
        ({"gravity": -1}, "gravity: expected at least 0"),
        ({"gravity": "much"}, "gravity: expected a number"),
        ({"ticks_per_second": 0, "title": "x" * 3000}, "title: expected at most 2000 characters"),
        ({"spread_decisions": "now and then"}, "spread_decisions: expected true or false"),
        ({"gravty": 1}, "did you mean 'gravity'"),
        ({"agents": []}, "agents: unknown"),
    ],
)
def test_invalid_settings_are_reported_by_field(values: dict[str, object], told: str) -> None:
    harness = EditorHarness()
    with pytest.raises(ChangeError) as caught:
        harness.done(harness.editor.change_settings(values))
    assert told in str(caught.value)
    assert {problem.path[0] for problem in caught.value.problems} == set(values)
    assert harness.editor.undo_label == ""


@pytest.mark.parametrize("values", [{"skip_frame": -1}, {"max_steps_per_episode": -1}])
def test_what_is_wrong_with_an_agent_is_told_by_field(values: dict[str, object]) -> None:
    harness = EditorHarness()
    with pytest.raises(ChangeError, match="expected at least 0, got -1") as caught:
        harness.done(harness.editor.change_agent("0", values))
    assert [problem.path for problem in caught.value.problems] == [tuple(values)]


def test_another_goal_reaches_the_pictures_of_a_paused_world() -> None:
    harness = EditorHarness()
    harness.runner.paused = True
    harness.done(harness.editor.change_settings({"goal": "Reach the box."}))
    assert harness.runner.latest.static_scene.goal == "Reach the box."

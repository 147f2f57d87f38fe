"""A scene that somebody builds has a goal: the first reward for reaching something."""

from typing import Any

import pytest

from ai4u_edu import Scene
from ai4u_edu.page.editing.goals import KINDS, with_goal_values
from ai4u_edu.page.editing.scene_pictures import EMPTY_SCENE, TEMPLATES
from ai4u_edu.page.editing.suggestion import suggest_block
from ai4u_edu.snapshot import capture_snapshot
from tests.page.editing.harness import EditorHarness

TARGET = {
    "name": "target",
    "shape": {"type": "circle", "radius": 0.4},
    "position": [3, 0],
    "kind": "static",
}


@pytest.fixture
def harness() -> EditorHarness:
    harness = EditorHarness(Scene.load(TEMPLATES / f"{EMPTY_SCENE}.yaml"))
    harness.done(harness.editor.add_body(TARGET))
    return harness


def added(harness: EditorHarness, name: str = "TouchRewardFunc") -> dict[str, Any]:
    """Add a reward as the page does; return it."""
    state = harness.editor.state
    block = with_goal_values(state, suggest_block(state, "0", name))
    harness.done(harness.editor.add_block("0", "rewards", block))
    reward: dict[str, Any] = dict(rewards(harness)[-1])
    return reward


def rewards(harness: EditorHarness) -> list[Any]:
    return list(harness.editor.state.agent("0")["rewards"])


def success(harness: EditorHarness) -> str | None:
    return harness.editor.state.description.success


def goal(harness: EditorHarness) -> str:
    return harness.editor.state.description.goal


def test_the_first_goal_pays_ends_the_episode_and_is_a_success(harness: EditorHarness) -> None:
    first = added(harness)
    assert first["reward"] == 10
    assert first["cause_episode_to_end"]
    assert success(harness) == "touch"
    assert goal(harness) == "Reach the target."
    harness.world["robot"].move_to(3, 0)
    while not harness.agent.done:
        harness.tick()
    agents = capture_snapshot(harness.runner.sim).agents
    assert agents[0].outcome(agents, harness.runner.sim.success) == "goal"
    assert agents[0].episode_reward == 10


def test_an_episode_is_recorded_with_the_goal_that_it_has() -> None:
    template = Scene.load(TEMPLATES / f"{EMPTY_SCENE}.yaml")
    harness = EditorHarness(template, record=True)
    harness.done(harness.editor.add_body(TARGET))
    added(harness)
    harness.world["robot"].move_to(3, 0)
    while not harness.agent.done:
        harness.tick()
    recorder = harness.runner.recorder
    assert recorder is not None
    recorder.finish()
    episode = recorder.episodes[-1]
    assert (episode.scene.goal, episode.success) == ("Reach the target.", True)


def test_second_goal_pays_without_ending_the_episode(harness: EditorHarness) -> None:
    added(harness)
    second = added(harness)
    assert second["reward"] == 1
    assert "cause_episode_to_end" not in second
    assert success(harness) == "touch"


def test_the_sentence_follows_the_goal_until_somebody_writes_another(
    harness: EditorHarness,
) -> None:
    empty = goal(harness)
    harness.done(harness.editor.add_body(TARGET | {"name": "gold_coin", "position": [0, 4]}))
    added(harness)
    target = {"target": "gold_coin"}
    harness.done(harness.editor.change_block("0", ("rewards", 0), target))
    assert goal(harness) == "Reach the gold coin."
    harness.done(harness.editor.undo())
    assert goal(harness) == "Reach the target."
    harness.done(harness.editor.remove_block("0", ("rewards", 0)))
    assert goal(harness) == empty
    assert success(harness) is None
    harness.done(harness.editor.undo())
    harness.done(harness.editor.change_settings({"goal": "Catch it!"}))
    harness.done(harness.editor.change_block("0", ("rewards", 0), target))
    assert goal(harness) == "Catch it!"


def test_a_reward_that_somebody_lets_end_the_episode_is_the_goal(harness: EditorHarness) -> None:
    reward = {"type": "TouchRewardFunc", "target": "target"}
    harness.done(harness.editor.add_block("0", "rewards", reward))
    assert success(harness) is None
    harness.done(harness.editor.change_block("0", ("rewards", 0), {"cause_episode_to_end": True}))
    assert success(harness) is None  # it pays nothing
    harness.done(harness.editor.change_block("0", ("rewards", 0), {"reward": 5}))
    assert success(harness) == "touch"
    assert goal(harness) == "Reach the target."


def test_the_goal_of_a_scene_of_the_library_stays_as_it_is() -> None:
    harness = EditorHarness(Scene.load("box_chase"))
    before = harness.editor.state.description
    added(harness)
    after = harness.editor.state.description
    assert (after.goal, after.success) == (before.goal, before.success)


@pytest.mark.parametrize("name", KINDS)
def test_each_kind_of_goal_has_a_sentence_without_gaps(name: str, harness: EditorHarness) -> None:
    harness.done(harness.editor.add_body(TARGET | {"name": "ball", "tags": ["dirt"]}))
    area = {"name": "home", "shape": {"type": "circle", "radius": 1}}
    harness.done(harness.editor.add_region(area, "areas"))
    added(harness, name)
    sentence = goal(harness)
    assert sentence.endswith(".")
    assert "{" not in sentence
    assert sentence != "There is no goal yet."
    assert success(harness)

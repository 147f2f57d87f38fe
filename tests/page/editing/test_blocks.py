"""Blocks that are changed on an agent under way."""

from functools import partial

import numpy as np
import pytest

from ai4u_edu import Scene
from ai4u_edu.page.editing import ChangeError
from ai4u_edu.recording import Replay
from tests.page.editing.harness import TEXT, EditorHarness, trace

RAYS = {
    "type": "LinearRayCastingSensor",
    "perception_key": "eyes",
    "number_of_rays": 9,
    "field_of_view": 90,
    "vision_max_distance": 8,
    "group_code": {"target": 1, "wall": 2},
}


@pytest.fixture
def harness() -> EditorHarness:
    return EditorHarness()


def test_a_sensor_is_added_without_a_reset(harness: EditorHarness) -> None:
    harness.tick(7)
    before = harness.agent.percept["bearing"].copy()
    outcome = harness.done(harness.editor.add_block("0", "sensors", RAYS))
    assert (outcome.when, outcome.label) == ("next decision", "add LinearRayCastingSensor")
    assert harness.agent.percept["eyes"].size == 9
    assert np.count_nonzero(harness.agent.percept["eyes"]) > 0
    assert (harness.agent.steps, harness.world.ticks) == (7, 7)
    assert harness.agent.percept["bearing"].tolist() == before.tolist()  # its stack goes on
    harness.tick(3)
    assert harness.agent.steps == 10


def test_bad_values_are_told_field_by_field_and_nothing_changes(harness: EditorHarness) -> None:
    harness.tick(4)
    fitting, text, version = (
        harness.agent.bound_blocks,
        harness.editor.text(),
        harness.editor.version,
    )
    values = {"number_of_rays": 0, "vision_max_distance": -1}
    with pytest.raises(ChangeError) as told:
        harness.done(harness.editor.add_block("0", "sensors", RAYS | values))
    assert {str(each) for each in told.value.problems} == {
        "number_of_rays: expected at least 1, got 0",
        "vision_max_distance: expected more than 0, got -1",
    }
    both = {"stacked_observations": 0, "noise": "wide"}  # out of range, and of the wrong type
    with pytest.raises(ChangeError) as told:
        harness.done(harness.editor.change_block("0", ("sensors", 0), both))
    assert {str(each) for each in told.value.problems} == {
        "stacked_observations: expected at least 1, got 0",
        "noise: expected a number, got 'wide'",
    }
    with pytest.raises(ChangeError) as told:
        harness.done(harness.editor.change_block("0", ("sensors", 0), {"target": "bxo"}))
    (problem,) = told.value.problems
    assert problem.path == ("target",)
    assert problem.text.endswith("no body is named 'bxo'; did you mean 'box'?")
    assert (harness.agent.bound_blocks, harness.editor.text()) == (fitting, text)
    assert (harness.editor.version, harness.editor.undo_label) == (version, "")


def test_a_changed_block_is_new_and_the_others_stay(harness: EditorHarness) -> None:
    harness.tick(5)
    touch, progress = harness.agent.rewards
    outcome = harness.done(harness.editor.change_block("0", ("rewards", 0), {"reward": 7}))
    assert str(outcome) == "works from the next decision on"
    assert harness.agent.rewards[0] is not touch
    assert harness.agent.rewards[1] is progress
    assert harness.agent.rewards[0].reward == 7
    harness.tick()
    assert "progress" in harness.agent.reward_terms


def test_a_default_is_left_out_of_the_file(harness: EditorHarness) -> None:
    harness.done(harness.editor.change_block("0", ("sensors", 0), {"noise": 0.5}))
    assert "noise: 0.5" in harness.editor.text()
    harness.done(harness.editor.change_block("0", ("sensors", 0), {"noise": 0.0}))
    assert "noise" not in harness.editor.text()


def test_off_and_on(harness: EditorHarness) -> None:
    harness.done(harness.editor.switch_block("0", ("sensors", 0), False))
    assert "bearing" not in harness.agent.percept
    harness.done(harness.editor.switch_block("0", ("sensors", 0), True))
    assert "bearing" in harness.agent.percept
    with pytest.raises(ChangeError, match="exactly one brain that is on"):
        harness.done(harness.editor.switch_block("0", ("brains", 0), False))


def test_order(harness: EditorHarness) -> None:
    harness.done(harness.editor.move_block("0", ("rewards", 0), 1))
    assert [each.name for each in harness.agent.rewards] == ["progress", "touch"]
    harness.done(harness.editor.move_block("0", ("rewards", 0), -1))
    assert [each.name for each in harness.agent.rewards] == ["progress", "touch"]


def test_undo_and_redo(harness: EditorHarness) -> None:
    texts = [harness.editor.text()]
    editor = harness.editor
    for change in (
        partial(editor.add_block, "0", "sensors", RAYS),
        partial(editor.change_block, "0", ("sensors", 1), {"number_of_rays": 5}),
        partial(editor.remove_block, "0", ("sensors", 0)),
    ):
        harness.done(change())
        harness.tick(2)
        texts.append(harness.editor.text())
    assert harness.editor.undo_label == "remove BearingSensor"
    for text in texts[-2::-1]:
        harness.done(harness.editor.undo())
        assert harness.editor.text() == text
        harness.tick()
    with pytest.raises(ChangeError, match="nothing to undo"):
        harness.done(harness.editor.undo())
    for text in texts[1:]:
        harness.done(harness.editor.redo())
        assert harness.editor.text() == text
    assert list(harness.agent.percept) == ["eyes", "done", "id"]
    harness.done(harness.editor.undo())
    harness.done(harness.editor.change_block("0", ("sensors", 1), {"noise": 0.5}))
    assert harness.editor.redo_label == ""


def test_two_of_one_name_are_refused(harness: EditorHarness) -> None:
    harness.done(harness.editor.add_block("0", "sensors", RAYS))
    with pytest.raises(ChangeError, match="two sensors have the perception_key 'eyes'"):
        harness.done(harness.editor.add_block("0", "sensors", RAYS))


def test_edited_world_equals_a_rebuilt_one(harness: EditorHarness) -> None:
    harness.tick(5)
    for change in (
        harness.editor.add_block("0", "sensors", RAYS | {"noise": 0.1, "stacked_observations": 2}),
        harness.editor.change_block("0", ("actuators", 0), {"move_amount": 3}),
        harness.editor.add_body({"name": "ball", "position": [2, 2], "shape": {"type": "circle"}}),
        harness.editor.remove_block("0", ("rewards", 1)),
        harness.editor.move_body("box", 3, 1),
        harness.editor.undo(),
        harness.editor.change_body("box", {"mass": 4}),
        harness.editor.remove_body("wall"),
        harness.editor.undo(),
    ):
        harness.done(change)
        harness.tick(2)
    fresh = harness.editor.scene.build()
    for seed in (3, 4):
        assert trace(harness.runner.sim, seed) == trace(fresh, seed)


@pytest.mark.parametrize("name", ["forage", "soccer", "maze", "platform"])
def test_so_it_is_in_scenes_of_the_library(name: str) -> None:
    harness = EditorHarness(Scene.load(name))
    harness.tick(9)
    agent = harness.editor.state.description.agents[0]["id"]
    body = harness.scene.description.bodies[-1].name
    for change in (
        harness.editor.add_block(agent, "sensors", {"type": "StepSensor", "perception_key": "x"}),
        harness.editor.add_body({"name": "extra", "position": [0, 0], "kind": "static", "z": 50}),
        harness.editor.change_body(body, {"mass": 0.5}),
        harness.editor.remove_body("extra"),
        harness.editor.undo(),
        harness.editor.change_block(agent, ("actuators", 0), {"is_output": True}),
    ):
        harness.done(change)
        harness.tick(3)
    fresh = harness.editor.scene.build()
    for seed in (3, 4):
        assert trace(harness.runner.sim, seed, 20) == trace(fresh, seed, 20)


def test_before_the_first_decision_the_episode_begins_again() -> None:
    harness = EditorHarness(record=True)
    recorder = harness.runner.recorder
    assert recorder is not None
    harness.done(harness.editor.add_block("0", "sensors", RAYS))
    seed = harness.world.seeds.seed
    harness.tick(3)
    recorder.finish()
    (episode,) = recorder.episodes
    assert (episode.seed, len(episode.agent()), episode.changed) == (seed, 3, None)
    assert Replay(episode).verdict.exact


def test_change_ends_a_recording_and_reset_starts_another() -> None:
    harness = EditorHarness(record=True)
    recorder = harness.runner.recorder
    assert recorder is not None
    harness.tick(6)
    harness.done(harness.editor.add_block("0", "sensors", RAYS))
    harness.tick(4)
    harness.done(harness.runner.reset(seed=8))
    harness.tick(2)
    recorder.finish()
    first, second = recorder.episodes
    assert [len(each.agent()) for each in (first, second)] == [6, 2]
    assert all(Replay(each).verdict.exact for each in (first, second))
    assert len(second.scene.agents[0]["sensors"]) == 2


def test_an_agents_own_parameters(harness: EditorHarness) -> None:
    outcome = harness.done(harness.editor.change_agent("0", {"max_steps_per_episode": 3}))
    assert outcome.when == "next decision"
    harness.tick(3)
    assert harness.agent.truncated
    outcome = harness.done(harness.editor.change_agent("0", {"priority": 3}))
    assert outcome.when == "next reset"
    with pytest.raises(ChangeError, match="reward_scale: expected a number, got 'x'"):
        harness.done(harness.editor.change_agent("0", {"reward_scale": "x"}))


def test_the_success_goes_with_the_reward_function_that_pays_it() -> None:
    harness = EditorHarness(TEXT.replace("name: small", "name: small\nsuccess: touch"))

    def successes() -> tuple[str | None, str]:
        return harness.editor.scene.description.success, harness.runner.sim.success

    harness.done(harness.editor.change_block("0", ("rewards", 0), {"name": "arrived"}))
    assert successes() == ("arrived", "arrived")
    harness.done(harness.editor.remove_block("0", ("rewards", 1)))
    assert successes() == ("arrived", "arrived")
    outcome = harness.done(harness.editor.remove_block("0", ("rewards", 0)))
    assert "nothing pays 'arrived' any more" in str(outcome.note)
    assert successes() == (None, "")
    Scene.loads(harness.editor.text())
    harness.done(harness.editor.undo())
    assert successes() == ("arrived", "arrived")

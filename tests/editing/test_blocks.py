"""Blocks that are changed on an agent under way."""

from functools import partial

import numpy as np
import pytest

from ai4u_edu import Scene
from ai4u_edu.editing import ChangeError
from ai4u_edu.recording import Replay
from tests.editing.shops import TEXT, Shop, trace

RAYS = {
    "type": "LinearRayCastingSensor",
    "perception_key": "eyes",
    "number_of_rays": 9,
    "field_of_view": 90,
    "vision_max_distance": 8,
    "group_code": {"target": 1, "wall": 2},
}


@pytest.fixture
def shop() -> Shop:
    return Shop()


def test_a_sensor_is_added_without_a_reset(shop: Shop) -> None:
    shop.tick(7)
    before = shop.agent.percept["bearing"].copy()
    outcome = shop.done(shop.editor.add_block("0", "sensors", RAYS))
    assert (outcome.when, outcome.label) == ("next decision", "add LinearRayCastingSensor")
    assert shop.agent.percept["eyes"].size == 9
    assert np.count_nonzero(shop.agent.percept["eyes"]) > 0
    assert (shop.agent.steps, shop.world.ticks) == (7, 7)
    assert shop.agent.percept["bearing"].tolist() == before.tolist()  # its stack goes on
    shop.tick(3)
    assert shop.agent.steps == 10


def test_bad_values_are_told_field_by_field_and_nothing_changes(shop: Shop) -> None:
    shop.tick(4)
    fitting, text, version = shop.agent.bound_blocks, shop.editor.text(), shop.editor.version
    values = {"number_of_rays": 0, "vision_max_distance": -1}
    with pytest.raises(ChangeError) as told:
        shop.done(shop.editor.add_block("0", "sensors", RAYS | values))
    assert {str(each) for each in told.value.problems} == {
        "number_of_rays: expected at least 1, got 0",
        "vision_max_distance: expected more than 0, got -1",
    }
    both = {"stacked_observations": 0, "noise": "wide"}  # out of range, and of the wrong type
    with pytest.raises(ChangeError) as told:
        shop.done(shop.editor.change_block("0", ("sensors", 0), both))
    assert {str(each) for each in told.value.problems} == {
        "stacked_observations: expected at least 1, got 0",
        "noise: expected a number, got 'wide'",
    }
    with pytest.raises(ChangeError) as told:
        shop.done(shop.editor.change_block("0", ("sensors", 0), {"target": "bxo"}))
    (problem,) = told.value.problems
    assert problem.path == ("target",)
    assert problem.text.endswith("no body is named 'bxo'; did you mean 'box'?")
    assert (shop.agent.bound_blocks, shop.editor.text()) == (fitting, text)
    assert (shop.editor.version, shop.editor.undo_label) == (version, "")


def test_a_changed_block_is_new_and_the_others_stay(shop: Shop) -> None:
    shop.tick(5)
    touch, progress = shop.agent.rewards
    outcome = shop.done(shop.editor.change_block("0", ("rewards", 0), {"reward": 7}))
    assert str(outcome) == "it applies at the next decision"
    assert shop.agent.rewards[0] is not touch
    assert shop.agent.rewards[1] is progress
    assert shop.agent.rewards[0].reward == 7
    shop.tick()
    assert "progress" in shop.agent.reward_terms


def test_a_default_is_left_out_of_the_file(shop: Shop) -> None:
    shop.done(shop.editor.change_block("0", ("sensors", 0), {"noise": 0.5}))
    assert "noise: 0.5" in shop.editor.text()
    shop.done(shop.editor.change_block("0", ("sensors", 0), {"noise": 0.0}))
    assert "noise" not in shop.editor.text()


def test_off_and_on(shop: Shop) -> None:
    shop.done(shop.editor.switch_block("0", ("sensors", 0), False))
    assert "bearing" not in shop.agent.percept
    shop.done(shop.editor.switch_block("0", ("sensors", 0), True))
    assert "bearing" in shop.agent.percept
    with pytest.raises(ChangeError, match="exactly one brain that is on"):
        shop.done(shop.editor.switch_block("0", ("brains", 0), False))


def test_order(shop: Shop) -> None:
    shop.done(shop.editor.move_block("0", ("rewards", 0), 1))
    assert [each.name for each in shop.agent.rewards] == ["progress", "touch"]
    shop.done(shop.editor.move_block("0", ("rewards", 0), -1))
    assert [each.name for each in shop.agent.rewards] == ["progress", "touch"]


def test_undo_and_redo(shop: Shop) -> None:
    texts = [shop.editor.text()]
    editor = shop.editor
    for change in (
        partial(editor.add_block, "0", "sensors", RAYS),
        partial(editor.change_block, "0", ("sensors", 1), {"number_of_rays": 5}),
        partial(editor.remove_block, "0", ("sensors", 0)),
    ):
        shop.done(change())
        shop.tick(2)
        texts.append(shop.editor.text())
    assert shop.editor.undo_label == "remove BearingSensor"
    for text in texts[-2::-1]:
        shop.done(shop.editor.undo())
        assert shop.editor.text() == text
        shop.tick()
    with pytest.raises(ChangeError, match="nothing to undo"):
        shop.done(shop.editor.undo())
    for text in texts[1:]:
        shop.done(shop.editor.redo())
        assert shop.editor.text() == text
    assert list(shop.agent.percept) == ["eyes", "done", "id"]
    shop.done(shop.editor.undo())
    shop.done(shop.editor.change_block("0", ("sensors", 1), {"noise": 0.5}))
    assert shop.editor.redo_label == ""


def test_two_of_one_name_are_refused(shop: Shop) -> None:
    shop.done(shop.editor.add_block("0", "sensors", RAYS))
    with pytest.raises(ChangeError, match="two sensors have the perception_key 'eyes'"):
        shop.done(shop.editor.add_block("0", "sensors", RAYS))


def test_what_was_changed_is_what_a_new_world_would_be(shop: Shop) -> None:
    shop.tick(5)
    for change in (
        shop.editor.add_block("0", "sensors", RAYS | {"noise": 0.1, "stacked_observations": 2}),
        shop.editor.change_block("0", ("actuators", 0), {"move_amount": 3}),
        shop.editor.add_body({"name": "ball", "position": [2, 2], "shape": {"type": "circle"}}),
        shop.editor.remove_block("0", ("rewards", 1)),
        shop.editor.move_body("box", 3, 1),
        shop.editor.undo(),
        shop.editor.change_body("box", {"mass": 4}),
        shop.editor.remove_body("wall"),
        shop.editor.undo(),
    ):
        shop.done(change)
        shop.tick(2)
    fresh = shop.editor.scene.build()
    for seed in (3, 4):
        assert trace(shop.runner.sim, seed) == trace(fresh, seed)


@pytest.mark.parametrize("name", ["forage", "soccer", "maze", "platform"])
def test_so_it_is_in_scenes_of_the_library(name: str) -> None:
    shop = Shop(Scene.load(name))
    shop.tick(9)
    agent = shop.editor.state.description.agents[0]["id"]
    body = shop.scene.description.bodies[-1].name
    for change in (
        shop.editor.add_block(agent, "sensors", {"type": "StepSensor", "perception_key": "x"}),
        shop.editor.add_body({"name": "extra", "position": [0, 0], "kind": "static", "z": 50}),
        shop.editor.change_body(body, {"mass": 0.5}),
        shop.editor.remove_body("extra"),
        shop.editor.undo(),
        shop.editor.change_block(agent, ("actuators", 0), {"is_output": True}),
    ):
        shop.done(change)
        shop.tick(3)
    fresh = shop.editor.scene.build()
    for seed in (3, 4):
        assert trace(shop.runner.sim, seed, 20) == trace(fresh, seed, 20)


def test_before_the_first_decision_the_episode_begins_again() -> None:
    shop = Shop(record=True)
    recorder = shop.runner.recorder
    assert recorder is not None
    shop.done(shop.editor.add_block("0", "sensors", RAYS))
    seed = shop.world.seeds.seed
    shop.tick(3)
    recorder.finish()
    (episode,) = recorder.episodes
    assert (episode.seed, len(episode.agent()), episode.changed) == (seed, 3, None)
    assert Replay(episode).verdict.exact


def test_what_is_recorded_ends_with_a_change_and_begins_anew_at_the_reset() -> None:
    shop = Shop(record=True)
    recorder = shop.runner.recorder
    assert recorder is not None
    shop.tick(6)
    shop.done(shop.editor.add_block("0", "sensors", RAYS))
    shop.tick(4)
    shop.done(shop.runner.reset(seed=8))
    shop.tick(2)
    recorder.finish()
    first, second = recorder.episodes
    assert [len(each.agent()) for each in (first, second)] == [6, 2]
    assert all(Replay(each).verdict.exact for each in (first, second))
    assert len(second.scene.agents[0]["sensors"]) == 2


def test_an_agents_own_parameters(shop: Shop) -> None:
    outcome = shop.done(shop.editor.change_agent("0", {"max_steps_per_episode": 3}))
    assert outcome.when == "next decision"
    shop.tick(3)
    assert shop.agent.truncated
    outcome = shop.done(shop.editor.change_agent("0", {"priority": 3}))
    assert outcome.when == "next reset"
    with pytest.raises(ChangeError, match="reward_scale: expected a number, got 'x'"):
        shop.done(shop.editor.change_agent("0", {"reward_scale": "x"}))


def test_the_success_goes_with_the_reward_function_that_pays_it() -> None:
    shop = Shop(TEXT.replace("name: small", "name: small\nsuccess: touch"))

    def successes() -> tuple[str | None, str]:
        return shop.editor.scene.description.success, shop.runner.sim.success

    shop.done(shop.editor.change_block("0", ("rewards", 0), {"name": "arrived"}))
    assert successes() == ("arrived", "arrived")
    shop.done(shop.editor.remove_block("0", ("rewards", 1)))
    assert successes() == ("arrived", "arrived")
    outcome = shop.done(shop.editor.remove_block("0", ("rewards", 0)))
    assert "nothing pays 'arrived' any more" in str(outcome.note)
    assert successes() == (None, "")
    Scene.loads(shop.editor.text())
    shop.done(shop.editor.undo())
    assert successes() == ("arrived", "arrived")

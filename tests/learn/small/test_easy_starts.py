"""Easy starts: where episodes of a training begin, and when that widens."""

from dataclasses import replace
from pathlib import Path

import pytest

from ai4u_edu import Scene
from ai4u_edu.base.errors import SceneError
from ai4u_edu.learn.small.easy_starts import ENOUGH, EPISODES, EasyStarts
from ai4u_edu.learn.small.ppo import PpoSettings
from ai4u_edu.learn.small.ppo_training import PpoTraining

FEW = PpoSettings(worlds=4, steps=8, batch=16, epochs=1, check_every=32, check_episodes=2)
RANGE = "bodies.block.random.x"


def starts() -> EasyStarts:
    found = EasyStarts.of(Scene.load("push_block"))
    assert found is not None
    return found


def places(training: PpoTraining) -> list[float]:
    return [env.sim.world["block"].position[0] for env in training.ppo.worlds.envs]


def test_ranges_widen_when_four_of_five_of_the_latest_episodes_succeed() -> None:
    easy = starts()
    for _ in range(EPISODES - ENOUGH):
        easy.note(False)
    for _ in range(ENOUGH - 1):
        easy.note(True)
    assert easy.share == 0.0
    easy.note(True)
    assert easy.share == 0.1
    assert easy.options[RANGE] == pytest.approx([-0.51, 0.51])
    for _ in range(9 * ENOUGH):
        easy.note(True)
    assert (easy.share, easy.options) == (1.0, {})
    easy.note(True)  # there is nothing to widen any more
    assert easy.share == 1.0


def test_a_scene_without_easy_starts_has_all_of_them_at_once() -> None:
    assert EasyStarts.of(Scene.load("box_chase")) is None
    assert PpoTraining(Scene.load("yardstick"), FEW).ppo.easy_starts is None


def test_what_learns_begins_with_easy_starts_and_what_is_checked_does_not() -> None:
    training = PpoTraining(Scene.load("push_block"), replace(FEW, check_episodes=8))
    assert max(map(abs, places(training))) <= 0.4
    training.learn(64)
    assert max(map(abs, places(training))) <= 0.4
    checked = [env.sim.world["block"].sampled.position[0] for env in training._check_worlds.envs]
    assert max(map(abs, checked)) > 0.4


def test_a_training_goes_on_with_the_starts_it_had(tmp_path: Path) -> None:
    scene = Scene.load("push_block")
    training = PpoTraining(scene, FEW)
    assert training.ppo.easy_starts is not None
    for _ in range(3 * ENOUGH):
        training.ppo.easy_starts.note(True)
    training.ppo.easy_starts.note(False)
    training.save(tmp_path / "state.npz")
    again = PpoTraining.resume(tmp_path / "state.npz", scene)
    assert again.ppo.easy_starts is not None
    assert again.ppo.easy_starts.share == pytest.approx(0.3)
    assert again.ppo.easy_starts.state() == training.ppo.easy_starts.state()
    assert max(map(abs, places(again))) <= 0.4 + 0.3 * 1.1


def test_play_and_its_random_numbers_know_no_easy_starts() -> None:
    scene = Scene.load("push_block")
    text = "\n".join(line for line in scene.dumps().splitlines() if "curriculum" not in line)
    with_easy, without = scene.build(), Scene.loads(text).build()
    assert scene.description.task_key() == Scene.loads(text).description.task_key()
    for seed in range(20):
        for sim in (with_easy, without):
            sim.reset(seed)
        poses = [
            {name: body.pose for name, body in sim.world.bodies.items()}
            for sim in (with_easy, without)
        ]
        assert poses[0] == poses[1]


@pytest.mark.parametrize(
    ("before", "after", "problem"),
    [
        ("x: [-0.4, 0.4]", "x: [-0.4, 1.6]", "x: expected a part of random's range [-1.5, 1.5]"),
        ("x: [-0.4, 0.4]", "scale: [1, 2]", "scale has an easy range, and none in random"),
        ("x: [-0.4, 0.4]", "x: [0.4, -0.4]", "expected the smaller number first"),
        ("{x: [-0.4, 0.4], y: [-0.4, 0.4], heading_deg: [-5, 5]}", "{}", "no start is easier"),
        ("x: [-0.4, 0.4]", "z: [1, 2]", "z"),
    ],
)
def test_a_wrong_easy_range_is_named_with_its_line(before: str, after: str, problem: str) -> None:
    text = Scene.load("push_block").dumps()
    assert before in text
    with pytest.raises(SceneError) as error:
        Scene.loads(text.replace(before, after))
    assert problem in str(error.value)
    assert "scene, line " in str(error.value)

"""Trainings: what they leave, that a seed fixes them, that they can be stopped and resumed."""

import json
import signal
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch

from ai4u_edu import Scene, World
from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks.brains.network import Network
from ai4u_edu.explain.policy import Policy
from ai4u_edu.learn.training.algorithms import load_model
from ai4u_edu.learn.training.learning import EvalCallback, resume, train
from ai4u_edu.learn.training.notebook import export_checkpoints
from ai4u_edu.learn.training.run import Check, Run, run_of
from ai4u_edu.learn.training.settings import ALGORITHMS, Algorithm
from tests.learn.training.small import copied_training, small_settings, small_training

pytestmark = pytest.mark.needs("train")

ONE_OR_ALL = [
    each if each == "ppo" else pytest.param(each, marks=pytest.mark.nightly) for each in ALGORITHMS
]
"""The algorithm that a test takes; in the nightly run it takes the others too."""


def weights(path: Path, algorithm: Algorithm) -> dict[str, torch.Tensor]:
    return dict(load_model(algorithm, path).policy.state_dict())


def same(one: dict[str, torch.Tensor], other: dict[str, torch.Tensor]) -> bool:
    return all(torch.equal(one[name], other[name]) for name in one)


@pytest.mark.parametrize("algorithm", ONE_OR_ALL)
def test_the_same_seed_gives_the_same_model(tmp_path: Path, algorithm: Algorithm) -> None:
    for name, seed in {"a": 1, "b": 1, "c": 2}.items():
        small_training(tmp_path / name, algorithm, seed=seed)
    one, two, other = (weights(tmp_path / name / "last.zip", algorithm) for name in "abc")
    assert same(one, two)
    assert not same(one, other)


@pytest.mark.parametrize("algorithm", ONE_OR_ALL)
def test_it_never_begins_with_an_episode_that_an_evaluation_may_use(
    tmp_path: Path, algorithm: Algorithm, monkeypatch: pytest.MonkeyPatch
) -> None:
    given: list[int] = []
    reset = World.reset

    def noting(world: World, seed: int | None = None) -> None:
        if seed is not None:
            given.append(seed)
        reset(world, seed)

    monkeypatch.setattr(World, "reset", noting)
    small_training(tmp_path, algorithm, seed=1)
    resume(tmp_path, steps=400, quiet=True)
    checks = {2**41, 2**41 + 1}
    worlds = set(given) - checks
    assert checks <= set(given)
    assert len(worlds) == 4  # two for the training, two others for the rest of it
    assert min(worlds) > 2**32


def test_what_a_training_leaves_behind(tmp_path: Path) -> None:
    done = small_training(tmp_path, "sac", seed=3)
    run = Run(tmp_path)
    assert done.steps == 200
    assert [check.steps for check in run.checks()] == [100, 200]
    assert done.best in run.checks()
    config = run.config()
    assert (config.scene, config.algorithm, config.seed, config.steps) == (
        "box_chase",
        "sac",
        3,
        200,
    )
    assert config.settings == small_settings()
    assert config.versions["torch"] == torch.__version__
    assert run.scene() == Scene.load("box_chase")
    assert run.best.is_file()
    assert run.replay.is_file()
    assert list(run.tensorboard.glob("events*"))
    assert not [path for path in tmp_path.iterdir() if path.name.startswith(".")]


def test_a_second_training_does_not_overwrite_the_first(tmp_path: Path) -> None:
    copied_training(tmp_path)
    with pytest.raises(SetupError, match="holds a training already; go on with it"):
        small_training(tmp_path)


@pytest.mark.parametrize("algorithm", ONE_OR_ALL)
def test_a_resumed_training_goes_on_where_it_was(tmp_path: Path, algorithm: Algorithm) -> None:
    first = copied_training(tmp_path, algorithm)
    before = weights(tmp_path / "last.zip", algorithm)
    again = resume(tmp_path, steps=first.steps + 100, quiet=True)
    assert again.steps >= first.steps + 100
    assert again.checks[: len(first.checks)] == first.checks
    assert again.checks[-1].seconds > first.checks[-1].seconds
    assert not same(before, weights(tmp_path / "last.zip", algorithm))
    if algorithm == "sac":
        model: Any = load_model("sac", tmp_path / "last.zip")
        model.load_replay_buffer(tmp_path / "replay.pkl")
        assert model.replay_buffer.full  # 200 decisions of before, and new ones


def test_a_resume_needs_something_to_do(tmp_path: Path) -> None:
    copied_training(tmp_path)
    with pytest.raises(SetupError, match="has learned from 256 steps already"):
        resume(tmp_path, quiet=True)
    with pytest.raises(SetupError, match="holds no training; begin one with"):
        resume(tmp_path / "elsewhere", quiet=True)


def test_ctrl_c_keeps_what_was_learned(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    check = EvalCallback.check

    def interrupting(evaluation: EvalCallback) -> Check:
        if not evaluation.checks:
            signal.raise_signal(signal.SIGINT)
        return check(evaluation)

    monkeypatch.setattr(EvalCallback, "check", interrupting)
    handler = signal.getsignal(signal.SIGINT)
    done = small_training(tmp_path, "sac")
    assert done.interrupted
    assert 100 <= done.steps < 200
    assert signal.getsignal(signal.SIGINT) is handler
    monkeypatch.undo()
    assert Run(tmp_path).best.is_file()
    again = resume(tmp_path, quiet=True)
    assert not again.interrupted
    assert again.steps == 200


def test_the_best_is_kept_not_the_last(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    ranks = iter([0.2, 0.9, 0.4])

    def pretending(_model: Any, _envs: Any, seeds: Any, _table: Any) -> list[Any]:
        from ai4u_edu.learn.training.episode import EpisodeStats

        reward = next(ranks)
        return [EpisodeStats(seed, False, reward, 5, False) for seed in seeds]

    monkeypatch.setattr("ai4u_edu.learn.training.learning._trials", pretending)
    done = small_training(tmp_path, "sac", sac=small_settings().sac.model_dump() | {"steps": 300})
    assert done.best.steps == 200
    assert load_model("sac", tmp_path / "best.zip").num_timesteps == 200
    assert load_model("sac", tmp_path / "last.zip").num_timesteps == 300


def test_it_ends_when_it_is_good_enough(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    rates = iter([1.0, 0.0, 1.0, 1.0, 1.0])

    def pretending(_model: Any, _envs: Any, seeds: Any, _table: Any) -> list[Any]:
        from ai4u_edu.learn.training.episode import EpisodeStats

        success = next(rates) == 1.0
        return [EpisodeStats(seed, success, 0.0, 5, True) for seed in seeds]

    monkeypatch.setattr("ai4u_edu.learn.training.learning._trials", pretending)
    many = small_settings().sac.model_dump() | {"steps": 1000}
    done = small_training(tmp_path, "sac", enough=2, sac=many)
    assert done.enough
    assert done.steps == 400


def test_it_learns(tmp_path: Path) -> None:
    """PPO finds the box within seconds: the real thing, cut short."""
    from ai4u_edu.learn.training.settings import settings_for

    done = train(
        Scene.load("box_chase"), "ppo", settings_for("box_chase"), tmp_path, steps=12000, quiet=True
    )
    assert done.best.success is not None
    assert done.best.success >= 0.9
    text = (tmp_path / "checks.json").read_text()
    assert json.loads(text)[-1]["steps"] == done.checks[-1].steps


def test_it_says_which_of_several_agents_learns(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    """It gives no warning of an environment, whose advice is for scripts."""
    scene = Scene.load("sumo")
    done = train(scene, "ppo", small_settings("sumo"), tmp_path / "one", steps=64)
    told = capfd.readouterr().err
    assert "'blue' learns, the first of several agents (blue, orange)" in told
    assert "agent: ID" in told
    assert done.run.config().settings.agent == "blue"
    train(scene, "ppo", small_settings("sumo", agent="orange"), tmp_path / "two", steps=64)
    assert "learns" not in capfd.readouterr().err


def test_what_sac_and_one_actuator_can_not_do(tmp_path: Path) -> None:
    from tests.learn.training.small import CHOICES

    with pytest.raises(SetupError, match="sac needs actions of real numbers"):
        train(Scene.loads(CHOICES), "sac", small_settings(), tmp_path, quiet=True)
    wrong = small_settings(ppo={"steps": 100, "lerning_rate": 1e-3})
    with pytest.raises(
        SetupError, match="knows no setting 'lerning_rate'; did you mean 'learning_"
    ):
        train(Scene.load("box_chase"), "ppo", wrong, tmp_path, quiet=True)
    assert not tmp_path.joinpath("config.json").exists()


def test_the_model_of_each_check_is_kept_if_asked_for(tmp_path: Path) -> None:
    scene = Scene.load("box_chase")
    result = train(scene, "ppo", small_settings(), tmp_path, keep_checkpoints=True, quiet=True)
    kept = result.run.checkpoints
    assert [int(path.stem.removeprefix("checkpoint-")) for path in kept] == [
        check.steps for check in result.checks
    ]
    assert len(kept) > 1
    assert run_of(kept[0]).folder == tmp_path  # so that it can be exported
    result.run.clear()
    assert result.run.checkpoints == []
    with pytest.raises(SetupError, match="has no checkpoints; train with: ai4u-edu train SCENE"):
        export_checkpoints(result, tmp_path / "networks")


@pytest.mark.nightly
def test_checkpoints_are_exported_to_be_compared(tmp_path: Path) -> None:
    scene = Scene.load("box_chase")
    result = train(scene, "ppo", small_settings(), tmp_path, keep_checkpoints=True, quiet=True)
    files = export_checkpoints(result, tmp_path / "networks")
    assert [path.stem for path in files] == [path.stem for path in result.run.checkpoints]
    steps = [Network(path).about["steps"] for path in files]
    assert steps == [check.steps for check in result.checks]
    policies = [Policy(path) for path in files]
    sim = scene.build(1)
    sim.reset(1)
    actions = [policy.decide(sim.agents[0].percept) for policy in policies]
    assert not np.allclose(actions[0], actions[-1])

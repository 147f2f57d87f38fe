"""The small learner as a command: its folder, its files, and that it goes on after a kill."""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.base.errors import SetupError
from ai4u_edu.base.numeric_threads import ONE_THREAD
from ai4u_edu.blocks.brains.network import Network
from ai4u_edu.cli.main import app
from ai4u_edu.learn.training import clone, demonstrate, evaluate, export, train
from ai4u_edu.learn.training.assigned import with_drivers
from ai4u_edu.learn.training.run import Run
from tests.learn.small.corridor import corridor
from tests.waiting import LIMIT_S, until

pytestmark = pytest.mark.slow

QUICK = {"enough": 0, "check_episodes": 2, "max_steps": 12}


@pytest.fixture
def scene(tmp_path: Path) -> str:
    """File of a corridor that is learned in seconds."""
    corridor().save(tmp_path / "corridor.yaml")
    return str(tmp_path / "corridor.yaml")


def test_what_a_training_leaves_behind(scene: str, tmp_path: Path) -> None:
    out = tmp_path / "run"
    done = train(scene, trainer="small", steps=6000, seed=3, out=out, settings=QUICK, quiet=True)
    run = Run(out)
    assert (done.steps, done.interrupted, done.enough) == (6144, False, False)
    assert [check.steps for check in run.checks()] == [4096, 6144]
    assert done.best in run.checks()
    config = run.config()
    assert (config.trainer, config.seed, config.steps) == ("small", 3, 6000)
    progress = json.loads(run.progress.read_text())
    assert (progress["decisions"], progress["total"], progress["is_over"]) == (6144, 6000, True)
    assert len(progress["curve"]) == 2
    about = Network(run.best_network).about
    assert (about["steps"], about["trainer"]) == (done.best.steps, "small")
    assert Network(run.watched_network).about["steps"] == 6144
    result = evaluate(out, episodes=1, quiet=True)
    assert result.scene == "corridor"
    copy = export(out, tmp_path / "policy.onnx")
    assert copy.read_bytes() == run.best_network.read_bytes()
    again = train(
        scene, trainer="small", steps=512, out=out, settings=QUICK, overwrite=True, quiet=True
    )
    assert [check.steps for check in again.checks] == [512]


def test_without_torch_it_learns_and_says_why(
    scene: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("ai4u_edu.base.optional_deps.find_spec", lambda _name: None)
    words = ["train", scene, "--steps", "512", "--out", str(tmp_path / "run")]
    done = CliRunner().invoke(app, words)
    assert done.exit_code == 0, done.output
    assert "done after 512 steps" in done.stdout
    assert "best.onnx" in done.stdout
    assert "since Stable-Baselines3 and torch are not installed" in done.stderr


def test_a_killed_training_goes_on(scene: str, tmp_path: Path) -> None:
    out, settings = tmp_path / "run", tmp_path / "quick.yaml"
    settings.write_text(json.dumps(QUICK))
    command = [sys.executable, "-m", "ai4u_edu", "train", scene, "--trainer", "small"]
    options = ["--steps", "100000000", "--out", str(out), "--settings", str(settings)]
    with subprocess.Popen([*command, *options], env=os.environ | ONE_THREAD) as process:
        until((out / "checks.json").is_file)
        process.kill()
        process.wait(LIMIT_S)
    before = Run(out).checks()
    with np.load(Run(out).state) as state:
        steps = json.loads(str(state["state"]))["decisions"]
    assert steps >= before[-1].steps
    done = train(resume=True, out=out, steps=steps + 512, quiet=True)
    assert done.steps == steps + 512
    assert done.checks[: len(before)] == before
    with pytest.raises(SetupError, match="steps already; expected --steps larger"):
        train(resume=True, out=out, steps=512, quiet=True)
    with pytest.raises(SetupError, match="was begun by 'small', which has to go on with it"):
        train(resume=True, out=out, trainer="sb3", quiet=True)


def test_a_training_that_was_killed_before_its_first_check_goes_on(
    scene: str, tmp_path: Path
) -> None:
    out = tmp_path / "run"
    train(scene, trainer="small", steps=512, out=out, settings=QUICK, quiet=True)
    for name in ("checks.json", "watched.json"):
        (out / name).unlink()
    assert train(resume=True, out=out, steps=1024, quiet=True).steps == 1024


def test_the_same_seed_gives_the_same_file_in_processes_of_their_own(
    scene: str, tmp_path: Path
) -> None:
    """Also where the environment names no count of threads: the command begins again with one."""
    environment = {name: value for name, value in os.environ.items() if name not in ONE_THREAD}
    files = []
    for name in "ab":
        words = ["train", scene, "--trainer", "small", "--steps", "1024"]
        command = [sys.executable, "-m", "ai4u_edu", *words, "--out", str(tmp_path / name)]
        subprocess.run(command, env=environment, capture_output=True, check=True)
        files.append((tmp_path / name / "best.onnx").read_bytes())
    assert files[0] == files[1]


def test_a_clone_is_measured_on_whole_drives_and_improved(scene: str, tmp_path: Path) -> None:
    def ahead(percept: object) -> dict[str, list[float]]:
        return {"move": [1, 0, 0, 0]}

    drives = demonstrate(ahead, scene, episodes=5, quiet=True)
    network = tmp_path / "clone.onnx"
    done = clone(drives, network, trainer="small", updates=200, quiet=True)
    assert done.held_out == len(drives[0].agents[0])
    assert done.alike == 1.0
    about = Network(network).about
    assert (about["algorithm"], about["skip_frame"], about["demonstrations"]) == ("clone", 9, 5)
    improved = train(
        scene,
        steps=512,
        out=tmp_path / "run",
        settings=QUICK,
        begin_with=network,
        reward_weights={"touch": 2.0},
        quiet=True,
    )
    assert improved.run.config().trainer == "small"
    assert improved.best.success == 1.0


def test_a_clone_of_the_command_line_says_how_good_it_is(scene: str, tmp_path: Path) -> None:
    sim = Scene.load(scene).build()
    assert isinstance(sim.agents[0].brain, LocalBrain)
    words = ["record", scene, "--brain", "random", "--episodes", "5", "--out", str(tmp_path / "d")]
    assert CliRunner().invoke(app, words).exit_code == 0
    words = ["clone", str(tmp_path / "d"), "--out", str(tmp_path / "c.onnx"), "--updates", "100"]
    done = CliRunner().invoke(app, [*words, "--trainer", "small", "--evaluate", "2"])
    assert done.exit_code == 0, done.output
    assert "held-out ones it acts like the driver in" in done.output
    assert "c.onnx" in done.output


BRIEF = {"check_episodes": 2, "max_steps": 20}


def test_a_network_that_learned_against_itself_goes_on_and_drives_both_sides(
    tmp_path: Path,
) -> None:
    out = tmp_path / "run"
    train("sumo", steps=256, against="self", out=out, settings=BRIEF, quiet=True)
    config = Run(out).config()
    assert (config.trainer, config.against, config.settings.agent) == ("small", "self", "blue")
    assert train(resume=True, out=out, steps=2304, quiet=True).steps == 4096
    network = str(Run(out).best_network)
    drivers = [f"{agent}={network}" for agent in ("blue", "orange")]
    sim, _ = with_drivers(Scene.load("sumo"), drivers)
    sim.reset(1)
    for agent in sim.agents:
        sim.step(agent)
        assert agent.last_action["move"]


def test_a_network_to_learn_against_is_kept_in_the_folder(tmp_path: Path) -> None:
    first, out = tmp_path / "first", tmp_path / "run"
    train(
        "sumo", steps=256, against="player", agent="orange", out=first, settings=BRIEF, quiet=True
    )
    assert Run(first).config().settings.agent == "orange"
    network = first / "best.onnx"
    train("sumo", steps=256, against=network, out=out, settings=BRIEF, quiet=True)
    assert Run(out).opponent.read_bytes() == network.read_bytes()
    network.unlink()
    assert train(resume=True, out=out, steps=2304, quiet=True).steps == 4096
    best = Run(out).best_network.read_bytes()
    network = out / "best.onnx"
    train("sumo", steps=256, against=network, out=out, settings=BRIEF, overwrite=True, quiet=True)
    assert Run(out).opponent.read_bytes() == best


def test_the_command_says_who_can_play_the_other_side(tmp_path: Path) -> None:
    out = tmp_path / "run"
    words = ["train", "tag", "--against", "self", "--agent", "chaser", "--out", str(out)]
    done = CliRunner().invoke(app, words)
    assert done.exit_code == 1
    assert "'chaser' can't play against itself" in str(done.exception)
    assert not out.exists()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"trainer": "smal"}, "trainer: expected one of sb3, small, got 'smal'; did you mean"),
        ({"trainer": "small", "algo": "sac"}, "algo: the trainer 'small' has no such choice"),
        ({"trainer": "small", "watch": True}, "watch: the trainer 'small' has no such choice"),
        ({"trainer": "sb3", "against": "self"}, "against: the trainer 'sb3' has no such choice"),
        ({"trainer": "sb3", "begin_with": "a.onnx"}, "begin_with: the trainer 'sb3' has no such"),
        ({"reward_weights": {"toch": 2.0}}, "no reward term is called 'toch'; did you mean"),
    ],
)
def test_what_only_one_of_the_trainers_takes(
    scene: str, tmp_path: Path, arguments: dict[str, Any], message: str
) -> None:
    with pytest.raises(SetupError, match=message):
        train(scene, out=tmp_path / "run", quiet=True, **arguments)
    assert not (tmp_path / "run").exists()

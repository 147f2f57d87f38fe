"""The commands, from learning to driving in the page."""

import json
import re
import shutil
import socket
import subprocess
import time
from pathlib import Path
from typing import Any

import httpx
import pytest
from typer.testing import CliRunner

from ai4u_edu import Scene
from ai4u_edu.cli import _give_brain, app
from ai4u_edu.errors import AI4UError
from ai4u_edu.training.algorithms import load_model
from ai4u_edu.training.watch import MODEL, Watch
from tests.training.small import small_settings, small_training


def run(*arguments: str) -> str:
    told = CliRunner().invoke(app, list(arguments))
    if told.exception is not None and not isinstance(told.exception, SystemExit):
        raise told.exception
    assert told.exit_code == 0, told.output
    return told.output


def failed(*arguments: str) -> str:
    told = CliRunner().invoke(app, list(arguments))
    assert isinstance(told.exception, AI4UError), told.output
    return str(told.exception)


def test_train_resume_export_evaluate(tmp_path: Path) -> None:
    mine = tmp_path / "mine.yaml"
    plain = small_settings().model_dump(mode="json")
    mine.write_text(json.dumps(plain))  # JSON is YAML
    out, network = tmp_path / "run", tmp_path / "policy.onnx"
    options = ("--settings", str(mine), "--out", str(out))
    told = run("train", "box_chase", "--algo", "ppo", "--steps", "128", *options)
    assert "after 128 steps" in told
    assert f"ai4u-edu export {out} --out policy.onnx" in told.replace("\n", "")
    told = run("train", "--resume", "--out", str(out), "--steps", "256")
    assert "after 256 steps" in told
    assert "--brain" in run("export", str(out), "--out", str(network))
    scene = tmp_path / "short.yaml"
    text = (
        Scene.load("box_chase")
        .dumps()
        .replace("max_steps_per_episode: 3000", "max_steps_per_episode: 20")
    )
    scene.write_text(text)
    both = ("--compare", str(network), "--scene", str(scene), "--episodes", "3", "--json", "-")
    one, other = json.loads(run("evaluate", str(out), *both))
    assert one["each"] == other["each"]


@pytest.mark.parametrize("address", ["zoo", "zoo:box_chase", "0=zoo"])
def test_playing_with_a_network_of_the_zoo(address: str) -> None:
    sim = Scene.load("box_chase").build()
    _give_brain(sim, address, "box_chase")
    brain = sim.agents[0].brain
    assert (brain.title(), brain.skip_frame) == ("LocalBrain(NeuralNetController)", 9)


def test_what_is_wrong_on_the_command_line(tmp_path: Path) -> None:
    assert "expected one of sac, ppo, dqn, got 'sacc'" in failed("train", "--algo", "sacc")
    assert "--resume needs --out" in failed("train", "--resume")
    assert "did you mean 'box_chase'" in failed("train", "box_chese")
    assert "Expected --scene" in failed("evaluate", "random")
    assert "holds no training" in failed("export", str(tmp_path / "model.zip"))


def test_watching_hands_the_policy_on(tmp_path: Path) -> None:
    """The page's process serves the world in which the latest model drives."""
    done = small_training(tmp_path)
    model = load_model("ppo", done.run.last)
    watch = Watch(done.run, port=0, open_page=False)
    watch.init_callback(model)
    shutil.copy(done.run.last, tmp_path / MODEL)
    watch.hand_on()
    with subprocess.Popen(watch.command(), stderr=subprocess.PIPE, text=True) as page:
        assert page.stderr is not None
        try:
            line = next(line for line in page.stderr if "watch it learn" in line)
            found = re.search(r"http://\S+", line)
            assert found
            address = found[0] + "api/snapshot"
            before = httpx.get(address, timeout=20).json()["agents"][0]
            # from now on it does nothing but turn
            weights = model.policy.action_net
            weights.weight.data.zero_()
            weights.bias.data[:] = weights.bias.new_tensor([0.0, 1.0, 0.0, 0.0])
            watch.hand_on()
            for _ in range(100):
                time.sleep(0.1)
                after = httpx.get(address, timeout=20).json()["agents"][0]
                if turning(after):
                    break
        finally:
            page.terminate()
    assert before["brain"] == "LocalBrain(ScriptController)"
    assert not turning(before)
    assert turning(after)


def turning(agent: dict[str, Any]) -> bool:
    """Whether its last action was exactly a turn to the right."""
    return bool(agent["action"].get("move") == [0.0, 1.0, 0.0, 0.0])


def test_watching_takes_another_port_where_that_one_is_taken(tmp_path: Path) -> None:
    done = small_training(tmp_path)
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        watch = Watch(done.run, port=port, open_page=False)
        watch.init_callback(load_model("ppo", done.run.last))
        shutil.copy(done.run.last, tmp_path / MODEL)
        watch.hand_on()
        with subprocess.Popen(watch.command(), stderr=subprocess.PIPE, text=True) as page:
            assert page.stderr is not None
            try:
                line = next(line for line in page.stderr if "watch it learn" in line)
            finally:
                page.terminate()
    assert f":{port}/" not in line

"""The commands, from learning to driving in the page."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from ai4u_edu import Scene
from ai4u_edu.base.errors import AI4UError, NameNotFoundError, SetupError
from ai4u_edu.blocks import Block, RemoteBrain
from ai4u_edu.cli.main import app
from ai4u_edu.learn.training import export
from ai4u_edu.learn.training.assigned import with_drivers
from ai4u_edu.learn.training.run import Run
from ai4u_edu.learn.training.watch import Watch
from tests.learn.training.small import CHOICES, copied_training, small_settings

pytestmark = pytest.mark.needs("train")


def run(*arguments: str) -> str:
    told = CliRunner().invoke(app, list(arguments))
    if told.exception is not None and not isinstance(told.exception, SystemExit):
        raise told.exception
    assert told.exit_code == 0, told.output
    return told.stdout


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
    assert f"ai4u-edu evaluate --brain {out}" in told.replace("\n", "")
    assert "--brain" in run("export", str(out), "--out", str(network))
    scene = tmp_path / "short.yaml"
    text = (
        Scene.load("box_chase")
        .dumps()
        .replace("max_steps_per_episode: 3000", "max_steps_per_episode: 20")
    )
    scene.write_text(text)
    both = ("--brain", str(out), "--brain", str(network), "--episodes", "3", "--json", "-")
    one, other = json.loads(run("evaluate", str(scene), *both))
    assert one["each"] == other["each"]


OWN = """
from gymnasium.spaces import Box

from ai4u_edu import Sensor


class Compass(Sensor):
    def space(self):
        return Box(-1.0, 1.0, (1,))

    def read(self, body, view):
        return 0.5
"""


def test_a_scene_with_blocks_of_ones_own_is_learned(tmp_path: Path) -> None:
    built_in = Block.types

    def forget() -> None:
        Block.types = built_in

    blocks, scene, mine = tmp_path / "own.py", tmp_path / "own.yaml", tmp_path / "mine.yaml"
    blocks.write_text(OWN)
    mine.write_text(json.dumps(small_settings().model_dump(mode="json") | {"observe": []}))
    text = CHOICES.replace("{type: GroundStatusSensor}", "{type: Compass}")
    scene.write_text(text)
    out, network = tmp_path / "run", tmp_path / "policy.onnx"
    options = ("--settings", str(mine), "--out", str(out), "--algo", "ppo", "--steps", "128")
    assert "Compass" in failed("train", str(scene), *options)
    own = ("--blocks", str(blocks))
    told = run("train", str(scene), *options, *own).replace("\n", "")
    assert f"ai4u-edu evaluate {scene} --brain {out}" in told, "a file by its path, not its name"
    for path in out.rglob("*"):  # what is read again runs nothing
        assert str(blocks).encode() not in (path.read_bytes() if path.is_file() else b"")
    for command in (
        ["evaluate", "--brain", str(out), "--episodes", "1"],
        ["export", str(out), "--out", str(network)],
        ["train", "--resume", "--out", str(out), "--steps", "192"],
    ):
        forget()
        assert "named with --blocks FILE.py" in failed(*command)
        run(*command, *own)
    assert network.is_file()
    watch = Watch()
    watch.set_training(Run(out), 192)
    assert watch.command()[-1] == str(blocks)


DRIVERS = """
from ai4u_edu import Controller


def ahead(percept):
    return {"move": [1, 0, 0, 0]}


class Ahead(Controller):
    def get_action(self, percept):
        return {"move": [1, 0, 0, 0]}
"""


def test_whoever_can_be_recorded_can_be_watched(tmp_path: Path) -> None:
    file = tmp_path / "mine.py"
    file.write_text(DRIVERS)
    folder = copied_training(tmp_path / "run").run.folder
    network = export(str(folder), tmp_path / "policy.onnx")
    scene = Scene.load("box_chase")
    for who in (
        *(f"{file}:ahead", f"{file}:Ahead", str(folder), str(folder / "best.zip"), str(network)),
        *("random", "zoo", "zoo:box_chase", "scene", "WASDController", f"0={file}:ahead"),
    ):
        sims = [with_drivers(scene, [who], is_served=served)[0] for served in (True, False)]
        for sim in sims:
            sim.reset(1)
            sim.step()
        first, second = (sim.agents[0] for sim in sims)
        assert first.last_action == second.last_action
        assert first.brain.skip_frame == second.brain.skip_frame
    remote, _ = with_drivers(scene, ["ai4u://127.0.0.1:9"], is_served=True)
    assert isinstance(remote.agents[0].brain, RemoteBrain)
    remote.agents[0].brain.close()


@pytest.mark.parametrize("command", ["play", "record", "evaluate"])
def test_an_unknown_driver_is_told_all_forms_by_every_command(command: str) -> None:
    told = failed(command, "box_chase", "--brain", "nobody")
    assert told.startswith("nobody is called 'nobody': expected a training's folder, ")
    for form in (".zip", ".onnx", "zoo:SCENE", "FILE.py:NAME", "ai4u://", "random", "scene"):
        assert form in told


@pytest.mark.parametrize("command", ["record", "evaluate"])
def test_a_script_elsewhere_needs_a_served_world(command: str) -> None:
    address = "ai4u://127.0.0.1:9"
    told = failed(command, "box_chase", "--brain", address)
    assert "a script drives in a served world only" in told


def test_drivers_that_cant_be_given_to_agents(tmp_path: Path) -> None:
    scene = Scene.load("tag")
    first = scene.build().agents[0].id
    with pytest.raises(NameNotFoundError, match="no agent has the id 'nobody'"):
        with_drivers(scene, ["nobody=random"])
    with pytest.raises(SetupError, match="is driven by random already"):
        with_drivers(scene, [f"{first}=random", "random"])
    place = tmp_path / "rate=0.1"
    place.mkdir()
    with pytest.raises(SetupError, match="holds no training"):
        with_drivers(scene, [str(place)])


@pytest.mark.parametrize("address", ["zoo", "zoo:box_chase", "0=zoo"])
def test_playing_with_a_network_of_the_zoo(address: str) -> None:
    sim, _ = with_drivers(Scene.load("box_chase"), [address], is_served=True)
    brain = sim.agents[0].brain
    assert (brain.title(), brain.skip_frame) == ("LocalBrain(NeuralNetController)", 9)


def test_what_is_wrong_on_the_command_line(tmp_path: Path) -> None:
    assert "expected one of sac, ppo, dqn, got 'sacc'" in failed("train", "--algo", "sacc")
    assert "--resume needs --out" in failed("train", "--resume")
    assert "did you mean 'box_chase'" in failed("train", "box_chese")
    assert "in which scene is random to drive?" in failed("evaluate", "--brain", "random")
    assert "who is to drive? Expected: ai4u-edu evaluate maze" in failed("evaluate", "maze")
    assert "holds no training" in failed("export", str(tmp_path / "model.zip"))

"""A newcomer's own blocks and scene, from a file outside the package, are as good as built-in ones.

The files are in tests/newcomer; each class has less than 15 lines.
"""

import ast
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import ai4u_edu
from ai4u_edu import (
    Block,
    Report,
    Scene,
    check_actuator,
    check_controller,
    check_reward,
    check_scene,
    check_sensor,
)
from ai4u_edu.base.errors import SceneError
from ai4u_edu.blocks.loading import load_blocks
from ai4u_edu.check import Outcome
from ai4u_edu.page.panel.parts.agent import RewardRow, agent_part
from ai4u_edu.room import serve_world
from ai4u_edu.runtime.runner import Runner
from tests.page.viewer.pages import page, shown

pytestmark = pytest.mark.slow

HERE = Path(__file__).parent / "newcomer"


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder outside the package with the newcomer's files."""
    for name in ("robot.py", "robot_scene.yaml"):
        shutil.copy(HERE / name, tmp_path)
    monkeypatch.setattr(sys, "path", list(sys.path))
    return tmp_path


@pytest.fixture
def blocks(home: Path) -> dict[str, type[Block]]:
    return {cls.__name__: cls for cls in load_blocks(home / "robot.py")}


@pytest.fixture
def sim(blocks: dict[str, type[Block]], home: Path) -> ai4u_edu.ControlRequestor:
    return Scene.load(home / "robot_scene.yaml").build()


def test_the_files_are_short() -> None:
    tree = ast.parse((HERE / "robot.py").read_text())
    classes = [node for node in tree.body if isinstance(node, ast.ClassDef)]
    assert {base.id for each in classes for base in each.bases if isinstance(base, ast.Name)} == {
        "Sensor", "Actuator", "RewardFunc", "Controller",
    }  # fmt: skip
    for each in classes:
        assert each.end_lineno is not None
        assert each.end_lineno - each.lineno + 1 < 15, each.name


def test_they_are_found(blocks: dict[str, type[Block]]) -> None:
    assert blocks.keys() == {"Smell", "Crab", "Cosy", "Slalom"}


@pytest.mark.parametrize(
    ("name", "fields", "check"),
    [
        ("Smell", {"source": "box"}, check_sensor),
        ("Crab", {}, check_actuator),
        ("Cosy", {"place": "box"}, check_reward),
        ("Slalom", {}, check_controller),
    ],
)
def test_each_passes_its_check(
    blocks: dict[str, type[Block]],
    name: str,
    fields: dict[str, Any],
    check: Callable[[Any], Report],
) -> None:
    report = check(blocks[name](**fields))
    assert report.ok, str(report)
    assert [each for each in report.findings if each.outcome is Outcome.WARNING] == []


def test_the_scene_passes_its_check(sim: object, home: Path) -> None:
    report = check_scene(Scene.load(home / "robot_scene.yaml"))
    assert report.ok, str(report)
    assert [each for each in report.findings if each.outcome is Outcome.WARNING] == []


def test_all_of_it_appears_in_the_viewer(sim: ai4u_edu.ControlRequestor) -> None:
    runner = Runner(sim, seed=1)
    served = serve_world(runner)
    viewer = served.viewer
    try:
        for _ in range(30):
            runner._tick()
        runner._publish()
        with page(viewer):
            shown(viewer)
            part = agent_part(served.context, runner.latest, runner.latest.agents[0], ())
        (agent,) = sim.agents
        smell = float(agent.percept["smell"][0])
        assert 0.6 < smell < 1
        (sensor,) = [sensor for sensor in part.sensors if sensor.key == "smell"]
        assert sensor.values
        assert sensor.values[0].value == pytest.approx(smell, abs=0.01)
        paid = agent.ledger.episode_terms["cosy"]
        assert paid == 6
        assert part.rewards == [RewardRow("cosy", decision=1.0, episode=paid)]
        assert "LocalBrain" in part.brain
        names = list(viewer.server.scene._handle_from_node_name)
        assert len([name for name in names if name.endswith("/body")]) == 2, "mouse and cheese"
        texts = [
            label.handle.text for part in viewer.parts for label in getattr(part.part, "labels", ())
        ]
        assert sorted(texts) == ["cheese", "mouse"]
    finally:
        served.stop()


def run(*args: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "ai4u_edu", *args]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_on_the_command_line_the_file_is_named(home: Path) -> None:
    scene, robot = str(home / "robot_scene.yaml"), str(home / "robot.py")
    told = run("check", scene, "--blocks", robot)
    assert (told.stderr, told.returncode) == ("", 0)
    first, *checks = told.stdout.splitlines()
    assert first == f"{scene}: 2 bodies, 0 floors, 1 agent"
    assert checks[0] == f"cheese: in order ({len(checks[1:])} checks)"
    assert {check.split()[0] for check in checks[1:]} == {"passed"}
    told = run("check", scene)
    first, *others = told.stderr.splitlines()
    assert told.returncode == 1
    assert first.startswith(
        "error: robot_scene.yaml, line 17: agents[0].sensors[0].type: unknown type of sensor "
        "'Smell'; known are 'ActionSensor', "
    )
    for line in (first, *others):
        assert line.endswith(
            "; a block of your own is known once its file is imported, or named with --blocks "
            "FILE.py"
        )
    assert len(others) == 3
    told = run("play", scene, "--blocks", str(home / "robt.py"))
    assert told.stderr == (
        f"error: {home}/robt.py: expected a Python file (.py) with blocks of your own\n"
    )


def test_play_loads_the_file_as_well(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from ai4u_edu.cli import main as cli

    served: list[str] = []
    monkeypatch.setattr(
        "ai4u_edu.page.server.serve", lambda *_args, **_kwargs: served.append("a room")
    )
    scene, robot = str(home / "robot_scene.yaml"), str(home / "robot.py")
    with pytest.raises(SceneError, match="unknown type of sensor 'Smell'"):
        cli.app(["play", scene, "--no-open"], standalone_mode=False)
    cli.app(["play", scene, "--no-open", "--blocks", robot], standalone_mode=False)
    assert served == ["a room"]


def test_a_scene_file_can_not_name_code(home: Path) -> None:
    text = (home / "robot_scene.yaml").read_text()
    with pytest.raises(SceneError, match="line 1: blocks: unknown parameter"):
        Scene.loads(f"blocks: robot.py\n{text}")

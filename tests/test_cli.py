"""The command line, as a process of its own."""

import json
import subprocess
import sys
from pathlib import Path

from ai4u_edu.version import __version__


def run(*args: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "ai4u_edu", *args]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_version() -> None:
    assert run("--version").stdout.strip() == __version__


def test_scenes() -> None:
    told = run("scenes").stdout
    assert "box_chase" in told
    assert "sample_scene" in told
    assert "Reach the box" in told


def test_check_says_fine_or_what_is_wrong(tmp_path: Path) -> None:
    file = tmp_path / "mine.yaml"
    source = Path(__file__).parents[1] / "ai4u_edu/scenes/library/box_chase.yaml"
    file.write_text(source.read_text())
    told = run("check", str(file))
    assert (told.returncode, told.stdout) == (0, f"{file}: fine: 2 bodies, 1 floor, 1 agent\n")
    file.write_text(source.read_text().replace("radius: 0.5", "radius: big"))
    told = run("check", str(file))
    assert (told.returncode, told.stdout, told.stderr) == (
        1,
        "",
        "error: mine.yaml, line 13: bodies[0].shape.radius: expected a number, got 'big'\n",
    )


def test_schema() -> None:
    assert json.loads(run("schema").stdout)["title"] == "SceneDescription"


def test_play_of_an_unknown_scene() -> None:
    told = run("play", "box_chese")
    assert told.returncode == 1
    assert told.stderr == (
        "error: no scene is called 'box_chese'; did you mean 'box_chase'?; a file's name ends in "
        ".yaml\n"
    )

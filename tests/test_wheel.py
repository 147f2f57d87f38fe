"""The wheel, installed alone in an empty environment, as by `pip install`."""

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from ai4u_edu.base.version import __version__

REPO = Path(__file__).resolve().parent.parent
EPISODE = """
from ai4u_edu import Scene
sim = Scene.load("box_chase").build(seed=1)
sim.reset()
for _ in range(50):
    sim.step()
"""

# Building and installing fetch the build tool and every dependency.
pytestmark = [pytest.mark.slow, pytest.mark.timeout(600)]


def run(*command: str | Path, cwd: Path) -> str:
    """Run a command outside the checkout, and return what it printed."""
    done = subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("wheel")
    run(sys.executable, "-m", "build", "--wheel", "--outdir", out, REPO, cwd=out)
    (built,) = out.glob("*.whl")
    return built


@pytest.fixture(scope="module")
def scripts(wheel: Path) -> Path:
    """The folder of programs of an environment that holds the wheel and what it asks for."""
    venv = wheel.parent / "venv"
    run(sys.executable, "-m", "venv", venv, cwd=wheel.parent)
    programs = venv / ("Scripts" if os.name == "nt" else "bin")
    run(programs / "python", "-m", "pip", "install", "--quiet", wheel, cwd=wheel.parent)
    return programs


def test_the_wheel_holds_the_page_and_the_scenes_and_no_tests(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as packed:
        names = packed.namelist()
    assert any(name.startswith("ai4u_edu/web/") for name in names)
    assert "ai4u_edu/scenes/library/box_chase.yaml" in names
    assert "ai4u_edu/lessons/course/01_drive.py" in names
    assert "ai4u_edu/py.typed" in names
    assert "ai4u_edu/world/native/rays.c" in names
    assert {name.partition("/")[0] for name in names} == {
        "ai4u_edu",
        f"ai4u_edu-{__version__}.dist-info",
    }


def test_it_imports_without_a_warning(scripts: Path, tmp_path: Path) -> None:
    run(scripts / "python", "-I", "-W", "error", "-c", "import ai4u_edu", cwd=tmp_path)


def test_the_command_says_its_version(scripts: Path, tmp_path: Path) -> None:
    assert __version__ in run(scripts / "ai4u-edu", "--version", cwd=tmp_path)


def test_the_command_lists_the_scenes(scripts: Path, tmp_path: Path) -> None:
    assert "box_chase" in run(scripts / "ai4u-edu", "scenes", cwd=tmp_path)


def test_an_episode_runs_without_a_browser(scripts: Path, tmp_path: Path) -> None:
    run(scripts / "python", "-I", "-c", EPISODE, cwd=tmp_path)

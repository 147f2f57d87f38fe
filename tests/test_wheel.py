"""The wheel, installed outside of the checkout; nightly with its dependencies, as a user would."""

import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from ai4u_edu.base.version import __version__
from ai4u_edu.page.server.web_files import FOLDERS
from ai4u_edu.world.native.compiled import library_name
from tests.playing import played
from tests.without import ACT, OPTIONS, STEPS

REPO = Path(__file__).resolve().parent.parent
EPISODE = """
from ai4u_edu import Scene
sim = Scene.load("box_chase").build(seed=1)
sim.reset()
for _ in range(50):
    sim.step()
"""
MAPS = """
from ai4u_edu import explain
print(explain.field("zoo:box_chase", "box_chase", columns=3).actions.shape)
print(explain.value_map("zoo:box_chase", "box_chase", columns=2).values.shape)
"""

CHECKSUM = """
import hashlib
from ai4u_edu import Scene
from ai4u_edu.world.native.segments import compiled_cast
found = hashlib.sha256()
sim = Scene.load("yardstick").build(seed=1)
sim.reset(seed=1)
for _ in range(200):
    found.update(sim.step().data)
print(compiled_cast() is not None, found.hexdigest())
"""

# Installing as a user does fetches every dependency.
pytestmark = pytest.mark.slow


def run(*command: str | Path, cwd: Path) -> str:
    """Run a command outside the checkout, and return what it printed."""
    done = subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def build(out: Path, compiled: str = "") -> Path:
    """Build the wheel; "0" for `compiled` leaves the compiled part out."""
    command: list[str | Path] = [
        sys.executable,
        "-m",
        "build",
        "--wheel",
        "--no-isolation",
        "--outdir",
        out,
        REPO,
    ]
    environment = {**os.environ, "AI4U_COMPILED": compiled}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    (built,) = out.glob("*.whl")
    return built


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build(tmp_path_factory.mktemp("wheel"))


@pytest.fixture(scope="module")
def pure_wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build(tmp_path_factory.mktemp("pure"), compiled="0")


@pytest.fixture(
    scope="module",
    params=["alone", pytest.param("with dependencies", marks=pytest.mark.nightly)],
)
def installed(wheel: Path, request: pytest.FixtureRequest) -> list[str | Path]:
    """Install the wheel, and return the Python that has it.

    Alone it takes a second, and its dependencies are those of this environment.
    """
    folder = wheel.parent / "installed"
    pip = ["-m", "pip", "install", "--quiet", "--no-compile"]
    if request.param == "alone":
        run(sys.executable, *pip, "--no-deps", "--target", folder, wheel, cwd=wheel.parent)
        first = f"import sys; sys.path.insert(0, {str(folder)!r}); "
        return [sys.executable, "-I", "-W", "error", "-c", first]
    run(sys.executable, "-m", "venv", folder, cwd=wheel.parent)
    python = folder / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    run(python, *pip, wheel, cwd=wheel.parent)
    return [python, "-I", "-W", "error", "-c", ""]


def test_the_wheel_holds_the_page_and_the_scenes_and_no_tests(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as packed:
        names = packed.namelist()
    web = {
        f"ai4u_edu/{path.relative_to(REPO).as_posix()}"
        for folder in (*FOLDERS, "vendor")
        for path in (REPO / "web" / folder).rglob("*")
        if path.is_file()
    }
    assert {name for name in names if name.startswith("ai4u_edu/web/")} == web
    assert "ai4u_edu/web/vendor/pyodide/pyodide.asm.wasm.gz" in web
    assert "ai4u_edu/classroom/results.html" in names
    assert "ai4u_edu/scenes/library/box_chase.yaml" in names
    assert "ai4u_edu/lessons/course/02_drive.py" in names
    assert "ai4u_edu/py.typed" in names
    assert "ai4u_edu/world/native/rays.c" in names
    assert {name.partition("/")[0] for name in names} == {
        "ai4u_edu",
        f"ai4u_edu-{__version__}.dist-info",
    }


def libraries(wheel: Path) -> list[str]:
    with zipfile.ZipFile(wheel) as packed:
        return [name for name in packed.namelist() if name.endswith((".so", ".dll"))]


def test_the_compiled_part_makes_it_a_wheel_of_a_platform(wheel: Path, pure_wheel: Path) -> None:
    assert pure_wheel.name == f"ai4u_edu-{__version__}-py3-none-any.whl"
    assert libraries(pure_wheel) == []
    if shutil.which("cc") is None:
        pytest.skip("no C compiler here")
    assert f"-{__version__}-py3-none-" in wheel.name
    assert not wheel.name.endswith("-any.whl")
    assert libraries(wheel) == [f"ai4u_edu/world/native/{library_name(os.name)}"]


def test_both_wheels_give_the_same_bits(wheel: Path, pure_wheel: Path, tmp_path: Path) -> None:
    """Without a compiler in reach, and with nothing written anywhere."""
    found = []
    for name, each in (("compiled", wheel), ("pure", pure_wheel)):  # the same without a compiler
        folder, home = tmp_path / name, tmp_path / f"home of {name}"
        home.mkdir()
        with zipfile.ZipFile(each) as packed:
            packed.extractall(folder)
        program = f"import sys; sys.path.insert(0, {str(folder)!r})\n{CHECKSUM}"
        done = subprocess.run(
            [sys.executable, "-I", "-B", "-c", program],
            env={
                "HOME": str(home),
                "PATH": str(home),
                "SYSTEMREPO": os.environ.get("SYSTEMREPO", ""),
            },
            capture_output=True,
            text=True,
            check=True,
        )
        found.append(done.stdout.split())
        assert list(home.iterdir()) == []
    (is_compiled, bits), (is_pure_compiled, pure_bits) = found
    assert is_compiled == str(bool(libraries(wheel)))
    assert is_pure_compiled == "False"
    assert bits == pure_bits


def ran(installed: list[str | Path], code: str, folder: Path) -> str:
    """Run code in a Python that has the wheel, and return what it printed."""
    return run(*installed[:-1], f"{installed[-1]}{code}", cwd=folder)


def command(*words: str) -> str:
    """Return code that runs ``ai4u-edu`` with these words."""
    declared = "entry_points(group='console_scripts', name='ai4u-edu')['ai4u-edu']"
    return (
        f"import sys; from importlib.metadata import entry_points; sys.argv[1:] = {list(words)!r}; "
        f"sys.exit({declared}.load()())"
    )


def test_it_imports_without_a_warning(installed: list[str | Path], tmp_path: Path) -> None:
    where = ran(installed, "import ai4u_edu; print(ai4u_edu.__file__)", tmp_path)
    assert not Path(where.strip()).is_relative_to(REPO)


def test_the_command_says_its_version(installed: list[str | Path], tmp_path: Path) -> None:
    assert __version__ in ran(installed, command("--version"), tmp_path)


def test_the_command_lists_the_scenes(installed: list[str | Path], tmp_path: Path) -> None:
    assert "box_chase" in ran(installed, command("scenes"), tmp_path)


def test_an_episode_runs_without_a_browser(installed: list[str | Path], tmp_path: Path) -> None:
    ran(installed, EPISODE, tmp_path)


def test_a_network_drives_and_is_explained(installed: list[str | Path], tmp_path: Path) -> None:
    words = ("evaluate", "box_chase", "--brain", "zoo", "--episodes", "2")
    assert "zoo:box_chase     100%" in ran(installed, command(*words), tmp_path)
    assert ran(installed, MAPS, tmp_path) == "(9, 4)\n(4,)\n"


def test_an_agent_learns_with_numpy_alone(installed: list[str | Path], tmp_path: Path) -> None:
    words = ("train", "box_chase", "--trainer", "small", "--steps", "512", "--out", "run")
    assert "kept run/best.onnx" in ran(installed, command(*words), tmp_path).replace(os.sep, "/")


@pytest.mark.nightly
@pytest.mark.parametrize("option", OPTIONS)
def test_it_works_without_the_folders_of_an_option(
    pure_wheel: Path, tmp_path: Path, option: str
) -> None:
    with zipfile.ZipFile(pure_wheel) as packed:
        packed.extractall(tmp_path)
    for name in OPTIONS[option]:
        shutil.rmtree(tmp_path / name.replace(".", "/"))
    first = f"import sys; sys.path.insert(0, {str(tmp_path)!r})\n"
    main = f"{first}from ai4u_edu.cli.main import main; main()"
    with played("box_chase", program=["-I", "-c", main]) as world:
        steps = "" if option == "learn" else STEPS
        code = first + steps + ACT.format(url=world.url)
        assert run(sys.executable, "-I", "-c", code, cwd=tmp_path) == "True\n"
        assert world.health()["scene"] == "Box chase"

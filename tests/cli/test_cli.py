"""The command line, as a process of its own."""

import inspect
import json
import math
import os
import subprocess
import sys
from pathlib import Path
from typing import Any, get_args, get_type_hints

import pytest
import typer
from PIL import Image
from typer.testing import CliRunner

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.base.seeding import MAX_SEED, MAX_TRAINING_SEED
from ai4u_edu.base.version import __version__
from ai4u_edu.cli.main import app
from ai4u_edu.cli.options import finite
from ai4u_edu.page.editing.sharing import shared_link
from ai4u_edu.scenes import Scene
from tests.playing import played

pytestmark = pytest.mark.slow

COMMANDS = {
    each.name or each.callback.__name__: each.callback
    for each in app.registered_commands
    if each.callback
}
NO_SCENE = {"bridge", "blocks", "bundle", "doctor", "schema", "lessons"}
"""Commands that read neither a scene nor a recording that somebody else may have written."""


def parameters(command: str) -> dict[str, tuple[Any, Any, inspect.Parameter]]:
    """The type, what Typer was told, and the parameter, by the option's name."""
    function = COMMANDS[command]
    hints = get_type_hints(function, include_extras=True)
    found = {}
    for name, parameter in inspect.signature(function).parameters.items():
        if hints[name] is typer.Context:
            continue
        kind, told = get_args(hints[name])
        # in an annotation Typer takes the first name for a default
        words = [
            each for each in (told.default, *(told.param_decls or ())) if isinstance(each, str)
        ]
        named = [each for each in words if each.startswith("--")]
        found[named[0] if named else f"--{name.replace('_', '-')}"] = kind, told, parameter
    return found


NUMBERS = [
    (command, option)
    for command in COMMANDS
    for option, (kind, _, _) in parameters(command).items()
    if {int, float} & {kind, *get_args(kind)}
]


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


def test_scenes_tells_all_that_a_scene_says_of_itself_in_80_columns() -> None:
    told = CliRunner(env={"COLUMNS": "80"}).invoke(app, ["scenes"]).output
    assert max(map(len, told.splitlines())) <= 80
    shown = "".join(told.split())
    for name in Scene.names():
        described = Scene.load(name).description
        for text in (name, described.goal, described.controls, described.rewards):
            assert "".join(text.split()) in shown
    one = CliRunner().invoke(app, ["scenes", "box_chase"]).output
    assert one.splitlines()[0] == "box_chase (Box chase)"
    assert "+100 for touching the box" in one
    assert "donut" not in one
    unknown = CliRunner().invoke(app, ["scenes", "box_chese"])
    assert "did you mean 'box_chase'?" in str(unknown.exception)


def test_scenes_are_drawn_into_a_folder(tmp_path: Path) -> None:
    mine = tmp_path / "mine.yaml"
    mine.write_text(Scene.load("maze").source.replace("name: maze", 'name: "my: maze"'))
    out = tmp_path / "pictures"
    for scene, name in (("maze", "maze.png"), (str(mine), "my__maze.png")):
        told = CliRunner().invoke(app, ["scenes", scene, "--pictures", str(out)]).output
        assert told.startswith(f"{out / name}: ")
        with Image.open(out / name) as picture:
            assert (picture.format, max(picture.size)) == ("PNG", 400)
    assert len([*out.iterdir()]) == 2


def test_check_reports_or_says_what_is_wrong(tmp_path: Path) -> None:
    file = tmp_path / "mine.yaml"
    source = Path(__file__).parents[2] / "ai4u_edu/scenes/library/box_chase.yaml"
    file.write_text(source.read_text())
    told = run("check", str(file))
    assert told.returncode == 0
    assert told.stdout.startswith(
        f"{file}: 2 bodies, 1 floor, 1 agent\nbox_chase: in order (14 checks)\n  passed "
    )
    before, _, after = source.read_text().partition("radius: 0.5")
    file.write_text(before + "radius: big" + after)
    line = 1 + before.count("\n")
    told = run("check", str(file))
    assert (told.returncode, told.stdout, told.stderr) == (
        1,
        "",
        f"error: mine.yaml, line {line}: bodies[0].shape.radius: expected a number, got 'big'\n",
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


def test_what_takes_a_scene_or_a_recording_takes_blocks_of_ones_own() -> None:
    assert set(COMMANDS) > NO_SCENE
    for command in set(COMMANDS) - NO_SCENE:
        assert "--blocks" in parameters(command), command


@pytest.mark.parametrize(("command", "option"), NUMBERS)
def test_every_number_has_bounds(command: str, option: str) -> None:
    _, told, parameter = parameters(command)[option]
    low, high, default = told.min, told.max, parameter.default
    assert low is not None
    assert high is not None
    assert 0 <= low < high <= MAX_SEED
    assert default is None or low <= default <= high
    if option.endswith("seed"):  # --seeds is a count
        assert (low, high) == (0, MAX_TRAINING_SEED if command == "train" else MAX_SEED)
    needed = [
        "x"
        for _, info, each in parameters(command).values()
        if isinstance(info, typer.models.ArgumentInfo) and each.default is each.empty
    ]
    for text in ("nan", "inf", "-inf", str(low - 1), str(high + 1), "9" * 5000, "x", ""):
        refused = CliRunner().invoke(app, [command, *needed, option, text])
        assert refused.exit_code == 2, (text, refused.output)
        assert "Invalid value for" in refused.output


def test_nan_is_refused_by_whoever_reads_numbers() -> None:
    for number in (math.nan, math.inf, -math.inf):
        with pytest.raises(typer.BadParameter, match="expected a finite number"):
            finite(number)


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["export", "nosuch"], "nosuch holds no training: there is no such folder or model"),
        (["export", "nosuch/best.zip"], "nosuch/best.zip holds no training"),
        (["evaluate", "--brain", "nosuch.zip"], "nosuch.zip holds no training"),
        (
            ["evaluate", "--brain", "nosuch"],
            "nobody is called 'nosuch': expected a training's folder",
        ),
        (["train", "--resume", "--out", "nosuch"], "nosuch holds no training"),
        (["clone", "nosuch"], "nosuch: expected a recorded episode (.episode), or a folder"),
        (["dataset", "nosuch", "--out", "x.npz"], "nosuch: expected a recorded episode"),
        (["replay", "nosuch"], "nosuch: can't be read: No such file or directory"),
        (["play", "--ghost", "nosuch"], "nosuch: can't be read: No such file or directory"),
        (["check", "nosuch.yaml"], "nosuch.yaml: can't be read: No such file or directory"),
        (["record", "box_chase", "--seed", str(MAX_SEED), "--episodes", "2"], "room for 2 seeds"),
        (
            ["evaluate", "box_chase", "--brain", "random", "--seed", str(MAX_SEED)],
            "seed: expected room for 100 seeds",
        ),
    ],
    ids=lambda each: each[0] if isinstance(each, list) else "",
)
def test_what_is_not_there_is_named(
    arguments: list[str], text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    told = CliRunner().invoke(app, arguments)
    assert isinstance(told.exception, AI4UError), told.output
    assert text in str(told.exception)


def test_a_file_that_cant_be_written_is_told_in_a_sentence(tmp_path: Path) -> None:
    place = tmp_path / "nosuch" / "out.json"
    told = run(
        "evaluate", "box_chase", "--brain", "random", "--episodes", "1", "--json", str(place)
    )
    assert (told.returncode, told.stderr) == (1, f"error: {place}: No such file or directory\n")


def test_play_serves_a_shared_scene_with_its_seed() -> None:
    link = shared_link(Scene.load("maze"), 2**62).fragment
    with played(f"http://elsewhere:8080/#{link}") as server:
        assert server.health()["scene"] == "Maze"
        assert server.snapshot()["seed"] == 2**62


def test_play_says_what_is_wrong_with_a_link() -> None:
    link = shared_link(Scene.load("maze"), 7).fragment
    told = run("play", f"#{link[:90]}", "--no-open")
    assert told.returncode != 0
    assert "the link is damaged" in told.stderr
    assert "Traceback" not in told.stderr


def test_what_the_console_lacks_is_printed_as_a_question_mark(tmp_path: Path) -> None:
    """A console of Windows in a pipe has 256 characters."""
    done = subprocess.run(
        [sys.executable, "-m", "ai4u_edu", "check", "maçã 한.yaml"],
        env={**os.environ, "PYTHONIOENCODING": "cp1252"},
        capture_output=True,
        check=False,
        cwd=tmp_path,
    )
    assert "maçã ?.yaml".encode("cp1252") in done.stderr

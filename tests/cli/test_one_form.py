"""All commands take a scene, and its drivers as options; other forms get a hint."""

import json

import pytest
from typer.testing import CliRunner, Result

from ai4u_edu.base.errors import SetupError
from ai4u_edu.cli.main import app

pytestmark = pytest.mark.slow

HINT = "hint: as in play, the scene comes first: ai4u-edu evaluate box_chase --brain zoo"


def run(*args: str) -> Result:
    return CliRunner().invoke(app, [*args])


def evaluated(*args: str) -> tuple[list[str], str]:
    """Return who was evaluated, and what was said besides."""
    done = run("evaluate", *args, "--episodes", "1", "--json", "-")
    assert done.exception is None, done.output
    said = json.loads(done.stdout)
    return [each["name"] for each in said], done.stderr


def test_a_scene_and_its_drivers_are_evaluated() -> None:
    assert evaluated("box_chase", "--brain", "zoo") == (["zoo:box_chase"], "")
    both = ("--brain", "zoo", "--brain", "random")
    assert evaluated("box_chase", *both) == (["zoo:box_chase", "random"], "")


@pytest.mark.parametrize(
    "words",
    [
        ["zoo:box_chase", "box_chase"],
        ["box_chase", "zoo"],
        ["zoo", "--scene", "box_chase"],
        ["zoo", "--scene", "box_chase", "--compare", "random"],
    ],
)
def test_the_other_forms_work_with_a_hint(words: list[str]) -> None:
    drivers, said = evaluated(*words)
    assert drivers[0] == "zoo:box_chase"
    assert said.startswith(HINT)
    assert ("--brain random" in said) is ("random" in words)


def test_without_a_driver_it_says_what_to_add() -> None:
    for words, right in ((["box_chase"], "box_chase"), ([], "SCENE")):
        failed = run("evaluate", *words).exception
        assert isinstance(failed, SetupError)
        assert str(failed) == (
            f"who is to drive? Expected: ai4u-edu evaluate {right} --brain DRIVER"
        )


@pytest.mark.parametrize("command", ["play", "record"])
@pytest.mark.parametrize(
    ("words", "right"),
    [
        (["zoo:maze", "maze"], "maze --brain zoo:maze"),
        (["maze", "zoo"], "maze --brain zoo"),
        (["mine.py:drive"], "SCENE --brain mine.py:drive"),
        (["maze", "tag"], "maze --brain DRIVER"),
    ],
)
def test_a_driver_in_the_place_of_a_scene_is_refused_with_the_right_form(
    command: str, words: list[str], right: str
) -> None:
    done = run(command, *words)
    assert done.exit_code == 2
    said = " ".join(done.stderr.replace("│", " ").split())
    assert f"expected one scene, got {' '.join(words)}; the driver is an option" in said
    assert f"ai4u-edu {command} {right}" in said

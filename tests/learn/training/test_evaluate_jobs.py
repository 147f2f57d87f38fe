"""Evaluation on several cores: the same table as on one."""

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
from typer.testing import CliRunner

from ai4u_edu import Scene
from ai4u_edu.base.errors import AI4UError
from ai4u_edu.cli.main import app
from ai4u_edu.games.jobs import Engine, engine
from ai4u_edu.learn.training.evaluate_jobs import evaluate_on
from ai4u_edu.learn.training.evaluating import evaluate
from ai4u_edu.learn.training.policies import entrant
from ai4u_edu.scenes.scene_data import scene_data

COMMAND = ["evaluate", "box_chase", "--brain", "random", "--brain", "scene", "--episodes", "6"]

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def processes() -> Iterator[Engine]:
    with engine("processes", width=2) as made:
        yield made


@pytest.mark.parametrize("who", ["random", "zoo"])
def test_it_is_equal_to_that_in_one_process(who: str, processes: Engine) -> None:
    seeds = range(40, 57)
    counts: list[int] = []
    drives = [(who, scene_data("box_chase"))]
    (told,) = evaluate_on(processes, drives, seeds, tell=counts.append)
    scene = Scene.load("box_chase")
    assert told == evaluate(entrant(who, "box_chase"), scene, seeds)
    assert sum(counts) == 17
    assert len(counts) > 2


def test_a_driver_that_can_t_drive_is_told_with_its_seeds(processes: Engine) -> None:
    with pytest.raises(AI4UError, match="Nobody, seeds 0 to 0: nobody is called 'Nobody'"):
        evaluate_on(processes, [("Nobody", scene_data("box_chase"))], range(1))


def test_the_command_gives_the_same_on_each_engine(tmp_path: Path) -> None:
    tables = []
    for name in ("inline", "processes"):
        file = tmp_path / f"{name}.json"
        done = CliRunner().invoke(
            app,
            [*COMMAND, "--json", str(file), "--engine", name],
        )
        assert done.exit_code == 0, done.output
        tables.append(json.loads(file.read_text()))
    assert tables[0] == tables[1]


def test_an_engine_that_is_not_there_is_told() -> None:
    done = CliRunner().invoke(app, ["evaluate", "box_chase", "--brain", "random", "--engine", "x"])
    assert done.exit_code != 0
    assert "expected an engine of inline, processes, ray, got 'x'" in str(
        done.exception or done.output
    )

"""Folders of sweeps and tournaments that somebody else wrote: data, of which nothing is run."""

import base64
import json
import os
import pickle
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.cli.main import app
from tests.learn.training.small import small_settings

pytestmark = [pytest.mark.needs("train", "sweep", "tournament"), pytest.mark.slow]


class Touch:
    """Makes a file where somebody unpickles it."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def __reduce__(self) -> tuple[Any, ...]:
        return (os.mkdir, (str(self.path),))


def run(*arguments: str) -> str:
    done = CliRunner().invoke(app, list(arguments))
    if done.exception is not None and not isinstance(done.exception, SystemExit):
        raise done.exception
    return done.output


@pytest.fixture(scope="module")
def swept(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a sweep by Optuna."""
    folder = tmp_path_factory.mktemp("sweep")
    settings = folder / "small.yaml"
    settings.write_text(json.dumps(small_settings().model_dump(mode="json")))
    run(
        *("sweep", "yardstick", "--settings", str(settings), "--steps", "64", "--algo", "ppo"),
        *("--set", "learning_rate=0.001..0.01", "--trials", "2", "--engine", "inline"),
        *("--out", str(folder / "out")),
    )
    return folder / "out"


@pytest.fixture(scope="module")
def played(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a tournament."""
    folder = tmp_path_factory.mktemp("played") / "out"
    run(*("tournament", "sumo", "Ann=scene", "Bob=random", "--seeds", "1", "--engine", "inline"),
        *("--out", str(folder)))  # fmt: skip
    return folder


def resume(kind: str, folder: Path) -> str:
    return run(kind, "--resume", "--out", str(folder), "--engine", "inline")


def pickled(path: Path) -> str:
    return base64.b64encode(pickle.dumps(Touch(path))).decode()


WRONG: list[tuple[str, Callable[[dict[str, Any], Path], object]]] = [
    ("no object", lambda line, _: line.clear()),
    ("another result", lambda line, _: line.update(result=[1, 2])),
    ("no result", lambda line, _: line.update(result=None)),
    ("text for a number", lambda line, _: line.update(tries="many")),
    ("NaN", lambda line, _: line.update(seconds=float("nan"))),
    ("one key more", lambda line, _: line.update(more=1)),
    ("pickle", lambda line, path: line.update(result=pickled(path))),
    ("NaN in the result", lambda line, _: _spoil(line["result"])),
    ("pickle for a file", lambda line, path: _put(line["result"], pickled(path)[:-3])),
]


def _spoil(result: dict[str, Any]) -> None:
    if "checks" in result:
        result["checks"][0]["reward"] = float("nan")
    else:
        result["points"][0] = float("nan")


def _put(result: dict[str, Any], data: str) -> None:
    result["network" if "network" in result else "episode"] = data


@pytest.mark.parametrize("kind", ["sweep", "tournament"])
@pytest.mark.parametrize("change", [each for _, each in WRONG], ids=[name for name, _ in WRONG])
def test_a_forged_journal_is_told_and_nothing_of_it_is_run(
    kind: str,
    change: Callable[[dict[str, Any], Path], object],
    request: pytest.FixtureRequest,
    tmp_path: Path,
) -> None:
    source = request.getfixturevalue({"sweep": "swept", "tournament": "played"}[kind])
    folder, made = tmp_path / "out", tmp_path / "made"
    shutil.copytree(source, folder)
    journal = folder / "journal.jsonl"
    lines = [json.loads(each) for each in journal.read_text().splitlines()]
    change(lines[0], made)
    journal.write_text("".join(f"{json.dumps(each)}\n" for each in lines))
    with pytest.raises(AI4UError, match="expected"):
        resume(kind, folder)
    assert not made.exists()


def test_the_study_of_optuna_is_written_again_and_not_read(swept: Path, tmp_path: Path) -> None:
    folder, made = tmp_path / "out", tmp_path / "made"
    shutil.copytree(swept, folder)
    log = folder / "optuna.log"
    whole = log.read_text()
    log.write_bytes(pickle.dumps(Touch(made)) + b'\n{"op_code": 0, "study_name": "other"}\n')
    journal = (folder / "journal.jsonl").read_bytes()
    resume("sweep", folder)
    assert (folder / "journal.jsonl").read_bytes() == journal, "nothing is run again"
    assert not made.exists()
    assert len(log.read_text().splitlines()) == len(whole.splitlines())


def test_a_plan_that_runs_python_files_wants_them_named(played: Path, tmp_path: Path) -> None:
    folder, made = tmp_path / "out", tmp_path / "made"
    shutil.copytree(played, folder)
    evil = tmp_path / "evil.py"
    evil.write_text(f"import os\nos.mkdir({str(made)!r})\n")
    path = folder / "tournament.json"
    plan = json.loads(path.read_text())
    plan["scene"]["blocks"] = [str(evil)]
    path.write_text(json.dumps(plan))
    for words in (["--resume", "--out", str(folder)], ["verify", str(folder)]):
        with pytest.raises(AI4UError, match="read it, then say --blocks"):
            run("tournament", *words, "--engine", "inline")
    plan["scene"].pop("blocks")
    source = base64.b64encode(evil.read_bytes()).decode()
    driver = {"kind": "python", "file": "evil.py", "name": "", "data": source}
    plan["entries"][0]["drivers"] = {"": driver}
    path.write_text(json.dumps(plan))
    with pytest.raises(AI4UError, match="say --trust-python"):
        resume("tournament", folder)
    with pytest.raises(AI4UError):
        run("tournament", "verify", str(folder), "--engine", "inline")
    assert not made.exists()

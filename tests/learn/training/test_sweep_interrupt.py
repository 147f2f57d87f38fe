"""A sweep that is interrupted, and one whose trials run in other processes."""

import csv
import json
import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest

from tests.learn.training.small import small_settings

pytestmark = [pytest.mark.slow, pytest.mark.nightly]

SAME = ("trial", "algorithm", "learning_rate", "seed", "state", "success", "reward", "curve")


INTERRUPTED = """
import os, signal
from itertools import count
from ai4u_edu.cli.main import main
from ai4u_edu.games.jobs import Journal

add, numbers = Journal.add, count(1)

def interrupted(journal, outcome):
    add(journal, outcome)
    if next(numbers) == 2:
        os.killpg(0, signal.SIGINT)

if __name__ == "__main__":
    Journal.add = interrupted
    main()
"""
"""The command, whose terminal gets Ctrl-C as soon as the second trial is in the journal."""


def begun(
    folder: Path, *arguments: str, program: Sequence[str] = ("-m", "ai4u_edu")
) -> subprocess.Popen[str]:
    settings = folder / "small.yaml"
    settings.write_text(json.dumps(small_settings().model_dump(mode="json")))
    command = [sys.executable, *program, "sweep", *arguments]
    if "--resume" not in arguments:
        command += ["yardstick", "--settings", str(settings), "--steps", "64", "--algo", "ppo"]
        command += ["--set", "learning_rate=0.001,0.003", "--seeds", "0-2"]
    env = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    return subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env=env,
        start_new_session=True,
    )


def table(folder: Path) -> list[dict[str, str]]:
    rows = csv.DictReader((folder / "trials.csv").read_text().splitlines())
    return [{name: row[name] for name in SAME} for row in rows]


@pytest.mark.skipif(sys.platform == "win32", reason="Ctrl-C is sent in another way there")
def test_ctrl_c_keeps_what_is_finished_and_the_table_is_that_of_a_whole_run(tmp_path: Path) -> None:
    whole, part = tmp_path / "whole", tmp_path / "part"
    with begun(tmp_path, "--out", str(whole), "--engine", "inline") as process:
        told, _ = process.communicate()
    assert process.returncode == 0, told
    program, journal = tmp_path / "interrupted.py", part / "journal.jsonl"
    program.write_text(INTERRUPTED)
    words = ("--out", str(part), "--engine", "processes")
    with begun(tmp_path, *words, program=[str(program)]) as process:
        told, _ = process.communicate()
    assert process.returncode == 130, told
    assert "Traceback" not in told
    assert "leaked" not in told
    kept = journal.read_bytes()
    assert "not run yet" in (part / "index.html").read_text()
    assert len(table(part)) == 1
    with begun(tmp_path, "--resume", "--out", str(part)) as process:
        told, _ = process.communicate()
    assert process.returncode == 0, told
    assert journal.read_bytes().startswith(kept)
    assert len(table(whole)) == 6
    assert table(part) == table(whole)

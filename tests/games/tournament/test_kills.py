"""Tournaments that are killed again and again, and go on each time."""

import os
import random
import subprocess
import sys
import time
from pathlib import Path

import pytest

from ai4u_edu.games.jobs import engine
from ai4u_edu.games.tournament.entry import Entry
from ai4u_edu.games.tournament.plan import TournamentPlan
from ai4u_edu.games.tournament.verify import verify
from ai4u_edu.scenes.scene_data import scene_data
from tests.waiting import until

pytestmark = [
    pytest.mark.needs("train", "tournament"),
    pytest.mark.slow,
    pytest.mark.skipif(os.name != "posix", reason="a process is killed in another way there"),
]


def begun(folder: Path) -> "subprocess.Popen[str]":
    command = [sys.executable, "-m", "ai4u_edu", "tournament", "--resume", "--out", str(folder)]
    env = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    pipe = subprocess.PIPE
    return subprocess.Popen(command, stdout=pipe, stderr=pipe, env=env, text=True)


def plan(seeds: int) -> TournamentPlan:
    entries = [Entry(name=name, drivers={"": {"kind": "random"}}) for name in ("ann", "bob")]
    entries.append(Entry(name="eve", drivers={"": {"kind": "scene"}}))
    return TournamentPlan(
        scene=scene_data("sumo"),
        entries=tuple(entries),
        seeds=tuple(range(seeds)),
        system="round-robin",
        rounds=0,
    )


@pytest.mark.parametrize(
    "kills",
    [3, pytest.param(100, marks=[pytest.mark.nightly, pytest.mark.timeout(7200)])],
)
def test_a_tournament_goes_on_after_each_kill_and_is_whole(tmp_path: Path, kills: int) -> None:
    """Each time some games more are in the journal, or none, if it is killed at once."""
    plan(seeds=max(2, kills // 5)).save(tmp_path)
    journal, moments = tmp_path / "journal.jsonl", random.Random(kills)
    for number in range(kills):
        with begun(tmp_path) as process:
            if number % 2 and kills > 3:
                # real time: any moment is right, also one before it has begun
                time.sleep(moments.uniform(0, 4))
            else:
                _wait_for_a_game(journal, process)
            process.kill()
            _, told = process.communicate()  # its jobs have ended, as they hold the pipe
        # killed while it starts a process, Python has a traceback, with no line of ours
        assert "ai4u_edu" not in told, told
    with begun(tmp_path) as process:
        _, told = process.communicate()
    assert process.returncode == 0, told
    count = 6 * max(2, kills // 5)
    assert verify(tmp_path, engine("inline")) == (count, [])


def _wait_for_a_game(journal: Path, process: "subprocess.Popen[str]") -> None:
    """Wait until another game is in the journal, or all of them are."""

    def size() -> int:
        return journal.stat().st_size if journal.exists() else 0

    before = size()
    until(lambda: size() > before or process.poll() is not None)

"""A tournament while it is played: each contest is shown as soon as it has ended."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from ai4u_edu.games.jobs import engine
from ai4u_edu.games.tournament.entry import Entry
from ai4u_edu.games.tournament.live_process import live_view
from ai4u_edu.games.tournament.plan import TournamentPlan
from ai4u_edu.games.tournament.run import run_tournament
from ai4u_edu.games.tournament.tournament import Tournament

NAMES = ("ann", "bob", "eve")


def plan(system: Any = "round-robin", seeds: int = 1) -> TournamentPlan:
    entries = [Entry(name=name, drivers={"": {"kind": "random"}}) for name in NAMES[:2]]
    entries.append(Entry(name=NAMES[2], drivers={"": {"kind": "scene"}}))
    return TournamentPlan(
        scene={"name": "sumo"},
        entries=tuple(entries),
        seeds=tuple(range(seeds)),
        system=system,
        rounds=2,
    )


def output_of(folder: Path) -> str:
    """Play the plan in a folder in a process of its own, and return what it tells."""
    command = [sys.executable, "-m", "ai4u_edu.games.tournament.live_process", str(folder)]
    pipe = subprocess.PIPE
    with subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=pipe, text=True) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        told = process.stdout.read()  # its input stays open, as it ends with that
        assert process.stderr.read() == ""
    assert process.returncode == 0
    return told


def last_line(output: str) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(output.splitlines()[-1])
    return found


@pytest.mark.slow
def test_each_contest_is_shown_and_the_process_goes_on_where_it_was(tmp_path: Path) -> None:
    views: list[dict[str, Any]] = []

    def show(done: Tournament) -> None:
        views.append(json.loads(json.dumps(live_view(done))))

    done = run_tournament(plan(), tmp_path, engine("inline"), show=show)
    assert [each["games"] for each in views] == [0, 2, 4, 6]
    assert {each["total"] for each in views} == {6}
    assert views[0]["standings"][0]["against"] == {}
    first = views[1]
    (contest,) = first["latest"]
    assert {each["name"] for each in contest["entries"]} == {"ann", "bob"}
    assert [each["number"] for each in contest["games"]] == [1, 2]
    files = sorted(path.name for path in (tmp_path / "games").iterdir())
    assert files == [each["file"] for each in done.games]
    assert files[0].startswith("0001-ann-vs-bob-seed-0")
    assert [each["names"] for each in views[-1]["latest"][0]["games"]] == [
        ["bob", "eve"],
        ["eve", "bob"],
    ]

    plan().save(tmp_path)
    journal = (tmp_path / "journal.jsonl").read_bytes()
    end = last_line(output_of(tmp_path))
    assert (end["is_over"], end["view"]) == (True, views[-1] | {"latest": end["view"]["latest"]})
    assert (tmp_path / "journal.jsonl").read_bytes() == journal, "nothing is played again"
    assert (tmp_path / "index.html").exists()


@pytest.mark.slow
@pytest.mark.nightly
def test_a_process_without_a_plan_tells_the_problem(tmp_path: Path) -> None:
    assert "holds no tournament" in last_line(output_of(tmp_path))["problem"]

"""A sweep and a tournament on a Ray cluster of three machines, here on one, of which one dies."""

import csv
import json
from collections.abc import Iterator
from pathlib import Path
from threading import Thread
from typing import Any

import psutil
import pytest

from ai4u_edu import Scene
from ai4u_edu.games.jobs import Engine, engine
from ai4u_edu.games.tournament.entry import Entry, parse_entry
from ai4u_edu.games.tournament.plan import TournamentPlan
from ai4u_edu.games.tournament.run import run_tournament, write_results
from ai4u_edu.games.tournament.sides import sides_of
from ai4u_edu.games.tournament.tournament import Tournament
from ai4u_edu.learn.training.sweep.plan import SweepPlan
from ai4u_edu.learn.training.sweep.result import csv_text
from ai4u_edu.learn.training.sweep.run import Sweep, run_sweep
from ai4u_edu.learn.training.sweep.search_space import Parameter
from ai4u_edu.scenes.scene_data import scene_data
from tests.games.jobs.ray_cluster import RayCluster, ray_cluster
from tests.learn.training.small import small_settings
from tests.processes import command_line

pytestmark = [pytest.mark.slow, pytest.mark.nightly]


class Killer:
    """Kills a machine of a cluster when some jobs have ended, and it runs another one."""

    def __init__(self, cluster: RayCluster) -> None:
        self.ended = 0
        self.killing = Thread(target=cluster.kill)

    def __call__(self, _outcome: object) -> None:
        self.ended += 1
        if self.ended == 3:
            self.killing.start()


@pytest.fixture
def cluster() -> Iterator[tuple[Engine, Killer]]:
    with ray_cluster() as made, engine("ray", address=made.address) as running:
        killer = Killer(made)
        yield running, killer
        killer.killing.join()


def rows(done: Sweep) -> list[dict[str, str]]:
    table = csv.DictReader(csv_text(done.results, ["learning_rate"]).splitlines())
    return [{name: each for name, each in row.items() if name != "seconds"} for row in table]


@pytest.mark.timeout(1800)
def test_a_sweep_has_the_same_table_though_a_machine_dies(
    cluster: tuple[Engine, Killer], tmp_path: Path
) -> None:
    plan = SweepPlan(
        scene={"name": "yardstick"},
        algorithms=("ppo",),
        seeds=(0, 1),
        parameters=(Parameter.parse("learning_rate=0.001..0.01:log"),),
        trials=8,
        batch=8,
        steps=64,
        settings=small_settings().model_dump(mode="json"),
    )
    running, killer = cluster
    for name in ("ray", "inline"):
        plan.save(tmp_path / name)
    there = run_sweep(plan, tmp_path / "ray", running, tell=killer)
    with engine("inline") as here:
        alone = run_sweep(plan, tmp_path / "inline", here)
    assert rows(there) == rows(alone)
    assert [each.network for each in there.results] == [each.network for each in alone.results]
    expect_each_once(tmp_path / "ray", 8)
    assert max(tries(tmp_path / "ray")) > 1, "the machine died with a trial"


def lines(folder: Path) -> list[dict[str, Any]]:
    return [json.loads(each) for each in (folder / "journal.jsonl").read_text().splitlines()]


def expect_each_once(folder: Path, count: int) -> None:
    """Expect a number of jobs that all ended well, and none twice."""
    ended = lines(folder)
    assert len({each["key"] for each in ended}) == len(ended) == count
    assert {each["error"] for each in ended} == {""}


def tries(folder: Path) -> list[int]:
    return [each["tries"] for each in lines(folder)]


def played(plan: TournamentPlan, folder: Path, running: Engine, **options: Any) -> Tournament:
    plan.save(folder)
    done = run_tournament(plan, folder, running, **options)
    write_results(done)
    return done


def sumo() -> TournamentPlan:
    sides = sides_of(Scene.load("sumo"))
    entries: tuple[Entry, ...] = tuple(
        parse_entry(each, sides) for each in ("scene", "PushOutController", "random")
    )
    return TournamentPlan(
        scene=scene_data("sumo"), entries=entries, seeds=(0, 1, 2), system="round-robin", rounds=0
    )


def expect_equal(there: Path, alone: Path) -> None:
    """Compare two folders of the tournament bit for bit."""
    files = [
        {path.name: path.read_bytes() for path in (folder / "games").iterdir()}
        for folder in (there, alone)
    ]
    assert len(files[0]) == 18
    assert files[0] == files[1], "bit for bit"
    for name in ("games.json", "standings.csv"):
        assert (there / name).read_text() == (alone / name).read_text()
    expect_each_once(there, 21)


@pytest.mark.timeout(1800)
def test_a_tournament_has_the_same_recordings_though_a_machine_dies(
    cluster: tuple[Engine, Killer], tmp_path: Path
) -> None:
    running, killer = cluster
    played(sumo(), tmp_path / "ray", running, tell=killer)
    with engine("inline") as here:
        played(sumo(), tmp_path / "inline", here)
    expect_equal(tmp_path / "ray", tmp_path / "inline")
    assert max(tries(tmp_path / "ray")) > 1, "the machine died with a game"


def test_a_tournament_has_the_same_recordings_though_a_process_dies(tmp_path: Path) -> None:
    before = {each.pid for each in psutil.Process().children(recursive=True)}
    ended = 0

    def kill_one(_outcome: object) -> None:
        nonlocal ended
        ended += 1
        children = psutil.Process().children(recursive=True)
        jobs = [each for each in children if "spawn_main" in command_line(each)]
        if ended == 3:
            next(each for each in jobs if each.pid not in before).kill()

    with engine("processes", width=2) as running:
        played(sumo(), tmp_path / "processes", running, tell=kill_one)
    with engine("inline") as here:
        played(sumo(), tmp_path / "inline", here)
    expect_equal(tmp_path / "processes", tmp_path / "inline")

"""A sweep and a tournament on a Ray cluster of three machines, here on one, of which one dies."""

import csv
import json
import socket
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest

from ai4u_edu import Scene
from ai4u_edu.jobs import Engine, engine
from ai4u_edu.scenes.scene_data import scene_data
from ai4u_edu.tournament.entry import Entry, parse_entry
from ai4u_edu.tournament.plan import Plan as TournamentPlan
from ai4u_edu.tournament.run import Tournament, run_tournament, write_results
from ai4u_edu.tournament.sides import sides_of
from ai4u_edu.training.sweep.plan import Plan
from ai4u_edu.training.sweep.result import csv_text
from ai4u_edu.training.sweep.run import Sweep, run_sweep
from ai4u_edu.training.sweep.search_space import Parameter
from tests.training.small import small_settings

pytestmark = [pytest.mark.slow, pytest.mark.nightly]


class Killer:
    """Kills a machine of a cluster when some jobs have ended."""

    def __init__(self, cluster: Any, machine: Any) -> None:
        self.cluster, self.machine, self.ended = cluster, machine, 0

    def __call__(self, _outcome: object) -> None:
        self.ended += 1
        if self.ended == 3:
            self.cluster.remove_node(self.machine, False)


def ports() -> dict[str, int]:
    """Free ports for a machine's helpers, which a busy machine starts too slowly to be asked."""
    names = ("metrics_agent", "metrics_export", "runtime_env_agent", "dashboard_agent_listen")
    with ExitStack() as held:
        sockets = [held.enter_context(socket.create_server(("127.0.0.1", 0))) for _ in names]
        return {
            f"{name}_port": each.getsockname()[1] for name, each in zip(names, sockets, strict=True)
        }


@pytest.fixture
def cluster() -> Iterator[tuple[Engine, Killer]]:
    from ray.cluster_utils import Cluster

    head = {"num_cpus": 1, "include_dashboard": False, **ports()}
    made = Cluster(initialize_head=True, head_node_args=head)
    try:
        mortal = made.add_node(num_cpus=1, **ports())
        made.add_node(num_cpus=1, **ports())
        with engine("ray", address=made.address) as running:
            yield running, Killer(made, mortal)
    finally:
        made.shutdown()  # type: ignore[no-untyped-call]


def rows(done: Sweep) -> list[dict[str, str]]:
    table = csv.DictReader(csv_text(done.results, ["learning_rate"]).splitlines())
    return [{name: each for name, each in row.items() if name != "seconds"} for row in table]


@pytest.mark.timeout(1800)
def test_a_sweep_has_the_same_table_though_a_machine_dies(
    cluster: tuple[Engine, Killer], tmp_path: Path
) -> None:
    plan = Plan(
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
    journal = (tmp_path / "ray" / "journal.jsonl").read_text().splitlines()
    assert len({json.loads(line)["key"] for line in journal}) == len(journal) == 8


def played(plan: TournamentPlan, folder: Path, running: Engine, **options: Any) -> Tournament:
    plan.save(folder)
    done = run_tournament(plan, folder, running, **options)
    write_results(done)
    return done


@pytest.mark.timeout(1800)
def test_a_tournament_has_the_same_recordings_though_a_machine_dies(
    cluster: tuple[Engine, Killer], tmp_path: Path
) -> None:
    sides = sides_of(Scene.load("sumo"))
    entries: tuple[Entry, ...] = tuple(
        parse_entry(each, sides) for each in ("scene", "PushOutController", "random")
    )
    plan = TournamentPlan(
        scene=scene_data("sumo"), entries=entries, seeds=(0, 1, 2), system="round-robin", rounds=0
    )
    running, killer = cluster
    played(plan, tmp_path / "ray", running, tell=killer)
    with engine("inline") as here:
        played(plan, tmp_path / "inline", here)
    files = [
        {path.name: path.read_bytes() for path in (tmp_path / name / "games").iterdir()}
        for name in ("ray", "inline")
    ]
    assert len(files[0]) == 18
    assert files[0] == files[1], "bit for bit"
    for name in ("games.json", "standings.csv"):
        assert (tmp_path / "ray" / name).read_text() == (tmp_path / "inline" / name).read_text()
    journal = (tmp_path / "ray" / "journal.jsonl").read_text().splitlines()
    assert len({json.loads(line)["key"] for line in journal}) == len(journal) == 21

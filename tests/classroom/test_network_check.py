"""Checks of handed-in networks: one that takes long holds up no other one."""

import asyncio
from collections.abc import Iterator
from pathlib import Path

import pytest

from ai4u_edu.classroom import ClassStore
from ai4u_edu.classroom.tournament import network_check
from ai4u_edu.classroom.tournament.network_check import NetworkCheck
from ai4u_edu.classroom.tournament.networks import Networks
from ai4u_edu.games.jobs import isolated
from tests.classroom.patient_class import serve_jobs_with_usual_priority
from tests.classroom.two_seats import two_seats
from tests.games.tournament.bad_networks import INPUTS, folding
from tests.learn.training.networks import network
from tests.waiting import LIMIT_S, until_async

pytestmark = [pytest.mark.needs("train", "tournament"), pytest.mark.slow]


@pytest.fixture
def store(tmp_path: Path) -> Iterator[ClassStore]:
    with two_seats(tmp_path / "class") as store:
        yield store


@pytest.fixture
def networks(store: ClassStore, tmp_path: Path) -> Networks:
    """Networks of which the first seat's take minutes to load, and the second seat's are good."""
    found = Networks(store, lambda _: None)
    folding(tmp_path / "slow.onnx")
    slow = (tmp_path / "slow.onnx").read_bytes()
    good = network(tmp_path / "good.onnx", INPUTS).read_bytes()
    for scene in ("sumo", "soccer"):
        found.add(1, scene, "", "slow.onnx", slow)
    found.add(2, "sumo", "", "good.onnx", good)
    return found


@pytest.fixture(autouse=True)
def usual_priority(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(isolated, "serve_jobs", serve_jobs_with_usual_priority)


def verdicts(networks: Networks) -> list[str]:
    return [each.verdict for each in networks.rows]


def test_nobody_waits_for_a_network_that_takes_minutes(
    networks: Networks, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(network_check, "LOAD_CPU_S", 10 * LIMIT_S)
    check = NetworkCheck(networks, tmp_path / "check")

    async def run() -> None:
        task = asyncio.create_task(check.run())
        await until_async(lambda: verdicts(networks) == ["open", "open", "right"])
        task.cancel()
        await asyncio.gather(task, return_exceptions=True)

    asyncio.run(run())
    assert not (tmp_path / "check").exists()


def test_a_network_that_takes_long_to_load_is_refused(
    networks: Networks, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(network_check, "LOAD_CPU_S", 1.0)
    check = NetworkCheck(networks, tmp_path / "check")

    async def run() -> None:
        task = asyncio.create_task(check.run())
        await until_async(lambda: "open" not in verdicts(networks))
        task.cancel()
        await asyncio.gather(task, return_exceptions=True)

    asyncio.run(run())
    reasons = {each.reason for each in networks.rows}
    assert reasons == {"it took more than 5 s of processor time to load", ""}

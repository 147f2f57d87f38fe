"""Jobs with data of unknown people: one that hangs or dies takes nothing with it."""

import asyncio
import os
import tempfile
import time
from pathlib import Path

import pytest

from ai4u_edu.games.jobs import Job
from ai4u_edu.games.jobs.isolated import IsolatedJobs
from tests.waiting import LIMIT_S

MAX_CPU_S = 2.0


def write_file() -> str:
    with tempfile.NamedTemporaryFile("w", delete=False) as file:
        file.write("a network")
    return file.name


def go_round() -> None:
    while True:
        pass


def die() -> None:
    os._exit(3)


def fail() -> None:
    raise ValueError("no such thing")


@pytest.mark.nightly
def test_a_job_that_hangs_or_dies_is_told_and_the_next_one_runs(tmp_path: Path) -> None:
    folder = tmp_path / "jobs"

    async def run() -> None:
        jobs = IsolatedJobs(MAX_CPU_S, LIMIT_S, folder)
        first = await jobs.run(Job.of(write_file))
        assert Path(first.result).parent == folder
        assert (await jobs.run(Job.of(go_round))).error == "it took more than 2 s of processor time"
        assert not folder.exists(), "what the job wrote is gone"
        assert "no such thing" in (await jobs.run(Job.of(fail))).error
        assert (await jobs.run(Job.of(die))).error.startswith("its process died")
        await jobs.end()

    asyncio.run(run())
    assert not folder.exists()


def wait() -> None:
    time.sleep(3600)  # real time: it is ended earlier


@pytest.mark.nightly
def test_a_job_that_waits_is_told(tmp_path: Path) -> None:
    async def run() -> str:
        jobs = IsolatedJobs(MAX_CPU_S, 0.5, tmp_path / "jobs")
        answer = await jobs.run(Job.of(wait))
        await jobs.end()
        return answer.error

    assert asyncio.run(run()) == "it took more than 0.5 s"

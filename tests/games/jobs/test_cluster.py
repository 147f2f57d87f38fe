"""A Ray cluster of three machines, here on one, of which one dies."""

from pathlib import Path
from threading import Thread

import pytest

from ai4u_edu.games.jobs import Job, engine, run_jobs
from tests.games.jobs import functions
from tests.games.jobs.ray_cluster import ray_cluster

pytestmark = [pytest.mark.slow, pytest.mark.nightly]


def test_a_machine_that_dies_loses_no_job_and_none_is_counted_twice(tmp_path: Path) -> None:
    begins = tmp_path / "begins"
    jobs = [
        Job.of(functions.square_on_machine, number=number, begins=str(begins))
        for number in range(12)
    ]
    results, tries, machines = [], [], set()
    with ray_cluster() as cluster, engine("ray", address=cluster.address) as made:
        assert made.width == 6

        def kill() -> None:
            cluster.kill()  # in the middle of its first job
            begins.touch()

        killing = Thread(target=kill)
        killing.start()
        for outcome in run_jobs(jobs, made):
            number, machine = outcome.result
            results.append(number)
            tries.append(outcome.tries)
            machines.add(machine)
        killing.join()
        assert cluster.mortal not in machines
    assert sorted(results) == [number**2 for number in range(12)]
    assert max(tries) > 1, "the machine died with a job"

"""A Ray cluster of three machines, here on one, of which one dies."""

from threading import Timer

import pytest

from ai4u_edu.jobs import Job, engine, run_jobs
from tests.jobs import functions
from tests.jobs.ray_cluster import ray_cluster

pytestmark = [pytest.mark.slow, pytest.mark.nightly]


def test_a_machine_that_dies_loses_no_job_and_none_is_counted_twice() -> None:
    jobs = [Job.of(functions.square_on_machine, number=number) for number in range(12)]
    results, tries, is_ending = [], [], False
    with ray_cluster() as cluster, engine("ray", address=cluster.address) as made:
        assert made.width == 6
        ending = Timer(1, cluster.kill)
        for outcome in run_jobs(jobs, made):
            number, machine = outcome.result
            results.append(number)
            tries.append(outcome.tries)
            if machine == cluster.mortal and not is_ending:
                is_ending = True
                ending.start()  # in the middle of its next job
        ending.join()
    assert sorted(results) == [number**2 for number in range(12)]
    assert max(tries) > 1, "the machine died with a job"

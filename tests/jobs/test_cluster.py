"""A Ray cluster of three machines, here on one, of which one dies."""

from threading import Timer

import pytest

from ai4u_edu.jobs import Job, engine, run_jobs
from tests.jobs import functions

pytestmark = [pytest.mark.slow, pytest.mark.nightly]


@pytest.mark.timeout(300)
def test_a_machine_that_dies_loses_no_job_and_none_is_counted_twice() -> None:
    from ray.cluster_utils import Cluster

    cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 1})
    try:
        mortal = cluster.add_node(num_cpus=1)
        cluster.add_node(num_cpus=1)
        jobs = [Job.of(functions.square_on_machine, number=number) for number in range(12)]
        results, tries, is_ending = [], [], False
        ending = Timer(1, cluster.remove_node, (mortal, False))
        with engine("ray", address=cluster.address) as made:
            for outcome in run_jobs(jobs, made):
                number, machine = outcome.result
                results.append(number)
                tries.append(outcome.tries)
                if machine == mortal.node_id and not is_ending:
                    is_ending = True
                    ending.start()  # in the middle of its next job
        ending.join()
        assert sorted(results) == [number**2 for number in range(12)]
        assert max(tries) > 1, "the machine died with a job"
    finally:
        cluster.shutdown()  # type: ignore[no-untyped-call]

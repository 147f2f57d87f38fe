"""Run jobs on an engine: each one once, and again if it failed by chance."""

from collections import deque
from collections.abc import Iterable, Iterator

from ai4u_edu.games.jobs.engine import Engine
from ai4u_edu.games.jobs.job import Job, JobOutcome
from ai4u_edu.games.jobs.journal import Journal

TRIES = 3
"""Times that a job is tried, unless it is said otherwise."""


def run_jobs(
    jobs: Iterable[Job], engine: Engine, *, journal: Journal | None = None, tries: int = TRIES
) -> Iterator[JobOutcome]:
    """Yield the outcome of each job: first of those in the journal, then as they end.

    Equal jobs are run once and have one outcome. After Ctrl-C, or if nobody takes further outcomes,
    the engine has to be closed; what the journal has is kept.

    Args:
        jobs: to be run, in this order.
        engine: runs them.
        journal: results of earlier runs; new ones are added.
        tries: runs of a job that raises an error, or whose process or machine dies; an AI4UError
            is not tried again.
    """
    waiting = deque({job.key: job for job in jobs}.values())
    tried: dict[str, int] = {}
    if journal is not None:
        yield from (journal.outcome(job) for job in waiting if job in journal)
        waiting = deque(job for job in waiting if job not in journal)
    running = 0
    while waiting or running:
        while waiting and running < engine.width:
            engine.start(waiting.popleft())
            running += 1
        job, answer = engine.wait()
        running -= 1
        tried[job.key] = tried.get(job.key, 0) + 1
        if answer.error and answer.can_retry and tried[job.key] < tries:
            waiting.append(job)
            continue
        outcome = JobOutcome(job, answer.result, answer.error, tried[job.key], answer.seconds)
        if journal is not None:
            journal.add(outcome)
        yield outcome

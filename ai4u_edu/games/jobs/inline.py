"""The engine that runs jobs in this process, one after another."""

from typing import Self

from ai4u_edu.games.jobs.call import Answer, call
from ai4u_edu.games.jobs.job import Job


class InlineEngine:
    """Runs a job when it is waited for; errors are those of the other engines."""

    width = 1

    def __init__(self) -> None:
        self._job: Job | None = None

    def start(self, job: Job) -> None:
        """See :class:`ai4u_edu.games.jobs.Engine`."""
        self._job = job

    def wait(self) -> tuple[Job, Answer]:
        """See :class:`ai4u_edu.games.jobs.Engine`."""
        if self._job is None:
            raise RuntimeError("no job runs")
        job, self._job = self._job, None
        return job, call(job)

    def close(self) -> None:
        """Do nothing: nothing runs."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

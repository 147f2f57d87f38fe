"""The engine that runs jobs on Ray, on this machine or on a cluster.

Whoever can connect to a Ray cluster can run any program on its machines: so Ray is started with its
token authentication.
"""

import os
from contextlib import suppress
from typing import Any, Self

from ai4u_edu.base.errors import SetupError
from ai4u_edu.base.optional_deps import need
from ai4u_edu.jobs.call import Answer, call, use_one_thread
from ai4u_edu.jobs.job import Job

JOBS_PER_CORE = 2
"""Jobs that Ray has for each core, so that none waits for the way there and back."""


class RayEngine:
    """Connects to Ray, or starts it; what it started ends with it.

    Args:
        width: number of jobs at a time; left out, as many as the cluster has cores for.
        address: of the cluster; left out, Ray is started here.

    Raises:
        SetupError: Ray is not installed, or there is no cluster at that address.
    """

    def __init__(self, width: int | None = None, address: str = "") -> None:
        need("ray", "ray")
        os.environ.setdefault("RAY_AUTH_MODE", "token")
        import ray

        self._ray: Any = ray  # it has types for a part
        self._has_started = not ray.is_initialized()
        if self._has_started:
            _connect(ray, address)
        self._remote = ray.remote(num_cpus=1, max_retries=0)(_call)
        self._running: dict[Any, Job] = {}
        cores = int(self._ray.cluster_resources().get("CPU", 1))
        self.width = width or max(1, cores) * JOBS_PER_CORE

    def start(self, job: Job) -> None:
        """See :class:`ai4u_edu.jobs.Engine`."""
        self._running[self._remote.remote(job)] = job

    def wait(self) -> tuple[Job, Answer]:
        """See :class:`ai4u_edu.jobs.Engine`."""
        (ready,), _ = self._ray.wait([*self._running], num_returns=1)
        job = self._running.pop(ready)
        try:
            return job, Answer(*self._ray.get(ready))
        except self._ray.exceptions.RayError as error:  # its process or its machine died
            first, *_ = str(error).strip().splitlines() or [""]
            return job, Answer(error=f"{type(error).__name__}: {first}")

    def close(self) -> None:
        """See :class:`ai4u_edu.jobs.Engine`."""
        for each in self._running:
            with suppress(self._ray.exceptions.RayError):
                self._ray.cancel(each, force=True)
        self._running.clear()
        if self._has_started:
            self._ray.shutdown()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def _connect(ray: Any, address: str) -> None:
    try:
        ray.init(
            address=address or "local",
            include_dashboard=None if address else False,
            log_to_driver=False,
            logging_level="ERROR",
        )
    except Exception as error:  # Ray raises its plainest class where a node does not start in time
        raise SetupError(
            f"expected a Ray cluster at {address or 'this machine'}: {error}"
        ) from error


def _call(job: Job) -> tuple[Any, ...]:
    use_one_thread()
    return tuple(call(job))

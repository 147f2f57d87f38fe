"""Interface of the engines, and the engines by name."""

from types import TracebackType
from typing import Protocol, Self

from ai4u_edu.base.errors import SetupError, suggest
from ai4u_edu.games.jobs.call import JobAnswer, call
from ai4u_edu.games.jobs.job import Job
from ai4u_edu.locale import gettext as _

NAMES = ("inline", "processes", "ray")


class Engine(Protocol):
    """Runs jobs, several at a time. A context manager; its end ends all that still runs."""

    width: int
    """Number of jobs that run at a time."""

    def start(self, job: Job) -> None:
        """Begin a job; called while fewer than :attr:`width` jobs run."""
        ...

    def wait(self) -> tuple[Job, JobAnswer]:
        """Return a job that has ended, and its answer; called while a job runs."""
        ...

    def close(self) -> None:
        """End all jobs that still run."""
        ...

    def __enter__(self) -> Self: ...

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None: ...


def engine(name: str = "processes", *, width: int | None = None, address: str = "") -> Engine:
    """Return an engine.

    Args:
        name: ``inline`` runs jobs one after another in this process; ``processes`` runs them in
            processes of this machine; ``ray`` runs them on Ray.
        width: number of jobs at a time; default: one for each core.
        address: of a Ray cluster, such as ``192.0.2.7:6379``; default: Ray is started on this
            machine.

    Raises:
        SetupError: there is no such engine, or Ray is not installed.
    """
    if address and name != "ray":
        raise SetupError(_("--address is for --engine ray, got --engine {name}", name=name))
    if name == "inline":
        return _InlineEngine()
    if name == "processes":
        from ai4u_edu.games.jobs.processes import ProcessEngine

        return ProcessEngine(width)
    if name == "ray":
        from ai4u_edu.games.jobs.ray_engine import RayEngine

        return RayEngine(width, address)
    raise SetupError(
        _(
            "expected an engine of {names}, got {name!r}; {hint}",
            names=", ".join(NAMES),
            name=name,
            hint=suggest(name, NAMES),
        )
    )


class _InlineEngine:
    """Runs a job when it is waited for; errors are those of the other engines."""

    width = 1

    def __init__(self) -> None:
        self._job: Job | None = None

    def start(self, job: Job) -> None:
        self._job = job

    def wait(self) -> tuple[Job, JobAnswer]:
        if self._job is None:
            raise RuntimeError(_("no job runs"))
        job, self._job = self._job, None
        return job, call(job)

    def close(self) -> None:
        """Do nothing: nothing runs."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        """Do nothing: nothing runs."""

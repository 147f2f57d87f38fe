"""Processes for jobs end with the process that started them, also in the middle of a job."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from ai4u_edu.games.jobs import Job, processes, run_jobs
from ai4u_edu.games.jobs.processes import ProcessEngine
from tests.games.jobs import functions
from tests.waiting import until

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(os.name != "posix", reason="a process is killed in another way there"),
]

PROGRAM = """
import asyncio, sys
from pathlib import Path
from threading import Thread
from ai4u_edu.games.jobs import Job, engine, run_jobs
from ai4u_edu.games.jobs.isolated import IsolatedJobs
from tests.games.jobs import functions

def run(paths, busy):
    jobs = [Job.of(functions.hold, path=path, busy=busy) for path in paths]
    with engine("processes", width=len(jobs)) as made:
        list(run_jobs(jobs, made))

def run_isolated(paths, busy):
    jobs = IsolatedJobs(1e9, 1e9)
    asyncio.run(jobs.run(Job.of(functions.hold, path=paths[0], busy=busy)))

if __name__ == "__main__":
    how, busy, *paths = sys.argv[1:]
    if how == "main":
        run(paths, bool(busy))
    else:
        work = Thread(target=run if how == "thread" else run_isolated, args=(paths, bool(busy)))
        work.start()
        work.join()
"""


def is_held(path: Path) -> bool:
    """Return True if a process holds the lock on a file."""
    import fcntl

    try:
        with path.open("rb") as file:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except FileNotFoundError:
        return False
    except OSError:
        return True
    return False


@pytest.mark.parametrize("busy", ["", "busy"])
@pytest.mark.parametrize("how", ["main", "thread", "isolated"])
def test_jobs_end_with_a_process_that_is_killed_and_say_nothing(
    how: str, busy: str, tmp_path: Path
) -> None:
    paths = [tmp_path / str(number) for number in range(1 if how == "isolated" else 2)]
    script = tmp_path / "script.py"
    script.write_text(PROGRAM)
    process = subprocess.Popen(
        [sys.executable, str(script), how, busy, *map(str, paths)],
        stderr=subprocess.PIPE,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
        text=True,
    )
    with process:
        until(lambda: all(map(is_held, paths)))
        process.kill()
        assert process.stderr is not None
        assert process.stderr.read() == "", "all that could write there have ended"
    until(lambda: not any(map(is_held, paths)))


def test_a_job_whose_process_is_stopped_goes_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(processes, "STOP_POLL_S", 0.02)
    with ProcessEngine(1) as engine:
        (done,) = run_jobs([Job.of(functions.stop_once, folder=str(tmp_path))], engine)
    assert (done.result, done.tries) == ("goes on", 1)

"""The process on Ray's side: starts jobs on Ray and sends their answers."""

import os
import signal
from contextlib import suppress
from multiprocessing.connection import Connection
from typing import Any

from ai4u_edu.games.jobs.call import Answer, call, use_one_thread
from ai4u_edu.games.jobs.job import Job

START_TRIES = 3
"""Attempts to start Ray here: a node gives up if its agents take 15 s, as on a busy machine."""
PIPE_POLL_S = 0.5
"""Interval in which a process that waits for a job looks whether it shall end."""


def drive(pipe: Connection, address: str) -> None:
    """Do what comes through a pipe until it closes: start a job, or, at None, send an answer.

    The first message that it sends is the number of the cluster's cores and an empty text, or 0 and
    why there is no cluster. An answer is a job's key and its
    :class:`~ai4u_edu.games.jobs.call.Answer`.

    Args:
        pipe: to the process of the engine.
        address: of the cluster; empty to start Ray here.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C ends the one that started it
    os.environ.setdefault("RAY_AUTH_MODE", "token")
    import ray as untyped

    ray: Any = untyped  # it has types for a part
    problem = _connect(ray, address)
    if problem:
        pipe.send((0, problem))
        return
    running: dict[Any, Job] = {}
    with suppress(EOFError, OSError):  # the other process has closed the pipe, or died
        pipe.send((int(ray.cluster_resources().get("CPU", 1)), ""))
        _serve(ray, pipe, running)
    for each in running:
        with suppress(ray.exceptions.RayError):
            ray.cancel(each, force=True)
    ray.shutdown()


def _connect(ray: Any, address: str) -> str:
    """Connect to Ray or start it, and return why that is impossible, or an empty text."""
    problem = ""
    for _ in range(1 if address else START_TRIES):
        try:
            ray.init(
                address=address or "local",
                include_dashboard=None if address else False,
                log_to_driver=False,
                logging_level="ERROR",
            )
        except Exception as error:  # its plainest class where a node does not start in time
            problem = str(error)
            ray.shutdown()
        else:
            return ""
    return problem


def _serve(ray: Any, pipe: Connection, running: dict[Any, Job]) -> None:
    remote = ray.remote(num_cpus=1, max_retries=0)(_call)
    while True:
        job = pipe.recv()
        if job is not None:
            running[remote.remote(job)] = job
            continue
        ready: list[Any] = []
        while not ready:
            ready, _ = ray.wait([*running], num_returns=1, timeout=PIPE_POLL_S)
            if not ready and pipe.poll():  # it asks for nothing more before it has its answer
                raise EOFError
        pipe.send((running.pop(ready[0]).key, _answer(ray, ready[0])))


def _answer(ray: Any, done: Any) -> Answer:
    try:
        return Answer(*ray.get(done))
    except ray.exceptions.RayError as error:  # its process or its machine died
        first, *_ = str(error).strip().splitlines() or [""]
        return Answer(error=f"{type(error).__name__}: {first}")


def _call(job: Job) -> tuple[Any, ...]:
    use_one_thread()
    return tuple(call(job))

"""A Ray cluster of three machines, here on one, in a process of its own.

Ray's calls can block in C, where no time limit of pytest's can end them: so no test loads Ray.
"""

import contextlib
import json
import os
import secrets
import subprocess
import sys
import threading
from collections.abc import Iterator
from dataclasses import dataclass
from typing import IO

import psutil
import pytest

from tests.waiting import until

START_TIMEOUT_S, END_TIMEOUT_S = 300.0, 30.0
START_TRIES = 5
"""Attempts to start Ray: a node gives up if its agents take 15 s, as on a busy machine."""


@dataclass
class RayCluster:
    """A cluster of a machine that stays, one that dies, and a third one; each has a core."""

    address: str
    mortal: str
    """Id of the machine that dies."""
    _process: "subprocess.Popen[str]"

    def kill(self) -> None:
        """Kill the machine that dies as soon as it runs a job, and wait until that is done."""
        print("kill", file=_pipe(self._process.stdin), flush=True)
        told = _line(self._process)
        assert told == "killed", told


@contextlib.contextmanager
def ray_cluster() -> Iterator[RayCluster]:
    """Start a cluster, and end it whatever happens.

    It has a token of its own, which this process and those that it starts know. Ray makes none for
    a cluster, and a user's file with one is there only if Ray was started before.
    """
    with pytest.MonkeyPatch.context() as variables:
        variables.setenv("RAY_AUTH_MODE", "token")
        variables.setenv("RAY_AUTH_TOKEN", secrets.token_hex(32))
        with _started() as cluster:
            yield cluster


@contextlib.contextmanager
def _started() -> Iterator[RayCluster]:
    for _ in range(START_TRIES):
        process = subprocess.Popen(
            [sys.executable, "-m", "tests.games.jobs.ray_cluster"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)},
        )
        try:
            told = _line(process)
            if told:
                yield RayCluster(**json.loads(told), _process=process)
                return
        finally:
            _end(process)
    raise AssertionError("Ray did not start")


def _end(process: "subprocess.Popen[str]") -> None:
    family = psutil.Process(process.pid).children(recursive=True)
    _pipe(process.stdin).close()
    with contextlib.suppress(subprocess.TimeoutExpired):
        process.wait(END_TIMEOUT_S)
    process.kill()
    process.wait()
    for each in family:
        with contextlib.suppress(psutil.Error):
            each.kill()
    _pipe(process.stdout).close()


def _line(process: "subprocess.Popen[str]") -> str:
    """Return the next line of a process; kill it if none comes in time."""
    # real time: only a fault lasts so long; Ray's own calls may block for ever
    timer = threading.Timer(START_TIMEOUT_S, process.kill)
    timer.start()
    try:
        return _pipe(process.stdout).readline().strip()
    finally:
        timer.cancel()


def _pipe(pipe: IO[str] | None) -> IO[str]:
    assert pipe is not None
    return pipe


def main() -> None:
    """Start the cluster, tell its address, kill a machine at the first line, end with the input."""
    from ray.cluster_utils import Cluster

    cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 1})
    mortal = cluster.add_node(num_cpus=1)
    cluster.add_node(num_cpus=1)
    print(json.dumps({"address": cluster.address, "mortal": mortal.node_id}), flush=True)
    if sys.stdin.readline():
        raylet = psutil.Process(mortal.all_processes["raylet"][0].process.pid)
        stopped: list[psutil.Process] = []

        def holds_job() -> bool:
            stopped[:] = _stopped_with_job(raylet)
            return bool(stopped)

        until(holds_job)
        cluster.remove_node(mortal, allow_graceful=False)
        for each in stopped:
            each.kill()
        print("killed", flush=True)
        sys.stdin.read()
    cluster.shutdown()


def _stopped_with_job(raylet: psutil.Process) -> list[psutil.Process]:
    """Stop a process of a machine that runs a job, so that the job does not end before it."""
    for each in raylet.children():
        with contextlib.suppress(psutil.Error):
            if _runs_job(each):
                each.suspend()
                if _runs_job(each):
                    return [each]
                each.resume()
    return []


def _runs_job(process: psutil.Process) -> bool:
    """Return True if a process runs a job, whose name is its title then."""
    return "ray::_call" in " ".join(process.cmdline())


if __name__ == "__main__":
    main()

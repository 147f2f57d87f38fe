"""Check of networks: each plays against itself, in a process of its own, before it is taken."""

import asyncio
import base64
from pathlib import Path

from ai4u_edu.base.errors import SetupError
from ai4u_edu.base.optional_deps import need
from ai4u_edu.classroom.tournament.network_scene import network_scenes
from ai4u_edu.classroom.tournament.networks import NetworkRow, Networks
from ai4u_edu.jobs import Job
from ai4u_edu.jobs.isolated import IsolatedJobs
from ai4u_edu.tournament.contest import game_job
from ai4u_edu.tournament.entry import Driver
from ai4u_edu.tournament.plan import CHECK_SEED

MAX_CHECK_CPU_S = 30.0
"""Processor time in which a network has to be loaded and to play a game against itself: the
tournament of a class has hundreds of games."""
MAX_CHECK_WALL_S = 600.0
IDLE_S = 20.0
"""Time for which the process waits for other networks: to start one takes seconds."""
POLL_S = 0.25


def missing_extras() -> str:
    """Return how to install what tournaments need; empty if all of it is there."""
    try:
        need("tournament", "onnxruntime", "openskill")
    except SetupError as error:
        return f"Tournaments: {error}. Then start the class again."
    return ""


class NetworkCheck:
    """Checks the networks that wait, one after the other. Belongs to the event loop.

    Args:
        networks: of the class.
        folder: for files of the check, in which nothing stays.
    """

    def __init__(self, networks: Networks, folder: Path) -> None:
        self._networks, self._folder = networks, folder
        self._process = IsolatedJobs(MAX_CHECK_CPU_S, MAX_CHECK_WALL_S, folder)

    async def run(self) -> None:
        """Check all that wait or come soon, and end the process.

        Raises:
            StoreError: a verdict can't be written.
        """
        loop = asyncio.get_running_loop()
        try:
            idle_since = loop.time()
            while loop.time() - idle_since < IDLE_S:
                row = self._networks.next_open()
                if row is None:
                    await asyncio.sleep(POLL_S)
                    continue
                await asyncio.to_thread(self._networks.judge, row, await self._fault(row))
                idle_since = loop.time()
        finally:
            await self._process.end()

    async def _fault(self, row: NetworkRow) -> str:
        """Return why a network can't play; empty if it can."""
        try:
            job = await asyncio.to_thread(self._job, row)
        except OSError:
            return "The file is not there any more. Hand it in again."
        answer = await self._process.run(job)
        reason = answer.error or str(answer.result["reason"])
        reason = reason.replace(str(self._folder.absolute()), "")  # it is the teacher's
        return f"Its game could not be played: {reason}" if answer.error else reason

    def _job(self, row: NetworkRow) -> Job:
        scene = network_scenes()[row.scene]
        entry = scene.entry("this network", {row.part: driver_of(self._networks, row)})
        return game_job({"name": row.scene}, CHECK_SEED, [entry] * len(scene.sides.names))


def driver_of(networks: Networks, row: NetworkRow) -> Driver:
    """Return the driver of an entry that a network is.

    Raises:
        OSError: its file can't be read.
    """
    data = networks.path_of(row).read_bytes()
    return {"kind": "network", "file": row.file, "data": base64.b64encode(data).decode()}

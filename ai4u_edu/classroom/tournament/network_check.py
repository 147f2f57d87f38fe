"""Check of networks: each plays against itself, in a process of its own, before it is taken."""

import asyncio
import base64
import re
import shutil
from contextlib import suppress
from math import inf
from pathlib import Path
from tempfile import TemporaryDirectory

from ai4u_edu.base.errors import AI4UError, SetupError, text_of
from ai4u_edu.base.optional_deps import need
from ai4u_edu.blocks.brains.controllers.neural import TRAINED_IN
from ai4u_edu.classroom.tournament.network_scene import network_scenes
from ai4u_edu.classroom.tournament.networks import NetworkRow, Networks
from ai4u_edu.games.jobs import Job
from ai4u_edu.games.jobs.isolated import IsolatedJobs
from ai4u_edu.games.tournament.contest import game_job
from ai4u_edu.games.tournament.drivers import load_network
from ai4u_edu.games.tournament.entry import Driver
from ai4u_edu.games.tournament.limits import LOAD_CPU_S, OverTimeError, is_over_time, over_load_time
from ai4u_edu.games.tournament.plan import CHECK_SEED
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import library_text, unpacked

MAX_CHECK_CPU_S = 30.0
"""Processor time in which a network has to be loaded and to play a game against itself: the
tournament of a class has hundreds of games."""
MAX_CHECK_WALL_S = 600.0
WIDTH = 2
"""Networks that are checked at a time."""
IDLE_S = 20.0
"""Time for which a process waits for other networks: to start one takes seconds."""
POLL_S = 0.25


def missing_extras() -> str:
    """Return how to install what tournaments need; empty if all of it is there."""
    try:
        need("tournament", "openskill")
    except SetupError as error:
        return _("Tournaments: {problem}. Then start the class again.", problem=text_of(error))
    return ""


def prepare() -> None:
    """Import what a game needs, so that no network's time counts it; a job's function."""
    import onnxruntime  # noqa: F401  # it takes a second


def load(driver: Driver) -> None:
    """Load a network, for its time alone: what is wrong with it shows in a game; a job's function.

    Args:
        driver: the network.
    """
    with TemporaryDirectory() as folder, suppress(AI4UError, OverTimeError):
        load_network(driver, Path(folder))


class NetworkCheck:
    """Checks the networks that wait. Belongs to the event loop.

    Two are checked at a time, of two seats, and seats take turns: so nobody waits long for a
    network of somebody else.

    Args:
        networks: of the class.
        folder: for files of the check, in which nothing stays.
    """

    def __init__(self, networks: Networks, folder: Path) -> None:
        self._networks, self._folder = networks, folder
        self._turns: dict[int, float] = {}
        """Number of the latest check of each seat; infinite while one runs."""
        self._count = 0

    async def run(self) -> None:
        """Check all that wait or come soon, and end the processes.

        Raises:
            StoreError: a verdict can't be written.
            OSError: a process could not be started.
        """
        tasks = [asyncio.create_task(self._work(number)) for number in range(WIDTH)]
        try:
            await asyncio.gather(*tasks)
        finally:
            for each in tasks:
                each.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)
            await asyncio.to_thread(shutil.rmtree, self._folder, ignore_errors=True)

    async def _work(self, number: int) -> None:
        folder = self._folder / str(number)
        process = IsolatedJobs(MAX_CHECK_CPU_S, MAX_CHECK_WALL_S, folder, first=Job.of(prepare))
        loop = asyncio.get_running_loop()
        try:
            idle_since = loop.time()
            while loop.time() - idle_since < IDLE_S:
                row = self._networks.next_open(lambda seat: self._turns.get(seat, 0.0))
                if row is None or self._turns.get(row.seat) == inf:
                    await asyncio.sleep(POLL_S)
                    continue
                self._turns[row.seat] = inf
                try:
                    fault = await self._fault(row, process)
                    await asyncio.to_thread(self._networks.judge, row, fault)
                finally:
                    self._count += 1
                    self._turns[row.seat] = self._count
                idle_since = loop.time()
        finally:
            await process.end()

    async def _fault(self, row: NetworkRow, process: IsolatedJobs) -> str:
        """Return why a network can't play; empty if it can."""
        try:
            driver = await asyncio.to_thread(driver_of, self._networks, row)
        except OSError:
            return _("The file is not there any more. Hand it in again.")
        answer = await process.run(Job.of(load, driver=driver), 1.2 * LOAD_CPU_S)
        if is_over_time(answer.error):
            return over_load_time()
        answer = await process.run(await asyncio.to_thread(self._job, row, driver))
        reason = answer.error or unpacked(answer.result["reason"])
        without_folder = re.sub(re.escape(str(self._folder.absolute())) + "/?[0-9]?", "", reason)
        if without_folder != reason:
            reason = without_folder
        reason = _other_scene(row.scene, reason) or reason  # the path is the teacher's
        return (
            _("Its game could not be played: {reason}", reason=reason) if answer.error else reason
        )

    @staticmethod
    def _job(row: NetworkRow, driver: Driver) -> Job:
        scene = network_scenes()[row.scene]
        entry = scene.entry("this network", {row.part: driver})
        return game_job({"name": row.scene}, CHECK_SEED, [entry] * len(scene.sides.names))


def _other_scene(scene: str, reason: str) -> str:
    """Return a sentence if a network does not fit because it was trained in another scene."""
    found = re.search(f"{TRAINED_IN}'([^']+)'", reason)
    if found is None or found[1] == scene:
        return ""
    titles = {name: library_text(each.title) for name, each in network_scenes().items()}
    title = titles.get(scene, scene)
    return _(
        "It was trained in “{scene}”; this tournament is “{title}”. Hand in a network "
        "that was trained in “{title}”.",
        scene=titles.get(found[1], found[1]),
        title=title,
    )


def driver_of(networks: Networks, row: NetworkRow) -> Driver:
    """Return the driver of an entry that a network is.

    Raises:
        OSError: its file can't be read.
    """
    data = networks.path_of(row).read_bytes()
    return {"kind": "network", "file": row.file, "data": base64.b64encode(data).decode()}

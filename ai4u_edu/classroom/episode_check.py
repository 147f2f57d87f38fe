"""Check of a race's result: the recorded episode is replayed, in a process of its own."""

import asyncio
import multiprocessing
import sys
import time
from collections.abc import Iterable
from dataclasses import dataclass, replace
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from pathlib import Path
from typing import NamedTuple

import psutil

from ai4u_edu.base.errors import AI4UError, shorten
from ai4u_edu.blocks.loading import load_blocks
from ai4u_edu.recording import Episode, Replay
from ai4u_edu.recording.file import decode
from ai4u_edu.scenes import Scene
from ai4u_edu.snapshot.outcome import outcome

MAX_CHECK_CPU_S = 30.0
"""Processor time in which an episode must be replayed; a longer one is refused. Wall time does not
count: a class's machine is busy during a race."""
MAX_CHECK_WALL_S = 600.0
"""Wall time, for a process that waits for ever."""
START_TIMEOUT_S = 300.0
"""Time in which the process starts; then the check is tried again later."""
POLL_S = 0.1
END_TIMEOUT_S = 2.0
TIME_TOLERANCE_S = 0.05
"""Accepted difference between the claimed and the replayed time."""
MAX_REASON_CHARS = 200
_EVERY_TICK = 10**9


@dataclass(frozen=True)
class Claim:
    """Result of an episode, as a room tells it."""

    episode: bytes
    scene: str
    """Scene of the race: a name in the library, or YAML."""
    seed: int
    outcome: str
    seconds: float


def find_fault(claim: Claim) -> str:
    """Return why a claim is wrong; empty if the episode replays to what it claims."""
    try:
        episode = decode(Episode, claim.episode, "the episode")
        scene = Scene.loads(claim.scene) if "\n" in claim.scene else Scene.load(claim.scene)
        if episode.seed != claim.seed:
            return f"expected seed {claim.seed}, got {episode.seed}"
        # the world and agents are compared below; what counts as success is not among them
        goal = {"success": scene.description.success, "goal": scene.description.goal}
        replay = Replay(replace(episode, scene=episode.scene.model_copy(update=goal)))
        if not replay.fits(scene.build()):
            return "it was driven in another scene"
        if not replay.verdict.exact:
            return replay.verdict.why
        found = _outcome(replay)
    except AI4UError as error:
        return shorten(str(error), MAX_REASON_CHARS)
    if found != claim.outcome:
        return f"expected the outcome {claim.outcome!r}, got {found!r} in the replay"
    if abs(episode.seconds - claim.seconds) > TIME_TOLERANCE_S:
        return f"expected {claim.seconds:.2f} s, got {episode.seconds:.2f} s in the replay"
    return ""


def _outcome(replay: Replay) -> str:
    """Return the outcome of a replayed episode for the agent that acts first."""
    found = ""
    for picture in replay.snapshots(every=_EVERY_TICK):  # the last one only
        found = outcome(picture.agents[0], picture.agents, picture.static_scene.success)
    return found


def check_claims(claims: Connection, blocks: tuple[Path, ...]) -> None:
    """Check claims until the other end is closed; the main function of the process.

    Args:
        claims: gets None when all is loaded; gives each :class:`Claim`, and gets the fault.
        blocks: Python files with the teacher's blocks.
    """
    for file in blocks:
        load_blocks(file)
    try:
        claims.send(None)  # the time until here is no part of a check
        while True:
            claims.send(find_fault(claims.recv()))
    except (EOFError, OSError, KeyboardInterrupt):
        return


class _Running(NamedTuple):
    process: BaseProcess
    connection: Connection
    usage: psutil.Process


class EpisodeCheck:
    """Checks claims one after the other in a process, which is replaced if it takes too long.

    Belongs to the event loop.

    Args:
        blocks: Python files with the teacher's blocks.
        max_cpu_s: processor time of one check.
    """

    def __init__(self, blocks: Iterable[Path] = (), max_cpu_s: float = MAX_CHECK_CPU_S) -> None:
        self.max_cpu_s = max_cpu_s
        self._blocks = tuple(blocks)
        self._lock = asyncio.Lock()
        self._running: _Running | None = None
        # started anew and not forked, as this process has threads
        method = "forkserver" if sys.platform == "linux" else "spawn"
        self._context = multiprocessing.get_context(method)

    async def find_fault(self, claim: Claim) -> str:
        """Return why a claim is wrong; empty if it is right. See :func:`find_fault`.

        Raises:
            OSError: the process could not be started; a later try may succeed.
        """
        async with self._lock:
            return await asyncio.to_thread(self._ask, claim)

    def _ask(self, claim: Claim) -> str:
        running = self._running = self._running or self._start()
        try:
            begin_cpu_s, end_at = _cpu_s(running.usage), time.monotonic() + MAX_CHECK_WALL_S
            running.connection.send(claim)
            while not running.connection.poll(POLL_S):
                used_s = _cpu_s(running.usage) - begin_cpu_s
                if used_s > self.max_cpu_s or time.monotonic() > end_at:
                    self.close()
                    return f"it could not be replayed in {self.max_cpu_s:g} s of processor time"
            return str(running.connection.recv())
        except (EOFError, OSError, psutil.Error):
            self.close()
            return "the process that replayed it has ended"

    def _start(self) -> _Running:
        ours, theirs = self._context.Pipe()
        process = self._context.Process(  # type: ignore[attr-defined]
            target=check_claims, args=(theirs, self._blocks), name="episode check", daemon=True
        )
        process.start()
        theirs.close()
        try:
            if ours.poll(START_TIMEOUT_S):
                ours.recv()
                return _Running(process, ours, psutil.Process(process.pid))
        except (EOFError, psutil.Error):
            pass
        ours.close()
        process.kill()
        raise OSError("the process that checks episodes did not start")

    def close(self) -> None:
        """End the process."""
        running, self._running = self._running, None
        if running is not None:
            running.connection.close()
            running.process.kill()
            running.process.join(END_TIMEOUT_S)


def _cpu_s(process: psutil.Process) -> float:
    times = process.cpu_times()
    return float(times.user + times.system)

"""Check of a race's result: the recorded episode is replayed, in a process of its own."""

import base64
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ai4u_edu.base.errors import AI4UError, shorten, text_of
from ai4u_edu.blocks.loading import load_blocks
from ai4u_edu.games.jobs import Job
from ai4u_edu.games.jobs.isolated import IsolatedJobs
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import packed, unpacked
from ai4u_edu.recording import Episode, Replay
from ai4u_edu.recording.episode import decode
from ai4u_edu.scenes import Scene

MAX_CHECK_CPU_S = 30.0
"""Processor time in which an episode must be replayed; a longer one is refused. Wall time does not
count: a class's machine is busy during a race."""
MAX_CHECK_WALL_S = 600.0
"""Wall time, for a process that waits for ever."""
TIME_TOLERANCE_S = 0.05
"""Accepted difference between the claimed and the replayed time."""
MAX_REASON_CHARS = 200
_EVERY_TICK = 10**9


@dataclass(frozen=True)
class Claim:
    """Result of an episode, as a room reports it."""

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
            return _("expected seed {seed}, got {found}", seed=claim.seed, found=episode.seed)
        if not Replay(episode).fits(scene.build()):
            return _("it was driven in another scene")
        # the world and agents are those of the scene; what counts as success is not among them
        goal = {"success": scene.description.success, "goal": scene.description.goal}
        replay = Replay(replace(episode, scene=episode.scene.model_copy(update=goal)))
        if not replay.verdict.exact:
            return replay.verdict.why
        found = _outcome(replay)
    except AI4UError as error:
        return shorten(text_of(error), MAX_REASON_CHARS)
    if found != claim.outcome:
        return _(
            "expected the outcome {outcome!r}, got {found!r} in the replay",
            outcome=claim.outcome,
            found=found,
        )
    if abs(episode.seconds - claim.seconds) > TIME_TOLERANCE_S:
        return _(
            "expected {seconds:.2f} s, got {found:.2f} s in the replay",
            seconds=claim.seconds,
            found=episode.seconds,
        )
    return ""


def _outcome(replay: Replay) -> str:
    """Return the outcome of a replayed episode for the agent that acts first."""
    found = ""
    for picture in replay.snapshots(every=_EVERY_TICK):  # the last one only
        found = picture.agents[0].outcome(picture.agents, picture.static_scene.success)
    return found


def prepare(blocks: list[str]) -> None:
    """Load what a check needs: a job's function.

    Args:
        blocks: paths of Python files with the teacher's blocks.
    """
    for file in blocks:
        load_blocks(Path(file))


def fault_of(episode: str, **fields: Any) -> str:
    """Return :func:`find_fault` of a claim as plain data; a job's function.

    Args:
        episode: the bytes of its file in base64.
        **fields: the other fields of the claim.
    """
    return packed(find_fault(Claim(base64.b64decode(episode), **fields)))


class EpisodeCheck:
    """Checks claims one at a time in a process, which is replaced if it takes too long.

    Belongs to the event loop.

    Args:
        blocks: Python files with the teacher's blocks.
        max_cpu_s: processor time of one check.
    """

    def __init__(self, blocks: Iterable[Path] = (), max_cpu_s: float = MAX_CHECK_CPU_S) -> None:
        first = Job.of(prepare, blocks=[str(each) for each in blocks])
        self._jobs = IsolatedJobs(max_cpu_s, MAX_CHECK_WALL_S, first=first)

    @property
    def max_cpu_s(self) -> float:
        """Processor time of one check."""
        return self._jobs.max_cpu_s

    @max_cpu_s.setter
    def max_cpu_s(self, value: float) -> None:
        self._jobs.max_cpu_s = value

    async def find_fault(self, claim: Claim) -> str:
        """Return why a claim is wrong; empty if it is right. See :func:`find_fault`.

        Raises:
            OSError: the process could not be started; a later try may succeed.
        """
        fields = vars(claim) | {"episode": base64.b64encode(claim.episode).decode()}
        answer = await self._jobs.run(Job.of(fault_of, **fields))
        if not answer.error:
            return unpacked(str(answer.result))
        reason = answer.error.replace("it took more than", "it could not be replayed in")
        return shorten(reason, MAX_REASON_CHARS)

    def close(self) -> None:
        """End the process."""
        self._jobs.close()

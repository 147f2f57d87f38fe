"""Verification of a tournament: all games are played again and compared bit for bit."""

import base64
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ai4u_edu.base.errors import SetupError
from ai4u_edu.jobs import Engine, Job, run_jobs
from ai4u_edu.recording import Episode, RecordingError, Replay
from ai4u_edu.tournament.contest import game_job
from ai4u_edu.tournament.entry import Entry
from ai4u_edu.tournament.plan import Plan
from ai4u_edu.tournament.run import GAMES, LIST


def verify(
    folder: Path, engine: Engine, tell: Callable[[], object] = lambda: None
) -> tuple[int, list[str]]:
    """Play all games of a tournament again.

    A game of networks, scripts and recordings is decided again from the entries, and has to give
    the same file. A game with a program, or that ended by a failure, is replayed from its recorded
    actions, as processor time is not the same twice.

    Args:
        folder: the tournament's.
        engine: runs the games.
        tell: called after each game.

    Returns:
        The number of games, and a sentence for each that differs.

    Raises:
        SetupError: there is no finished tournament in the folder.
    """
    plan = Plan.load(folder)
    entries = {each.name: each for each in plan.entries}
    try:
        games: list[dict[str, Any]] = json.loads((folder / LIST).read_bytes())
        jobs = [_job(plan, folder, each, entries) for each in games]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise SetupError(f"{folder / LIST}: expected the games of a tournament: {error}") from error
    problems = []
    done: dict[str, Any] = {}
    for outcome in run_jobs(jobs, engine):
        done[outcome.job.key] = outcome
        tell()
    for number, (each, job) in enumerate(zip(games, jobs, strict=True), 1):
        outcome = done[job.key]
        reason = outcome.error or _difference(outcome.result, each, folder)
        if reason:
            names = " vs ".join(each["entries"])
            problems.append(f"game {number} ({names}, seed {each['seed']}): {reason}")
    return len(games), problems


def replay_again(file: str) -> dict[str, Any]:
    """Replay a recorded game from its actions; a job's function.

    Returns:
        ``exact``, and ``why`` not.
    """
    verdict = Replay(Episode.load(file)).verdict
    return {"exact": verdict.exact, "why": verdict.why}


def _job(plan: Plan, folder: Path, told: dict[str, Any], entries: dict[str, Entry]) -> Job:
    seating = [entries[name] for name in told["entries"]]
    if told["forfeit"] < 0 and all(each.can_repeat for each in seating):
        return game_job(plan.scene, told["seed"], seating)
    if not told["file"]:
        return game_job(plan.scene, told["seed"], seating)
    return Job.of(replay_again, file=str((folder / GAMES / told["file"]).absolute()))


def _difference(result: dict[str, Any], told: dict[str, Any], folder: Path) -> str:
    """Return why a game differs from what the folder says; empty if it does not."""
    if "exact" in result:
        return str(result["why"]) if not result["exact"] else ""
    for name in ("points", "goal", "ticks", "forfeit", "reason"):
        if result[name] != told[name]:
            return f"{name}: the folder says {told[name]}, and now it is {result[name]}"
    if not told["file"]:
        return ""
    path = folder / GAMES / told["file"]
    try:
        there = path.read_bytes()
    except OSError as error:
        return f"{told['file']}: can't be read: {error.strerror}"
    if there == base64.b64decode(result["episode"]):
        return ""
    try:
        verdict = Replay(Episode.load(path)).verdict
    except RecordingError as error:
        return str(error)
    return verdict.why or "the file is another one than the entries play now"

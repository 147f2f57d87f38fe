"""A run of a tournament: its games on an engine, and the files in its folder.

::

    DIR/tournament.json   the plan, with the content of all entries
    DIR/journal.jsonl     the results of all games; a tournament goes on from it
    DIR/games/            a recorded episode of each game
    DIR/games.json        each game's file, entries, seed and result
    DIR/standings.csv, index.html
"""

import base64
import csv
import io
import json
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.errors import SetupError
from ai4u_edu.jobs import Engine, Job, Journal, Outcome, run_jobs
from ai4u_edu.tournament.contest import Contest, ContestResult, game_job
from ai4u_edu.tournament.entry import Entry
from ai4u_edu.tournament.plan import CHECK_SEED, Plan
from ai4u_edu.tournament.schedule import races, round_robin, swiss_round
from ai4u_edu.tournament.standings import Standing, standings

GAMES = "games"
LIST = "games.json"
PAGE = "index.html"


@dataclass
class Tournament:
    """Results of a tournament so far."""

    plan: Plan
    folder: Path
    refused: dict[str, str] = field(default_factory=dict)
    """Reasons for which entries take no part, by name."""
    results: list[ContestResult] = field(default_factory=list)
    """Results of the contests that ended, in the order of the schedule."""
    games: list[dict[str, Any]] = field(default_factory=list)
    """File, entries, seed and result of each game."""
    is_interrupted: bool = False

    @property
    def admitted(self) -> list[Entry]:
        """The entries that take part."""
        return [each for each in self.plan.entries if each.name not in self.refused]

    @property
    def standings(self) -> list[Standing]:
        """The standings, the best first."""
        return standings([each.name for each in self.admitted], self.results)


def run_tournament(
    plan: Plan,
    folder: Path,
    engine: Engine,
    *,
    tell: Callable[[Outcome], object] = lambda _outcome: None,
) -> Tournament:
    """Play the games of a plan that have not been played; Ctrl-C keeps those that are finished.

    Args:
        plan: the plan.
        folder: a tournament's folder, with the plan in it.
        engine: runs the games.
        tell: called with the outcome of each game when it ends, checks included.

    Raises:
        SetupError: fewer than two entries can play.
    """
    done = Tournament(plan, folder)
    outcomes: dict[str, Outcome] = {}
    with Journal(folder) as journal:

        def play(jobs: Sequence[Job]) -> None:
            for outcome in run_jobs(jobs, engine, journal=journal):
                outcomes[outcome.job.key] = outcome
                tell(outcome)

        try:
            _check(done, play, outcomes)
            _play(done, play, outcomes)
        except KeyboardInterrupt:
            done.is_interrupted = True
    return done


def _check(
    done: Tournament, play: Callable[[Sequence[Job]], None], outcomes: dict[str, Outcome]
) -> None:
    """Let each entry play against itself, and refuse those that fail."""
    plan = done.plan
    count = len(plan.sides.names)
    jobs = {each.name: game_job(plan.scene, CHECK_SEED, [each] * count) for each in plan.entries}
    play([*jobs.values()])
    for name, job in jobs.items():
        outcome = outcomes[job.key]
        reason = outcome.error or outcome.result["reason"]
        if reason:
            done.refused[name] = reason
    if len(done.admitted) < 2:
        told = "; ".join(f"{name}: {reason}" for name, reason in done.refused.items())
        raise SetupError(f"expected two entries that can play at least; {told}")


def _play(
    done: Tournament, play: Callable[[Sequence[Job]], None], outcomes: dict[str, Outcome]
) -> None:
    plan, entries = done.plan, done.admitted
    if plan.sides.is_race:
        rounds = [races(entries, plan.seeds)]
    elif plan.system == "round-robin":
        rounds = [round_robin(entries, plan.seeds)]
    else:
        rounds = []
    swiss = 0 if rounds else plan.rounds_for(len(entries))
    by_name = {each.name: each for each in entries}
    for number in range(len(rounds) or swiss):
        contests = rounds[number] if rounds else swiss_round(by_name, done.standings, plan.seeds)
        try:
            play([job for each in contests for job in each.jobs(plan.scene)])
        finally:
            for each in contests:
                _take(done, each, outcomes)


def _take(done: Tournament, contest: Contest, outcomes: dict[str, Outcome]) -> None:
    """Add a contest's result and its games' files, if all of its games have ended."""
    jobs = contest.jobs(done.plan.scene)
    if not all(job.key in outcomes for job in jobs):
        return
    ended = [outcomes[job.key] for job in jobs]
    error = next((each.error for each in ended if each.error), "")
    if error:
        done.results.append(ContestResult(contest, (), error))
        return
    done.results.append(ContestResult(contest, tuple(each.result for each in ended)))
    for seating, outcome in zip(contest.seatings, ended, strict=True):
        names = [each.name for each in seating]
        number = len(done.games) + 1
        file = f"{number:04}-{'-vs-'.join(map(_file_part, names))}-seed-{contest.seed}.episode"
        told = dict(outcome.result)
        data = base64.b64decode(told.pop("episode"))
        if data:
            path = done.folder / GAMES / file
            path.parent.mkdir(exist_ok=True)
            if not path.exists() or path.read_bytes() != data:
                write_atomically(path, data)
        done.games.append(
            {"file": file if data else "", "seed": contest.seed, "entries": names} | told
        )


def write_results(done: Tournament) -> None:
    """Write the list of games and the standings."""
    write_atomically(done.folder / LIST, json.dumps(done.games, indent=1) + "\n")
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    head = ["place", "name", "rating", "uncertainty", "provisional"]
    writer.writerow([*head, "won", "drawn", "lost", "forfeits", "points"])
    for place, each in enumerate(done.standings, 1):
        rating = (f"{each.mu:.6g}", f"{each.sigma:.6g}", each.is_provisional)
        counts = (each.won, each.drawn, each.lost, each.forfeits)
        writer.writerow([place, each.name, *rating, *counts, f"{each.points:.6g}"])
    write_atomically(done.folder / "standings.csv", out.getvalue())


def _file_part(name: str) -> str:
    return re.sub(r"[^\w.-]", "_", name)

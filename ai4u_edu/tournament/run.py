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
from collections.abc import Callable, Iterator, Sequence
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
Play = Callable[[Sequence[Job]], Iterator[Outcome]]
"""Runs jobs, and yields their outcomes as they end."""


@dataclass
class Tournament:
    """Results of a tournament so far."""

    plan: Plan
    folder: Path
    refused: dict[str, str] = field(default_factory=dict)
    """Reasons for which entries take no part, by name."""
    ended: dict[int, ContestResult] = field(default_factory=dict)
    """Results of the contests that ended, by their place in the schedule."""
    files: dict[int, list[dict[str, Any]]] = field(default_factory=dict)
    """File, entries, seed and result of each game, by the place of its contest."""
    is_interrupted: bool = False

    @property
    def results(self) -> list[ContestResult]:
        """Results of the contests that ended, in the order of the schedule."""
        return [self.ended[place] for place in sorted(self.ended)]

    @property
    def games(self) -> list[dict[str, Any]]:
        """File, entries, seed and result of each game, in the order of the schedule."""
        return [game for place in sorted(self.files) for game in self.files[place]]

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
    show: Callable[[Tournament], object] = lambda _done: None,
) -> Tournament:
    """Play the games of a plan that have not been played; Ctrl-C keeps those that are finished.

    Args:
        plan: the plan.
        folder: a tournament's folder, with the plan in it.
        engine: runs the games.
        tell: called with the outcome of each game when it ends, checks included.
        show: called with the tournament so far after the checks, and when a contest has ended.

    Raises:
        SetupError: fewer than two entries can play.
    """
    done = Tournament(plan, folder)
    with Journal(folder) as journal:

        def play(jobs: Sequence[Job]) -> Iterator[Outcome]:
            for outcome in run_jobs(jobs, engine, journal=journal):
                tell(outcome)
                yield outcome

        try:
            _check(done, play)
            show(done)
            _play(done, play, show)
        except KeyboardInterrupt:
            done.is_interrupted = True
    return done


def _check(done: Tournament, play: Play) -> None:
    """Let each entry play against itself, and refuse those that fail."""
    plan = done.plan
    count = len(plan.sides.names)
    jobs = {each.name: game_job(plan.scene, CHECK_SEED, [each] * count) for each in plan.entries}
    outcomes = {outcome.job.key: outcome for outcome in play([*jobs.values()])}
    for name, job in jobs.items():
        outcome = outcomes[job.key]
        reason = outcome.error or outcome.result["reason"]
        if reason:
            done.refused[name] = reason
    if len(done.admitted) < 2:
        told = "; ".join(f"{name}: {reason}" for name, reason in done.refused.items())
        raise SetupError(f"expected two entries that can play at least; {told}")


def _play(done: Tournament, play: Play, show: Callable[[Tournament], object]) -> None:
    plan, entries = done.plan, done.admitted
    if plan.sides.is_race:
        rounds = [races(entries, plan.seeds)]
    elif plan.system == "round-robin":
        rounds = [round_robin(entries, plan.seeds)]
    else:
        rounds = []
    swiss = 0 if rounds else plan.rounds_for(len(entries))
    by_name = {each.name: each for each in entries}
    first = 0
    for number in range(len(rounds) or swiss):
        contests = rounds[number] if rounds else swiss_round(by_name, done.standings, plan.seeds)
        _play_round(done, dict(enumerate(contests, first)), play, show)
        first += len(contests)


def _play_round(
    done: Tournament,
    waiting: dict[int, Contest],
    play: Play,
    show: Callable[[Tournament], object],
) -> None:
    """Play contests, by their place in the schedule, and take each as soon as its games ended."""
    outcomes: dict[str, Outcome] = {}
    jobs = {place: contest.jobs(done.plan.scene) for place, contest in waiting.items()}
    places: dict[str, list[int]] = {}
    for place, games in jobs.items():
        for job in games:
            places.setdefault(job.key, []).append(place)
    for outcome in play([job for games in jobs.values() for job in games]):
        outcomes[outcome.job.key] = outcome
        for place in places[outcome.job.key]:
            if place in waiting and all(job.key in outcomes for job in jobs[place]):
                ended = [outcomes[job.key] for job in jobs[place]]
                _take(done, place, waiting.pop(place), ended)
                show(done)


def _take(done: Tournament, place: int, contest: Contest, ended: Sequence[Outcome]) -> None:
    """Add a contest's result, and write its games' files."""
    error = next((each.error for each in ended if each.error), "")
    if error:
        done.ended[place] = ContestResult(contest, (), error)
        return
    done.ended[place] = ContestResult(contest, tuple(each.result for each in ended))
    games: list[dict[str, Any]] = []
    done.files[place] = games
    for number, (seating, outcome) in enumerate(
        zip(contest.seatings, ended, strict=True), place * len(ended) + 1
    ):
        names = [each.name for each in seating]
        file = f"{number:04}-{'-vs-'.join(map(_file_part, names))}-seed-{contest.seed}.episode"
        told = dict(outcome.result)
        data = base64.b64decode(told.pop("episode"))
        if data:
            path = done.folder / GAMES / file
            path.parent.mkdir(exist_ok=True)
            if not path.exists() or path.read_bytes() != data:
                write_atomically(path, data)
        games.append({"file": file if data else "", "seed": contest.seed, "entries": names} | told)


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

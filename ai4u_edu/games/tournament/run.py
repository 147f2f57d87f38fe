"""A run of a tournament: its games on an engine, and the files in its folder.

::

    DIR/tournament.json   the plan, with the content of all entries
    DIR/journal.jsonl     the results of all games; a tournament goes on from it
    DIR/games/            a recorded episode of each game
    DIR/games.json        each game's file, entries, seed, job and result
    DIR/standings.csv, index.html
    DIR/SHA256SUMS        hashes of all these files
"""

import hashlib
import json
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import combinations
from pathlib import Path
from typing import Any

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.csv_table import csv_table
from ai4u_edu.base.errors import SetupError
from ai4u_edu.games.jobs import Engine, Job, JobOutcome, Journal, run_jobs
from ai4u_edu.games.jobs.journal import FILE as JOURNAL
from ai4u_edu.games.tournament.contest import Contest, ContestResult, game_job
from ai4u_edu.games.tournament.game import result_fault
from ai4u_edu.games.tournament.page import page_of
from ai4u_edu.games.tournament.plan import CHECK_SEED, TournamentPlan
from ai4u_edu.games.tournament.plan import FILE as PLAN
from ai4u_edu.games.tournament.standings import Standing
from ai4u_edu.games.tournament.tournament import Tournament
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join, unpacked

GAMES = "games"
LIST = "games.json"
TABLE = "standings.csv"
PAGE = "index.html"
SUMS = "SHA256SUMS"
"""Hashes of all other files of the folder, as ``sha256sum --check`` reads them."""
MAX_FILE_PART_BYTES = 100
Play = Callable[[Sequence[Job]], Iterator[JobOutcome]]
"""Runs jobs, and yields their outcomes as they end."""


def run_tournament(
    plan: TournamentPlan,
    folder: Path,
    engine: Engine,
    *,
    journal: Path | None = None,
    tell: Callable[[JobOutcome], object] = lambda _outcome: None,
    show: Callable[[Tournament], object] = lambda _done: None,
) -> Tournament:
    """Play the games of a plan that have not been played; Ctrl-C keeps those that are finished.

    Args:
        plan: the plan.
        folder: a tournament's folder, with the plan in it.
        engine: runs the games.
        journal: folder of the journal; by default that of the tournament.
        tell: called with the outcome of each game when it ends, checks included.
        show: called with the tournament so far after the checks, and when a contest has ended.

    Raises:
        SetupError: fewer than two entries can play, or the journal is not of this program.
    """
    done, sides = Tournament(plan, folder), len(plan.sides.names)
    with Journal(folder if journal is None else journal) as kept:

        def play(jobs: Sequence[Job]) -> Iterator[JobOutcome]:
            for outcome in run_jobs(jobs, engine, journal=kept):
                fault = "" if outcome.error else result_fault(outcome.result, sides)
                if fault:
                    raise SetupError(
                        _(
                            "{path}: expected results of games, got: {fault}",
                            path=str(kept.path),
                            fault=fault,
                        )
                    )
                tell(outcome)
                yield outcome

        def take(place: int | None) -> None:
            if place is not None:
                _write_recordings(done, place)
            show(done)

        try:
            play_all(done, play, take)
        except KeyboardInterrupt:
            done.is_interrupted = True
    return done


def play_all(
    done: Tournament, play: Play, take: Callable[[int | None], object] = lambda _place: None
) -> None:
    """Play all games of a plan, after a check of each entry.

    Args:
        done: the tournament; gets the results.
        play: runs the games.
        take: called with the place of each contest that has ended, and with None after the checks.

    Raises:
        SetupError: fewer than two entries can play.
    """
    _check(done, play)
    take(None)
    first = 0
    for contests in _rounds(done):
        _play_round(done, dict(enumerate(contests, first)), play, take)
        first += len(contests)


def _rounds(done: Tournament) -> Iterator[list[Contest]]:
    """Yield the contests of each round; those of the Swiss system follow from the standings."""
    plan, entries = done.plan, done.admitted
    if plan.sides.is_race:
        yield [Contest(seed, tuple(entries), is_race=True) for seed in plan.seeds]
    elif plan.system == "round-robin":
        yield [
            Contest(seed, pair, is_race=False)
            for seed in plan.seeds
            for pair in combinations(entries, 2)
        ]
    else:
        by_name = {entry.name: entry for entry in entries}
        for _ in range(plan.rounds_for(len(entries))):
            pairs = _swiss_pairs(done.standings)
            yield [
                Contest(seed, (by_name[one.name], by_name[other.name]), is_race=False)
                for seed in plan.seeds
                for one, other in pairs
            ]


def _swiss_pairs(order: Sequence[Standing]) -> list[tuple[Standing, Standing]]:
    """Return neighbours in the standings who have not met.

    With an odd number of entries, the lowest one that has played most rests.
    """
    by_score = sorted(order, key=lambda standing: (-standing.score, -standing.mu, standing.name))
    if len(by_score) % 2:
        most = max(len(standing.against) for standing in by_score)
        resting = [standing for standing in by_score if len(standing.against) == most][-1]
        by_score.remove(resting)
    return _unmet_pairs(by_score) or list(zip(by_score[::2], by_score[1::2], strict=True))


def _unmet_pairs(order: list[Standing]) -> list[tuple[Standing, Standing]]:
    """Pair the first one with the next it has not met, and so on; empty if that can't be done."""
    if not order:
        return []
    first, *others = order
    for other in others:
        if other.name in first.against:
            continue
        left = [each for each in others if each is not other]
        rest = _unmet_pairs(left)
        if rest or not left:
            return [(first, other), *rest]
    return []


def _check(done: Tournament, play: Play) -> None:
    """Let each entry play against itself, and refuse those that fail."""
    plan = done.plan
    count = len(plan.sides.names)
    jobs = {each.name: game_job(plan.scene, CHECK_SEED, [each] * count) for each in plan.entries}
    outcomes = {outcome.job.key: outcome for outcome in play([*jobs.values()])}
    for name, job in jobs.items():
        outcome = outcomes[job.key]
        reason = outcome.error or unpacked(outcome.result["reason"])
        if reason:
            done.refused[name] = reason
    if len(done.admitted) < 2:
        told = join([join(pair, ": ") for pair in done.refused.items()], "; ")
        raise SetupError(_("expected two entries that can play at least; {told}", told=told))


def _play_round(
    done: Tournament,
    waiting: dict[int, Contest],
    play: Play,
    take: Callable[[int | None], object],
) -> None:
    """Play contests, by their place in the schedule, and take each as soon as its games ended."""
    outcomes: dict[str, JobOutcome] = {}
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
                take(place)


def _take(done: Tournament, place: int, contest: Contest, ended: Sequence[JobOutcome]) -> None:
    """Add a contest's result."""
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
        told = dict(outcome.result) | {"reason": str(unpacked(outcome.result["reason"]))}
        has_recording = bool(told.pop("episode"))
        games.append(
            {
                "file": file if has_recording else "",
                "seed": contest.seed,
                "entries": names,
                "job": outcome.job.key,
            }
            | told
        )


def _write_recordings(done: Tournament, place: int) -> None:
    for file, data in done.recordings(place):
        path = done.folder / GAMES / file
        path.parent.mkdir(exist_ok=True)
        if not path.exists() or path.read_bytes() != data:
            write_atomically(path, data)


def files_of(done: Tournament) -> dict[str, bytes]:
    """Return all files that follow from plan and results, by their path in the folder."""
    recordings = (each for place in sorted(done.files) for each in done.recordings(place))
    return {
        PLAN: done.plan.text.encode(),
        **{f"{GAMES}/{name}": data for name, data in recordings},
        LIST: (json.dumps(done.games, indent=1) + "\n").encode(),
        TABLE: _table(done).encode(),
        PAGE: page_of(done).encode(),
    }


def _table(done: Tournament) -> str:
    head = ["place", "name", "rating", "uncertainty", "provisional"]
    head += ["won", "drawn", "lost", "forfeits", "points"]
    rows = (
        [
            *(place, each.name, f"{each.mu:.6g}", f"{each.sigma:.6g}", each.is_provisional),
            *(each.won, each.drawn, each.lost, each.forfeits, f"{each.points:.6g}"),
        ]
        for place, each in enumerate(done.standings, 1)
    )
    return csv_table(head, rows)


def sums_of(files: Mapping[str, bytes]) -> bytes:
    """Return the hashes of files, as ``sha256sum`` writes them.

    Args:
        files: content by path.
    """
    hashes = (f"{hashlib.sha256(data).hexdigest()}  {name}" for name, data in files.items())
    return "".join(f"{each}\n" for each in sorted(hashes, key=lambda line: line[66:])).encode()


def write_results(done: Tournament) -> None:
    """Write the list of games, the standings, the page, and the hashes of all files."""
    files = files_of(done)
    for name in (LIST, TABLE, PAGE):
        write_atomically(done.folder / name, files[name])
    journal = done.folder / JOURNAL
    if journal.is_file():
        files[JOURNAL] = journal.read_bytes()
    write_atomically(done.folder / SUMS, sums_of(files))


def _file_part(name: str) -> str:
    """Return a name as a part of a file's name, whose length most systems limit to 255 bytes."""
    return re.sub(r"[^\w.-]", "_", name).encode()[:MAX_FILE_PART_BYTES].decode(errors="ignore")

"""Verification of a tournament: all of its folder is made again from the plan, and compared."""

import base64
import json
import os
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from ai4u_edu.base.errors import AI4UError, SetupError, shorten, text_of
from ai4u_edu.games.jobs import Engine, Job, JobOutcome, run_jobs
from ai4u_edu.games.jobs.journal import FILE as JOURNAL
from ai4u_edu.games.jobs.journal import line_of, read_line
from ai4u_edu.games.tournament.drivers import ANSWERS
from ai4u_edu.games.tournament.game import result_fault
from ai4u_edu.games.tournament.limits import is_over_time
from ai4u_edu.games.tournament.plan import TournamentPlan
from ai4u_edu.games.tournament.run import GAMES, LIST, PAGE, SUMS, files_of, play_all, sums_of
from ai4u_edu.games.tournament.tournament import Tournament
from ai4u_edu.locale import SOURCE, join, known_language, reader
from ai4u_edu.locale import gettext as _
from ai4u_edu.recording import Episode, Replay
from ai4u_edu.recording.episode import decode

RESULT = ("points", "goal", "ticks", "forfeit", "reason")
MAX_VALUE_CHARS = 120
PROGRAM = "python"
"""Kind of the drivers that are not run again."""


def verify(
    folder: Path, engine: Engine, tell: Callable[[], object] = lambda: None
) -> tuple[int, list[str]]:
    """Make all results of a tournament again from its plan, and compare them with the folder.

    Which games there are, their sides and seeds follow from the plan. Networks, scripts and
    recordings decide again; of a program, which is not run, the recorded answers are taken, and
    the sentence with which it failed. So are those of a network that was too slow, if it is again.
    Standings and page follow from the games, the page in the language that it has there; each file
    has to be the same, bit for bit.

    Args:
        folder: the tournament's.
        engine: runs the games.
        tell: called after each game.

    Returns:
        The number of games, and a sentence for each game and each file that differs.

    Raises:
        SetupError: there is no finished tournament in the folder.
    """
    plan = TournamentPlan.load(folder)
    if not (folder / LIST).is_file():
        raise SetupError(
            _(
                "{folder}: expected a finished tournament, and there is no {list}; go on "
                "with it: ai4u-edu tournament --resume --out {folder}",
                folder=str(folder),
                list=LIST,
            )
        )
    return _Verification(plan, folder, engine, tell).run()


class _Verification:
    def __init__(
        self, plan: TournamentPlan, folder: Path, engine: Engine, tell: Callable[[], object]
    ) -> None:
        self._plan, self._folder = plan, folder
        self._engine, self._tell = engine, tell
        self._problems: list[str] = []
        self._outcomes: dict[str, JobOutcome] = {}
        self._wrong: set[str] = set()
        """Keys of the jobs of games that are reported to differ."""
        self._there = dict(self._read(folder))
        self._lines = self._journal()
        self._claims = self._claimed()

    def run(self) -> tuple[int, list[str]]:
        """Return the number of games, and what differs."""
        done = Tournament(self._plan, self._folder)
        play_all(done, self._play)
        with reader(self._language()):
            expected = files_of(done)
        if JOURNAL in self._there:  # some of it is measured: how long, and how often it was tried
            expected[JOURNAL] = self._there[JOURNAL]
        expected[SUMS] = sums_of(expected)
        compared = self._compare_games(done)
        self._compare_journal()
        for name in sorted(expected.keys() - compared):
            if name not in self._there:
                self._problems.append(_("{name}: it is missing", name=name))
            elif self._there[name] != expected[name]:
                self._problems.append(
                    _("{name}: it is another one than the plan and its games give", name=name)
                )
        for name in sorted(self._there.keys() - expected.keys()):
            self._problems.append(_("{name}: it is no file of this tournament", name=name))
        for contest in done.results:
            if contest.error:
                names, seed = " vs ".join(contest.contest.names), contest.contest.seed
                self._problems.append(
                    _(
                        "a game ({names}, seed {seed}): {problem}",
                        names=names,
                        seed=seed,
                        problem=contest.error,
                    )
                )
        return len(done.games), self._problems

    def _language(self) -> str:
        """Return the language of the folder's page, which whoever played it had."""
        found = re.match(
            rb'<!doctype html>\s*<html lang="([\w-]{2,20})"', self._there.get(PAGE, b"")
        )
        return known_language(found[1].decode() if found else "") or SOURCE

    # -- what the folder says ----------------------------------------------------------------------

    def _read(self, folder: Path, place: str = "") -> Iterator[tuple[str, bytes]]:
        """Yield path and content of each file; links lead elsewhere, and are none."""
        for entry in sorted(os.scandir(folder), key=lambda entry: entry.name):
            name = place + entry.name
            if entry.is_dir(follow_symlinks=False) and name == GAMES:
                yield from self._read(folder / GAMES, f"{GAMES}/")
            elif not entry.is_file(follow_symlinks=False):
                self._problems.append(_("{name}: expected a file of the tournament", name=name))
            else:
                try:
                    yield name, Path(entry.path).read_bytes()
                except OSError as error:
                    self._problems.append(
                        _("{name}: can't be read: {reason}", name=name, reason=error.strerror or "")
                    )

    def _journal(self) -> list[Any]:
        """Return the lines of the journal."""
        lines = []
        for number, line in enumerate(self._there.get(JOURNAL, b"").splitlines(), 1):
            try:
                lines.append(read_line(line))
            except ValueError as error:
                self._problems.append(
                    _(
                        "{journal}, line {number}: expected a job, got: {problem}",
                        journal=JOURNAL,
                        number=number,
                        problem=text_of(error),
                    )
                )
        return lines

    def _claimed(self) -> dict[str, dict[str, Any]]:
        """Return the results of the games by the keys of their jobs, as the folder has them."""
        claims: dict[str, Any] = {}
        for each in self._listed():
            told = {name: each.get(name) for name in RESULT}
            data = self._there.get(f"{GAMES}/{each.get('file')}", b"")
            claims[str(each.get("job"))] = told | {"episode": base64.b64encode(data).decode()}
        claims |= {each["key"]: each["result"] for each in self._lines if not each["error"]}
        sides = len(self._plan.sides.names)
        return {key: told for key, told in claims.items() if not result_fault(told, sides)}

    def _listed(self) -> list[dict[str, Any]]:
        """Return the list of games; empty if it is none."""
        try:
            listed = json.loads(self._there[LIST])
        except (ValueError, KeyError, RecursionError):
            return []
        is_list = isinstance(listed, list) and all(isinstance(each, dict) for each in listed)
        return listed if is_list else []

    # -- the games ---------------------------------------------------------------------------------

    def _play(self, jobs: Sequence[Job]) -> Iterator[JobOutcome]:
        """Play games again, and yield their outcomes."""
        slow: list[Job] = []
        for outcome in self._run(jobs, {}):
            if self._is_slow_again(outcome):
                slow.append(outcome.job)
            else:
                yield outcome
        sides = {job.key: int(self._claims[job.key]["forfeit"]) for job in slow}
        yield from self._run(slow, sides)

    def _run(self, jobs: Sequence[Job], sides: Mapping[str, int]) -> Iterator[JobOutcome]:
        """Run jobs with recorded answers in place of programs, and of a side of some jobs.

        Args:
            jobs: the games.
            sides: index of the side, by the job's key.
        """
        originals: dict[str, list[Job]] = {}
        playing = []
        for job in {job.key: job for job in jobs}.values():
            again = self._again(job, sides.get(job.key, -1))
            if again is None:
                yield self._ended(
                    JobOutcome(
                        job, error=_("{journal} has no result of this game", journal=JOURNAL)
                    )
                )
                continue
            originals.setdefault(again.key, []).append(job)
            playing.append(again)
        for outcome in run_jobs(playing, self._engine):
            for job in originals[outcome.job.key]:
                yield self._ended(replace(outcome, job=job))

    def _ended(self, outcome: JobOutcome) -> JobOutcome:
        self._outcomes[outcome.job.key] = outcome
        self._tell()
        return outcome

    def _again(self, job: Job, side: int) -> Job | None:
        """Return the job of a game with recorded answers; None if there are none."""
        claim = self._claims.get(job.key)
        entries = []
        for index, entry in enumerate(job.arguments["entries"]):
            reason = claim["reason"] if claim is not None and index == claim["forfeit"] else ""
            drivers = dict(entry["drivers"])
            for part, driver in drivers.items():
                if driver["kind"] == PROGRAM or index == side:
                    if claim is None:
                        return None
                    drivers[part] = {"kind": ANSWERS, "data": claim["episode"], "reason": reason}
            entries.append({**entry, "drivers": drivers})
        return Job(job.function, {**job.arguments, "entries": entries})

    def _is_slow_again(self, outcome: JobOutcome) -> bool:
        """Return True if a side took too much time as the folder says, but not in the same way."""
        claim, now = self._claims.get(outcome.job.key), outcome.result
        return (
            claim is not None
            and now is not None
            and now != claim
            and now["forfeit"] == claim["forfeit"]
            and is_over_time(now["reason"])
            and is_over_time(claim["reason"])
        )

    # -- comparison --------------------------------------------------------------------------------

    def _compare_games(self, done: Tournament) -> set[str]:
        """Compare list and recordings game by game; return the names of the compared files."""
        listed, games = self._listed(), done.games
        data = dict(each for place in done.files for each in done.recordings(place))
        if len(listed) != len(games):
            self._problems.append(
                _(
                    "{list}: it has {n} games, and the plan has {n2}",
                    list=LIST,
                    n=len(listed),
                    n2=len(games),
                )
            )
        before = len(self._problems)
        for number, now in enumerate(games):
            told = listed[number] if len(listed) == len(games) else now
            why = _difference(told, now) or self._wrong_recording(now["file"], data)
            if why:
                self._wrong.add(now["job"])
                names = " vs ".join(now["entries"])
                self._problems.append(
                    _(
                        "game {number} ({names}, seed {seed}): {why}",
                        number=number + 1,
                        names=names,
                        seed=now["seed"],
                        why=why,
                    )
                )
        is_told = len(listed) != len(games) or len(self._problems) > before
        return {f"{GAMES}/{name}" for name in data} | ({LIST} if is_told else set[str]())

    def _wrong_recording(self, file: str, expected: Mapping[str, bytes]) -> str:
        """Return why a recording is another one than it should be; empty if it is not."""
        if not file:
            return ""
        data = self._there.get(f"{GAMES}/{file}")
        if data is None:
            return _("{file} is missing", file=file)
        if data == expected[file]:
            return ""
        try:
            verdict = Replay(decode(Episode, data, file)).verdict
        except AI4UError as error:
            return text_of(error)
        return join([file, verdict.why or _("it is another game than the entries play now")], ": ")

    def _compare_journal(self) -> None:
        """Compare the journal line by line, but for what is measured."""
        if JOURNAL not in self._there:
            return
        seen, why = set[str](), ""
        for number, line in enumerate(self._lines, 1):
            outcome = self._outcomes.get(line["key"])
            if outcome is None:
                why = _("it is no game of this tournament")
            elif line["error"] or line["key"] in self._wrong:
                why = ""
            elif line["key"] in seen:
                why = _("this game has a result already")
            else:
                why = _difference(line, line_of(outcome), ("function", "arguments", "result"))
            if why:
                self._problems.append(
                    _("{journal}, job {number}: {why}", journal=JOURNAL, number=number, why=why)
                )
            if not line["error"]:
                seen.add(line["key"])
        missing = [each for each in self._outcomes.values() if each.job.key not in seen]
        if missing:
            self._problems.append(
                _("{journal}: {n} games have no result", journal=JOURNAL, n=len(missing))
            )


def _difference(
    told: Mapping[str, Any], now: Mapping[str, Any], names: Sequence[str] | None = None
) -> str:
    """Return what differs between what the folder says and what is true now."""
    for name in now if names is None else names:
        if told.get(name) != now[name]:
            values = told.get(name), now[name]
            then, here = (shorten(repr(each), MAX_VALUE_CHARS) for each in values)
            return _(
                "{name}: the folder says {then}, and now it is {here}",
                name=name,
                then=then,
                here=here,
            )
    return ""

"""Answers that act by the clock, for the checks: ``python -m tests.lessons.by_the_clock``.

A solution is driven by readings, or replaced by actions, that come from a schedule: some
decisions of one value, some of another, and so on. A search looks for a schedule that passes the
check, which a robot must not do that never looks at its world. Numbers of exercises may follow
(``06 07.2``), and ``--tries 200``.
"""

import math
import os
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import redirect_stdout
from dataclasses import dataclass, field
from functools import wraps
from io import StringIO
from itertools import groupby
from typing import Any

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.blocks import Controller, LocalBrain
from ai4u_edu.blocks.brains.controllers.script import ScriptController
from ai4u_edu.lessons.answers import answers_to
from ai4u_edu.lessons.course import exercise_ids, is_ticket, lesson
from ai4u_edu.lessons.rollouts import Drive, observed
from tests.lessons.workbook import SLOW, tried

MAX_VALUES = 6
"""Values of a reading, or actions, of which a schedule is made; more are thinned out."""
MIN_DECISIONS = 60
"""Decisions of a check below which an answer is no robot's driver."""
MAX_DURATION = 400
ACTION = "action"
"""Name of what a schedule replaces, if it is the action and no reading."""
SETTLED = ("00.", "08.")
"""Beginnings of the exercises in which a plan by the clock is a right answer."""
TWO_ROBOTS = ("21.4",)
"""Exercises in which two robots are driven at once, whose percepts have different keys."""


@dataclass(frozen=True)
class Schedule:
    """Values and the decisions for which each of them holds."""

    segments: tuple[tuple[int, int], ...]
    """Index of a value, and a number of decisions."""
    repeats: bool
    """True begins again after the last segment, False keeps its value."""

    def index_at(self, decision: int) -> int:
        """Return the index of the value that holds in a decision."""
        total = sum(duration for _, duration in self.segments)
        decision = decision % total if self.repeats else decision
        for index, duration in self.segments:
            decision -= duration
            if decision < 0:
                return index
        return self.segments[-1][0]


@dataclass
class Recorder:
    """Records what a solution's driver sees and does in a check."""

    episodes: list[list[tuple[Mapping[str, Any], Any]]] = field(default_factory=list)
    read: set[str] = field(default_factory=set)
    """Keys of the readings that the solution looked at."""

    def watch(self, drive: Drive) -> None:
        """Note the beginning of an episode."""
        if drive.steps == 0:
            self.episodes.append([])

    def decide(self, decide: Callable[[Any], Any], percept: Any) -> Any:
        """Ask the solution, and note percept and action."""
        action = decide(_Noted(self.read, percept))
        if self.episodes:
            self.episodes[-1].append((dict(percept), action))
        return action


class _Noted(dict[str, Any]):
    """Percept that notes which readings are looked at."""

    def __init__(self, read: set[str], percept: Mapping[str, Any]) -> None:
        super().__init__(percept)
        self._read = read

    def __getitem__(self, key: str) -> Any:
        self._read.add(key)
        return super().__getitem__(key)


@dataclass
class Clock:
    """Drives by a schedule, and counts how far a check gets."""

    values: Sequence[Mapping[str, Any]]
    """Readings by key, or the action under ``ACTION``, between which it changes."""
    schedule: Schedule
    decision: int = 0
    episodes: int = 0
    decisions: int = 0

    def watch(self, drive: Drive) -> None:
        """Begin to count again in each episode."""
        if drive.steps == 0:
            self.decision, self.episodes = 0, self.episodes + 1

    def decide(self, decide: Callable[[Any], Any], percept: Any) -> Any:
        """Return the scheduled action, or the solution's for scheduled readings."""
        value = self.values[self.schedule.index_at(self.decision)]
        self.decision += 1
        self.decisions += 1
        return value[ACTION] if ACTION in value else decide({**percept, **value})


def driven_by(driver: Recorder | Clock, thing: Any) -> Any:
    """Return a student's function, controller or agent whose decisions go through a driver."""
    if isinstance(thing, type) and issubclass(thing, Controller) and "get_action" in vars(thing):
        asked = vars(thing)["get_action"]

        def get_action(self: Any, percept: Any) -> Any:
            return driver.decide(lambda seen: asked(self, seen), percept)

        thing.get_action = get_action  # type: ignore[method-assign]
    elif getattr(getattr(thing, "__code__", None), "co_varnames", ())[:1] == ("percept",):

        @wraps(thing)
        def function(percept: Any) -> Any:
            return driver.decide(thing, percept)

        return function
    elif isinstance(thing, BasicAgent) and thing.brains:
        controller = getattr(thing.brains[0], "controller", None)
        if isinstance(controller, ScriptController):
            asks = driven_by(driver, controller.function)
            return thing.changed(brains=[LocalBrain(controller=asks)])
    return thing


def passes(exercise: str, driver: Recorder | Clock, code: str) -> bool:
    """Return True if an answer passes its check with that driver."""
    with redirect_stdout(StringIO()), observed(driver.watch):
        change = lambda thing: driven_by(driver, thing)  # noqa: E731 - of two arguments
        return tried(lesson(exercise[:2]), exercise, code, change).passed


def survivor(exercise: str, tries: int, seed: int = 0) -> str:
    """Return a schedule that passes an exercise's check, in words; empty if none was found."""
    solution, *others = [each.code for each in answers_to(exercise).all if each.is_right]
    recorder = Recorder()
    assert passes(exercise, recorder, solution), exercise
    for other in others:  # what one of them does without need not be looked at
        second = Recorder()
        passes(exercise, second, other)
        recorder.read &= second.read or recorder.read
    rng = np.random.default_rng(seed)
    recorder.episodes = [episode for episode in recorder.episodes if episode]
    if sum(map(len, recorder.episodes)) < MIN_DECISIONS:
        return ""
    for values, seen in _replaceable(recorder):
        if len(values) < 2:
            continue
        best, best_score = None, (-1, -1)
        begin = _begin(seen)
        for _ in range(tries):
            schedule = next(begin, None) or _other(best, len(values), rng)
            clock = Clock(values, schedule)
            if passes(exercise, clock, solution):
                return f"{schedule} of {values}"
            score = clock.episodes, clock.decisions
            if score >= best_score:
                best, best_score = schedule, score
    return ""


def _replaceable(recorder: Recorder) -> Iterator[tuple[list[Any], list[list[int]]]]:
    """Yield what a schedule may give, and which of these values came in each episode.

    A value is the reading of one or more sensors, by key, or the action. Two eyes, or the bearings
    of two posts, come from a schedule together only: a robot that looks with one of them looks.
    """
    episodes = recorder.episodes
    read = [key for key in episodes[0][0][0] if key in recorder.read]
    families = [tuple(other for other in read if _are_siblings(key, other)) for key in read]
    groups = dict.fromkeys(families)
    groups |= dict.fromkeys((key,) for key in read if _is_few(episodes, key))
    for group in groups:
        yield _few([[{key: seen[key] for key in group} for seen, _ in each] for each in episodes])
    yield _few([[{ACTION: action} for _, action in episode] for episode in episodes])


def _are_siblings(one: str, other: str) -> bool:
    """Return True for keys that differ in one word at most, such as "to red" and "to blue"."""
    words = list(zip(one.split(), other.split(), strict=False))
    differ = sum(first != second for first, second in words)
    return one == other or (len(one.split()) == len(other.split()) > 1 and differ == 1)


def _is_few(episodes: list[list[tuple[Mapping[str, Any], Any]]], key: str) -> bool:
    shown = {_shown(seen[key]) for episode in episodes for seen, _ in episode}
    return len(shown) <= MAX_VALUES


def _few(episodes: list[list[Any]]) -> tuple[list[Any], list[list[int]]]:
    """Return some values that stand for all, and the index of the nearest one for each."""
    known: dict[str, Any] = {}
    for value in (value for episode in episodes for value in episode):
        known.setdefault(_shown(value), value)
    ordered = sorted(known.values(), key=lambda value: tuple(_flat(value)))
    if len(ordered) > MAX_VALUES:
        places = np.linspace(0, len(ordered) - 1, MAX_VALUES).round().astype(int)
        ordered = [ordered[place] for place in places]
    rows = [_flat(value) for value in ordered]

    def nearest(value: Any) -> int:
        row = _flat(value)
        sizes = [math.dist(row, other) if len(row) == len(other) else math.inf for other in rows]
        return sizes.index(min(sizes))

    return ordered, [[nearest(value) for value in episode] for episode in episodes]


def _flat(value: Any) -> list[float]:
    if isinstance(value, Mapping):
        return [number for part in value.values() for number in _flat(part)]
    return [float(number) for number in np.ravel(value)]


def _shown(value: Any) -> str:
    return repr([round(number, 3) for number in _flat(value)])


def _begin(episodes: list[list[int]]) -> Iterator[Schedule]:
    """Yield the solution's own schedules, as they came in some worlds."""
    for episode in episodes[:3]:
        runs = tuple((index, len(list(run))) for index, run in groupby(episode))
        if runs:
            yield Schedule(runs, repeats=False)
            yield Schedule(runs[:4], repeats=True)


def _other(schedule: Schedule | None, values: int, rng: np.random.Generator) -> Schedule:
    """Return a schedule at random, or one that is a little different."""
    if schedule is None or rng.random() < 0.4:
        count = int(rng.integers(2, 5))
        durations = np.exp(rng.uniform(0, math.log(MAX_DURATION), count)).round().astype(int)
        drawn = rng.integers(0, values, count)
        pairs = zip(drawn.tolist(), durations.tolist(), strict=True)
        return Schedule(tuple(pairs), repeats=bool(rng.random() < 0.7))
    segments = list(schedule.segments)
    place = int(rng.integers(len(segments)))
    index, duration = segments[place]
    if rng.random() < 0.2:
        index = int(rng.integers(values))
    segments[place] = index, max(1, round(duration * math.exp(rng.normal(0, 0.4))))
    return Schedule(tuple(segments), schedule.repeats)


def drivers() -> list[str]:
    """Return the exercises in which a robot's driver is handed in, and must look at its world."""
    return [
        exercise
        for exercise in exercise_ids()
        if not is_ticket(exercise)
        and exercise not in (*SLOW, *TWO_ROBOTS)
        and not exercise.startswith(SETTLED)
        if "percept" in answers_to(exercise).solution
    ]


def main() -> None:
    """Print the schedules that pass."""
    os.environ["AI4U_FAST"] = "1"
    arguments = sys.argv[1:]
    tries = int(arguments.pop(arguments.index("--tries") + 1)) if "--tries" in arguments else 40
    wanted = tuple(each for each in arguments if not each.startswith("-"))
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for exercise in drivers():
            if not wanted or exercise.startswith(wanted):
                print(f"{exercise}: {survivor(exercise, tries)}", flush=True)


if __name__ == "__main__":
    main()

"""Exercises whose answer is a function that is called, wherever it runs.

Such an exercise's judge is a generator: it yields the arguments of a call, receives what the
student's function returned, and returns when all is right. A notebook calls the function itself;
the page of a mission calls it in the browser, so that no student's code runs on a server::

    @function_exercise("01.4", "How many are near?", hints={...})
    def counts_the_near_ones(chance):
        for distances in ([1.0, 3.0], [2.5]):
            found = finite_number((yield (distances,)))
            ...
        return "Every count was right."
"""

import json
import math
import zlib
from collections.abc import Callable, Generator, Mapping
from functools import wraps
from typing import Any, NamedTuple

import numpy as np

from ai4u_edu.base.syntax import parsed
from ai4u_edu.lessons.course import lesson
from ai4u_edu.lessons.exercise import Done, NotYet, a_function, enter, find
from ai4u_edu.lessons.notebook import Cell
from ai4u_edu.lessons.numeric import chance_for

Calls = Generator[tuple[Any, ...], Any, "str | Done"]
"""Yields the arguments of a call; receives its value."""
CallsJudge = Callable[[np.random.Generator], Calls]
"""Function from the generator of an exercise's numbers to its calls."""
MAX_VALUE_DEPTH = 12
"""Depth to which a value from a page is read; its own limit is lower."""
JUDGES: dict[str, CallsJudge] = {}
"""Judges by the id of the exercise."""


def function_exercise(
    exercise_id: str, title: str, *, hints: Mapping[str, str]
) -> Callable[[CallsJudge], CallsJudge]:
    """Register a generator as the check of an exercise.

    Args:
        exercise_id: the lesson's number, a point, the exercise's number.
        title: a few words.
        hints: hints by name of the diagnosis; at least one.
    """

    def register(judge: CallsJudge) -> CallsJudge:
        @wraps(judge)
        def judge_function(made: Any) -> str | Done:
            function = a_function(made)
            calls = judge(chance_for(exercise_id, function))
            return call_all(calls, function)

        JUDGES[exercise_id] = judge
        enter(exercise_id, title, judge_function, hints)
        return judge

    return register


def call_all(calls: Calls, function: Callable[..., Any]) -> str | Done:
    """Call a function as a judge asks, and return what it says.

    Raises:
        NotYet: it is not right yet.
    """
    try:
        arguments = next(calls)
        while True:
            arguments = calls.send(function(*arguments))
    except StopIteration as end:
        result: str | Done = end.value
        return result


class Judged(NamedTuple):
    """The opinion of a judge."""

    passed: bool
    text: str
    hint: str = ""
    """Hint for the mistake; empty if it is not known."""


class RemoteCalls:
    """Calls of an exercise's function that runs elsewhere, in a page.

    Args:
        exercise_id: one of :data:`JUDGES`.
        source: the student's text, which seeds the numbers; it is not run.

    >>> calls = RemoteCalls("01.1", "def speed_for(distance, seconds): ...")
    >>> calls.arguments
    '[6, 3]'
    >>> calls.answer("2")
    >>> calls.arguments
    '[6, 2]'
    """

    def __init__(self, exercise_id: str, source: str) -> None:
        self.exercise = find(exercise_id)
        seed = zlib.crc32(f"{exercise_id}|{source}".encode())
        self._calls = JUDGES[exercise_id](np.random.default_rng(seed))
        self.arguments = ""
        """Arguments of the next call, as the page's Python reads them; empty if there is none."""
        self.judged = Judged(False, "")
        """The verdict, once there is no call left."""
        self._go_on(lambda: next(self._calls))

    def answer(self, value: str) -> None:
        """Give the judge what the function returned, as the page's Python wrote it."""
        try:
            read = _decoded(json.loads(value), MAX_VALUE_DEPTH)
        except (ValueError, RecursionError):
            read = _Shown(value[:80])
        self._go_on(lambda: self._calls.send(read))

    def _go_on(self, step: Callable[[], tuple[Any, ...]]) -> None:
        self.arguments = ""
        try:
            self.arguments = json.dumps([_encoded(each) for each in step()])
        except StopIteration as end:
            result: str | Done = end.value
            self.judged = Judged(True, result if isinstance(result, str) else result.text)
        except NotYet as reason:
            hint = self.exercise.hints.get(reason.hint, "")
            self.judged = Judged(False, reason.text, hint)


def starting_text(exercise_id: str) -> str:
    """Return the cell of an exercise as a student gets it, with what the lesson imports for it."""
    first = next(cell for cell in _cells(exercise_id) if "setup" in cell.tags)
    imports = "import math\n\n\n" if "\nimport math\n" in f"\n{first.source}" else ""
    return f"{imports}{_cell(exercise_id).source.strip()}"


def function_name(exercise_id: str) -> str:
    """Return the name of the function that a student writes."""
    first, *_ = (
        each.name for each in parsed(_cell(exercise_id).source).body if hasattr(each, "name")
    )
    return str(first)


def _cell(exercise_id: str) -> Cell:
    return next(cell for cell in _cells(exercise_id) if cell.exercise == exercise_id)


def _cells(exercise_id: str) -> list[Cell]:
    return lesson(exercise_id.partition(".")[0]).cells


def _encoded(value: Any) -> Any:
    """Return an argument as ``host.call`` reads it."""
    if isinstance(value, np.ndarray):
        return {"array": value.tolist()}
    if isinstance(value, Mapping):
        return {"percept": {key: np.asarray(each).tolist() for key, each in value.items()}}
    return value.item() if isinstance(value, np.generic) else value


class _Shown:
    """A value that a page can't send: it is shown in sentences, and never right."""

    def __init__(self, text: str) -> None:
        self._text = text

    def __repr__(self) -> str:
        return self._text


def _decoded(value: Any, depth: int) -> Any:
    """Return a function's value from what ``host.encoded`` made of it, or from anything else."""
    if depth == 0:
        return _Shown("...")
    if isinstance(value, list):
        return [_decoded(each, depth - 1) for each in value]
    if not isinstance(value, dict):
        return value
    if "number" in value:
        return {"inf": math.inf, "-inf": -math.inf}.get(str(value["number"]), math.nan)
    pairs = value.get("table")
    if isinstance(pairs, list) and all(isinstance(each, list) and len(each) == 2 for each in pairs):
        return {str(key): _decoded(each, depth - 1) for key, each in pairs}
    text = str(value.get("shown", ""))[:200]
    return ... if text == "Ellipsis" else _Shown(text)

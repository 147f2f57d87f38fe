"""``check``, ``hint``, ``solution`` and ``progress``, for students."""

import ast
import reprlib
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from ai4u_edu.base.syntax import parsed
from ai4u_edu.lessons.answers import answers_to
from ai4u_edu.lessons.class_membership import class_trouble, report_event
from ai4u_edu.lessons.course import is_ticket, lesson, lessons
from ai4u_edu.lessons.diagnoses import COMMON, UNKNOWN, diagnosis_id
from ai4u_edu.lessons.exercise import Done, Exercise, NotYet, find, unfinished
from ai4u_edu.lessons.notebook_output import cells_so_far, tell
from ai4u_edu.lessons.progress_file import ExerciseProgress, ProgressFile
from ai4u_edu.lessons.student_errors import Mistake, line_of, mistake_in
from ai4u_edu.lessons.time_limit import TimeLimit, TimeLimitError
from ai4u_edu.lessons.translation import translated_code, translated_title
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join, translate

YES, NO = "\u2714", "\u2013"
NONE_GIVEN = _(
    "What you handed in is None: nothing. Give the function's name without brackets after it. If "
    "it is what a function returned, that function lacks a `return`."
)
READ_AGAIN = _(
    "The lesson's text answers all three questions: read the part again that the question is about."
)
NO_SOLUTION = _(
    "An exit ticket has no solution to print, since it is there to find out what you know."
)
UNFINISHED = _("There is still `...` where your answer should be: run its cell once you wrote it.")


@dataclass(frozen=True)
class CheckResult:
    """Result of a check."""

    passed: bool
    text: str
    hint: str = ""
    """Name of the diagnosis, whose hint helps."""
    picture: bytes = b""


def judge(exercise: Exercise, *things: Any) -> CheckResult:
    """Run a student's work; return their exception as a sentence."""
    if not things or any(unfinished(thing) for thing in things):
        return CheckResult(False, UNFINISHED, "unfinished")
    if any(thing is None for thing in things):
        return CheckResult(False, NONE_GIVEN, "no-return")
    with TimeLimit(exercise.call_limit_s, exercise.total_limit_s) as limit:
        try:
            found = exercise.judge(*things)
        except NotYet as reason:
            return CheckResult(False, reason.text, reason.hint or UNKNOWN, reason.picture)
        except TimeLimitError:
            return CheckResult(False, limit.text, limit.diagnosis)
        except (Exception, SystemExit) as error:
            return _failed(exercise, things, error)
    done = Done(found) if isinstance(found, str) else found
    return CheckResult(True, done.text, picture=done.picture)


def check(exercise_id: str, *things: Any) -> None:
    """Check an exercise, show what is right or what happened, and save the result.

    Args:
        exercise_id: such as ``"04.2"``.
        things: what you made in the exercise's cell.

    Raises:
        SetupError: there is no such exercise.
    """
    check_as(exercise_id, *things)


def check_as(exercise_id: str, *things: Any, code: str | None = None) -> None:
    """Check an exercise as :func:`check` does, and save the code that is given, if any is.

    Raises:
        SetupError: there is no such exercise.
    """
    exercise = find(exercise_id)
    try:
        verdict = judge(exercise, *things)
    except KeyboardInterrupt as stopped:
        line = line_of(stopped)
        words = _("You stopped the check. Nothing was saved.")
        if line:
            words = _("You stopped the check ({line}). Nothing was saved.", line=line)
        tell("grey", _("Stopped."), [words])
        return
    progress = ProgressFile()
    diagnosis = diagnosis_id(exercise_id, verdict.hint, exercise.hints) if verdict.hint else ""
    progress.note(
        exercise_id,
        passed=verdict.passed,
        text=str(verdict.text),
        diagnosis=diagnosis,
        picture=verdict.picture,
        code=_written(exercise_id) if code is None else code,
    )
    report_event(exercise_id, "right" if verdict.passed else "wrong", diagnosis)
    if verdict.passed:
        colour, sign, more = "green", _("{sign} Right.", sign=YES), []
    else:
        colour, sign = "vermillion", _("Not yet.")
        stuck = _('Stuck? Run `hint("{exercise}")`.', exercise=exercise_id)
        more = [] if is_ticket(exercise_id) else [stuck]
    lines = [verdict.text, *more, *filter(None, [progress.trouble, class_trouble()])]
    tell(colour, sign, lines, verdict.picture)


def hint(exercise_id: str) -> None:
    """Show the hint that the last check pointed to; called again, the next one.

    Raises:
        SetupError: there is no such exercise.
    """
    exercise = find(exercise_id)
    diagnosis = ProgressFile().entries().get(exercise_id, ExerciseProgress()).diagnosis
    report_event(exercise_id, "hint", diagnosis)
    pointed = diagnosis.rpartition("/")[2]
    names = _hints_in_order(exercise, pointed)
    asked = _asked.get((exercise_id, pointed), 0)
    _asked[exercise_id, pointed] = asked + 1
    text = names[asked % len(names)]
    rest = len(names) - 1
    again = _('{n} more: run `hint("{exercise}")` again.', n=rest, exercise=exercise_id)
    tell("blue", _("Hint."), [text, *([again] if rest and not asked else [])])


def _hints_in_order(exercise: Exercise, pointed: str) -> list[str]:
    """Return the hints: the one that fits, the exercise's others, a neutral one at the end."""
    own = list(exercise.hints)
    if is_ticket(exercise.id):  # the sentences on other choices would leave the right one over
        return [exercise.hints[pointed if pointed in own else own[0]], READ_AGAIN]
    if pointed in own:
        start = own.index(pointed)
        return [exercise.hints[name] for name in own[start:] + own[:start]] + [COMMON[UNKNOWN]]
    first = [COMMON[pointed]] if pointed in COMMON and pointed != UNKNOWN else []
    if pointed == UNKNOWN:
        return [COMMON[UNKNOWN], *exercise.hints.values()]
    return [*first, *exercise.hints.values(), COMMON[UNKNOWN]]


_asked: dict[tuple[str, str], int] = {}


def solution(exercise_id: str) -> None:
    """Print one solution; there are others.

    Raises:
        SetupError: there is no such exercise.
    """
    if is_ticket(find(exercise_id).id):
        print(translate(join([NO_SOLUTION, READ_AGAIN])))  # noqa: T201 - as below
        return
    code = answers_to(exercise_id).solution
    print(translated_code(exercise_id, code))  # noqa: T201 - to be copied from


def progress() -> None:
    """Show which exercises are solved."""
    progress = ProgressFile()
    entries = progress.entries()
    rows: list[str] = []
    passed = total = 0
    for each in lessons():
        marks = [entries.get(name, ExerciseProgress()).passed for name in each.exercises]
        passed, total = passed + sum(marks), total + len(marks)
        named = list(zip(each.exercises, marks, strict=True))
        signs = "   ".join(f"{name} {YES if mark else NO}" for name, mark in named)
        rows.append(f"{translated_title(each)}: {signs}")
    line = _("{passed} of {total} exercises are solved.", passed=passed, total=total)
    trouble = [progress.trouble] if progress.trouble else []
    tell("blue", _("Progress."), [line, *rows, *trouble])


def _failed(exercise: Exercise, things: tuple[Any, ...], error: BaseException) -> CheckResult:
    """Return the verdict on an exception: the student's mistake, or a fault of the check."""
    mistake = mistake_in(error)
    if mistake is None:
        shown = reprlib.repr(things[0]) if len(things) == 1 else reprlib.repr(things)
        text = _(
            "The check itself has a fault: it could not try out {shown} ({kind}: {error}). Please "
            "tell your teacher.",
            shown=shown,
            kind=type(error).__name__,
            error=str(error),
        )
        return CheckResult(False, text, UNKNOWN)
    if mistake.function:
        return CheckResult(False, _parameters_of(exercise, mistake), mistake.name)
    return CheckResult(False, mistake.text, mistake.name)


def _parameters_of(exercise: Exercise, mistake: Mistake) -> str:
    """Return a sentence on a function whose parameters are not those of the exercise."""
    name = mistake.function.rpartition(".")[2]
    line = _definition_line(exercise.id, name)
    text = _(
        "`{name}` is called with other parameters than it has: {text}.",
        name=name,
        text=mistake.text,
    )
    return join([text, _("Its first line has to be `{line}`.", line=line)]) if line else text


def _written(exercise: str) -> str:
    """Return the code that was run last for an exercise; empty outside a notebook."""
    cells = lesson(exercise.partition(".")[0]).cells
    wanted = {name for cell in cells if cell.exercise == exercise for name in _made_in(cell.source)}
    return _latest(wanted, cells_so_far())


def _latest(wanted: set[str], cells: Sequence[str]) -> str:
    """Return the last cell that defines one of the names.

    >>> _latest({"go"}, ["def go(): ...", "go()", "x = 1"])
    'def go(): ...'
    """
    found = (cell for cell in reversed(cells) if wanted & _made_in(cell))
    return next(found, "")


def _made_in(code: str) -> set[str]:
    r"""Return the names that a cell defines, apart from those within a function.

    >>> sorted(_made_in("def f(): x = 1\na, b = 1, 2\nclass C: ..."))
    ['C', 'a', 'b', 'f']
    """
    try:
        statements = parsed(code).body
    except (SyntaxError, ValueError):  # such as a line that is meant for the notebook alone
        return set()
    made = set()
    for each in statements:
        if isinstance(each, ast.FunctionDef | ast.ClassDef):
            made.add(each.name)
        elif isinstance(each, ast.Assign | ast.AnnAssign):
            targets = each.targets if isinstance(each, ast.Assign) else [each.target]
            parts = [part for target in targets for part in ast.walk(target)]
            made |= {part.id for part in parts if isinstance(part, ast.Name)}
    return made


def _definition_line(exercise: str, name: str) -> str:
    """Return the line that defines a function in an exercise's cell; empty if there is none."""
    for cell in lesson(exercise.partition(".")[0]).cells:
        if cell.exercise == exercise:
            found = (line.strip() for line in cell.source.splitlines())
            return next((line for line in found if line.startswith(f"def {name}(")), "")
    return ""

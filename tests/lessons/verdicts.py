"""Tries answers to exercises on their checks: ``python -m tests.lessons.verdicts [NUMBER ...]``.

Numbers of lessons or exercises (``04 05.2``) choose what is tried; without them it is everything.
"""

import os
import sys
import tempfile
from contextlib import redirect_stdout
from io import StringIO

from ai4u_edu.lessons.answers import SampleAnswer, answers_to
from ai4u_edu.lessons.checking import CheckResult
from ai4u_edu.lessons.course import exercise_ids, is_ticket, lesson
from ai4u_edu.lessons.diagnoses import diagnosis_id
from ai4u_edu.lessons.exercise import find
from tests.lessons.workbook import try_answer


def is_as_wanted(answer: SampleAnswer, verdict: CheckResult) -> bool:
    """Return True if right answers pass, and wrong ones get their diagnosis."""
    if answer.is_right or verdict.passed:
        return answer.is_right and verdict.passed
    return answer.hint in {"", verdict.hint}


def row(exercise: str, answer: SampleAnswer, verdict: CheckResult) -> str:
    """Return a line with an answer, the diagnosis that it gets, and the check's text."""
    known = find(exercise).hints
    diagnosis = "passes" if verdict.passed else diagnosis_id(exercise, verdict.hint, known)
    text = " ".join(verdict.text.split())
    return f"{exercise} | {answer.kind} | {answer.name} | {diagnosis} | {text}"


def main() -> int:
    """Try the answers; return how many verdicts are not as they should be."""
    os.environ["AI4U_FAST"] = "1"
    chosen = tuple(sys.argv[1:]) or ("",)
    exercises = [name for name in exercise_ids() if name.startswith(chosen) and not is_ticket(name)]
    count, bad = 0, 0
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for exercise in exercises:
            for answer in answers_to(exercise).all:
                with redirect_stdout(StringIO()):
                    verdict = try_answer(lesson(exercise[:2]), exercise, answer)
                good = is_as_wanted(answer, verdict)
                count, bad = count + 1, bad + (not good)
                print(f"{'  ' if good else '! '}{row(exercise, answer, verdict)}", flush=True)
    print(f"{count} answers, {bad} with another verdict than they should get")
    return bad


if __name__ == "__main__":
    sys.exit(main())

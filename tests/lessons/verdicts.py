"""Writes the table of answers and verdicts: ``python -m tests.lessons.verdicts [--write]``.

``--write`` replaces docs/lesson-checks.md; the numbers of exercises may follow (``04 05.2``), to
try these only.
"""

import os
import sys
import tempfile
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path

from ai4u_edu.lessons.answers import SampleAnswer, answers_to
from ai4u_edu.lessons.checking import CheckResult
from ai4u_edu.lessons.course import exercise_ids, is_ticket, lesson
from ai4u_edu.lessons.diagnoses import diagnosis_id
from ai4u_edu.lessons.exercise import find
from tests.lessons.workbook import try_answer

PAGE = Path(__file__).parents[2] / "docs" / "lesson-checks.md"
MAX_TEXT_CHARS = 150
HEAD = """# Verdicts of the lessons' checks

Each row is an answer that is tried on a check: right ones, misconceptions with the
diagnosis that they get, and lucky or hard-coded ones. Made by
`python -m tests.lessons.verdicts --write`; the answers are in `lessons/answers/`.
"""


def is_as_wanted(answer: SampleAnswer, verdict: CheckResult) -> bool:
    """Return True if right answers pass, and wrong ones get their diagnosis."""
    if answer.is_right or verdict.passed:
        return answer.is_right and verdict.passed
    return answer.hint in {"", verdict.hint}


def row(exercise: str, answer: SampleAnswer, verdict: CheckResult) -> str:
    """Return a line of the table."""
    known = find(exercise).hints
    said = "passes" if verdict.passed else f"`{diagnosis_id(exercise, verdict.hint, known)}`"
    text = " ".join(verdict.text.split()).replace("|", "/")
    text = text if len(text) <= MAX_TEXT_CHARS else text[: MAX_TEXT_CHARS - 1] + "\u2026"
    return f"{beginning(exercise, answer)} {said} | {text} |"


def beginning(exercise: str, answer: SampleAnswer) -> str:
    """Return the part of a line that is known without trying the answer."""
    return f"| {exercise} | {answer.kind} | {answer.name} |"


def _rows() -> list[str]:
    """Return the table's lines."""
    return [line for line in PAGE.read_text(encoding="utf-8").splitlines() if line[2:3].isdigit()]


def _is_of(line: str, exercises: list[str]) -> bool:
    return line[2:].startswith(tuple(exercises))


def main() -> int:
    """Tries the answers; returns how many verdicts are not as they should be."""
    os.environ["AI4U_FAST"] = "1"
    wanted = [each for each in sys.argv[1:] if not each.startswith("-")]
    lines, bad = [], 0
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for exercise in exercise_ids():
            if is_ticket(exercise) or (wanted and not exercise.startswith(tuple(wanted))):
                continue
            for answer in answers_to(exercise).all:
                with redirect_stdout(StringIO()):
                    verdict = try_answer(lesson(exercise[:2]), exercise, answer)
                good = is_as_wanted(answer, verdict)
                bad += not good
                lines.append(row(exercise, answer, verdict))
                print(f"{'  ' if good else '! '}{lines[-1]}", flush=True)
    if "--write" in sys.argv:
        head = "| exercise | kind | answer | verdict | text |\n|---|---|---|---|---|\n"
        kept = [] if not wanted else [line for line in _rows() if not _is_of(line, wanted)]
        lines = sorted(
            [*kept, *lines], key=lambda line: line[2:6]
        )  # each exercise's in their order
        PAGE.write_text(HEAD + "\n" + head + "\n".join(lines) + "\n", encoding="utf-8")
    print(f"{len(lines)} answers, {bad} not as wanted")
    return bad


if __name__ == "__main__":
    sys.exit(main())

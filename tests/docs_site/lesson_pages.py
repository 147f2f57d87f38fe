"""The checks of the lessons: what each asks for, its diagnoses, and the answers tried on it."""

from collections.abc import Iterable, Iterator, Mapping

from ai4u_edu.lessons.answers import Answers, answers_to
from ai4u_edu.lessons.course import is_ticket, lessons
from ai4u_edu.lessons.diagnoses import COMMON, diagnosis_id
from ai4u_edu.lessons.exercise import Exercise, find
from tests.docs_site.staging import Staging


def add_lesson_checks(site: Staging) -> None:
    """Write the checks of all exercises under the page that introduces them."""
    site.append("lesson-checks.md", "\n".join(_page()))


def section(exercise: Exercise, answers: Answers) -> str:
    """Return an exercise's check as Markdown.

    Raises:
        ValueError: a description is missing: the title, the check's docstring, the hint of a
            diagnosis, or a diagnosis that an answer names.
    """
    description = (exercise.judge.__doc__ or "").strip()
    if not (exercise.title and description and exercise.hints):
        raise ValueError(f"exercise {exercise.id}: expected a title, a docstring and hints")
    known = exercise.hints
    rows = [
        (answer.kind, answer.name, _diagnosis(exercise, answer.hint) if answer.hint else "")
        for answer in answers.all
    ]
    return "\n".join(
        [
            f"### {exercise.id} {exercise.title}\n",
            f"{description}\n",
            *_table(("diagnosis", "hint"), _hints(exercise.id, known)),
            *_table(("kind", "answer", "diagnosis"), rows),
        ]
    )


def _page() -> Iterator[str]:
    yield "## Mistakes that may occur in every exercise\n"
    yield from _table(("diagnosis", "hint"), _hints("", COMMON))
    for lesson in lessons():
        yield f"## Lesson {lesson.number}\n"
        for name in lesson.exercises:
            if not is_ticket(name):
                yield section(find(name), answers_to(name))


def _hints(exercise: str, hints: Mapping[str, str]) -> Iterator[tuple[str, str]]:
    for name, text in hints.items():
        if not text:
            raise ValueError(f"exercise {exercise}: expected a hint of the diagnosis {name!r}")
        yield f"`{diagnosis_id(exercise, name, hints if exercise else ())}`", text


def _diagnosis(exercise: Exercise, name: str) -> str:
    if name not in {*exercise.hints, *COMMON}:
        raise ValueError(f"exercise {exercise.id}: no diagnosis is called {name!r}")
    return f"`{diagnosis_id(exercise.id, name, exercise.hints)}`"


def _table(head: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> Iterator[str]:
    """Yield the lines of a table, and an empty one."""
    for cells in (head, ("---",) * len(head), *rows):
        yield "| " + " | ".join(" ".join(cell.split()).replace("|", "\\|") for cell in cells) + " |"
    yield ""

"""The checks of the lessons: what each asks for, its diagnoses, and the answers tried on it."""

from collections.abc import Iterable, Iterator, Mapping

from ai4u_edu.lessons.answers import Answers, answers_to
from ai4u_edu.lessons.course import is_ticket, lessons
from ai4u_edu.lessons.diagnoses import COMMON, diagnosis_id
from ai4u_edu.lessons.exercise import Exercise, find
from tests.docs_site.staging import Staging


def add_lesson_checks(site: Staging) -> None:
    """Write the checks of all exercises under the page that introduces them."""
    site.append("lesson-checks.md", "\n".join(_page(site)))


def section(site: Staging, exercise: Exercise, answers: Answers) -> str:
    """Return an exercise's check as Markdown.

    Args:
        site: its language is that of titles and hints.
        exercise: the exercise.
        answers: the answers that are tried on it.

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
            f"### {exercise.id} {site.translated(exercise.title)}\n",
            f"{description}\n",
            *_hints(site, exercise.id, known),
            *_table((site.words("kind"), site.words("answer"), site.words("diagnosis")), rows),
        ]
    )


def _page(site: Staging) -> Iterator[str]:
    yield "## " + site.words("Mistakes that may occur in every exercise") + "\n"
    yield from _hints(site, "", COMMON)
    for lesson in lessons():
        yield "## " + site.words("Lesson {number}").format(number=lesson.number) + "\n"
        for name in lesson.exercises:
            if not is_ticket(name):
                yield section(site, find(name), answers_to(name))


def _hints(site: Staging, exercise: str, hints: Mapping[str, str]) -> Iterator[str]:
    """Yield the lines of the table of an exercise's hints; of the common ones without its id."""
    rows = []
    for name, text in hints.items():
        if not text:
            raise ValueError(f"exercise {exercise}: expected a hint of the diagnosis {name!r}")
        diagnosis = diagnosis_id(exercise, name, hints if exercise else ())
        rows.append((f"`{diagnosis}`", site.translated(text)))
    yield from _table((site.words("diagnosis"), site.words("hint")), rows)


def _diagnosis(exercise: Exercise, name: str) -> str:
    if name not in {*exercise.hints, *COMMON}:
        raise ValueError(f"exercise {exercise.id}: no diagnosis is called {name!r}")
    return f"`{diagnosis_id(exercise.id, name, exercise.hints)}`"


def _table(head: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> Iterator[str]:
    """Yield the lines of a table, and an empty one."""
    for cells in (head, ("---",) * len(head), *rows):
        yield "| " + " | ".join(" ".join(cell.split()).replace("|", "\\|") for cell in cells) + " |"
    yield ""

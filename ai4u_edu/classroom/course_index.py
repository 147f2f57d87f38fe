"""Index of the course for a class: exercises, and the words for each mistake."""

import re
from functools import lru_cache
from typing import NamedTuple

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.lessons.course import Lesson, course_folder, lesson, lessons
from ai4u_edu.lessons.diagnoses import COMMON, COMMON_ID, UNKNOWN
from ai4u_edu.lessons.exercise import find
from ai4u_edu.lessons.translation import translated_title
from ai4u_edu.locale import catalogue

_SHOWN_SCENE = re.compile(r'^(?:\w+ = )?show\("(\w+)"', re.MULTILINE)
GUIDE = "README.md"
"""The teacher's guide, in the course's folder."""


class LessonWorld(NamedTuple):
    """A lesson, and the world that it begins with."""

    number: str
    title: str
    scene: str
    """Name in the library; empty if the lesson shows a world of its own, or none."""


class LessonExercises(NamedTuple):
    """A lesson, and the ids of its exercises."""

    lesson: str
    title: str
    ids: list[str]


@lru_cache(maxsize=1)
def course_index() -> list[LessonExercises]:
    """Return all lessons that have exercises, in order."""
    return [
        LessonExercises(one.number, one.title.removeprefix(one.number).strip(), one.exercises)
        for one in lessons()
        if one.exercises
    ]


@lru_cache(maxsize=1)
def course_lessons() -> list[LessonWorld]:
    """Return all lessons, in order."""
    return [
        LessonWorld(one.number, one.title.removeprefix(one.number).strip(), _first_scene(one))
        for one in lessons()
    ]


def lesson_title(number: str) -> str:
    """Return a lesson's title without its number, in the reader's language."""
    return _title_in(catalogue().language, number)


@lru_cache(maxsize=100)
def _title_in(_language: str, number: str) -> str:
    # the file is read for it
    return translated_title(lesson(number)).removeprefix(number).strip()


def _first_scene(one: Lesson) -> str:
    found = (_SHOWN_SCENE.search(cell.source) for cell in one.cells)
    return next((each[1] for each in found if each), "")


@lru_cache(maxsize=1)
def known_exercises() -> frozenset[str]:
    """Return the ids of all exercises."""
    return frozenset(each for one in course_index() for each in one.ids)


def known_diagnosis(exercise: str, diagnosis: str) -> str:
    """Return a diagnosis if the course has it, else that of an unknown mistake.

    >>> known_diagnosis("04.2", "04.2/<b>"), known_diagnosis("04.2", "any/error")
    ('any/unknown', 'any/error')
    """
    place, _, name = diagnosis.partition("/")
    if place == COMMON_ID and name in COMMON:
        return diagnosis
    if place == exercise and name in find(exercise).hints:
        return diagnosis
    return f"{COMMON_ID}/{UNKNOWN}"


@lru_cache(maxsize=1000)
def words_for(exercise: str, diagnosis: str) -> tuple[str, str]:
    """Return the hint that students get for a mistake, and the guide's words to say about it."""
    name = diagnosis.partition("/")[2]
    try:
        hints = find(exercise).hints
    except AI4UError:  # of another version of the course
        return diagnosis, ""
    return {**COMMON, **hints}.get(name, diagnosis), guide_words(exercise)


def guide_words(exercise: str) -> str:
    """Return what the teacher's guide says of an exercise: its mistakes, then what to say.

    The guide's points of the lesson that name other exercises are left out.
    """
    points = _guide().get(exercise.partition(".")[0], [])
    named = [each for each in points if exercise in each]
    general = [each for each in points if not re.search(r"\b\d\d\.\d", each)]
    return "\n".join([*named, *general])


@lru_cache(maxsize=1)
def _guide() -> dict[str, list[str]]:
    """Return the points of the guide by the lesson's number.

    Mistakes that name no exercise are left out. The points stand
    below a heading for each lesson, under "Typical mistakes" and "What to say".
    """
    found: dict[str, list[str]] = {}
    text = (course_folder() / GUIDE).read_text(encoding="utf-8")
    for number, part in re.findall(r"^### (\d\d) .*\n((?:(?!#).*\n?)*)", text, re.MULTILINE):
        mistakes, _, advice = part.partition("What to say\n")
        points = [each for each in _points(mistakes) if re.search(r"\b\d\d\.\d", each)]
        found[number] = [*points, *_points(advice)]
    return found


def _points(text: str) -> list[str]:
    found = re.findall(r"^- (.*(?:\n  .*)*)", text, re.MULTILINE)
    return [" ".join(each.split()) for each in found]

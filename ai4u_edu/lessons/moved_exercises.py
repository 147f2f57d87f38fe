"""New ids of the exercises of the first course, whose progress files have version 1."""

LESSONS = {
    "01": "02",
    "02": "03",
    "03": "04",
    "04": "05",
    "05": "06",
    "06": "08",
    "07": "09",
    "08": "15",
    "09": "10",
    "10": "11",
    "11": "12",
    "12": "16",
    "13": "18",
    "14": "19",
    "15": "20",
}
EXERCISES = {"05.3": "07.1", "11.4": "13.3", "12.3": "17.4"}
"""Exercises that went to another lesson than the others of theirs."""


def moved(name: str) -> str:
    """Return the new id of an exercise, or of one of its diagnoses.

    >>> moved("03.2"), moved("12.3/late"), moved("00.1"), moved("any/no-return"), moved("")
    ('04.2', '17.4/late', '00.1', 'any/no-return', '')
    """
    exercise, slash, diagnosis = name.partition("/")
    lesson, dot, number = exercise.partition(".")
    new = EXERCISES.get(exercise, f"{LESSONS.get(lesson, lesson)}{dot}{number}")
    return f"{new}{slash}{diagnosis}"

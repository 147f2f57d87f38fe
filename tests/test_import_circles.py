"""No files import each other; imports for type checkers, and those inside functions, count too."""

from tests.imports import circles

LEFT = [
    ["ai4u_edu/lessons/exercises/lesson_11.py", "ai4u_edu/lessons/exercises/lesson_11_choice.py"],
    ["ai4u_edu/tournament/page.py", "ai4u_edu/tournament/run.py"],
]
"""Circles that are left; there may only be fewer."""


def test_no_files_import_each_other_but_those_that_are_left() -> None:
    assert circles() == LEFT

"""Source of the cell in which a student solved an exercise, found by the names it defines."""

import ast
from collections.abc import Sequence

from ai4u_edu.base.syntax import parsed
from ai4u_edu.lessons.course import lesson
from ai4u_edu.lessons.notebook_output import cells_so_far


def written(exercise: str) -> str:
    """Return the code that was run last for an exercise; empty outside a notebook."""
    cells = lesson(exercise.partition(".")[0]).cells
    wanted = {name for cell in cells if cell.exercise == exercise for name in made_in(cell.source)}
    return latest(wanted, cells_so_far())


def latest(wanted: set[str], cells: Sequence[str]) -> str:
    """Return the last cell that defines one of the names.

    >>> latest({"go"}, ["def go(): ...", "go()", "x = 1"])
    'def go(): ...'
    """
    found = (cell for cell in reversed(cells) if wanted & made_in(cell))
    return next(found, "")


def made_in(code: str) -> set[str]:
    r"""Return the names that a cell defines, apart from those within a function.

    >>> sorted(made_in("def f(): x = 1\na, b = 1, 2\nclass C: ..."))
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


def definition_line(exercise: str, name: str) -> str:
    """Return the line that defines a function in an exercise's cell; empty if there is none."""
    for cell in lesson(exercise.partition(".")[0]).cells:
        if cell.exercise == exercise:
            found = (line.strip() for line in cell.source.splitlines())
            return next((line for line in found if line.startswith(f"def {name}(")), "")
    return ""

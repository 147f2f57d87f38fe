"""Small edits of the solutions, for the checks: ``python -m tests.lessons.mutants``.

Numbers of exercises may follow (``04 05.2``). Prints the mutants that pass.
"""

import ast
import copy
import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import redirect_stdout
from dataclasses import dataclass
from io import StringIO

from ai4u_edu.lessons.answers import answers_to
from ai4u_edu.lessons.course import exercise_ids, is_ticket, lesson
from tests.lessons.workbook import SLOW, tried

OPERATORS: dict[type[ast.AST], type[ast.AST]] = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.Gt: ast.Lt,
    ast.Lt: ast.Gt,
    ast.And: ast.Or,
    ast.Or: ast.And,
    ast.Eq: ast.NotEq,
}


@dataclass(frozen=True)
class Mutant:
    """A solution with one edit."""

    name: str
    """The edit, in a few words."""
    code: str


def mutants_of(code: str) -> Iterator[Mutant]:
    """Give each edit of one operator, comparison or number in a cell."""
    tree = ast.parse(code)
    for index, node in enumerate(ast.walk(tree)):
        for words, field, value in _edits(node):
            changed = copy.deepcopy(tree)
            target = list(ast.walk(changed))[index]
            setattr(target, field, value)
            line = getattr(node, "lineno", 0)
            yield Mutant(f"line {line}: {words}", ast.unparse(ast.fix_missing_locations(changed)))


def _edits(node: ast.AST) -> Iterator[tuple[str, str, object]]:
    if isinstance(node, ast.BinOp | ast.BoolOp) and type(node.op) in OPERATORS:
        other = OPERATORS[type(node.op)]
        yield f"{type(node.op).__name__} to {other.__name__}", "op", other()
    elif isinstance(node, ast.Compare) and type(node.ops[0]) in OPERATORS:
        other = OPERATORS[type(node.ops[0])]
        yield f"{type(node.ops[0]).__name__} to {other.__name__}", "ops", [other()]
    elif isinstance(node, ast.Constant) and type(node.value) in (int, float):
        number = float(node.value)  # type: ignore[arg-type]
        for new in {0.0: (1.0,)}.get(number, (-number, 3 * number)):
            yield f"{number:g} to {new:g}", "value", new


def survivors(exercise: str) -> list[str]:
    """Return the names of an exercise's mutants that pass its check."""
    found = []
    for mutant in mutants_of(answers_to(exercise).solution):
        with redirect_stdout(StringIO()):
            try:
                one = lesson(exercise[:2])
                passed = tried(one, exercise, mutant.code, may_be_endless=True).passed
            except AssertionError:  # the cell itself stops with an error: a student sees that
                continue
        if passed:
            found.append(mutant.name)
    return found


def main() -> None:
    """Print the survivors."""
    os.environ["AI4U_FAST"] = "1"
    wanted = tuple(sys.argv[1:])
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for exercise in exercise_ids():
            if is_ticket(exercise) or exercise in SLOW:
                continue
            if not wanted or exercise.startswith(wanted):
                count = len(list(mutants_of(answers_to(exercise).solution)))
                print(f"{exercise}: {count} mutants; pass: {survivors(exercise)}", flush=True)


if __name__ == "__main__":
    main()

"""Answers that are a constant or a table, for the checks: ``python -m tests.lessons.tables``.

A solution's function is replaced by one that returns the same for everything, or what the check's
messages said before; where it returns a block, that happens to the block's parameters. Numbers of
exercises may follow (``04 05.2``).
"""

import ast
import copy
import os
import re
import sys
import tempfile
from collections.abc import Callable
from contextlib import redirect_stdout
from dataclasses import dataclass, field
from io import StringIO
from typing import Any

import numpy as np

from ai4u_edu.lessons.answers import answers_to
from ai4u_edu.lessons.checking import CheckResult
from ai4u_edu.lessons.course import exercise_ids, is_ticket, lesson
from tests.lessons.workbook import SLOW, handed_in, tried

ROUNDS = 12
"""Entries of a table that are looked for; nobody collects more."""
MAX_CONSTANTS = 8
NAMED = {"01.2", "07.3"}
"""Exercises whose right answer is a table."""


@dataclass
class Asked:
    """Questions of a check in its last run."""

    pairs: list[tuple[str, Any]] = field(default_factory=list)
    """Key of the arguments, and the right answer."""


asked = Asked()


def ask(table: dict[str, Any], default: Any, right: Callable[[], Any], *arguments: Any) -> Any:
    """Return the table's entry for some arguments; note the right one."""
    parts = [repr(each) for each in arguments if isinstance(each, PLAIN)]
    key = ", ".join(parts) or f"call {len(asked.pairs) + 1}"
    asked.pairs.append((key, copy.deepcopy(right())))
    return table.get(key, default)


PLAIN = (bool, int, float, str, list, tuple, dict, np.ndarray)


def places_in(code: str, names: list[str]) -> list[int]:
    """Return the nodes of a solution's tree that may be replaced: functions, and keywords.

    Args:
        code: the solution.
        names: names of what is handed in.
    """
    found = []
    for number, node in enumerate(ast.walk(ast.parse(code))):
        is_function = isinstance(node, ast.FunctionDef) and node.name in names
        if is_function or (
            isinstance(node, ast.keyword) and node.arg and not isinstance(node.value, ast.Constant)
        ):
            found.append(number)
    return found


def with_table(code: str, place: int, table: dict[str, Any], default: Any) -> str:
    """Return a solution in which one function, or keyword, looks its value up."""
    tree = ast.parse(code)
    nodes = list(ast.walk(tree))
    node = nodes[place]
    functions = [each for each in nodes if isinstance(each, ast.FunctionDef)]
    inside = [each for each in functions if node is each or node in ast.walk(each)]
    parameters = ", ".join(each.arg for each in inside[-1].args.args) if inside else ""
    if isinstance(node, ast.FunctionDef):
        head = copy.deepcopy(node)
        right = f"_right_{node.name}"
        head.body = ast.parse(
            f"return ASK(TABLE, DEFAULT, lambda: {right}({parameters}), {parameters})"
        ).body
        node.name = right
        tree.body.append(head)
    elif isinstance(node, ast.keyword):
        value = ast.unparse(node.value)
        node.value = ast.parse(
            f"ASK(TABLE, DEFAULT, lambda: {value}, {parameters})", mode="eval"
        ).body
    begin = (
        f"from tests.lessons.tables import ask as ASK\nTABLE, DEFAULT = {table!r}, {default!r}\n"
    )
    return begin + ast.unparse(ast.fix_missing_locations(tree))


def leaked(value: Any, text: str) -> Any:
    """Return a right answer as a message tells it; None if it does not."""
    if isinstance(value, str):
        return value if re.search(rf"['\"`]{re.escape(value)}['\"`]", text) else None
    if isinstance(value, bool):
        return value if str(value) in text else None
    if isinstance(value, list | tuple | np.ndarray):
        parts = [leaked(each, text) for each in np.ravel(np.asarray(value)).tolist()]
        return None if None in parts or not parts else parts
    if not isinstance(value, int | float):
        return None
    for word in re.findall(r"-?\d+(?:\.\d+)?", text):
        digits = len(word.partition(".")[2])
        if abs(float(word) - value) <= 0.51 * 10**-digits:
            return float(word) if digits else int(word)
    return None


def _verdict(exercise: str, code: str) -> CheckResult | None:
    asked.pairs = []
    with redirect_stdout(StringIO()):
        try:
            return tried(lesson(exercise[:2]), exercise, code)
        except AssertionError:  # the cell itself stops with an error: a student sees that
            return None


def survivors(exercise: str) -> list[str]:
    """Return the constants and tables that pass an exercise's check, in words."""
    code = answers_to(exercise).solution
    expression = ast.parse(handed_in(lesson(exercise[:2]), exercise), mode="eval")
    names = [node.id for node in ast.walk(expression) if isinstance(node, ast.Name)]
    found = []
    for place in places_in(code, names):
        _verdict(exercise, with_table(code, place, {}, None))
        values = [value for _, value in asked.pairs if isinstance(value, PLAIN)]
        constants = list({repr(each): each for each in values}.values())[:MAX_CONSTANTS]
        for constant in constants:
            verdict = _verdict(exercise, with_table(code, place, {}, constant))
            if verdict is not None and verdict.passed:
                found.append(f"node {place}: always {constant!r}")
                break
        else:
            table = _table(exercise, code, place, constants[:1])
            if table:
                found.append(f"node {place}: {table}")
    return found


def _table(exercise: str, code: str, place: int, defaults: list[Any]) -> dict[str, Any]:
    """Return a table of what the messages say that passes the check; empty if there is none."""
    table: dict[str, Any] = {}
    for _ in range(ROUNDS):
        text = with_table(code, place, table, defaults[0] if defaults else None)
        verdict = _verdict(exercise, text)
        if verdict is None:
            return {}
        if verdict.passed:
            return table
        new = {
            key: told
            for key, value in asked.pairs
            if key not in table and (told := leaked(value, verdict.text)) is not None
        }
        if not new:
            return {}
        table |= new
    return {}


def exercises() -> list[str]:
    """Return the exercises to try: those with functions that no robot asks."""
    return [
        exercise
        for exercise in exercise_ids()
        if not is_ticket(exercise) and exercise not in (*SLOW, *NAMED)
        if re.search(r"^def \w+\((?!percept\))", answers_to(exercise).solution, re.MULTILINE)
    ]


def main() -> None:
    """Print the constants and tables that pass."""
    os.environ["AI4U_FAST"] = "1"
    wanted = tuple(sys.argv[1:])
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for exercise in exercises():
            if not wanted or exercise.startswith(wanted):
                print(f"{exercise}: {survivors(exercise)}", flush=True)


if __name__ == "__main__":
    main()

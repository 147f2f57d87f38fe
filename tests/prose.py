"""The mechanical part of the language guide, as a checker: ``python -m tests.prose [PATH ...]``.

It reads docstrings and constants and runs nothing. A docstring's first line must not be a bare
relative clause ("What ...", "Whether ..."), and a constant that is said to be a number of seconds,
bytes or characters must have the unit in its name. That functions begin with an imperative is
ruff's rule D401.
"""

import ast
import re
import sys
from collections.abc import Iterable, Iterator
from itertools import pairwise
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BARE = frozenset(
    {"As", "By", "For", "How", "Of", "So", "Somebody", "That", "Those", "What", "When", "Where"}
    | {"Whether", "Which", "Who", "Whom", "Whose", "Why"}
)
"""First words that begin no sentence and no noun phrase, but a piece of one."""
UNITS = {
    r"\bseconds?\b|\(s\)": ("_S", "_MS", "_NS", "_MINUTES"),
    r"\bbytes\b|\(bytes\)": ("BYTES", "KIB", "MIB"),
    r"\bcharacters\b": ("CHARS",),
}
RATES = re.compile(r"\b(a|per|each|every) second\b|/s\b")
"""A rate has another unit than seconds."""

Documented = ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef


def check_file(path: Path) -> Iterator[str]:
    """Yield a line for each finding in a Python file, as ``path:line: finding``."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    shown = path.relative_to(ROOT) if path.is_relative_to(ROOT) else path
    for line, found in sorted(set(check_tree(tree))):
        yield f"{shown}:{line}: {found}"


def check_tree(tree: ast.Module) -> Iterator[tuple[int, str]]:
    """Yield the line and the text of each finding in a syntax tree.

    >>> list(check_tree(ast.parse("def f():\\n    '''What it does.'''")))
    [(1, "'What ...' is no sentence: begin with a verb or a noun")]
    >>> list(check_tree(ast.parse("LONGEST = 5.0\\n'''Seconds to wait.'''")))
    [(1, 'LONGEST: expected the unit in the name, such as _S')]
    >>> list(check_tree(ast.parse("RATE = 5.0\\n'''Messages a second.'''")))
    []
    """
    for node in ast.walk(tree):
        if isinstance(node, Documented):
            yield from _check_first_word(getattr(node, "lineno", 1), ast.get_docstring(node))
        body = getattr(node, "body", None)
        if isinstance(node, ast.Module | ast.ClassDef) and isinstance(body, list):
            for assigned, text in _documented_names(body):
                yield from _check_first_word(assigned.lineno, text)
                yield from _check_unit(assigned, text)


def _documented_names(body: list[ast.stmt]) -> Iterator[tuple[ast.Assign | ast.AnnAssign, str]]:
    for first, second in pairwise(body):
        is_text = isinstance(second, ast.Expr) and isinstance(second.value, ast.Constant)
        if isinstance(first, ast.Assign | ast.AnnAssign) and is_text:
            text = second.value.value  # type: ignore[attr-defined]  # narrowed by is_text
            if isinstance(text, str):
                yield first, text


def _check_first_word(line: int, text: str | None) -> Iterator[tuple[int, str]]:
    word = re.match(r"\w+", (text or "").strip())
    if word and word.group() in BARE:
        yield line, f"'{word.group()} ...' is no sentence: begin with a verb or a noun"


def _check_unit(assigned: ast.Assign | ast.AnnAssign, text: str) -> Iterator[tuple[int, str]]:
    target = assigned.targets[0] if isinstance(assigned, ast.Assign) else assigned.target
    if not (isinstance(target, ast.Name) and target.id.isupper() and _is_number(assigned.value)):
        return
    first = text.split(". ")[0]
    for pattern, suffixes in UNITS.items():
        is_rate = suffixes[0] == "_S" and RATES.search(first)
        if re.search(pattern, first, re.IGNORECASE) and not is_rate:
            if not any(suffix in target.id for suffix in suffixes):
                expected = f"{target.id}: expected the unit in the name, such as {suffixes[0]}"
                yield assigned.lineno, expected
            return


def _is_number(value: ast.expr | None) -> bool:
    match value:
        case ast.Constant(value=int() | float()):
            return True
        case ast.BinOp(left=left, right=right):
            return _is_number(left) and _is_number(right)
    return False


def check_paths(paths: Iterable[Path]) -> list[str]:
    """Return the findings in Python files, and in all files of folders."""
    files = [
        file for path in paths for file in (sorted(path.rglob("*.py")) if path.is_dir() else [path])
    ]
    return [found for file in files for found in check_file(file)]


if __name__ == "__main__":
    findings = check_paths(map(Path, sys.argv[1:] or [str(ROOT / "ai4u_edu")]))
    print("\n".join(findings))
    sys.exit(f"{len(findings)} to mend" if findings else 0)

"""Find where a test depends on the speed of its machine: ``python -m tests.real_time [PATH ...]``.

A busy machine takes ten times as long for everything, and no test may fail for that. A test waits
for an event (:mod:`tests.waiting`) or runs on a clock of its own. What sleeps, reads a real clock
or has a short limit needs its reason beside it, in a comment ``# real time: ...``.
"""

import ast
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path

TESTS = Path(__file__).resolve().parent
MARK = "# real time: "
MIN_LIMIT_S = 30
"""Limit (s) of a wait from which on only a fault reaches it."""
MEASURING = ("benchmarks", "load")
"""Folders whose programs measure time, and no test depends on what they find."""
TOOLS = ("soak.py", "stability.py", "waiting.py", "screenshot.py", "*_sheet.py", "*_film.py")
"""Programs that a person starts, and the waits themselves."""
PROGRAMS = ("program/solutions", "remote/ai4u_scripts")
"""Folders with programs of students and of scripts."""
CLOCKS = {"monotonic", "monotonic_ns", "perf_counter", "perf_counter_ns", "process_time", "time"}
WAITS = {"join", "result", "settimeout", "silence", "wait"}
"""Methods whose first argument is a limit in seconds."""
LIMITS = ("timeout", "patience", "grace")
"""Parts of the names of arguments that are limits in seconds; a ``receive_timeout`` is in ms."""


def check_file(path: Path) -> Iterator[str]:
    """Yield a line for each finding in a Python file, as ``path:line: finding``."""
    text = path.read_text(encoding="utf-8")
    shown = path.relative_to(TESTS.parent) if path.is_relative_to(TESTS) else path
    for line, found in check_text(text):
        yield f"{shown}:{line}: {found}"


def check_text(text: str) -> list[tuple[int, str]]:
    """Return the line and the text of each finding in a program.

    >>> check_text("time.sleep(0.3)")
    [(1, 'time.sleep(0.3)')]
    >>> check_text("# real time: the outage is the test\\ntime.sleep(60)")
    []
    >>> check_text("assert time.monotonic() < end")
    [(1, 'time.monotonic()')]
    >>> check_text("future.result(5); future.result(0); future.result(LIMIT_S)")
    [(1, 'future.result(5)')]
    >>> check_text("connect(timeout=0.5, grace=60.0)")
    [(1, 'timeout=0.5')]
    >>> check_text("page.evaluate('new Promise((done) => setTimeout(done, 99))')")
    [(1, 'setTimeout in a script')]
    """
    lines = text.splitlines()

    def has_reason(node: ast.expr | ast.keyword) -> bool:
        around = lines[max(node.lineno - 2, 0) : node.end_lineno]
        return any(MARK in line for line in around)

    return sorted(
        (node.lineno, found)
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.expr | ast.keyword)
        for found in _findings(node)
        if not has_reason(node)
    )


def _findings(node: ast.expr | ast.keyword) -> Iterator[str]:
    match node:
        case ast.Call(func=ast.Attribute(attr="sleep") | ast.Name(id="sleep"), args=[seconds]):
            if not _is_number(seconds, below=1e-9):  # sleep(0) lets others go first
                yield ast.unparse(node)
        case ast.Call(func=ast.Attribute(attr="wait_for_timeout" | "Timer")):
            yield ast.unparse(node)
        case ast.Call(func=ast.Attribute(value=ast.Name(id="time"), attr=name)) if name in CLOCKS:
            yield ast.unparse(node)
        case ast.Call(func=ast.Attribute(attr=name), args=[limit]) if name in WAITS:
            if _is_number(limit, below=MIN_LIMIT_S) and not _is_number(limit, below=1e-9):
                yield ast.unparse(node)
        case ast.keyword(arg=str(name), value=limit) if any(each in name for each in LIMITS):
            below = MIN_LIMIT_S * (1000 if name == "receive_timeout" else 1)
            if _is_number(limit, below=below) and not _is_number(limit, below=1e-9):
                yield f"{name}={ast.unparse(limit)}"
        # real time: what is looked for
        case ast.Constant(value=str(text)) if "setTimeout(" in text:
            yield "setTimeout in a script"


def _is_number(node: ast.expr, *, below: float) -> bool:
    return (
        isinstance(node, ast.Constant)
        and isinstance(node.value, int | float)
        and (node.value < below)
    )


def is_checked(path: Path) -> bool:
    """Return True for a file whose waits the tests depend on."""
    inside = path.relative_to(TESTS)
    return not (
        inside.parts[0] in MEASURING
        or any(inside.match(name) for name in TOOLS)
        or any(inside.is_relative_to(folder) for folder in PROGRAMS)
    )


def check_paths(paths: Iterable[Path]) -> list[str]:
    """Return the findings in Python files, and in all files of folders."""
    files = [
        file for path in paths for file in (sorted(path.rglob("*.py")) if path.is_dir() else [path])
    ]
    return [found for file in files if is_checked(file.resolve()) for found in check_file(file)]


if __name__ == "__main__":
    findings = check_paths(map(Path, sys.argv[1:] or [str(TESTS)]))
    print("\n".join(findings))
    sys.exit(f"{len(findings)} to mend" if findings else 0)

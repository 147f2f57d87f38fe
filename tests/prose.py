"""The mechanical part of the language guide, as a checker: ``python -m tests.prose [PATH ...]``.

It reads docstrings, comments, constants and, in JavaScript, the texts that people see; it runs
nothing. A docstring's first line must not be a bare relative clause ("What ...", "Whether ...").
A constant that is said to be a number of seconds, bytes or characters must have the unit in its
name. Some phrases have a usual word in their place. That Python's functions begin with an
imperative is ruff's rule D401.
"""

import ast
import io
import re
import sys
import tokenize
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
    r"\(ms\)": ("_MS",),
    r"\(px\)": ("_PX",),
}
RATES = re.compile(r"\b(a|per|each|every) second\b|/s\b")
"""A rate has another unit than seconds."""
PHRASES = {
    r"\banew\b": "again",
    r"\bis to be\b": "must be, should be or will be",
    r"\b(for|to|from) who\b": "for anyone who",
    r"\bmostly\b": "usually",
    r"[;:(] ?left out, ": "default: ...",
    r"\bone after the other\b": "in turn, or one at a time",
    r"\bso many\b(?! that)": "a name for the number",
    r"\bas the \w+ has it\b": "whose setting it is",
}
"""Phrases, and what to write in their place."""
OLD_PHRASES = (
    *(
        f"{root}/{folder}"
        for root in ("ai4u_edu", "tests")
        for folder in ("agent", "learn", "world")
    ),
    "tests/prose.py",
)
"""Python that is not searched for phrases: folders that still have some, and this file."""
FOREIGN = frozenset({"generated", "node_modules", "vendor"})
"""Folders of scripts that are not written here."""
SCRIPT_TOKEN = re.compile(
    r"""(?P<doc>/\*\*.*?\*/)|(?P<comment>/\*.*?\*/|//[^\n]*)"""
    r"""|(?P<text>"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*'|`(?:\\.|[^`\\])*`)"""
    r"""|(?<=[(,=:\[!&|?{};\n])\s*/(?![*/])(?:\\.|\[(?:\\.|[^\]\\])*\]|[^/\\\n\[])+/""",
    re.DOTALL,
)
"""Comment, text or regular expression of a script."""
SCRIPT_CONSTANT = re.compile(r"\s*(?:export )?const (?P<name>[A-Z][A-Z\d_]*) = [\d_.e* +]+;")

Documented = ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef


def check_file(path: Path) -> Iterator[str]:
    """Yield a line for each finding in a file, as ``path:line: finding``."""
    name = str(path.relative_to(ROOT) if path.is_relative_to(ROOT) else path)
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".py":
        findings = set(check_tree(ast.parse(text)))
        if not name.startswith(OLD_PHRASES):
            findings |= set(check_phrases(text))
    else:
        findings = set(check_script(text))
    for line, finding in sorted(findings):
        yield f"{name}:{line}: {finding}"


def check_script(text: str) -> Iterator[tuple[int, str]]:
    """Yield the line and the text of each finding in JavaScript.

    >>> list(check_script("/** What it does. */"))
    [(1, "'What ...' is no sentence: begin with a verb or a noun")]
    >>> list(check_script("/** Interval of a poll (ms). */\\nconst POLL = 200;"))
    [(1, 'POLL: expected the unit in the name, such as _MS')]
    >>> list(check_script('say("Connect anew.");  // again'))
    [(1, "'anew': again")]
    """
    for token in SCRIPT_TOKEN.finditer(text):
        line = text.count("\n", 0, token.start()) + 1
        prose = token["doc"] or token["comment"] or token["text"] or ""
        yield from _check_phrases(line, prose)
        if token["doc"]:
            words = " ".join(re.sub(r"^\s*\*", "", prose[3:-2], flags=re.MULTILINE).split())
            yield from _check_first_word(line, words)
            if constant := SCRIPT_CONSTANT.match(text, token.end()):
                yield from _check_unit(line, constant["name"], words)


def check_phrases(text: str) -> Iterator[tuple[int, str]]:
    """Yield the line and the text of each phrase in Python's comments and docstrings.

    >>> list(check_phrases('x = "anew"  # start anew'))
    [(1, "'anew': again")]
    """
    lines = io.StringIO(text).readline
    for token in tokenize.generate_tokens(lines):
        is_prose = token.string.lstrip("rbuf").startswith('"""')
        if token.type == tokenize.COMMENT or (token.type == tokenize.STRING and is_prose):
            yield from _check_phrases(token.start[0], token.string)


def _check_phrases(line: int, text: str) -> Iterator[tuple[int, str]]:
    for pattern, better in PHRASES.items():
        for match in re.finditer(pattern, text):
            yield line + text.count("\n", 0, match.start()), f"{match.group()!r}: {better}"


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
                target = (
                    assigned.targets[0] if isinstance(assigned, ast.Assign) else assigned.target
                )
                if isinstance(target, ast.Name) and _is_number(assigned.value):
                    yield from _check_unit(assigned.lineno, target.id, text)


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


def _check_unit(line: int, name: str, text: str) -> Iterator[tuple[int, str]]:
    if not name.isupper():
        return
    first = text.split(". ")[0]
    for pattern, suffixes in UNITS.items():
        is_rate = suffixes[0] == "_S" and RATES.search(first)
        if re.search(pattern, first, re.IGNORECASE) and not is_rate:
            if not any(suffix in name for suffix in suffixes):
                yield line, f"{name}: expected the unit in the name, such as {suffixes[0]}"
            return


def _is_number(value: ast.expr | None) -> bool:
    match value:
        case ast.Constant(value=int() | float()):
            return True
        case ast.BinOp(left=left, right=right):
            return _is_number(left) and _is_number(right)
    return False


def check_paths(paths: Iterable[Path]) -> list[str]:
    """Return the findings in files, and in all Python and JavaScript of folders."""
    files = [file for path in paths for file in (_sources(path) if path.is_dir() else [path])]
    return [finding for file in files for finding in check_file(file)]


def _sources(folder: Path) -> list[Path]:
    files = (path for ending in ("*.py", "*.js", "*.mjs") for path in folder.rglob(ending))
    return sorted(path for path in files if not FOREIGN & {*path.parts})


if __name__ == "__main__":
    findings = check_paths(map(Path, sys.argv[1:] or [str(ROOT / "ai4u_edu"), str(ROOT / "web")]))
    print("\n".join(findings))
    sys.exit(f"{len(findings)} to mend" if findings else 0)

"""The mechanical part of the language guide, as a checker: ``python -m tests.prose [PATH ...]``.

It reads docstrings, comments, constants and the texts that people see; it runs nothing. A
docstring's first line must not be a bare relative clause ("What ...", "Whether ..."). A constant
that is said to be a number of seconds, bytes or characters must have the unit in its
name. Some phrases have a usual word in their place. That Python's functions begin with an
imperative is ruff's rule D401.
"""

import ast
import io
import re
import sys
import tokenize
from collections.abc import Iterable, Iterator, Mapping
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
SHOWN_PHRASES = {
    r"[Bb]ecause of what": "Why?",
    r"[Ww]hat it would do (elsewhere|there)": "What if it stood somewhere else?, where it would go",
    r"\bworth is\b|what each place is worth": "good and bad places",
    r"\bslots? (alone|of the percept)\b": "sensor number",
    r"\bIt would look\b": "Facing",
    r"If this were another": "Try another number",
    r"Reached the goal": "You did it!",
    r"^(Fell|You lose)\b": "You fell., You lost.",
    r"goal missed|missed the goal": "fell, time is up, or not there",
    r"\bYou drive\b": "You're driving",
    r"[Pp]ush the stick": "move the stick",
    r"Turn with robot|Robot's view": "Turn along, Through its eyes",
    r"Two drivers on|^One driver$|^Another one$": "Compare two drivers, First, Second",
    r"What paid in": "Where the points came from",
    r"notices nothing yet|gets no reward yet": "No sensors yet., No rewards yet.",
    r"from the next decision on\.": "right away.",
    r"Closer than ever": "Closer than before",
    r"[Tt]he thing it is about": "Which thing?",
    r"(Scene|Agent)'s settings": "Scene settings, Robot settings",
    r"Visit targets in order": "Touch things in order",
    r"[Aa]nticlockwise": "from 1 to 2 to 3",
    r"places out of AI4U": "what the person sees",
    r"Nobody else may join": "Lock the class",
    r"End of class": "End class",
    r"\bnot begun\b": "not started",
    r"knows of you": "sees",
    r"kept among the unsaved": "kept; find it under Unsaved",
    r"unseen starts": "new starts",
    r"Loading Python, once": "Getting Python ready (first time only)",
    r"mistake in line .+ ended it|A mistake ended it": "Stopped: there's a mistake in line ...",
    r"is over at decision|reached at decision": "Your program decided ... times.",
    r"has nobody to ask": "doesn't work here",
    r"[Hh]ang it under": "snap it under",
    r"begins it in the world": "Click a row to try that start.",
    r"let go, and the program": "Press Let go to give the robot back to your program.",
    r"\(no effect\)": "(leave it out)",
    r"no reading is called|has no actuator [{']": "there is no sensor called, the robot can't do",
}
"""Phrases in texts that people see, and words for a fourteen-year-old in their place."""
SHOWN_BY = (
    "ai4u_edu/classroom",
    "ai4u_edu/explain/page",
    "ai4u_edu/page",
    "ai4u_edu/program",
    "ai4u_edu/scenes/library",
    "web",
)
"""Files with the texts of pages: of the room, the start page, a class and its projector."""
OLD_PHRASES = (
    *(
        f"{root}/{folder}"
        for root in ("ai4u_edu", "tests")
        for folder in ("agent", "learn", "world")
    ),
    "tests/prose.py",
)
"""Python that is not searched for phrases: folders that still have some, and this file."""
SCRIPTS = frozenset({".js", ".mjs"})
ENDINGS = ("*.py", "*.js", "*.mjs", "*.html", "*.yaml")
"""Patterns of the files to read."""
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
    is_shown = name.startswith(SHOWN_BY)
    if path.suffix == ".py":
        tree = ast.parse(text)
        findings = set(check_tree(tree))
        if is_shown:
            findings |= set(check_shown(tree))
        if not name.startswith(OLD_PHRASES):
            findings |= set(check_phrases(text))
    elif path.suffix in SCRIPTS:
        findings = set(check_script(text, is_shown=is_shown))
    else:  # a page or a scene, whose texts are all that it has
        findings = set(_check_phrases(1, text, SHOWN_PHRASES)) if is_shown else set()
    for line, finding in sorted(findings):
        yield f"{name}:{line}: {finding}"


def check_script(text: str, *, is_shown: bool = True) -> Iterator[tuple[int, str]]:
    """Yield the line and the text of each finding in JavaScript.

    Args:
        text: the script.
        is_shown: True if people see its texts.

    >>> list(check_script("/** What it does. */"))
    [(1, "'What ...' is no sentence: begin with a verb or a noun")]
    >>> list(check_script("/** Interval of a poll (ms). */\\nconst POLL = 200;"))
    [(1, 'POLL: expected the unit in the name, such as _MS')]
    >>> list(check_script('say("Connect anew.");  // again'))
    [(1, "'anew': again")]
    >>> list(check_script('say("You drive now"); /** You drive. */'))
    [(1, "'You drive': You're driving")]
    """
    for token in SCRIPT_TOKEN.finditer(text):
        line = text.count("\n", 0, token.start()) + 1
        prose = token["doc"] or token["comment"] or token["text"] or ""
        yield from _check_phrases(line, prose)
        if token["text"] and is_shown:
            yield from _check_phrases(line, prose[1:-1], SHOWN_PHRASES)
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


def check_shown(tree: ast.Module) -> Iterator[tuple[int, str]]:
    """Yield the line and the text of each old phrase in texts that people see.

    >>> list(check_shown(ast.parse("'''You drive.'''\\nsay('You drive', f'You drive {x}')")))
    [(2, "'You drive': You're driving"), (2, "'You drive': You're driving")]
    """
    documents = {
        id(node.value)
        for node in ast.walk(tree)
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
    }
    for node in ast.walk(tree):
        if id(node) in documents or not isinstance(node, ast.Constant):
            continue
        if isinstance(node.value, str):
            yield from _check_phrases(node.lineno, node.value, SHOWN_PHRASES)


def _check_phrases(
    line: int, text: str, phrases: Mapping[str, str] = PHRASES
) -> Iterator[tuple[int, str]]:
    for pattern, better in phrases.items():
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
    """Return the findings in files, and in all Python, scripts, pages and scenes of folders."""
    files = [file for path in paths for file in (_sources(path) if path.is_dir() else [path])]
    return [finding for file in files for finding in check_file(file)]


def _sources(folder: Path) -> list[Path]:
    files = (path for ending in ENDINGS for path in folder.rglob(ending))
    return sorted(path for path in files if not FOREIGN & {*path.parts})


if __name__ == "__main__":
    findings = check_paths(map(Path, sys.argv[1:] or [str(ROOT / "ai4u_edu"), str(ROOT / "web")]))
    print("\n".join(findings))
    sys.exit(f"{len(findings)} to mend" if findings else 0)

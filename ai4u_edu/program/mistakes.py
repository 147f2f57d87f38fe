"""Errors of students' programs as sentences for beginners, with the line."""

import builtins
import re
from collections.abc import Collection, Iterable
from typing import Any

from ai4u_edu.program.endless import line_at
from ai4u_edu.program.reading import MissingReadingError, Reading, Readings
from ai4u_edu.program.texts import deferred
from ai4u_edu.program.texts import gettext as _
from ai4u_edu.program.words import nearest, shorten, shown, suggest

MAX_TEXT_CHARS = 500
"""An exception's own text may be of any length."""
NOTHING_RETURNED = deferred("Your function returned nothing (None). Is `return` missing?")
NO_NUMPY = deferred(
    "numpy is not there in the page. A reading can do without: it has .min(), .max(), .sum(), "
    ".mean(), .argmin() and .argmax(), and `import math` has sin, cos and sqrt."
)
_PARAMETERS = re.compile(
    r"(?P<name>[\w.<>]+)\(\) (?:takes (?:from )?\d+(?: to \d+)? positional arguments?"
    r" but \d+ (?:was|were) given|missing \d+ required positional argument)"
)
_SYNTAX = (
    (
        r"indented block after (?P<what>.+?)(?: definition| statement)? on line (?P<line>\d+)",
        deferred(
            "This line is inside the {what} of line {line}. Put four more spaces in front of it."
        ),
    ),
    (
        r"unexpected indent",
        deferred(
            "This line begins with more spaces than the line before it: expected "
            "as many, unless that one ends with a colon (:)."
        ),
    ),
    (
        r"unindent does not match",
        deferred(
            "This line begins with a number of spaces that no line above "
            "has: expected as many as the line that it belongs with."
        ),
    ),
    (
        r"inconsistent use of tabs",
        deferred("This line begins with tabs, and others with spaces: expected spaces everywhere."),
    ),
    (
        r"expected ':'",
        deferred("A colon (:) is missing at the end of this line, or before what stands after it."),
    ),
    (
        r"'(?P<what>[(\[{])' was never closed",
        deferred("The bracket {what} in this line is never closed."),
    ),
    (
        r"unmatched '(?P<what>.)'",
        deferred("There is a bracket {what} in this line that was never opened."),
    ),
    (
        r"closing parenthesis '(?P<what>.)' does not match opening parenthesis '(?P<other>.)'",
        deferred("The bracket {other} is closed by {what}: expected brackets of the same kind."),
    ),
    (
        r"unterminated (?:triple-quoted )?f?-?string",
        deferred(
            "A text begins in this line and does not end: expected a quote (\" or ') behind it."
        ),
    ),
    (
        r"Maybe you meant '==' (?:or ':='|instead of '=')|perhaps you meant \"==\"",
        deferred(
            "One = stores a value, and two compare: expected ==, or a name on the left of the =."
        ),
    ),
    (
        r"cannot assign to|illegal expression for augmented assignment",
        deferred("Only a name can get a value: expected a name on the left of the =."),
    ),
    (
        r"'(?P<what>break|continue)' (?:outside loop|not properly in loop)",
        deferred("`{what}` stands outside of a loop: expected it below a `for` or a `while`."),
    ),
    (
        r"invalid non-printable character",
        deferred(
            "This line has a character that can't be seen, perhaps from a copy: type the line "
            "again."
        ),
    ),
    (
        r"invalid decimal literal",
        deferred(
            "A number is followed by a letter: names begin with a letter, and a number has none."
        ),
    ),
    (
        r"leading zeros in decimal",
        deferred("A number can't begin with a 0: write 5 in place of 05."),
    ),
    (
        r"unexpected character after line continuation",
        deferred(
            "There is a \\ in this line that does not belong there, or something stands behind it."
        ),
    ),
    (
        r"Perhaps you forgot a comma",
        deferred("Something is missing between two values: perhaps a comma."),
    ),
    (
        r"'return' outside function",
        deferred(
            "`return` stands outside of a function: begin the line with "
            "four spaces if it belongs to the function above."
        ),
    ),
    (r"Missing parentheses in call to 'print'", deferred("`print` needs brackets: print(...).")),
    (
        r"invalid character '(?P<what>.)'",
        deferred("Python does not know the character {what}: perhaps it was copied from a text."),
    ),
    (
        r"^invalid syntax$",
        deferred(
            "Python can't read this line. Is a bracket, a comma or a colon missing "
            "in it, or in the line above?"
        ),
    ),
)
"""Python's messages, and the sentences for them."""


class ProgramError(Exception):
    """A mistake in a program, as a sentence.

    Args:
        text: what was expected, what came, and how to mend it.
        line: in the program, from 1; 0 if there is none.
        kind: name of the mistake: syntax, indentation, entry, parameters, no-return, action,
            actuator, length, not-a-number, not-finite, wrong-key, unknown-name, attribute,
            endless, recursion, memory, numpy, import, or error.
    """

    def __init__(self, text: str, line: int = 0, kind: str = "error") -> None:
        super().__init__(text)
        self.text = text
        self.line = line
        self.kind = kind

    def __str__(self) -> str:
        if not self.line:
            return str(self.text)
        return str(_("line {line}: {text}", line=self.line, text=self.text))

    def in_file(self, file: str) -> str:
        """Return the sentence behind the name of the program's file, and the line."""
        if not self.line:
            return _("{file}: {text}", file=file, text=self.text)
        return _("{file}, line {line}: {text}", file=file, line=self.line, text=self.text)


def syntax_mistake(error: SyntaxError) -> ProgramError:
    r"""Return the mistake that keeps Python from reading a program.

    >>> try:
    ...     compile("def decide(percept)\n    return {}", "program.py", "exec")
    ... except SyntaxError as error:
    ...     print(syntax_mistake(error))
    line 1: A colon (:) is missing at the end of this line, or before what stands after it.
    """
    said = str(error.msg)
    kind = "indentation" if isinstance(error, IndentationError) else "syntax"
    for pattern, text in _SYNTAX:
        found = re.search(pattern, said)
        if found:
            return ProgramError(_(text, **found.groupdict()), error.lineno or 0, kind)
    why = shorten(said, MAX_TEXT_CHARS).rstrip(".?!")
    text = _("Python can't read this line: {why}.", why=why)
    return ProgramError(text, error.lineno or 0, kind)


def mistake_in(error: BaseException, file: str, quoted: Collection[str] = ()) -> ProgramError:
    """Return the mistake behind an exception that a program raised.

    Args:
        error: with its traceback.
        file: name of the program's file, as in the traceback.
        quoted: names that are texts in a program: of readings and actuators.
    """
    if isinstance(error, SyntaxError) and error.filename == file:
        return syntax_mistake(error)
    line, names = _place_of(error, file)
    if isinstance(error, ProgramError):
        return ProgramError(error.text, error.line or line, error.kind)
    text, kind = _sentence(error, names, quoted)
    return ProgramError(text, line, kind)


def _sentence(
    error: BaseException, names: Iterable[str], quoted: Collection[str]
) -> tuple[str, str]:
    """Return the sentence on an exception, and the kind of the mistake."""
    said = _text_of(error)
    match error:
        case MissingReadingError():
            return said, "wrong-key"
        case UnboundLocalError():
            # its name is in the text alone
            name = found[1] if (found := re.search(r"variable '([^']+)'", said)) else _("it")
            text = _(
                "{name!r} has no value yet in this function. To change a variable from outside it, "
                "write `global {name}` as the function's first line.",
                name=name,
            )
            return text, "unknown-name"
        case NameError() if error.name and error.name in quoted:
            text = _(
                'nothing is called {name!r}; did you mean "{name}", in quotes?', name=error.name
            )
            return text, "unknown-name"
        case NameError() if error.name:
            hint = _near(error.name, names)
            text = _("nothing is called {name!r}; {hint}", name=error.name, hint=hint)
            return text, "unknown-name"
        case AttributeError() if error.name:
            return _no_attribute(error.obj, error.name), "attribute"
        case RecursionError():
            return _("A function calls itself again and again, without an end."), "recursion"
        case MemoryError():
            return _("The program needs more memory than there is."), "memory"
        case ImportError() if error.name == "numpy":
            return _(NO_NUMPY), "numpy"
        case ImportError():
            return _("Your code stopped at an import: {why}.", why=said), "import"
        case SystemExit():
            return _("Your code ended the program; expected `return` with an action."), "error"
        case TypeError() if "'Readings' object is not callable" in said:
            return _('a reading is taken with square brackets, as in percept["name"]'), "error"
        case TypeError() if _PARAMETERS.search(said):
            text = _("{error}: compare the names in the brackets after `def`.", error=said)
            return text, "parameters"
    name = type(error).__name__
    if not said:
        return _("Your code stopped with {error}.", error=name), "error"
    return _("Your code stopped with {error}: {text}.", error=name, text=said), "error"


def _near(name: str, names: Iterable[str]) -> str:
    near = nearest(name, {*names, *vars(builtins)})
    if near:
        return _("did you mean {name!r}?", name=near)
    return _("a name gets its value with =, and a text stands in quotes")


def _no_attribute(owner: Any, name: str) -> str:
    if isinstance(owner, Readings):
        near = nearest(name, owner) or "name"
        return _('a reading is taken with brackets and quotes: percept["{name}"]', name=near)
    known = [each for each in dir(type(owner)) if not each.startswith("_")]
    if isinstance(owner, Reading):
        return _("a reading has no {name!r}; {hint}", name=name, hint=suggest(name, known))
    if owner is None:
        return _(
            "None has no {name!r}: the value before the dot is nothing. Is `return` missing?",
            name=name,
        )
    near = nearest(name, known)
    what = type(owner).__name__ if type(owner).__name__ != "module" else shown(owner)
    if not near:
        return _("{owner} has no {name!r}", owner=what, name=name)
    return _("{owner} has no {name!r}; did you mean {near!r}?", owner=what, name=name, near=near)


def _text_of(error: BaseException) -> str:
    said = error.args[0] if len(error.args) == 1 else None
    if isinstance(said, str) and type(said) is not str:
        return said  # one of this package's sentences, which is translated later
    try:
        return shorten(str(error), MAX_TEXT_CHARS).removesuffix(".")
    except Exception:  # a text of the program's own class
        return ""


def _place_of(error: BaseException, file: str) -> tuple[int, list[str]]:
    """Return the program's innermost line in a traceback, and the names that are known there."""
    line, names = 0, list[str]()
    trace = error.__traceback__
    while trace is not None:
        code, frame = trace.tb_frame.f_code, trace.tb_frame
        # the last call of a recursion does not begin: the line that calls is the mistake's
        is_call = isinstance(error, RecursionError) and trace.tb_lineno == code.co_firstlineno
        if code.co_filename == file and not (line and is_call):
            line, names = line_at(code, trace.tb_lasti), [*frame.f_locals, *frame.f_globals]
        trace = trace.tb_next
    return line, names

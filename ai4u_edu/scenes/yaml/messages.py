"""Messages about syntax errors in YAML, for people who do not know its grammar.

The parser reports what it expected next ("did not find expected key"). The text around that place
shows the cause: a tab, a missing colon, an unclosed quote. libyaml and PyYAML's own parser report
errors in different words, so only words that both use are looked for.
"""

from typing import Any, NamedTuple

import yaml

from ai4u_edu.locale import gettext as _

MAX_SHOWN_CHARS = 76
"""Characters of a line in a message."""


class Fault(NamedTuple):
    """A syntax error in a text."""

    line: int
    """Line, from 1; 0 if unknown."""
    column: int
    """Column, from 1; 0 for the whole line."""
    words: str


class _Place(NamedTuple):
    line: int
    column: int
    """Column, like the line from 0, as the parser counts."""


def fault_of(error: yaml.YAMLError | ValueError, text: str) -> Fault:
    """Return the message and the place of a syntax error.

    Args:
        error: raised by the parser.
        text: the parsed text.
    """
    if isinstance(error, UnicodeEncodeError):
        return Fault(*_at(text, error.start), _("expected text, got half of a character"))
    if isinstance(error, yaml.reader.ReaderError):
        code: Any = error.character
        number = code if isinstance(code, int) else ord(code)
        words = _(
            "expected text, got the control character 0x{number:02x}; is this a text file?",
            number=number,
        )
        return Fault(*_at(text, error.position), words)
    if not isinstance(error, yaml.MarkedYAMLError):
        return Fault(0, 0, _("not YAML: {why}", why=str(error)))
    mark, begun = error.problem_mark, error.context_mark
    there = _Place(mark.line, mark.column) if mark else None
    start = _Place(begun.line, begun.column) if begun else None
    here = there or start or _Place(0, 0)
    lines = text.split("\n")
    return _explained(error, here, start or here, lines)


def shown(text: str, line: int, column: int) -> str:
    """Return a line of a text, and below it a caret that points to a column."""
    lines = text.split("\n")
    if not 1 <= line <= len(lines):
        return ""
    whole = lines[line - 1].replace("\t", " ").rstrip()
    skipped = max(0, column - MAX_SHOWN_CHARS) if column else 0
    part = "".join(char if char.isprintable() else "?" for char in whole[skipped:])
    told = f"\n    {part[:MAX_SHOWN_CHARS]}"
    return told + (f"\n    {' ' * (column - 1 - skipped)}^" if column else "")


def _explained(error: yaml.MarkedYAMLError, here: _Place, start: _Place, lines: list[str]) -> Fault:
    context, problem = error.context or "", error.problem or ""
    char = _char(lines, here)
    if "quoted scalar" in context and "end of" in problem:
        quote = _char(lines, start)
        return _fault(
            start,
            _("this {quote} is never closed; expected another {quote} at the end", quote=quote),
        )
    if "escape character" in problem:
        words = _(
            "in double quotes a \\ begins a special character; write \\\\, or use single quotes"
        )
        return _fault(start, words)
    if "flow sequence" in context or "flow mapping" in context:
        return _in_brackets(here, start, lines)
    if "start any token" in problem or char == "\t":
        if char == "\t":
            return _fault(here, _("a tab stands here; expected spaces to indent with"))
        return _fault(here, _("a value can't begin with {char}; put it in quotes", char=char))
    if "expected ':'" in problem:
        words = _("no colon follows; expected 'name: value', with a space after the colon")
        return _fault(start, words)
    if "mapping values" in problem:
        return _one_colon_too_many(here, lines)
    if "anchor" in context or "alias" in context:
        sign = _char(lines, start)
        return _fault(start, _("a value can't begin with {char}; put it in quotes", char=sign))
    if "block mapping" in context or "block collection" in context:
        return _misaligned(here, start, lines, is_list="collection" in context)
    if "node content" in problem or "block node" in context:
        if not char:
            opened = _last_opened(lines)
            if opened is not None:
                return _in_brackets(here, opened, lines)
            return _fault(here, _("the file ends where a value was expected"))
        return _fault(
            here, _("{char} stands here, and nothing was opened that it closes", char=char)
        )
    if "block scalar" in context:
        return _fault(here, _("the text after | or > begins on the next line"))
    return _fault(here, _("not YAML: {why}", why=problem or context))


def _last_opened(lines: list[str]) -> _Place | None:
    """Return the last unclosed bracket; brackets in quotes are counted too."""
    opened: list[_Place] = []
    for number, line in enumerate(lines):
        for column, char in enumerate(line):
            if char in "[{":
                opened.append(_Place(number, column))
            elif char in "]}" and opened:
                opened.pop()
    return opened[-1] if opened else None


def _in_brackets(here: _Place, start: _Place, lines: list[str]) -> Fault:
    opening = _char(lines, start)
    closing = {"[": "]", "{": "}"}.get(opening, "]")
    if here.line != start.line or not _char(lines, here):
        words = _(
            "this {opening} is never closed; expected {closing} at the end, commas between",
            opening=opening,
            closing=closing,
        )
        return _fault(start, words)
    return _fault(here, _("expected a comma or {closing} before this", closing=closing))


def _one_colon_too_many(here: _Place, lines: list[str]) -> Fault:
    line = lines[here.line] if here.line < len(lines) else ""
    indent = len(line) - len(line.lstrip())
    if ": " in line[: here.column]:
        return _fault(here, _("a second colon in this line; put the value in quotes"))
    above = next(
        (each for each in reversed(lines[: here.line]) if each.strip(" -") and "#" not in each[:1]),
        "",
    )
    if above and ":" not in above:
        words = _(
            "{line!r}, which stands above, has no colon; expected 'name: value'",
            line=above.strip()[:40],
        )
        return _fault(here, words)
    if indent > len(above) - len(above.lstrip()):
        words = _("this line is indented more than the one above, which has a value already")
        return _fault(_Place(here.line, indent), words)
    return _fault(here, _("no colon was expected here; put the value in quotes"))


def _misaligned(here: _Place, start: _Place, lines: list[str], *, is_list: bool) -> Fault:
    line = lines[here.line] if here.line < len(lines) else ""
    before = line[: here.column].strip()
    if before and before != "-":
        return _fault(here, _("something follows after the value; put all of it in quotes"))
    line_of_start = start.line + 1
    if here.column == start.column and is_list:
        words = _(
            "expected '- ' before each entry of the list that begins in line {line}",
            line=line_of_start,
        )
    elif here.column == start.column and line[here.column : here.column + 1] == "-":
        words = _(
            "a list's entry (-) among the 'name: value' lines from line {line} on",
            line=line_of_start,
        )
    else:
        words = _(
            "this line begins at column {column}, and none of those above that it could belong to "
            "does; expected it to line up with one of them",
            column=here.column + 1,
        )
    return _fault(here, words)


def _fault(place: _Place, words: str) -> Fault:
    return Fault(place.line + 1, place.column + 1, words)


def _char(lines: list[str], place: _Place) -> str:
    line = lines[place.line] if place.line < len(lines) else ""
    return line[place.column : place.column + 1]


def _at(text: str, position: int) -> tuple[int, int]:
    before = text[:position]
    return before.count("\n") + 1, position - (before.rfind("\n") + 1) + 1

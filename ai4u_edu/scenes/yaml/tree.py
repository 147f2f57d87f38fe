"""Parser of YAML events to plain data with line numbers; uses libyaml (C) where available."""

import re
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import yaml

from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes.yaml.messages import fault_of

MAX_DEPTH = 24
MAX_NUMBER_CHARS = 100
"""Length of a number."""

_Event = Any  # PyYAML's types say nothing of what an event has
_Loader: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
HAS_LIBYAML = _Loader is not yaml.SafeLoader
"""True if PyYAML has libyaml, as all its wheels have."""


def _inf_or_nan(text: str) -> float:
    return float(text.replace(".", ""))


# scalars that are no text in YAML 1.2
_SPECIAL = re.compile(r"[-+.0-9~tTfFnN]")
_WORDS = {
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
    **dict.fromkeys(("null", "Null", "NULL", "~", ""), None),
}
_NUMBERS: tuple[tuple[re.Pattern[str], Callable[[str], int | float]], ...] = (
    (re.compile(r"[-+]?[0-9][0-9_]*"), int),
    (re.compile(r"[-+]?(\.[0-9]+|[0-9][0-9_]*(\.[0-9_]*)?)([eE][-+]?[0-9]+)?"), float),
    (re.compile(r"[-+]?0o[0-7]+"), lambda text: int(text, 8)),
    (re.compile(r"[-+]?0x[0-9a-fA-F]+"), lambda text: int(text, 16)),
    (re.compile(r"[-+]?0b[01]+"), lambda text: int(text, 2)),
    (
        re.compile(r"[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN)"),
        _inf_or_nan,
    ),
)


class Tree(NamedTuple):
    """A value with its line."""

    data: Any
    """Mappings, lists, texts, numbers, booleans and None."""
    line: int
    """Line, from 1; of an entry of a mapping its key's."""
    parts: "dict[str | int, Tree]"
    """Entries of a mapping by key, or of a list by index."""


_NONE: "dict[str | int, Tree]" = {}


class NotYamlError(Exception):
    """A text that can't be read.

    Attributes:
        line: from 1; 0 if unknown.
        column: from 1; 0 for the whole line.
    """

    def __init__(self, line: int, text: str, column: int = 0) -> None:
        super().__init__(text)
        self.line, self.column = line, column


def read_tree(text: str) -> Tree:
    """Parse a document.

    Raises:
        NotYamlError: it is not YAML, or uses features that scenes do not need.

    >>> read_tree("a: [1, x]").data
    {'a': [1, 'x']}
    """
    try:
        events = yaml.parse(text, Loader=_Loader)
        return _document(events)
    except (yaml.YAMLError, ValueError) as error:
        fault = fault_of(error, text)
        raise NotYamlError(fault.line, fault.words, fault.column) from None


def _document(events: Iterator[_Event]) -> Tree:
    next(events)  # the stream begins
    if isinstance(next(events), yaml.StreamEndEvent):
        return Tree(None, 1, {})
    tree = _tree(next(events), events, 0)
    next(events)  # the document ends
    after = next(events)
    if not isinstance(after, yaml.StreamEndEvent):
        raise NotYamlError(after.start_mark.line + 1, _("expected one document, got another one"))
    return tree


def _tree(event: _Event, events: Iterator[_Event], depth: int, line: int = 0) -> Tree:
    line = line or event.start_mark.line + 1
    # aliases can expand a small file to a huge one, and tags make objects; scenes need neither
    if isinstance(event, yaml.AliasEvent) or event.anchor is not None or event.tag is not None:
        raise NotYamlError(
            line,
            _(
                "expected plain values; anchors (&), aliases (*) and tags (!) are not used in "
                "scene files"
            ),
        )
    if isinstance(event, yaml.ScalarEvent):
        return Tree(_value(event.value, line) if event.implicit[0] else event.value, line, _NONE)
    if depth > MAX_DEPTH:
        raise NotYamlError(0, _("nested more than {max_depth} deep", max_depth=MAX_DEPTH))
    parts: dict[str | int, Tree] = {}
    if isinstance(event, yaml.SequenceStartEvent):
        while not isinstance(event := next(events), yaml.SequenceEndEvent):
            parts[len(parts)] = _tree(event, events, depth + 1)
        return Tree([part.data for part in parts.values()], line, parts)
    while not isinstance(event := next(events), yaml.MappingEndEvent):
        named = _tree(event, events, depth + 1)
        if not isinstance(event, yaml.ScalarEvent):
            raise NotYamlError(named.line, _("expected words as keys, got lists or mappings"))
        if event.value in parts:
            first = parts[event.value].line
            raise NotYamlError(
                named.line,
                _(
                    "{value} stands here for the second time, after line {first}; expected each "
                    "name once",
                    value=repr(event.value),
                    first=first,
                ),
                _column(event),
            )
        parts[event.value] = _tree(next(events), events, depth + 1, named.line)
    return Tree({key: part.data for key, part in parts.items()}, line, parts)


def _column(event: _Event) -> int:
    return int(event.start_mark.column) + 1


def _value(text: str, line: int) -> Any:
    """Return the value of an unquoted scalar."""
    if text in _WORDS:
        return _WORDS[text]
    if _SPECIAL.match(text):
        for pattern, number in _NUMBERS:
            if pattern.fullmatch(text):
                if len(text) > MAX_NUMBER_CHARS:
                    raise NotYamlError(
                        line,
                        _(
                            "expected numbers of at most {max_number_chars} characters",
                            max_number_chars=MAX_NUMBER_CHARS,
                        ),
                    )
                return number(text.replace("_", ""))
    return text

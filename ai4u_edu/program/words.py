"""Short texts for messages: suggestions of names, and values as they are shown."""

from collections.abc import Iterable
from difflib import get_close_matches
from types import FunctionType, ModuleType
from typing import Any

from ai4u_edu.program.texts import gettext as _

MAX_SHOWN_CHARS = 60
"""Maximum length of a value in a message."""
MAX_NAMES_COMPARED = 500
MAX_NAMES_SHOWN = 20
MAX_NAME_CHARS = 80
_MARKS: dict[type, str] = {list: "[]", tuple: "()", set: "{}", dict: "{}"}
MAX_DEPTH = 3
"""Levels of nested values that are shown."""


def suggest(name: str, known: Iterable[str]) -> str:
    """Return a hint for an unknown name: the nearest known one, or all.

    >>> suggest("mov", ["move", "grip"])
    "did you mean 'move'?"
    >>> suggest("x", ["move", "grip"])
    "known are 'grip', 'move'"
    """
    names = sorted(known)
    if not names:
        return _("there are none")
    near = nearest(name, names)
    if near:
        return _("did you mean {name!r}?", name=near)
    first = ", ".join(repr(each[:MAX_NAME_CHARS]) for each in names[:MAX_NAMES_SHOWN])
    more = len(names) - MAX_NAMES_SHOWN
    if more > 0:
        return _("known are {names} and {more} more", names=first, more=more)
    return _("known are {names}", names=first)


def nearest(name: str, known: Iterable[str]) -> str:
    """Return the known name that is most like an unknown one; empty if none is.

    >>> nearest("Decide", ["decide", "left"])
    'decide'
    """
    if len(name) > MAX_NAME_CHARS:
        return ""
    names = sorted(known)[:MAX_NAMES_COMPARED]
    same = [each for each in names if each.lower() == name.lower()]
    return (same or get_close_matches(name, names, n=1) or [""])[0]


def shorten(text: str, max_chars: int = MAX_SHOWN_CHARS) -> str:
    """Shorten a text to a maximum number of characters."""
    return text if len(text) <= max_chars else text[: max_chars - 3] + "..."


def shown(value: object, max_chars: int = MAX_SHOWN_CHARS) -> str:
    """Return the beginning of a value's repr; no code of the value's class runs.

    >>> shown([1.0] * 1000, 20)
    '[1.0, 1.0, 1.0, 1...'
    >>> shown("x" * 10_000_000, 12)
    "'xxxxxxxx..."
    >>> shown(10**5000)
    'a very large number'
    """
    return shorten(_begun(value, max_chars + 1, 0), max_chars)


def _begun(value: Any, chars: int, depth: int) -> str:
    kind = type(value)
    if kind in (str, bytes):
        return repr(value[: max(chars, 0)])
    if kind is int:
        return repr(value) if value.bit_length() < 1000 else _("a very large number")
    if value is None or kind in (bool, float, complex):
        return repr(value)
    if issubclass(kind, ModuleType | FunctionType | type):
        return f"<{value.__name__[:MAX_NAME_CHARS]}>"
    if kind.__name__ == "Reading" and hasattr(value, "_parts"):
        value, kind = value._parts, list
    marks = _MARKS.get(kind)
    if marks is None:
        return f"<{kind.__name__[:MAX_NAME_CHARS]}>"
    if depth >= MAX_DEPTH:
        return f"{marks[0]}...{marks[1]}"
    parts: list[str] = []
    for each in value.items() if kind is dict else value:
        if chars <= 0:
            break
        if kind is dict:
            part = f"{_begun(each[0], chars, depth + 1)}: {_begun(each[1], chars, depth + 1)}"
        else:
            part = _begun(each, chars, depth + 1)
        chars -= len(part) + 2
        parts.append(part)
    return f"{marks[0]}{', '.join(parts)}{marks[1]}"

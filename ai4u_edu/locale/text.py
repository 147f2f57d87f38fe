"""Sentences that can be shown in several languages; in code they are English."""

import json
import re
from collections.abc import Mapping, Sequence
from typing import Any, Final, Self

PYTHON: Final = "ai4u_edu"
"""The domain of what the Python code says."""
LIBRARY: Final = "library"
"""The domain of the library's scenes and missions."""

Value = str | int | float
"""A value in a sentence; a :class:`Text` is translated with the sentence."""

MAX_PACKED_CHARS: Final = 4000
"""Most characters of a text that is packed for a file or another process."""
PACKED = "\x1e"
"""Begins a packed text: ASCII's record separator, which no sentence has."""
_SAFE_FORMATS = re.compile(r"\{\{|\}\}|\{\w+(![rs])?(:[+,]?(\.\d)?[a-z%]?)?\}")


class Text(str):
    """An English sentence that knows how it was made, so that others can translate it.

    It is made where the sentence is known, by :func:`gettext` and :func:`ngettext`, in any thread;
    :meth:`ai4u_edu.locale.Catalogue.translate` translates it for one reader. Everybody who does not
    care gets a string.
    """

    __slots__ = ("domain", "is_sentence", "msgid", "number", "plural", "values")

    msgid: str
    """The sentence with names in braces for its values: its key in the catalogues."""
    plural: str
    """The same for all numbers but 1; empty if the sentence counts nothing."""
    number: int
    """The number that decides between them."""
    values: Mapping[str, Value]
    """Values by their names in ``msgid``."""
    is_sentence: bool
    """True if it is shown with a capital letter and a full stop."""
    domain: str
    """The catalogue that has its translation."""

    def __new__(
        cls,
        msgid: str,
        values: Mapping[str, Value] = {},
        plural: str = "",
        number: int = 1,
        is_sentence: bool = False,
        domain: str = PYTHON,
    ) -> Self:
        """Make a sentence."""
        pattern = plural if plural and number != 1 else msgid
        english = pattern.format_map(values) if values else pattern
        text = super().__new__(cls, sentence(english) if is_sentence else english)
        text.msgid, text.plural, text.number, text.values = msgid, plural, number, values
        text.is_sentence, text.domain = is_sentence, domain
        return text

    def __reduce__(self) -> tuple[type[Self], tuple[Any, ...]]:
        made_of = self.msgid, self.values, self.plural, self.number, self.is_sentence, self.domain
        return type(self), made_of


def library_text(text: str) -> Text:
    """Return a text of a scene or mission, which is translated if the library has it.

    A text that somebody wrote is in no catalogue, and is shown as it is written.
    """
    return Text(text, domain=LIBRARY)


def gettext(msgid: str, /, **values: Value) -> Text:
    """Return a sentence that can be translated; modules import this function as ``_``.

    Args:
        msgid: the sentence in English, with names in braces for its values, as ``str.format`` has
            them. Without values braces are characters as others are.
        values: values by their names.

    >>> gettext("no body is called {name!r}", name="bxo")
    "no body is called 'bxo'"
    """
    return Text(msgid, values)


def ngettext(one: str, many: str, number: int, /, **values: Value) -> Text:
    """Return a sentence with a count that can be translated.

    Args:
        one: the sentence in English for the number 1.
        many: the sentence for all others; ``{n}`` stands for the number.
        number: the number.
        values: other values by their names.

    >>> [ngettext("{n} body", "{n} bodies", number) for number in (1, 2)]
    ['1 body', '2 bodies']
    """
    return Text(one, {"n": number, **values}, many, number)


def join(texts: Sequence[str], separator: str = " ") -> Text:
    """Return several sentences as one text.

    >>> join([gettext("Saved."), gettext("It works after the next start.")])
    'Saved. It works after the next start.'
    """
    values = {f"text{number}": text for number, text in enumerate(texts)}
    return Text(separator.join(f"{{{name}}}" for name in values), values)


def listed(names: Sequence[str]) -> str:
    """Return names as a list in a sentence.

    >>> [listed(names) for names in (["a"], ["a", "b"], ["a", "b", "c"])]
    ['a', 'a and b', 'a, b and c']
    """
    if len(names) < 2:
        return names[0] if names else ""
    return gettext("{names} and {last}", names=join(names[:-1], ", "), last=names[-1])


def sentence(text: str) -> str:
    """Return a text with a capital letter and a full stop.

    >>> sentence(gettext("no body is called {name!r}", name="bxo"))
    "No body is called 'bxo'."
    """
    if isinstance(text, Text):
        made_of = text.msgid, text.values, text.plural, text.number
        return Text(*made_of, is_sentence=True, domain=text.domain)
    return text[:1].upper() + text[1:].rstrip(".") + "." if text else ""


def packed(text: object, max_chars: int = MAX_PACKED_CHARS) -> str:
    """Return a text as a plain string, for a file or another process, which unpacks it.

    It is a hook for msgspec's encoders, too.

    Args:
        text: the text; a plain string stays as it is.
        max_chars: the most characters; the text is packed in English if it needs more.

    Raises:
        NotImplementedError: it is no string.

    >>> unpacked(packed(gettext("no body is called {name!r}", name="bxo"))).values
    {'name': 'bxo'}
    """
    if not isinstance(text, str):
        raise NotImplementedError(f"expected data, got a {type(text).__name__}")
    if not isinstance(text, Text):
        return text
    values = {name: packed(v) if isinstance(v, str) else v for name, v in text.values.items()}
    parts = text.msgid, values, text.plural, text.number, text.is_sentence, text.domain
    whole = PACKED + json.dumps(parts, ensure_ascii=False, separators=(",", ":"))
    return whole if len(whole) <= max_chars else str(text)


def unpacked(text: str) -> str:
    """Return the text that was packed; a plain string as it is.

    Args:
        text: from anybody; it is empty if it is packed, but not as :func:`packed` does it.
    """
    if not text.startswith(PACKED):
        return text
    try:
        msgid, values, plural, number, is_sentence, domain = json.loads(text[len(PACKED) :])
        inner = {name: _value(value) for name, value in values.items()}
        patterns = (msgid, plural) if inner else ()
        # a pattern of somebody else's could ask for attributes, or for a gigabyte of blanks
        if domain in (PYTHON, LIBRARY) and not any(map(_has_other_braces, patterns)):
            return Text(msgid, inner, plural, int(number), bool(is_sentence), domain)
    except (ValueError, TypeError, LookupError, AttributeError, RecursionError):
        pass
    return ""


def _value(value: object) -> Value:
    if isinstance(value, str):
        return unpacked(value)
    if isinstance(value, int | float):
        return value
    raise TypeError(type(value).__name__)


def _has_other_braces(pattern: str) -> bool:
    rest = _SAFE_FORMATS.sub("", pattern)
    return "{" in rest or "}" in rest

"""Sentences of this package, which can be shown in several languages.

The package has the standard library alone. So it makes its sentences with a function that may be
replaced: by one that translates at once where the page has given its catalogue, or by one of
:mod:`ai4u_edu.locale`, whose texts are translated where they are shown.
"""

from collections.abc import Callable, Mapping

Value = str | int | float
MakeText = Callable[[str, Mapping[str, Value]], str]
"""Function that takes a sentence, with names in braces for its values, and the values."""


def _english(sentence: str, values: Mapping[str, Value]) -> str:
    return sentence.format_map(values) if values else sentence


_make_text: MakeText = _english


def gettext(sentence: str, /, **values: Value) -> str:
    """Return a sentence; modules import this function as ``_``.

    Args:
        sentence: in English, with names in braces for its values. Without values braces are
            characters as others are.
        values: values by their names.

    >>> gettext("there is no sensor called {key!r}", key="eye")
    "there is no sensor called 'eye'"
    """
    return _make_text(sentence, values)


def make_texts_with(make_text: MakeText) -> None:
    """Make sentences with another function from now on, in all threads."""
    global _make_text
    _make_text = make_text


def translate_with(catalogue: Mapping[str, object]) -> None:
    """Translate sentences at once.

    Args:
        catalogue: translations by the sentences in English; others stay English.
    """

    def translated(sentence: str, values: Mapping[str, Value]) -> str:
        found = catalogue.get(sentence)
        return _english(found if isinstance(found, str) else sentence, values)

    make_texts_with(translated)


def deferred(sentence: str) -> str:
    """Return a sentence as it is, for a table; what shows it calls :func:`gettext`.

    Its name is one by which sentences are collected for translators.
    """
    return sentence

"""Translations of texts into one language, read from the compiled catalogues beside this module.

``python -m tests.translations`` makes them; docs/translating.md says how.
"""

import gettext as gnu
import json
import os
import re
import unicodedata
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import lru_cache
from pathlib import Path

from ai4u_edu.locale.languages import (
    LANGUAGES,
    PSEUDO,
    SOURCE,
    VARIABLE,
    known_language,
    language_of_environment,
)
from ai4u_edu.locale.text import PYTHON, Text, Value, sentence

FOLDER = Path(__file__).parent
"""Folder of the languages, in gettext's layout: ``pt_BR/LC_MESSAGES/DOMAIN.mo``."""
PAGE = "page"
"""The domain of the page's scripts and HTML."""
LESSONS = "lessons"
"""The folder of the course's domains, one for each lesson."""

GROWTH = 0.4
"""Growth of a text in the pseudo-locale."""
_KEPT = re.compile(r"<code>.*?</code>|\{[^{}]*\}|<[^<>]*>|`[^`]*`|\]\([^()]*\)|&\w+;|\n")
"""Parts that a translator keeps, too: values, markup, code, addresses."""
_ACUTE = "\N{COMBINING ACUTE ACCENT}"
_WITH_ACUTE = {
    letter: accented
    for letter in "ACEILNORSUYZaceilnorsuyz"
    if len(accented := unicodedata.normalize("NFC", letter + _ACUTE)) == 1
}
_ACCENTS = str.maketrans(_WITH_ACUTE)


def catalogue_file(language: str, name: str) -> Path:
    """Return a file of a language."""
    return FOLDER / language / "LC_MESSAGES" / name


class Catalogue:
    """The translations of one domain into one language. Immutable, thread-safe.

    Args:
        language: its code.
        domain: its domain.
    """

    def __init__(self, language: str, domain: str = PYTHON) -> None:
        self.language, self.domain = language, domain

    def translate(self, text: str) -> str:
        """Return a text in this language; a plain string, and what has no translation, as it is.

        >>> Catalogue("en").translate("as it is")
        'as it is'
        """
        if not isinstance(text, Text) or self.language == SOURCE:
            return str(text)
        translations = _translations(self.language, text.domain)
        if text.plural:
            pattern = translations.ngettext(text.msgid, text.plural, text.number)
        else:
            pattern = translations.gettext(text.msgid) if text.msgid else ""
        if text.values:
            pattern = pattern.format_map({name: self._value(v) for name, v in text.values.items()})
        return sentence(pattern) if text.is_sentence else pattern

    def message(self, msgid: str) -> str:
        """Return the translation of a text that is its own key, such as the title of a scene."""
        # the empty text is the key of a catalogue's header
        return _translations(self.language, self.domain).gettext(msgid) if msgid else ""

    def _value(self, value: Value) -> Value:
        if isinstance(value, int) and not isinstance(value, bool):
            return _WholeNumber(value)
        return self.translate(value) if isinstance(value, Text) else value


class _WholeNumber(int):
    """A number whose thousands stand apart with a point, as our translations write them."""

    def __format__(self, spec: str) -> str:
        return int.__format__(self, spec).replace(",", ".")


class _PseudoTranslations(gnu.NullTranslations):
    def gettext(self, message: str) -> str:
        return pseudo(message)

    def ngettext(self, msgid1: str, msgid2: str, n: int) -> str:
        return pseudo(super().ngettext(msgid1, msgid2, n))


@lru_cache
def _translations(language: str, domain: str) -> gnu.NullTranslations:
    if language == PSEUDO:
        return _PseudoTranslations()
    file = catalogue_file(language, f"{domain}.mo")
    if not file.is_file():
        return gnu.NullTranslations()
    with file.open("rb") as opened:
        return gnu.GNUTranslations(opened)


@lru_cache
def page_catalogue(language: str) -> str:
    """Return the catalogue of the page's scripts as JSON, for ``web/shared/text.js``.

    Its keys are English texts; its values translations, by the plural categories of CLDR where a
    text counts something.
    """
    file = catalogue_file(_TRANSLATED[0] if language == PSEUDO else language, f"{PAGE}.json")
    messages: dict[str, str | dict[str, str]] = {}
    if language != SOURCE and file.is_file():
        messages = json.loads(file.read_text(encoding="utf-8"))
    if language == PSEUDO:
        messages = {
            # a plural's key is its singular; its translations tell that it is one
            key: pseudo(key) if isinstance(value, str) else {"one": pseudo(key)}
            for key, value in messages.items()
        }
    return json.dumps({"language": language, "messages": messages}, ensure_ascii=False)


_TRANSLATED = tuple(code for code in LANGUAGES if code != SOURCE)
_own: list[Catalogue] = []
_chosen: list[Catalogue] = []
"""Choice of :func:`set_language`; empty before it."""
_reader: ContextVar[Catalogue | None] = ContextVar("reader", default=None)


def set_language(language: str) -> None:
    """Choose the language of this process's terminal or notebook, and of errors as strings there.

    Programs that it starts later have it, too.

    Args:
        language: its code, such as ``"pt_BR"``.

    Raises:
        ValueError: there are no texts in it.
    """
    code = known_language(language)
    if not code:
        raise ValueError(f"expected one of {', '.join(LANGUAGES)}, got {language!r}")
    _own[:] = _chosen[:] = [Catalogue(code)]
    os.environ[VARIABLE] = code


def in_chosen_language(text: str) -> str:
    """Return a text in the language that :func:`set_language` chose; in English before that.

    For what a person's own program prints of an error. Where it is known who reads, take
    :func:`translate`.
    """
    return _chosen[0].translate(text) if _chosen else str(text)


@contextmanager
def reader(language: str) -> Iterator[None]:
    """Translate into a language in this context: in a page's request or socket.

    Tasks that are begun meanwhile, and what they run in threads, have it, too.

    Args:
        language: the code of a known language.
    """
    token = _reader.set(Catalogue(language))
    try:
        yield
    finally:
        _reader.reset(token)


def catalogue() -> Catalogue:
    """Return the catalogue of the reader: of the page that is served, of the terminal or notebook.

    The language of a terminal or notebook is the one that :func:`set_language` chose; else that of
    the environment.
    """
    reading = _reader.get()
    if reading is not None:
        return reading
    if not _own:
        _own.append(Catalogue(language_of_environment()))
    return _own[0]


def translate(text: str) -> str:
    """Return a text in the reader's language; see :func:`catalogue`."""
    return catalogue().translate(text)


def pseudo(text: str) -> str:
    """Return a text in the pseudo-locale.

    >>> pseudo("Save {name}")
    'Śávé {name}~~'
    """
    kept = _KEPT.findall(text)
    words = [part.translate(_ACCENTS) for part in _KEPT.split(text)]
    parts = [words[0]]
    for code, word in zip(kept, words[1:], strict=True):
        parts += code, word
    return "".join(parts) + "~" * round(GROWTH * sum(map(len, words)))

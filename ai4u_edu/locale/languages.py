"""Languages in which texts are shown, and the choice of one for a reader."""

import os
from collections.abc import Iterable, Mapping
from typing import Final

SOURCE: Final = "en"
"""The language of all texts in the code."""
PSEUDO: Final = "en_XA"
"""English with accents and 40% longer: it shows texts that nobody marked, or that don't fit."""
LANGUAGES: Final[Mapping[str, str]] = {SOURCE: "English", "pt_BR": "Português (Brasil)"}
"""The names of the languages in themselves by their codes."""
VARIABLE: Final = "AI4U_LANG"
"""The environment variable with the code of the wanted language."""
MAX_HEADER_CHARS: Final = 500
"""Most characters of a header that are read."""


def known_language(wanted: str) -> str:
    """Return the code of a language, however it is spelled; empty if there are no texts in it.

    >>> [known_language(each) for each in ("pt_BR", "pt-br", "pt", "pt_PT.UTF-8", "en-GB", "la")]
    ['pt_BR', 'pt_BR', 'pt_BR', 'pt_BR', 'en', '']
    """
    code = wanted.partition(".")[0].partition("@")[0].strip().replace("-", "_").lower()
    codes = (*LANGUAGES, PSEUDO)
    for known in codes:
        if known.lower() == code:
            return known
    for known in LANGUAGES:
        if code and known.partition("_")[0] == code.partition("_")[0]:
            return known
    return ""


def language_of_header(accept_language: str) -> str:
    """Return the language that a browser asks for with its header ``Accept-Language``.

    Args:
        accept_language: the header, from anybody; what can't be read in it is left out.

    >>> language_of_header("la;q=0.9, pt-BR, en;q=0.8")
    'pt_BR'
    >>> language_of_header("la"), language_of_header("en;q=0.4, pt;q=0.7"), language_of_header("")
    ('', 'pt_BR', '')
    """
    wanted = [_weighted(part) for part in accept_language[:MAX_HEADER_CHARS].split(",")]
    wanted.sort(key=lambda pair: -pair[1])
    return _first(code for code, weight in wanted if weight > 0)


def language_of_environment(environment: Mapping[str, str] | None = None) -> str:
    """Return the language of this program's terminal; English if there is none or another one.

    Args:
        environment: the environment's variables; default: those of this process.

    >>> language_of_environment({"LANG": "pt_BR.UTF-8"})
    'pt_BR'
    >>> language_of_environment({"LANG": "pt_BR.UTF-8", "AI4U_LANG": "en"})
    'en'
    >>> language_of_environment({"LANG": "C.UTF-8"})
    'en'
    """
    variables = os.environ if environment is None else environment
    # the order in which gettext looks, too
    names = (VARIABLE, "LANGUAGE", "LC_ALL", "LC_MESSAGES", "LANG")
    wanted = (code for name in names for code in variables.get(name, "").split(":"))
    return _first(wanted) or SOURCE


def language_of_page(accept_language: str) -> str:
    """Return the language for a page: of this program's option, the browser, or the terminal.

    Args:
        accept_language: the browser's header, or an empty text.
    """
    return (
        known_language(os.environ.get(VARIABLE, ""))
        or language_of_header(accept_language)
        or language_of_environment()
    )


def _first(wanted: Iterable[str]) -> str:
    return next((known for known in map(known_language, wanted) if known), "")


def _weighted(part: str) -> tuple[str, float]:
    code, _, weight = part.partition(";")
    try:
        return code, float(weight.strip().removeprefix("q=") or 1)
    except ValueError:
        return code, 0.0

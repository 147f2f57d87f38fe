"""Join codes, and names and colours of seats; nothing here says who a person is."""

import secrets
from collections.abc import Collection
from functools import cache
from importlib.resources import files
from itertools import product

CODE_LETTERS = "BCDFGHJKMNPRSTVWXZ"
"""Letters of a code: without those that look like others, and without vowels, which make words."""
CODE_LENGTH = 5
COLOURS = (
    "#0072b2",
    "#d55e00",
    "#009e73",
    "#cc79a7",
    "#e69f00",
    "#56b4e9",
    "#7a5195",
    "#8a6d3b",
)
"""Colours that people with colour blindness can tell apart, given out in turn."""
DEFAULT_LANGUAGE = "en"
_FOLDER = files("ai4u_edu.classroom") / "words"
LANGUAGES = tuple(
    sorted(each.name.removesuffix(".txt") for each in _FOLDER.iterdir() if ".txt" in each.name)
)
"""Languages of names."""


@cache
def words_of(language: str) -> tuple[list[str], list[str]]:
    """Return the first and the second words of names; each first one goes with each second one.

    >>> [len(words) > 30 for words in words_of("pt")]
    [True, True]
    """
    text = (_FOLDER / f"{language}.txt").read_text(encoding="utf-8")
    first, second = (line.split() for line in text.splitlines())
    return first, second


def new_code() -> str:
    """Return a random join code."""
    return "".join(secrets.choice(CODE_LETTERS) for _ in range(CODE_LENGTH))


def normalized_code(text: str) -> str:
    """Return a code as it is compared: capital letters, without spaces and hyphens.

    >>> normalized_code(" kv-btm ")
    'KVBTM'
    """
    return "".join(text.split()).replace("-", "").upper()


def is_name(text: str) -> bool:
    """Return True for a name of the lists, in any language.

    >>> is_name("Blue Otter"), is_name("Lobo Feliz"), is_name("Ada Lovelace")
    (True, True, False)
    """
    first, _, second = text.partition(" ")
    words = map(words_of, LANGUAGES)
    return any(first in firsts and second in seconds for firsts, seconds in words)


def free_names(taken: Collection[str], count: int, language: str = DEFAULT_LANGUAGE) -> list[str]:
    """Return different random names that nobody has."""
    names = (f"{first} {second}" for first, second in product(*words_of(language)))
    free = [name for name in names if name not in taken]
    return secrets.SystemRandom().sample(free, min(count, len(free)))


def colour_of(number: int) -> str:
    """Return the colour of a seat."""
    return COLOURS[number % len(COLOURS)]

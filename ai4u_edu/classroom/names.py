"""Join codes, and names and colours of seats; nothing here says who a person is."""

import secrets
from collections.abc import Collection
from importlib.resources import files

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
_WORDS = files("ai4u_edu.classroom") / "words" / "en.txt"
FIRST, SECOND = (line.split() for line in _WORDS.read_text(encoding="utf-8").splitlines())


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
    """Return True for a name of the lists.

    >>> is_name("Blue Otter"), is_name("Ada Lovelace")
    (True, False)
    """
    first, _, second = text.partition(" ")
    return first in FIRST and second in SECOND


def free_names(taken: Collection[str], count: int) -> list[str]:
    """Return different random names that nobody has."""
    free = [
        name for first in FIRST for second in SECOND if (name := f"{first} {second}") not in taken
    ]
    return secrets.SystemRandom().sample(free, min(count, len(free)))


def colour_of(number: int) -> str:
    """Return the colour of a seat."""
    return COLOURS[number % len(COLOURS)]

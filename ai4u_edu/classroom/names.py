"""Codes, and names and colours of seats; nothing here says who a person is."""

import secrets
import time
from collections.abc import Callable, Collection
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from itertools import product

from ai4u_edu.locale import catalogue

CODE_LETTERS = "BCDFGHJKMNPRSTVWXZ"
"""Letters of a code: without those that look like others, and without vowels, which make words."""
CODE_LENGTH = 5
MOVE_CODE_LIFE_S = 300.0
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

    >>> [len(words) > 30 for words in words_of("pt_BR")]
    [True, True]
    """
    text = (_FOLDER / f"{language}.txt").read_text(encoding="utf-8")
    first, second = (line.split() for line in text.splitlines())
    return first, second


def names_language() -> str:
    """Return the language of this program, if there are names in it; else English."""
    language = catalogue().language
    return language if language in LANGUAGES else DEFAULT_LANGUAGE


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


@dataclass
class _MoveCode:
    seat: int
    ends_at: float
    is_teachers: bool
    request: str = ""
    """Digest of the join request that has used it; empty before."""


class MoveCodes:
    """Codes with which seats move to other devices. Not thread-safe.

    Each has five letters, and is for one seat, one device and five minutes.

    Args:
        clock: returns seconds; to be replaced in tests.

    >>> codes = MoveCodes()
    >>> code = codes.new(3, ())
    >>> codes.use(code, "a"), codes.use(code, "a"), codes.use(code, "b")
    ((3, False), (3, False), (0, False))
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._codes: dict[str, _MoveCode] = {}

    def new(self, seat: int, taken: Collection[str], *, is_teachers: bool = False) -> str:
        """Return a new code of a seat, whose code before is void.

        Args:
            seat: its number.
            taken: codes that must not be used, such as the class's.
            is_teachers: True for a code that the teacher has asked for.
        """
        now = self._clock()
        self._codes = {
            code: each
            for code, each in self._codes.items()
            if each.ends_at > now and each.seat != seat
        }
        while (code := new_code()) in self._codes or code in taken:
            pass
        self._codes[code] = _MoveCode(seat, now + MOVE_CODE_LIFE_S, is_teachers)
        return code

    def use(self, code: str, request: str) -> tuple[int, bool]:
        """Use a code, and return its seat, and True if it is the teacher's.

        The seat is 0 if there is no such code, or another request has used it.

        Args:
            code: normalized.
            request: digest of the join request, which may be repeated because an answer was lost.
        """
        found = self._codes.get(code)
        if found is None or found.ends_at <= self._clock() or found.request not in ("", request):
            return 0, False
        found.request = request
        return found.seat, found.is_teachers

    def is_open(self, seat: int) -> bool:
        """Return True while a seat has a code that nobody has used yet."""
        return any(
            each.seat == seat and not each.request and each.ends_at > self._clock()
            for each in self._codes.values()
        )

    def cancel(self, seat: int) -> None:
        """Make the code of a seat void."""
        self._codes = {code: each for code, each in self._codes.items() if each.seat != seat}

    def clear(self) -> None:
        """Make all codes void."""
        self._codes.clear()

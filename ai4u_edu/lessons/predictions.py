"""``predict`` and ``compare``: a guess before a result, and both side by side after it."""

import html
import re
from collections.abc import Mapping
from contextlib import suppress
from itertools import zip_longest
from typing import Any

from ai4u_edu.base.errors import SetupError
from ai4u_edu.lessons.notebook_output import put, tell
from ai4u_edu.lessons.prediction_values import Value, saved_value, shown
from ai4u_edu.lessons.progress_file import ProgressFile
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import translate

_ID = re.compile(r"\d\d\.\w+")
GUESS_FIRST = _("Write your guess first: it costs nothing to be wrong.")
NO_GUESS = _(
    "You wrote no guess this time. Guess first at the next one: it helps even if it is wrong."
)


def predict(prediction_id: str, guess: Any) -> None:
    """Save a guess, and show it; a later one replaces it.

    Args:
        prediction_id: the lesson's number, a point, and a number or word, such as ``"09.1"``.
        guess: a number, a short text, or a list of these.

    Raises:
        SetupError: the id has another form.
    """
    _check_id(prediction_id)
    if _is_empty(guess):
        tell("grey", _("No guess yet."), [GUESS_FIRST])
        return
    value = saved_value(guess)
    progress = ProgressFile()
    progress.note_prediction(prediction_id, guess=value)
    lines = [f"{shown(value)}.", *([progress.trouble] if progress.trouble else [])]
    tell("blue", _("You said"), lines)


def compare(prediction_id: str, actual: Any) -> None:
    """Show a guess beside the result, with the difference of numbers.

    Args:
        prediction_id: as in ``predict``.
        actual: a number, a short text, or a list of these.

    Raises:
        SetupError: the id has another form.
    """
    _check_id(prediction_id)
    value = saved_value(actual)
    prediction = ProgressFile().note_prediction(prediction_id, actual=value)
    if prediction is None:
        tell("blue", _("It is"), [f"{shown(value)}.", NO_GUESS])
        return
    rows = _rows(prediction.guess, value)
    put(_table(rows), "\n".join(translate(_in_words(*row)) for row in rows))


def _check_id(prediction_id: Any) -> None:
    if not isinstance(prediction_id, str) or not _ID.fullmatch(prediction_id):
        raise SetupError(
            _(
                "expected a prediction's number in quotes, such as '09.1', got {prediction_id!r}",
                prediction_id=prediction_id,
            )
        )


def _is_empty(guess: Any) -> bool:
    """Return True while a placeholder stands for the guess, or for a part of it."""
    if isinstance(guess, Mapping):
        guess = list(guess.values())
    if isinstance(guess, list | tuple):
        return not guess or any(_is_empty(each) for each in guess)
    return guess is ... or guess is None or (isinstance(guess, str) and not guess.strip(" ."))


def _rows(guess: Value, actual: Value) -> list[tuple[str, str, str]]:
    """Return guess, result and difference of each item, in words."""
    guesses = guess if isinstance(guess, list) else [guess]
    results = actual if isinstance(actual, list) else [actual]
    return [
        (shown(said), shown(got), _difference(said, got))
        for said, got in zip_longest(guesses, results, fillvalue="\u2013")
    ]


def _in_words(said: str, got: str, gap: str) -> str:
    if not gap:
        return _("You said {said}. It is {got}.", said=said, got=got)
    return _("You said {said}. It is {got}. Difference: {gap}.", said=said, got=got, gap=gap)


def _difference(said: str | float, got: str | float) -> str:
    if isinstance(said, str) and isinstance(got, float):
        with suppress(ValueError, OverflowError):
            said = said if "n" in said.lower() else float(said)  # not "nan" and "inf"
    if isinstance(said, str) or isinstance(got, str):
        return _("none") if str(said).lower() == str(got).lower() else ""
    gap = said - got
    if abs(gap) < 1e-9 * max(1.0, abs(got)):
        return _("none")
    size = shown(abs(gap))
    return _("{size} too high", size=size) if gap > 0 else _("{size} too low", size=size)


def _table(rows: list[tuple[str, str, str]]) -> str:
    heads = (_("you said"), _("it is"), _("difference"))
    head = "".join(f"<th>{html.escape(translate(each))}</th>" for each in heads)
    body = "".join(
        f"<tr>{''.join(f'<td>{html.escape(translate(each))}</td>' for each in row)}</tr>"
        for row in rows
    )
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"

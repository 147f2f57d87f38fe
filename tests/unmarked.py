"""Sentences that reach a reader without a mark for translation, collected while tests run.

``python -m pytest --unmarked FILE tests/...`` writes them: errors of ours, what is translated
although it is no :class:`ai4u_edu.locale.Text`, values of texts, lines of the command line, and
refusals of a server. What a student wrote, and what developers alone read, is among them.
"""

import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
import typer
from starlette.exceptions import HTTPException

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.locale import Catalogue, Text

ENGLISH = {"a", "an", "and", "are", "at", "expected", "for", "got", "in", "is", "it", "no", "not"}
ENGLISH |= {"of", "on", "only", "or", "the", "this", "to", "was", "with"}
MIN_WORDS, MIN_ENGLISH = 3, 1
MAX_CHARS = 300


def is_english(text: object) -> bool:
    """Return True for a plain string that is an English sentence."""
    if isinstance(text, Text) or not isinstance(text, str):
        return False
    words = re.findall(r"[A-Za-z']+", text)
    return len(words) >= MIN_WORDS and sum(word in ENGLISH for word in words) >= MIN_ENGLISH


@contextmanager
def unmarked() -> Iterator[dict[str, str]]:
    """Yield a dictionary that fills with sentences and the places where they appeared."""
    found: dict[str, str] = {}
    translations: set[str] = set()

    def note(place: str, text: object) -> None:
        if is_english(text) and text not in translations:
            found.setdefault(" ".join(str(text).split())[:MAX_CHARS], place)

    def before(place: str, function: Callable[..., Any], index: int) -> Callable[..., Any]:
        def call(*args: Any, **kwargs: Any) -> Any:
            if len(args) > index:
                note(place, args[index])
            return function(*args, **kwargs)

        return call

    real = Catalogue.translate

    def translate(self: Catalogue, text: str) -> str:
        note("translated", text)
        if isinstance(text, Text):
            for value in text.values.values():
                note("value", value)
        result = real(self, text)
        translations.add(result)
        return result

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Catalogue, "translate", translate)
        patch.setattr(AI4UError, "__init__", before("error", AI4UError.__init__, 1))
        patch.setattr(HTTPException, "__init__", before("refusal", HTTPException.__init__, 2))
        patch.setattr(typer, "echo", before("command line", typer.echo, 0))
        yield found


class Unmarked:
    """Plugin that collects them during a run of the tests, and writes them at its end.

    Args:
        file: gets a line for each sentence; each process of a run appends its own.
    """

    def __init__(self, file: Path) -> None:
        self._file = file

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_call(self, item: pytest.Item) -> Iterator[None]:
        """Collect while a test runs."""
        with unmarked() as found:
            try:
                yield
            finally:
                with self._file.open("a", encoding="utf-8") as lines:
                    for text, place in found.items():
                        lines.write(f"{place}\t{text}\t{item.nodeid}\n")

"""Every text of the Python code rendered with values, in each language."""

import re
from collections.abc import Iterator
from string import Formatter

import pytest

from ai4u_edu.locale import LANGUAGES, PSEUDO, PYTHON, Catalogue, Text
from ai4u_edu.locale.text import Value
from tests import translations

pytestmark = pytest.mark.needs("dev")

TEXT, WHOLE, FRACTION = "qwx", 7, 1.5
"""Values that no sentence has in it."""
NUMBERS = (0, 1, 2, 5)
NAME = re.compile(r"[^\W\d]\w*")
SPEC = re.compile(r"[-+#,<>^.\w%]*")


def fields_of(msgid: str) -> list[tuple[str, str]]:
    """Return names and formats of the values of a text; none if its braces are characters."""
    try:
        parts = list(Formatter().parse(msgid))
    except ValueError:
        return []
    fields = [(name, spec or "") for _, name, spec, _ in parts if name is not None]
    are_values = all(NAME.fullmatch(name) and SPEC.fullmatch(spec) for name, spec in fields)
    return fields if are_values else []


def values_of(msgid: str) -> dict[str, Value]:
    values: dict[str, Value] = {}
    for name, spec in fields_of(msgid):
        if spec[-1:] in ("d", ",", "x", "+"):
            values[name] = WHOLE
        elif spec[-1:] in ("f", "g", "e", "%"):
            values[name] = FRACTION
        else:
            values.setdefault(name, TEXT)
    return values


def texts() -> Iterator[tuple[str, str]]:
    """Yield all texts, with their plural or an empty text."""
    (domain,) = (each for each in translations.domains() if each.name == PYTHON)
    for text, _ in domain.texts:
        yield (text, "") if isinstance(text, str) else text


@pytest.mark.parametrize("language", [*LANGUAGES, PSEUDO])
def test_every_text_can_be_rendered(language: str) -> None:
    catalogue = Catalogue(language)
    broken = []
    for one, many in texts():
        values = values_of(one) | values_of(many)
        for number in NUMBERS if many else (1,):
            counted = {**values, "n": number} if many else values
            try:
                shown = catalogue.translate(Text(one, counted, many, number))
            except (LookupError, ValueError, TypeError) as error:
                broken.append(f"{one!r}: {type(error).__name__}: {error}")
                continue
            if TEXT in counted.values() and TEXT not in shown:
                broken.append(f"{one!r}: a value is missing in {shown!r}")
    assert broken == []

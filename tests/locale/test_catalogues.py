"""The catalogues: valid, complete in values and markup, and compiled."""

import pytest

from ai4u_edu.locale.catalogues import FOLDER, catalogue_file
from tests import translations

pytestmark = pytest.mark.needs("dev")

CATALOGUES = [
    (file.relative_to(FOLDER).parts[0], file)
    for file in sorted(FOLDER.glob("*/LC_MESSAGES/**/*.po"))
]
EACH = pytest.mark.parametrize(
    ("language", "domain"),
    [
        (language, file.relative_to(catalogue_file(language, "")).with_suffix("").as_posix())
        for language, file in CATALOGUES
    ],
)


@EACH
def test_translations_keep_values_and_markup(language: str, domain: str) -> None:
    problems = [
        f"{message.id!r}: {problem}"
        for message in translations.translated(translations.read(language, domain))
        for problem in translations.problems_of(message)
    ]
    assert problems == []


@EACH
def test_the_compiled_catalogue_is_up_to_date(language: str, domain: str) -> None:
    file = translations.compiled(language, domain)
    assert file.read_bytes() == translations.compiled_content(language, domain), (
        "run python -m tests.translations compile"
    )

"""The catalogues: valid, complete in values and markup, and compiled."""

import re

import pytest

from ai4u_edu.locale.catalogues import catalogue_file
from tests import translations

pytestmark = pytest.mark.needs("dev")

CATALOGUES = [
    (language, file.relative_to(catalogue_file(language, "")).with_suffix("").as_posix())
    for language in translations.TRANSLATED
    for file in sorted(catalogue_file(language, "").rglob("*.po"))
]
OF_DOCS = [
    (language, name)
    for language in translations.TRANSLATED
    for name in (*translations.PAGES, translations.SITE)
    if translations.po_file(language, name).is_relative_to(translations.ROOT / "docs")
]


@pytest.mark.parametrize(("language", "domain"), [*CATALOGUES, *OF_DOCS])
def test_translations_keep_values_and_markup(language: str, domain: str) -> None:
    problems = [
        f"{message.id!r}: {problem}"
        for message in translations.translated(translations.read(language, domain))
        for problem in translations.problems_of(message)
    ]
    assert problems == []


@pytest.mark.parametrize(("language", "domain"), CATALOGUES)
def test_the_compiled_catalogue_is_up_to_date(language: str, domain: str) -> None:
    file = translations.compiled(language, domain)
    assert file.read_bytes() == translations.compiled_content(language, domain), (
        "run python -m tests.translations compile"
    )


@pytest.mark.parametrize("language", translations.TRANSLATED)
def test_the_readme_is_up_to_date_in_each_language(language: str) -> None:
    text = translations.readme_file(language).read_text(encoding="utf-8")
    assert text == translations.readme(language), "run python -m tests.translations compile"


@pytest.mark.parametrize("language", translations.TRANSLATED)
def test_the_readme_has_the_same_commands_and_links_in_each_language(language: str) -> None:
    def kept(text: str) -> list[str]:
        blocks = re.findall(r"```.*?```", text, re.DOTALL)
        words = " ".join(re.sub(r"```.*?```", "", text, flags=re.DOTALL).split())
        return blocks + re.findall(r"`[^`]+`|\]\([^)]+\)|src=\"[^\"]+\"", words)

    english = translations.README.read_text(encoding="utf-8")
    own = translations.readme_file(language).read_text(encoding="utf-8")
    assert [sorted(kept(each)) for each in own.split("\n## ")] == [
        sorted(kept(each)) for each in english.split("\n## ")
    ]
    assert f'href="{translations.readme_file(language).name}"' in english
    assert f'href="{translations.README.name}"' in own

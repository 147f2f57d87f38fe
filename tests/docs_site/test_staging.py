"""The sources of the docs site, in each language."""

import re
from pathlib import Path

import pytest

from ai4u_edu.locale import LANGUAGES, SOURCE
from tests import translations
from tests.docs_site.staging import Staging, anchors
from tests.translations import TRANSLATED


@pytest.mark.parametrize("language", LANGUAGES)
def test_links_lead_to_headings_in_each_language(language: str, tmp_path: Path) -> None:
    site = Staging(tmp_path, language)
    site.add_repository()
    found = 0
    for page in tmp_path.rglob("*.md"):
        for place, anchor in re.findall(r"\]\(([^)\s#:]*)#([^)\s]+)\)", page.read_text("utf-8")):
            target = (page.parent / place).resolve() if place else page
            assert anchor in anchors(target.read_text("utf-8")), f"{page}: {place}#{anchor}"
            found += 1
    assert found > 30


def test_anchors_are_those_of_the_translated_headings(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (language, *_) = TRANSLATED
    words = {"Keys": "Teclas de dirigir", "Build a scene": "Monte uma cena"}
    monkeypatch.setattr(translations, "translation", lambda *_: lambda text: words.get(text, text))
    Staging(tmp_path, language).add_repository()
    assert "\n## Teclas de dirigir\n" in (tmp_path / "build-a-scene.md").read_text("utf-8")
    assert "(build-a-scene.md#teclas-de-dirigir)" in (tmp_path / "page.md").read_text("utf-8")
    Staging(tmp_path, SOURCE).add_repository()
    assert "(build-a-scene.md#keys)" in (tmp_path / "page.md").read_text("utf-8")

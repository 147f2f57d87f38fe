"""The choice of a language: an option, the browser, the terminal."""

import pytest

from ai4u_edu.locale import LANGUAGES, VARIABLE, language_of_page, set_language, translate


@pytest.fixture
def _terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in (VARIABLE, "LANGUAGE", "LC_ALL", "LC_MESSAGES"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("LANG", "pt_BR.UTF-8")


@pytest.mark.usefixtures("_terminal")
@pytest.mark.parametrize(
    ("header", "wanted"),
    [
        ("en-US,en;q=0.9,pt;q=0.8", "en"),
        ("pt", "pt_BR"),
        ("la", "pt_BR"),  # of the terminal
        ("", "pt_BR"),
        ("pt;q=0, en", "en"),
        ("*", "pt_BR"),
        (";;q=a,,pt-BR;q=nan", "pt_BR"),
    ],
)
def test_a_browser_decides_before_the_terminal(header: str, wanted: str) -> None:
    assert language_of_page(header) == wanted


@pytest.mark.usefixtures("_terminal")
def test_an_option_decides_before_the_browser(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(VARIABLE, "en")
    assert language_of_page("pt-BR") == "en"


def test_an_unknown_language_is_refused() -> None:
    known = ", ".join(LANGUAGES)
    with pytest.raises(ValueError, match=f"expected one of {known}, got 'klingon'"):
        set_language("klingon")
    assert translate("as it is") == "as it is"

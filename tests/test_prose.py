"""The packages whose docstrings and constants follow the language guide stay so."""

import pytest

from tests.prose import ROOT, check_paths

CHECKED: tuple[str, ...] = ("tests/prose.py",)


@pytest.mark.parametrize("path", CHECKED)
def test_docstrings_and_constants_follow_the_language_guide(path: str) -> None:
    assert check_paths([ROOT / path]) == []

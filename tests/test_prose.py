"""Docstrings and constants follow the language guide, as far as a machine can tell."""

from tests.prose import ROOT, check_paths


def test_docstrings_and_constants_follow_the_language_guide() -> None:
    assert check_paths([ROOT / "ai4u_edu", ROOT / "tests"]) == []

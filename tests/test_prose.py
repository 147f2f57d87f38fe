"""Docstrings, comments, constants and scripts follow the language guide, as a machine can tell."""

from tests.prose import ROOT, check_paths


def test_python_and_javascript_follow_the_language_guide() -> None:
    assert check_paths([ROOT / "ai4u_edu", ROOT / "tests", ROOT / "web"]) == []

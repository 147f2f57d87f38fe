"""The packages whose docstrings and constants follow the language guide stay so."""

import pytest

from tests.prose import ROOT, check_paths

CHECKED = (
    "tests/prose.py",
    "ai4u_edu/cli",
    "ai4u_edu/envs",
    "ai4u_edu/lessons",
    "ai4u_edu/training",
)


@pytest.mark.parametrize("path", CHECKED)
def test_docstrings_and_constants_follow_the_language_guide(path: str) -> None:
    assert check_paths([ROOT / path]) == []

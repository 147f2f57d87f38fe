"""Messages for a person who lacks an extra."""

import sys

import pytest

from ai4u_edu.base import optional_deps
from ai4u_edu.base.errors import SetupError


@pytest.mark.parametrize(
    ("platform", "module", "is_advised"),
    [("linux", "torch", True), ("darwin", "torch", False), ("linux", "openskill", False)],
)
def test_the_small_torch_is_advised_where_the_usual_one_is_large(
    monkeypatch: pytest.MonkeyPatch, platform: str, module: str, is_advised: bool
) -> None:
    monkeypatch.setattr(optional_deps, "find_spec", lambda _name: None)
    monkeypatch.setattr(sys, "platform", platform)
    with pytest.raises(SetupError, match=r'pip install "ai4u-edu\[train\]"') as error:
        optional_deps.need("train", module)
    words = "first: pip install torch --index-url https://download.pytorch.org/whl/cpu (0.7 GB"
    assert (words in str(error.value)) is is_advised

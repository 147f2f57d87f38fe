"""Workflows of the repository's host: pinned actions, and what a release waits for."""

import re
from pathlib import Path
from typing import Any

import pytest
import yaml

FOLDER = Path(__file__).parents[1] / ".github" / "workflows"
FILES = sorted(FOLDER.glob("*.yml"))


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_actions_are_pinned_to_commits_with_their_versions(file: Path) -> None:
    used = [line for line in file.read_text(encoding="utf-8").splitlines() if "uses:" in line]
    assert used
    pinned = r".*uses: [\w-]+/[\w-]+@[0-9a-f]{40}  # v\d+\.\d+\.\d+(;.*)?"
    assert [line for line in used if not re.fullmatch(pinned, line)] == []


def test_a_release_waits_for_the_docs_and_publishes_them() -> None:
    text = (FOLDER / "release.yml").read_text(encoding="utf-8")
    jobs: dict[str, Any] = yaml.safe_load(text)["jobs"]
    assert {*jobs["publish"]["needs"]} == {"docs", "sdist", "wheels"}
    assert "actions/upload-pages-artifact" in str(jobs["docs"]["steps"])
    deploy = jobs["publish-docs"]
    assert "publish" in deploy["needs"]
    assert "actions/deploy-pages" in str(deploy["steps"])
    assert deploy["permissions"] == {"id-token": "write", "pages": "write"}

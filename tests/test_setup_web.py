"""Checks of the page's scripts: their commands, and a sentence where Node.js is missing or old."""

import os
import shutil
from pathlib import Path

import pytest

from tests import setup_web
from tests.tiers import ROOT

OLD = "#!/bin/sh\necho v18.20.0\n"
pytestmark = pytest.mark.skipif(os.name == "nt", reason="the old Node.js is a shell script")


def test_a_missing_program_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(setup_web.WebToolsError, match=r"Expected node on PATH .* Install Node\.js"):
        setup_web.ensure(ROOT)


def test_an_old_program_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "node").write_text(OLD)
    (tmp_path / "node").chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}{os.pathsep}{os.environ['PATH']}")
    with pytest.raises(setup_web.WebToolsError, match=r"20\.19 or newer .* found v18\.20\.0"):
        setup_web.ensure(ROOT)


def test_the_lock_file_names_no_registry() -> None:
    lock = (ROOT / "web" / "package-lock.json").read_text(encoding="utf-8")
    assert '"integrity"' in lock
    assert '"resolved"' not in lock


def test_node_modules_are_installed_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tools = tmp_path / "bin"
    tools.mkdir()
    (tools / "npm").write_text("#!/bin/sh\nmkdir -p node_modules\necho x >> ran\n")
    (tools / "npm").chmod(0o755)
    monkeypatch.setenv("PATH", f"{tools}{os.pathsep}{os.environ['PATH']}")
    web = tmp_path / "web"
    web.mkdir()
    for lock in ("one", "one", "two"):
        (web / "package-lock.json").write_text(lock)
        setup_web.install(web)
    assert (web / "ran").read_text() == "x\n" * 2
    shutil.rmtree(web / "node_modules")
    setup_web.install(web)
    assert (web / "ran").read_text() == "x\n" * 3

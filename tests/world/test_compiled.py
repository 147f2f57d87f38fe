"""The compiled library is optional: compiled once where possible, else silently left out."""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from ai4u_edu.world.native import compiled as _compiled

pytestmark = pytest.mark.skipif(os.name != "posix", reason="is compiled on Unix only")
needs_compiler = pytest.mark.skipif(shutil.which("cc") is None, reason="no C compiler here")
library = _compiled.load_library.__wrapped__


@pytest.fixture(autouse=True)
def kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty cache folder."""
    monkeypatch.delenv(_compiled.SWITCH_VARIABLE, raising=False)
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return tmp_path / "ai4u-edu"


@pytest.fixture
def compiler(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[str], None]:
    """Puts a script in the compiler's place."""

    def put(script: str) -> None:
        cc = tmp_path / "bin" / "cc"
        cc.parent.mkdir()
        cc.write_text(f"#!/bin/sh\n{script}\n")
        cc.chmod(0o755)
        monkeypatch.setenv("PATH", str(cc.parent))

    return put


@needs_compiler
def test_it_is_made_once(kept: Path, compiler: Callable[[str], None]) -> None:
    made = library()
    assert made is not None
    assert all(hasattr(made, name) for name in ("cast_fan", "look"))
    (path,) = kept.iterdir()
    compiler("exit 1")
    assert library() is not None, "the one that is there"
    assert list(kept.iterdir()) == [path]
    assert kept.stat().st_mode & 0o777 == 0o700


def test_it_can_be_switched_off(kept: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(_compiled.SWITCH_VARIABLE, "0")
    assert library() is None
    assert not kept.exists()


@pytest.mark.parametrize(
    "script",
    [
        "echo no; echo no >&2; exit 1",
        "exit 0",
        'while [ "$1" != -o ]; do shift; done; echo rubbish > "$2"',
        "kill -9 $$",
    ],
    ids=["fails", "makes nothing", "makes rubbish", "dies"],
)
def test_without_a_good_compiler_there_is_none_and_no_word(
    script: str, compiler: Callable[[str], None], capfd: pytest.CaptureFixture[str]
) -> None:
    compiler(script)
    assert library() is None
    assert capfd.readouterr() == ("", "")


def test_without_any_compiler_there_is_none(
    kept: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    assert library() is None
    assert not list(kept.iterdir())


def test_without_a_folder_there_is_none(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    assert library() is None


@needs_compiler
def test_what_others_could_write_is_not_run(kept: Path) -> None:
    assert library() is not None
    kept.chmod(0o777)
    assert library() is None


def begin_another_process() -> subprocess.Popen[str]:
    program = (
        "from ai4u_edu.world.native.compiled import load_library; print(load_library() is not None)"
    )
    command = [sys.executable, "-c", program]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


@needs_compiler
def test_half_a_file_is_made_anew(kept: Path) -> None:
    # in one process, what was loaded from a path stays what it was
    assert begin_another_process().communicate()[0] == "True\n"
    (path,) = kept.iterdir()
    whole = path.read_bytes()
    path.write_bytes(whole[:100])
    assert begin_another_process().communicate()[0] == "True\n"
    assert len(path.read_bytes()) == len(whole)


@needs_compiler
def test_many_may_make_it_at_once(kept: Path) -> None:
    others = [begin_another_process() for _ in range(4)]
    assert [each.communicate()[0] for each in others] == ["True\n"] * 4
    assert len(list(kept.iterdir())) == 1


def test_a_mac_without_tools_is_asked_nothing(
    compiler: Callable[[str], None], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """There ``cc`` opens a window."""
    asked = tmp_path / "asked"
    compiler(f"touch {asked}")
    monkeypatch.setattr(sys, "platform", "darwin")
    monkeypatch.setenv("HOME", str(tmp_path))
    assert _compiled.cache_folder() == tmp_path / "Library" / "Caches" / "ai4u-edu"
    assert library() is None, "/usr/bin/xcode-select is not here"
    assert not asked.exists()


def test_it_lies_in_the_users_own_cache(monkeypatch: pytest.MonkeyPatch) -> None:
    for given in ("", "not/absolute"):
        monkeypatch.setenv("XDG_CACHE_HOME", given)
        assert _compiled.cache_folder() == Path.home() / ".cache" / "ai4u-edu"

"""The compiled part, made with real compilers and with scripts in their place."""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / ".ci" / "compile_rays.py"
needs_compiler = pytest.mark.skipif(shutil.which("cc") is None, reason="no C compiler here")
posix_only = pytest.mark.skipif(os.name != "posix", reason="puts a script in a compiler's place")


def compiled(folder: Path, **variables: str) -> subprocess.CompletedProcess[str]:
    """Run the script; the library goes into `folder`."""
    return subprocess.run(
        [sys.executable, SCRIPT, folder],
        env={**os.environ, **variables},
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.fixture
def compiler(tmp_path: Path) -> Callable[[str], str]:
    """Puts a script in the compiler's place, and returns the folder to search."""

    def put(script: str) -> str:
        cc = tmp_path / "bin" / "cc"
        cc.parent.mkdir()
        cc.write_text(f"#!/bin/sh\n{script}\n")
        cc.chmod(0o755)
        return str(cc.parent)

    return put


@needs_compiler
def test_two_builds_give_the_same_bytes(tmp_path: Path) -> None:
    libraries = []
    for name in "a", "b":
        (tmp_path / name).mkdir()
        done = compiled(tmp_path / name)
        assert done.returncode == 0, done.stderr
        assert list((tmp_path / name).iterdir()) == [Path(done.stdout.strip())]
        libraries.append(Path(done.stdout.strip()).read_bytes())
    assert libraries[0] == libraries[1]
    assert str(tmp_path).encode() not in libraries[0]


@posix_only
@pytest.mark.parametrize("script", ["echo no; exit 1", "kill -9 $$", "exit 0"])
def test_a_compiler_that_fails_leaves_nothing(
    script: str, compiler: Callable[[str], str], tmp_path: Path
) -> None:
    folder = tmp_path / "out"
    folder.mkdir()
    done = compiled(folder, PATH=compiler(script), CC="")
    assert done.returncode == 1
    assert "cc" in done.stderr
    assert "Traceback" not in done.stderr
    assert list(folder.iterdir()) == []


def test_without_a_compiler_it_says_what_it_looked_for(tmp_path: Path) -> None:
    done = compiled(tmp_path, PATH=str(tmp_path), CC="")
    assert "Expected a C compiler (cc, gcc, clang), and found none." in done.stderr
    done = compiled(tmp_path, CC="absent-compiler")
    assert "Expected to run absent-compiler, and could not" in done.stderr


@posix_only
def test_a_mac_without_tools_is_asked_nothing(
    compiler: Callable[[str], str], tmp_path: Path
) -> None:
    """There ``cc`` opens a window."""
    asked = tmp_path / "asked"
    path = compiler(f"touch {asked}")
    program = f"""
import sys
sys.platform = "darwin"
sys.path.insert(0, {str(SCRIPT.parent)!r})
import compile_rays
try:
    compile_rays.find_compiler()
except compile_rays.CompileError as error:
    print(error)
"""
    done = subprocess.run(
        [sys.executable, "-c", program],
        env={**os.environ, "PATH": path, "CC": ""},
        capture_output=True,
        text=True,
        check=True,
    )
    assert "/usr/bin/xcode-select" in done.stdout, "it is not here"
    assert not asked.exists()

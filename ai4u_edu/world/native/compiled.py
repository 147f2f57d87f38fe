"""The optional compiled part: made on this machine, once, where there is a C compiler.

Without it everything gives the same numbers, more slowly. What was made lies in the user's cache
folder (``~/.cache/ai4u-edu``; on a Mac ``~/Library/Caches/ai4u-edu``), under a name that says what
it was made from. ``AI4U_COMPILED=0`` does without.
"""

import contextlib
import ctypes
import hashlib
import os
import shutil
import stat
import subprocess
import sys
import sysconfig
import tempfile
import time
from functools import cache
from pathlib import Path

SOURCE = Path(__file__).with_name("rays.c")
SWITCH = "AI4U_COMPILED"
# without contraction a * b + c is rounded twice, as in Python
FLAGS = (
    "-std=c11",
    "-O2",
    "-ffp-contract=off",
    "-shared",
    "-fPIC",
)
PREFIX = "compiling-"
"""Prefix of the folders in which something is compiled."""
PATIENCE = 60.0
"""Seconds that a compiler gets; it takes a tenth of one."""


@cache
def library() -> ctypes.CDLL | None:
    """The compiled part; None where it is switched off or can't be made."""
    if os.name != "posix" or os.environ.get(SWITCH) == "0":
        return None
    try:
        return _load(folder())
    except (OSError, RuntimeError):  # no room, no right, or no home
        return None


def folder() -> Path:
    """Where it is kept."""
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Caches" / "ai4u-edu"
    given = os.environ.get("XDG_CACHE_HOME", "")
    base = Path(given) if given.startswith("/") else Path.home() / ".cache"
    return base / "ai4u-edu"


def _load(kept: Path) -> ctypes.CDLL | None:
    """Loads what is kept, or makes it anew.

    Raises:
        OSError: there is no room for it, or it can't be loaded.
    """
    key = repr((SOURCE.read_bytes(), FLAGS, sysconfig.get_platform(), sys.maxsize)).encode()
    path = kept / f"compiled-{hashlib.sha256(key).hexdigest()[:20]}.so"
    kept.mkdir(mode=0o700, parents=True, exist_ok=True)
    if not _ours(kept):
        return None
    if path.exists():
        with contextlib.suppress(OSError):  # half of a file, from a full disk
            return ctypes.CDLL(str(path))
    return ctypes.CDLL(str(path)) if _make(path) else None


def _ours(kept: Path) -> bool:
    """Whether nobody else can put something there for us to run."""
    told = kept.stat()
    return told.st_uid == os.geteuid() and not told.st_mode & (stat.S_IWGRP | stat.S_IWOTH)


def _make(path: Path) -> bool:
    """Compiles; others who do the same at the same time see either nothing or all of it."""
    compiler = _compiler()
    if compiler is None:
        return False
    _remove_leftovers(path.parent)
    with tempfile.TemporaryDirectory(prefix=PREFIX, dir=path.parent) as here:
        made = Path(here) / path.name
        if not _run(compiler, *FLAGS, "-o", str(made), str(SOURCE), "-lm"):
            return False
        made.replace(path)
    return True


def _remove_leftovers(kept: Path) -> None:
    """Delete the folders in which killed processes were compiling."""
    for left in kept.glob(f"{PREFIX}*"):
        with contextlib.suppress(OSError):
            if time.time() - left.lstat().st_mtime > 2 * PATIENCE:
                shutil.rmtree(left)


def _compiler() -> str | None:
    found = shutil.which("cc")
    # on a Mac without developer tools, cc opens a window that offers to install them
    if found and sys.platform == "darwin" and not _run("/usr/bin/xcode-select", "-p"):
        return None
    return found


def _run(*command: str) -> bool:
    """Whether a command succeeds; what it says is nobody's business."""
    try:
        done = subprocess.run(  # noqa: S603 - a compiler, our own words and paths, no shell
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            timeout=PATIENCE,
            check=False,
        )
    except (OSError, subprocess.SubprocessError):
        return False
    return done.returncode == 0

"""The optional library of rays.c: compiled once on this machine, where there is a C compiler.

Without it everything gives the same bits, more slowly. The library is kept in the user's cache
folder (``~/.cache/ai4u-edu``; on a Mac ``~/Library/Caches/ai4u-edu``); its name is a hash of the
source, the compiler's flags and the platform. ``AI4U_COMPILED=0`` switches it off.
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
SWITCH_VARIABLE = "AI4U_COMPILED"
# no contraction: a * b + c is rounded twice, as in Python
FLAGS = (
    "-std=c11",
    "-O2",
    "-ffp-contract=off",
    "-shared",
    "-fPIC",
)
TEMPORARY_PREFIX = "compiling-"
"""Prefix of the temporary folders of compilations."""
COMPILER_TIMEOUT_S = 60.0
"""Timeout (s) of the compiler; it takes a tenth of a second."""


@cache
def load_library() -> ctypes.CDLL | None:
    """Return the compiled library; None where it is switched off or can't be made."""
    if os.name != "posix" or os.environ.get(SWITCH_VARIABLE) == "0":
        return None
    try:
        return _load(cache_folder())
    except (OSError, RuntimeError):  # no space, no permission, or no home folder
        return None


def cache_folder() -> Path:
    """Return the folder that the library is kept in."""
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Caches" / "ai4u-edu"
    given = os.environ.get("XDG_CACHE_HOME", "")
    base = Path(given) if given.startswith("/") else Path.home() / ".cache"
    return base / "ai4u-edu"


def _load(kept: Path) -> ctypes.CDLL | None:
    """Load the library from a folder; compile it if it is missing or broken.

    Raises:
        OSError: the folder can't be written, or the library can't be loaded.
    """
    key = repr((SOURCE.read_bytes(), FLAGS, sysconfig.get_platform(), sys.maxsize)).encode()
    path = kept / f"compiled-{hashlib.sha256(key).hexdigest()[:20]}.so"
    kept.mkdir(mode=0o700, parents=True, exist_ok=True)
    if not _is_private(kept):
        return None
    if path.exists():
        with contextlib.suppress(OSError):  # a truncated file, from a full disk
            return ctypes.CDLL(str(path))
    return ctypes.CDLL(str(path)) if _make(path) else None


def _is_private(kept: Path) -> bool:
    """Return True if no other user can put a library into the folder."""
    status = kept.stat()
    return status.st_uid == os.geteuid() and not status.st_mode & (stat.S_IWGRP | stat.S_IWOTH)


def _make(path: Path) -> bool:
    """Compile the library; an atomic rename shows other processes all of it or nothing."""
    compiler = _compiler()
    if compiler is None:
        return False
    _remove_leftovers(path.parent)
    with tempfile.TemporaryDirectory(prefix=TEMPORARY_PREFIX, dir=path.parent) as here:
        made = Path(here) / path.name
        if not _run(compiler, *FLAGS, "-o", str(made), str(SOURCE), "-lm"):
            return False
        made.replace(path)
    return True


def _remove_leftovers(kept: Path) -> None:
    """Delete the folders in which killed processes were compiling."""
    for left in kept.glob(f"{TEMPORARY_PREFIX}*"):
        with contextlib.suppress(OSError):
            if time.time() - left.lstat().st_mtime > 2 * COMPILER_TIMEOUT_S:
                shutil.rmtree(left)


def _compiler() -> str | None:
    found = shutil.which("cc")
    # on a Mac without developer tools, cc opens a window that offers to install them
    if found and sys.platform == "darwin" and not _run("/usr/bin/xcode-select", "-p"):
        return None
    return found


def _run(*command: str) -> bool:
    """Run a command, discard its output, and return True on exit status 0."""
    try:
        done = subprocess.run(  # noqa: S603 - a compiler, our own words and paths, no shell
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            timeout=COMPILER_TIMEOUT_S,
            check=False,
        )
    except (OSError, subprocess.SubprocessError):
        return False
    return done.returncode == 0

"""Files that are there whole, or not at all, whatever happens while they are written.

A file is written under a temporary name in the same folder, flushed to the disk, and then renamed.
A process that is killed in between leaves the temporary file behind. Its writer held a lock on it,
which ended with the process: that is how :func:`remove_leftovers` tells it from one that is still
being written.
"""

import errno
import os
import re
import secrets
import stat
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from ai4u_edu.base.errors import SetupError, text_of
from ai4u_edu.base.file_lock import FileLock, LockedError
from ai4u_edu.locale import gettext as _

PREFIX = ".ai4u-partial-"
LEFTOVER = re.compile(re.escape(PREFIX) + r"[0-9a-f]{16}(\.\w{1,10})?")
"""Names of temporary files. The target's name is no part: with it, a long name would be too long.
"""
MIN_LEFTOVER_AGE_S = 600.0
"""Age from which a temporary file counts as left behind where a lock can't tell."""
HAS_HELD_RENAME = sys.platform != "win32"
"""True where a file can be renamed while its lock is held."""

_cleaned: set[Path] = set()
_cleaned_lock = threading.Lock()


def write_atomically(
    path: Path, data: bytes | str, *, over: bool = True, mode: int = 0o666
) -> None:
    """Write a file whole, or not at all; text is written as UTF-8.

    Args:
        path: of the file.
        data: its content.
        over: whether a file that is there already may be replaced.
        mode: permissions of a new file, less the user's umask; a replaced file keeps its own.

    Raises:
        FileExistsError: there is one already, and ``over`` is False.
        OSError: it can't be written; then what was there is still there.
    """
    with partial_file(path, over=over, mode=mode) as beside, beside.open("wb") as out:
        out.write(data.encode() if isinstance(data, str) else data)


@contextmanager
def partial_file(path: Path, *, over: bool = True, mode: int = 0o666) -> Iterator[Path]:
    """Give the path of a temporary file to write to; at the end it takes the place of ``path``.

    The temporary file ends in the same suffix, since some libraries look at that. If the block
    raises, it is deleted, and what was there before stays. A symbolic link is followed; a device,
    such as ``/dev/stdout``, is written to directly.

    Args:
        path: of the file to write.
        over: whether a file that is there already may be replaced.
        mode: permissions of a new file, less the user's umask; a replaced file keeps its own.

    Raises:
        FileExistsError: there is one already, and ``over`` is False.
        OSError: it can't be written.
    """
    if path.is_symlink():
        path = path.resolve()
    if path.exists() and not path.is_file() and not path.is_dir():
        yield path
        return
    _clean_once(path.parent)
    lock = _new_partial(path, mode)
    try:
        yield lock.path
        _flush_file(lock.path)
        if not HAS_HELD_RENAME:
            lock.release()
        if over:
            lock.path.replace(path)
        else:
            _move_to_new(lock.path, path)
        lock.release()
    except BaseException:
        lock.release(remove=True)
        raise
    _flush_folder(path.parent)


def make_folder(folder: Path, what: str, *, is_private: bool = False) -> None:
    """Make a folder that the user asked for, and remove what killed processes left there.

    Args:
        folder: which; one that is there already will do.
        what: what it is for, for the message.
        is_private: True to let nobody but its owner look into it, also if it is there already; but
            not the user's home or the folder in which the program runs, which are for more.

    Raises:
        SetupError: it can't be made, or may not be written to.
    """
    try:
        folder.mkdir(0o700 if is_private else 0o777, parents=True, exist_ok=True)
        if is_private and folder.resolve() not in (Path.home().resolve(), Path.cwd()):
            make_private(folder)
        if not os.access(folder, os.W_OK | os.X_OK):
            raise PermissionError(errno.EACCES, _("it may not be written to"))
    except (OSError, ValueError) as error:  # ValueError: a null character
        why = reason(error) if isinstance(error, OSError) else text_of(error)
        raise SetupError(
            _(
                "{folder}: expected a folder for {what}: {why}; choose another one",
                folder=str(folder),
                what=what,
                why=why,
            )
        ) from None
    remove_leftovers(folder)


def make_private(path: Path) -> None:
    """Take away what others than the owner may do with a file or folder, where that is possible."""
    with suppress(OSError):  # another user's, or a file system without permissions
        mode = stat.S_IMODE(path.stat().st_mode)
        if mode & 0o077:
            path.chmod(mode & 0o700)


def remove_leftovers(folder: Path) -> int:
    """Delete the temporary files that killed processes left in a folder.

    Returns:
        How many were deleted. One that is still being written, that belongs to somebody else, or
        that is no regular file stays.
    """
    removed = 0
    with suppress(OSError), os.scandir(folder) as entries:
        for entry in entries:
            if LEFTOVER.fullmatch(entry.name):
                with suppress(OSError):
                    removed += _remove_if_left(Path(entry.path))
    return removed


def _clean_once(folder: Path) -> None:
    """Delete leftovers before this process first writes to a folder."""
    place = folder.absolute()
    with _cleaned_lock:
        if place in _cleaned:
            return
        _cleaned.add(place)
    remove_leftovers(place)


def _remove_if_left(path: Path) -> bool:
    status = path.lstat()
    if not stat.S_ISREG(status.st_mode):
        return False
    try:
        lock = FileLock(path)
    except LockedError:
        return False
    is_old = time.time() - status.st_mtime > MIN_LEFTOVER_AGE_S
    is_left = is_old or (lock.is_held and HAS_HELD_RENAME)
    lock.release(remove=is_left)
    return is_left


def _new_partial(path: Path, mode: int) -> FileLock:
    """Create a temporary file, locked."""
    while True:
        beside = path.with_name(f"{PREFIX}{secrets.token_hex(8)}{_suffix(path)}")
        try:
            fd = os.open(beside, os.O_RDWR | os.O_CREAT | os.O_EXCL, mode)
        except OSError as error:
            error.filename = str(path)  # the name that the user gave
            raise
        if HAS_HELD_RENAME:
            with suppress(OSError):
                os.fchmod(fd, stat.S_IMODE(path.stat().st_mode))
        os.close(fd)
        with suppress(LockedError):  # somebody who removes leftovers looks at it just now
            return FileLock(beside)


def _suffix(path: Path) -> str:
    return path.suffix if re.fullmatch(r"\.\w{1,10}", path.suffix) else ""


def _move_to_new(beside: Path, path: Path) -> None:
    """Rename a file unless the new name is taken."""
    if sys.platform == "win32":
        beside.rename(path)  # fails there if the name is taken
        return
    try:
        os.link(beside, path)
    except FileExistsError:
        raise
    except OSError:  # a file system without hard links: reserve the name first
        os.close(os.open(path, os.O_CREAT | os.O_EXCL, 0o600))
        beside.replace(path)
    else:
        beside.unlink()


def _flush_file(path: Path) -> None:
    fd = os.open(path, os.O_RDWR)
    try:
        os.fsync(fd)
    finally:
        os.close(fd)


def _flush_folder(folder: Path) -> None:
    """Flush the rename itself; not every system or file system can."""
    if sys.platform == "win32":
        return
    with suppress(OSError):
        fd = os.open(folder, os.O_RDONLY | getattr(os, "O_DIRECTORY", 0))
        try:
            os.fsync(fd)
        finally:
            os.close(fd)


def reason(error: OSError) -> str:
    """Return why a file can't be written, in the words of the operating system and of ours."""
    if error.errno == errno.ENOSPC:
        return _("the disk is full")
    return error.strerror or str(error)

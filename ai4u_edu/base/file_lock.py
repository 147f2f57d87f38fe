"""A lock on a file that the operating system holds for as long as a process lives."""

import errno
import os
import sys
from contextlib import suppress
from pathlib import Path

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

LOCKED_BYTE = 2**30
"""Position of the byte that is locked on Windows, where a locked byte can't be written either."""
LOCKED_ERRORS = {errno.EACCES, errno.EAGAIN, errno.EDEADLK}
"""Error numbers by which the operating system says that another holder has the lock."""


class LockedError(OSError):
    """Another holder, in this process or in another one, has the lock."""


class FileLock:
    """An exclusive lock on an open file; it ends with :meth:`release` or with the process.

    Unlike a file with a process id in it, it can't outlive its holder: after SIGKILL the system has
    released it. Two holders in one process exclude each other too. Where a file system knows no
    locks, :attr:`is_held` is False and nobody is excluded.

    Args:
        path: of the file; it is made if it is not there.
        fd: an open descriptor of that file, which the lock then owns; left out, one is opened.

    Raises:
        LockedError: another holder has it.
        OSError: the file can't be opened.
    """

    def __init__(self, path: Path, fd: int | None = None) -> None:
        self.path = path
        self._fd: int | None = _open(path) if fd is None else fd
        try:
            self.is_held = _lock(self._fd, path)
        except OSError:
            self._close()
            raise

    def release(self, *, remove: bool = False) -> None:
        """Release the lock; with ``remove``, delete the file, which nobody else can lock then."""
        if remove:
            if sys.platform == "win32":  # an open file can't be deleted there
                self._close()
            with suppress(OSError):
                self.path.unlink(missing_ok=True)
        self._close()

    def _close(self) -> None:
        fd, self._fd = self._fd, None
        if fd is not None:
            with suppress(OSError):
                os.close(fd)


def is_locked(path: Path) -> bool:
    """Return True if somebody holds the lock on a file; False if there is no such file."""
    try:
        fd = os.open(path, os.O_RDWR | getattr(os, "O_NOFOLLOW", 0))
    except OSError:
        return False
    try:
        FileLock(path, fd).release()
    except LockedError:
        return True
    except OSError:
        return False
    return False


def _open(path: Path) -> int:
    return os.open(path, os.O_RDWR | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0), 0o600)


def _lock(fd: int, path: Path) -> bool:
    """Lock an open file without waiting.

    Returns:
        Whether it is locked; False where the file system has no locks.
    """
    try:
        if sys.platform == "win32":
            os.lseek(fd, LOCKED_BYTE, os.SEEK_SET)
            msvcrt.locking(fd, msvcrt.LK_NBLCK, 1)
        else:
            # flock, not lockf: the latter ends when any descriptor of the file is closed
            fcntl.flock(fd, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        if error.errno in LOCKED_ERRORS:
            raise LockedError(error.errno, "in use by another process", str(path)) from None
        return False
    return True

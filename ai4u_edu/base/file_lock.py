"""A lock on a file that the operating system holds for as long as a process lives."""

import errno
import sys
from contextlib import suppress
from pathlib import Path

from ai4u_edu.locale import gettext as _

NO_LOCKS = {
    getattr(errno, name)
    for name in ("ENOSYS", "ENOLCK", "ENOTSUP", "EOPNOTSUPP")
    if hasattr(errno, name)  # not all of them on each system
}
"""Error numbers by which the operating system says that a file system has no locks."""


class LockedError(OSError):
    """Another holder, in this process or in another one, has the lock."""


class FileLock:
    """An exclusive lock on a file; it ends with :meth:`release` or with the process.

    Unlike a file with a process id in it, it can't outlive its holder: after SIGKILL the system has
    released it. Two holders in one process exclude each other too. Where a file system knows no
    locks, :attr:`is_held` is False and nobody is excluded. Any thread may release it.

    Args:
        path: of the file; it is made if it is not there. Its content stays as it is.

    Raises:
        LockedError: another holder has it.
        OSError: the file can't be opened.
    """

    def __init__(self, path: Path) -> None:
        import filelock  # here, as it takes longer to load than most programs need to lock

        self.path = path
        # without preserve_lock_file, the file is deleted with its release on Windows, and a file
        # that can outlive its holder takes the lock's place where there are none
        self._lock = filelock.FileLock(
            path, mode=0o600, thread_local=False, preserve_lock_file=True
        )
        try:
            self._lock.acquire(blocking=False)
        except filelock.Timeout:
            raise LockedError(errno.EAGAIN, _("in use by another process"), str(path)) from None
        except OSError as error:
            if error.errno not in NO_LOCKS:
                raise

    @property
    def is_held(self) -> bool:
        """True until the release; False where the file system has no locks."""
        return self._lock.is_locked

    def release(self, *, remove: bool = False) -> None:
        """Release the lock; with ``remove``, delete the file, which nobody else can lock then."""
        if remove and sys.platform == "win32":  # an open file can't be deleted there
            self._lock.release()
        if remove:
            with suppress(OSError):
                self.path.unlink(missing_ok=True)
        self._lock.release()


def is_locked(path: Path) -> bool:
    """Return True if somebody holds the lock on a file; False if there is no such file."""
    if not path.is_file():
        return False
    try:
        FileLock(path).release()
    except LockedError:
        return True
    except OSError:
        return False
    return False

"""A file that a page sends in parts, before the command that opens it."""

import asyncio

from ai4u_edu.base.errors import SetupError
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.server.limits.timeouts import DEFAULT_TIMEOUTS
from ai4u_edu.recording.episode import MAX_RECORDING_BYTES

MAX_PART_BYTES = 2**19


class Upload:
    """The parts that a page has sent so far. Belongs to the server's event loop.

    Args:
        idle_timeout: time (s) without a new part after which an unfinished file is dropped.
    """

    def __init__(self, idle_timeout: float = DEFAULT_TIMEOUTS.upload) -> None:
        self._idle_timeout = idle_timeout
        self._data = bytearray()
        self._timer: asyncio.TimerHandle | None = None

    def add(self, part: bytes) -> None:
        """Add a part.

        Raises:
            SetupError: the file is too large; its parts are dropped.
        """
        if len(self._data) + len(part) > MAX_RECORDING_BYTES:
            self.drop()
            raise SetupError(
                _("expected a file of at most {most} MB", most=MAX_RECORDING_BYTES // 2**20)
            )
        self._data += part
        self._stop_timer()
        self._timer = asyncio.get_running_loop().call_later(self._idle_timeout, self.drop)

    def take(self, size: int) -> bytes:
        """Return the file.

        Args:
            size: its size in bytes.

        Raises:
            SetupError: not all of it is there, or more; its parts are dropped.
        """
        data = bytes(self._data)
        self.drop()
        if len(data) != size:
            raise SetupError(
                _(
                    "expected a file of {size} bytes, got {got}; send it again",
                    size=size,
                    got=len(data),
                )
            )
        return data

    def drop(self) -> None:
        """Forget all parts."""
        self._data = bytearray()
        self._stop_timer()

    def _stop_timer(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None

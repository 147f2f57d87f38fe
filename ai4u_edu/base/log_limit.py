"""Rate limits for log lines, so that nobody can fill a log by repeating a mistake.

:func:`log_limited` is for our own lines, :class:`ErrorLog` for tracebacks that matter only once;
:func:`limited_logs` limits the lines of the libraries that a server runs, while it runs.
"""

import logging
import math
import threading
import time
import traceback
from collections import OrderedDict
from collections.abc import Callable, Hashable, Iterator
from contextlib import contextmanager
from types import TracebackType

LOG_INTERVAL_S = 10.0
"""Time between two lines of one kind, at least."""
MAX_LOG_KEYS = 100
"""Kinds of lines that are counted apart at a time; all others together count as one kind."""
MAX_KIND_CHARS = 80
"""Characters of a message that tell its kind."""
LOGGERS = ("ai4u_edu", "asyncio", "uvicorn", "viser", "websockets")
"""Loggers that :func:`limited_logs` limits, with all below them."""

_OTHERS = object()


class LogLimiter:
    """Admits one line per key and interval, and counts the others. Thread-safe, memory bounded.

    Args:
        interval: seconds between two lines of a key.
        max_keys: number of keys that are counted apart at a time; further ones share one.
        clock: seconds; to be replaced in tests.

    >>> now = 0.0
    >>> limiter = LogLimiter(clock=lambda: now)
    >>> limiter.admit("bad frame"), limiter.admit("bad frame"), limiter.admit("bad frame")
    (0, None, None)
    >>> now = 10.0
    >>> limiter.admit("bad frame")
    2
    """

    def __init__(
        self,
        interval: float = LOG_INTERVAL_S,
        max_keys: int = MAX_LOG_KEYS,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._interval = interval
        self._max_keys = max_keys
        self._clock = clock
        self._lock = threading.Lock()
        # key -> when its last line was written, lines left out since; the oldest first
        self._seen: OrderedDict[Hashable, tuple[float, int]] = OrderedDict()

    def admit(self, key: Hashable) -> int | None:
        """Return how many lines were left out before this one; None to leave this one out too."""
        now = self._clock()
        with self._lock:
            if key not in self._seen and len(self._seen) >= self._max_keys:
                self._forget(now)
                if len(self._seen) >= self._max_keys:
                    key = _OTHERS
            written, left_out = self._seen.get(key, (float("-inf"), 0))
            if now - written < self._interval:
                self._seen[key] = written, left_out + 1
                return None
            self._seen[key] = now, 0
            self._seen.move_to_end(key)
            return left_out

    def _forget(self, now: float) -> None:
        """Drop the keys whose interval is over."""
        while self._seen:
            key, (written, _) = next(iter(self._seen.items()))
            if now - written < self._interval:
                return
            del self._seen[key]


_limiter = LogLimiter()


def log_limited(
    logger: logging.Logger,
    level: int,
    key: Hashable,
    message: str,
    *args: object,
    limiter: LogLimiter = _limiter,
) -> None:
    """Write a log line, at most one per key every 10 s; the next one tells how many were left out.

    Args:
        logger: where to.
        level: of the line.
        key: of its kind, which is its logger's alone. What others may choose does not belong in it.
        message: with ``%`` places, as :meth:`logging.Logger.log` has it.
        args: for the places.
        limiter: counts the lines; to be replaced in tests.
    """
    if not logger.isEnabledFor(level):
        return
    left_out = limiter.admit((logger.name, key))
    if left_out is None:
        return
    text = message % args if args else message
    logger.log(level, "%s", text + _counted(left_out), extra={"is_limited": True}, stacklevel=2)


class ErrorLog:
    """Writes errors with their tracebacks to stderr; errors of one type from one line only once."""

    def __init__(self) -> None:
        self._limiter = LogLimiter(interval=math.inf)

    @contextmanager
    def caught(self) -> Iterator[None]:
        """Catch an error in the block and write it."""
        try:
            yield
        except Exception as error:
            self.write(error)

    def write(self, error: Exception) -> None:
        """Write an error, unless one of its type from its line was written before."""
        if self._limiter.admit((type(error), _place(error))) is not None:
            traceback.print_exception(error)


class LimitFilter(logging.Filter):
    """Limits the lines of a logger by their kind: the place that wrote them, and their exception.

    A traceback of the same place is written once; the lines that follow name the exception, and
    count.

    Args:
        limiter: counts the lines.
    """

    def __init__(self, limiter: LogLimiter | None = None) -> None:
        super().__init__()
        self._limiter = limiter or LogLimiter()

    def filter(self, record: logging.LogRecord) -> bool:
        """Return True if a line should be written; adds the count of those left out to it."""
        if getattr(record, "is_limited", False):
            return True
        error = record.exc_info[1] if record.exc_info else None
        kind = str(record.msg).partition("\n")[0][:MAX_KIND_CHARS]
        place = (record.name, record.levelno, record.pathname, record.lineno, kind)
        left_out = self._limiter.admit((place, type(error), _place(error)))
        if left_out is None:
            return False
        if left_out:
            text = record.getMessage().rstrip()
            if error is not None:
                described = traceback.format_exception_only(error)[-1].strip()
                text = f"{text}: {described}"
                record.exc_info = record.exc_text = None
            record.msg, record.args = text + _counted(left_out), None
        return True


def _counted(left_out: int) -> str:
    return f" ({left_out} more like this since the last such line)" if left_out else ""


def _place(error: BaseException | None) -> tuple[str, int] | None:
    """Return the file and line where an exception was raised."""
    at: TracebackType | None = error.__traceback__ if error is not None else None
    if at is None:
        return None
    while at.tb_next is not None:
        at = at.tb_next
    return at.tb_frame.f_code.co_filename, at.tb_lineno


_filter = LimitFilter()
_lock = threading.Lock()
_owners = 0
_limited: list[logging.Logger] = []


@contextmanager
def limited_logs() -> Iterator[None]:
    """Limit the lines of our loggers and of the server's libraries; takes the limit off at the end.

    Several owners share one limit: it stays until the last one has ended.
    """
    global _owners
    with _lock:
        _owners += 1
        # a logger's filter does not see what the loggers below it write
        for logger in _loggers():
            if logger not in _limited:
                logger.addFilter(_filter)
                _limited.append(logger)
    try:
        yield
    finally:
        with _lock:
            _owners -= 1
            if not _owners:
                for logger in _limited:
                    logger.removeFilter(_filter)
                _limited.clear()


def _loggers() -> list[logging.Logger]:
    expected = [*LOGGERS, "uvicorn.error", "websockets.client", "websockets.server"]
    existing = [
        name for name in list(logging.root.manager.loggerDict) if name.partition(".")[0] in LOGGERS
    ]
    return [logging.getLogger(name) for name in dict.fromkeys([*expected, *existing])]

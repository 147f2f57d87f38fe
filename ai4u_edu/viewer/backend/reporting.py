"""Reports of what goes wrong in callbacks: to the page that caused it, and once to stderr."""

from collections.abc import Awaitable, Callable, Coroutine
from functools import wraps
from typing import Any, TypeVar

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.base.log_limit import ErrorLog

E = TypeVar("E")
_error_log = ErrorLog()


def reported(error: Exception) -> str:
    """Return a sentence about an error for the page that caused it.

    An error that is not of our own kind is a fault of ours: it is written to stderr, once.
    """
    if isinstance(error, AI4UError):
        return str(error)
    _error_log.write(error)
    return f"{type(error).__name__}: {error}"


def reporting(callback: Callable[[E], Awaitable[None]]) -> Callable[[E], Coroutine[Any, Any, None]]:
    """Return a callback for something in the scene whose errors are written only once.

    Those of widgets need none: see :mod:`ai4u_edu.viewer.backend.incoming`.
    """

    @wraps(callback)
    async def run(event: E) -> None:
        try:
            await callback(event)
        except Exception as error:
            text, client = reported(error), getattr(event, "client", None)
            if client is not None:
                client.add_notification("That didn't work", f"{text:.500}", auto_close_seconds=8.0)

    return run

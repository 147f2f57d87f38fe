"""Reports of errors in callbacks: to the page that caused them, and once to stderr."""

from collections.abc import Awaitable, Callable, Coroutine
from functools import wraps
from typing import Any, TypeVar

from ai4u_edu.base.errors import AI4UError, text_of
from ai4u_edu.base.log_limit import ErrorLog
from ai4u_edu.locale import translate

E = TypeVar("E")
_error_log = ErrorLog()


def describe_error(error: Exception) -> str:
    """Return a sentence about an error for the page that caused it.

    An error that is no AI4UError is a bug, and is written to stderr once.
    """
    if isinstance(error, AI4UError):
        return translate(text_of(error))
    _error_log.write(error)
    return f"{type(error).__name__}: {error}"


def report_errors(
    callback: Callable[[E], Awaitable[None]],
) -> Callable[[E], Coroutine[Any, Any, None]]:
    """Wrap a callback of a scene node so that its errors are shown to the page."""

    @wraps(callback)
    async def run(event: E) -> None:
        try:
            await callback(event)
        except Exception as error:
            text, client = describe_error(error), getattr(event, "client", None)
            if client is not None:
                client.add_notification("That didn't work", f"{text:.500}", auto_close_seconds=8.0)

    return run

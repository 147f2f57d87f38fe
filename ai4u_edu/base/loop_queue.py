"""What one thread has another one's event loop do.

To wake a loop takes a call of the system, in which Python lets other threads go on first. A tick in
which a hundred agents sense would be interrupted a hundred times, and be late by as many
milliseconds. So a loop is woken once, for all that there is to do when it comes to it.
"""

import asyncio
from collections import deque
from collections.abc import Callable
from threading import get_ident
from typing import Any

AT_ONCE = 16
"""Errands that are carried out at one go; then the loop looks first who else wants something."""

Errand = tuple[Callable[[Any], None], Any]


class Post:
    """Errands for the loop in which it is made, carried out in their order."""

    def __init__(self) -> None:
        self._loop = asyncio.get_running_loop()
        self._thread = get_ident()
        self._errands: deque[Errand] = deque()
        self._is_called = False

    def is_here(self) -> bool:
        """Whether the loop that runs here is the one whose errands these are."""
        return self._loop is asyncio.get_running_loop()

    def give(self, function: Callable[[Any], None], argument: object) -> None:
        """Has something done in the loop: at once, if this is its thread and nothing goes before.

        Raises:
            RuntimeError: the loop has ended.
        """
        if not self._errands and get_ident() == self._thread:
            function(argument)
            return
        self._errands.append((function, argument))
        if not self._is_called:
            self._is_called = True
            self._loop.call_soon_threadsafe(self._carry_out)

    def _carry_out(self) -> None:
        self._is_called = False  # before it looks: what comes after that calls anew
        try:
            for _ in range(min(AT_ONCE, len(self._errands))):
                function, argument = self._errands.popleft()
                function(argument)
        finally:
            if self._errands and not self._is_called:
                self._is_called = True
                self._loop.call_soon(self._carry_out)


def post_here(post: Post | None) -> Post:
    """That post, if its loop is the one that runs here; else a new one."""
    return post if post is not None and post.is_here() else Post()

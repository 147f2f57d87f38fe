"""Syntax trees of Python code, made by one thread at a time.

CPython 3.11 counts the nesting of a tree that is being made per interpreter, not per thread. Where
two threads make trees at once, either may get "SystemError: AST constructor recursion depth
mismatch" (https://github.com/python/cpython/issues/106905). Ours wait for each other; others don't,
such as the standard library where it formats a traceback: so a tree is tried again.
"""

import ast
import inspect
import textwrap
import threading
from collections.abc import Callable

MAX_ATTEMPTS = 5

_lock = threading.Lock()


def parsed(code: str) -> ast.Module:
    """Return the syntax tree of a module's text.

    Raises:
        SyntaxError: it is no Python, or nested too deep.
        ValueError: it has characters that no Python text has.
    """
    return _made(lambda: ast.parse(code))


def parsed_class(cls: type) -> ast.Module:
    """Return the syntax tree of a class's text.

    Raises:
        OSError: there is no text.
        TypeError: the class is built in.
        SyntaxError: its text can't be read alone.
    """
    # to find the text, inspect parses as well
    return _made(lambda: ast.parse(textwrap.dedent(inspect.getsource(cls))))


def _made(make: Callable[[], ast.Module]) -> ast.Module:
    with _lock:
        for _ in range(MAX_ATTEMPTS - 1):
            try:
                return make()
            except SystemError:  # somebody else was at it
                continue
        return make()

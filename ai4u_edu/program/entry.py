"""The function or controller of a program that is asked for decisions."""

import ast
from collections.abc import Mapping
from typing import Any

from ai4u_edu.program.mistakes import ProgramError
from ai4u_edu.program.words import nearest, suggest

ENTRY = "decide"
"""Name of the function that is asked, if no other is named."""
METHOD = "get_action"
MODULE_NAME = "program"
"""Name of a program's module, as it is in ``__name__``."""
VARARGS = 0x04
"""Flag of a function with ``*arguments``; to import inspect for it takes long in a browser."""
EXPECTED = "expected a function: def decide(percept):"


def entry_name(names: Mapping[str, Any], tree: ast.Module, file: str, entry: str = "") -> str:
    """Return the name of what is asked: a function, a class with ``get_action``, or such an object.

    Args:
        names: the program's global names.
        tree: its syntax tree.
        file: its name for messages.
        entry: the name that was asked for; empty for ``decide``, else the only class with
            ``get_action``.

    Raises:
        ProgramError: there is none, or it can't be asked.
    """
    name = entry or _only_entry(names, tree)
    if name not in names or name.startswith("__"):
        known = [each for each in names if not each.startswith("_")]
        raise ProgramError(f"{file} has no {name!r}; {suggest(name, known)}", 0, "entry")
    value, line = names[name], line_of(tree, name)
    if isinstance(value, type) and not callable(getattr(value, METHOD, None)):
        text = f"the class {name} has no {METHOD}(self, percept): it must return an action"
        raise ProgramError(text, line, "entry")
    if not callable(value) and not callable(getattr(value, METHOD, None)):
        raise ProgramError(f"{name!r} is no function; {EXPECTED}", line, "entry")
    return name


def check_parameters(function: Any) -> None:
    """Raise a ProgramError unless a function can be called with the percept alone."""
    code = getattr(getattr(function, "__func__", function), "__code__", None)
    if code is None or code.co_flags & VARARGS:
        return
    is_method = hasattr(function, "__self__")
    optional = len(function.__defaults__ or ())
    if not code.co_argcount - optional <= 1 + is_method <= code.co_argcount:
        name = code.co_name
        wanted = "self and the percept" if is_method else "one value, the percept"
        names = "self, percept" if is_method else "percept"
        text = f"{name} must take {wanted}: def {name}({names}):"
        raise ProgramError(text, code.co_firstlineno, "parameters")


def line_of(tree: ast.Module, name: str) -> int:
    """Return the line in which a name of the module is defined; 0 if it is not found."""
    for node in tree.body:
        if getattr(node, "name", "") == name:
            return node.lineno
        targets = node.targets if isinstance(node, ast.Assign) else ()
        if any(isinstance(each, ast.Name) and each.id == name for each in targets):
            return node.lineno
    return 0


def _only_entry(names: Mapping[str, Any], tree: ast.Module) -> str:
    if ENTRY in names:
        return ENTRY
    own = {
        name: value
        for name, value in names.items()
        if getattr(value, "__module__", "") == MODULE_NAME
    }
    classes = [
        name for name, each in own.items() if isinstance(each, type) and hasattr(each, METHOD)
    ]
    if len(classes) == 1:
        return classes[0]
    near = nearest(ENTRY, own)
    if near:
        text = f"the function must be called {ENTRY}, exactly so; you wrote {near}"
        raise ProgramError(text, line_of(tree, near), "entry")
    raise ProgramError(f"there is no function {ENTRY!r}; {EXPECTED}", 0, "entry")

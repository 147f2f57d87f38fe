"""Check of a program's text for what only runs outside the page."""

import ast
import sys
from collections.abc import Iterator

from ai4u_edu.program.mistakes import NO_NUMPY, ProgramError
from ai4u_edu.program.standins import NAMES
from ai4u_edu.program.texts import gettext as _

HOOKS = ("on_setup", "on_reset")
"""Methods of a Controller that are given the agent and the world."""


def obstacle_in(source: str) -> ProgramError | None:
    r"""Return the first thing in a program that needs more than the page has; None if all is there.

    The page has the standard library, and of ai4u_edu its Controller and Percept. An agent and a
    world are not there, so a Controller that looks at them needs to run outside. What Python can't
    read is no obstacle: loading says what is wrong.

    >>> print(obstacle_in("import math\nimport scipy"))
    line 2: scipy is not there in the page: expected a module of Python's own, such as math
    """
    try:
        tree = ast.parse(source)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None
    return obstacle_in_tree(tree)


def obstacle_in_tree(tree: ast.Module) -> ProgramError | None:
    """Return the same as :func:`obstacle_in` for a program's syntax tree."""
    found = [*_imports(tree), *_hooks(tree)]
    return min(found, key=lambda error: error.line, default=None)


def _imports(tree: ast.Module) -> Iterator[ProgramError]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names = [each.name for each in node.names]
        elif isinstance(node, ast.ImportFrom):
            names = [f"{'.' * node.level}{node.module or ''}"]
            if names == ["ai4u_edu"]:
                names = [f"ai4u_edu.{each.name}" for each in node.names]
        else:
            continue
        for name in names:
            top, _dot, rest = name.partition(".")
            if top == "numpy":
                yield ProgramError(_(NO_NUMPY), node.lineno, "numpy")
            elif top == "ai4u_edu":
                if rest and rest not in NAMES:
                    text = _(
                        "{name} is not there in the page: of ai4u_edu it has {known}",
                        name=name,
                        known=_("{names} and {last}", names=", ".join(NAMES[:-1]), last=NAMES[-1]),
                    )
                    yield ProgramError(text, node.lineno, "import")
            elif top not in sys.stdlib_module_names:
                text = _(
                    "{name} is not there in the page: expected a module of Python's own, such as "
                    "math",
                    name=name,
                )
                yield ProgramError(text, node.lineno, "import")


def _hooks(tree: ast.Module) -> Iterator[ProgramError]:
    """Yield the methods that use the agent or the world that they are given."""
    for node in ast.walk(tree):
        if not isinstance(node, ast.FunctionDef) or node.name not in HOOKS:
            continue
        given = {each.arg for each in node.args.args[1:]}
        for part in ast.walk(node):
            if isinstance(part, ast.Name) and part.id in given:
                text = _(
                    "{name!r} is not there in the page: expected {method} to use only what it is "
                    "told by `percept`, and what it keeps in `self`",
                    name=part.id,
                    method=node.name,
                )
                yield ProgramError(text, part.lineno, "import")
                break

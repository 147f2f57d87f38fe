"""Loops that do not end: which one it is, and why."""

import ast
from types import CodeType

from ai4u_edu.program.texts import gettext as _

GROWS = ("append", "extend", "insert", "add")
"""Methods with which a loop adds to what it goes through."""


def loop_around(tree: ast.Module, line: int, first: int = 0) -> ast.While | ast.For | None:
    """Return the loop around a line that is the endless one most likely; None if there is none.

    The innermost ``for`` that adds to its own list, else the innermost ``while``, else the
    innermost ``for``: most loops with ``for`` end.

    Args:
        tree: the module.
        line: that runs.
        first: loops that begin in lines before this one are not meant, such as those around a
            function's definition.
    """
    around = [
        node
        for node in ast.walk(tree)
        if isinstance(node, ast.While | ast.For)
        and first <= node.lineno <= line <= (node.end_lineno or node.lineno)
    ]
    return max(around, key=lambda loop: (suspicion(loop), loop.lineno), default=None)


def suspicion(loop: ast.While | ast.For) -> int:
    """Return how likely a loop is the endless one among some: 2 is the most likely."""
    return 2 if _growing(loop) else int(isinstance(loop, ast.While))


def why_endless(loop: ast.While | ast.For | None, *, is_in_decision: bool) -> str:
    """Return a sentence on a call that did not end.

    Args:
        loop: the one that runs; None if it is not known.
        is_in_decision: True if a robot waits for the call's answer.
    """
    if loop is None:
        return _("Something in it never ends, or takes very long.")
    if isinstance(loop, ast.For):
        growing = _growing(loop)
        if growing:
            return _(
                "The loop never ends: it adds to `{name}` while it goes through it. Add to another "
                "list.",
                name=growing,
            )
        return _("The loop never ends, or takes very long.")
    if is_in_decision:
        return _("The robot asks it again at each decision: use `if`, not `while`.")
    return _("The loop never ends: its condition stays true.")


def _growing(loop: ast.While | ast.For) -> str:
    """Return the name of what a ``for`` goes through and adds to; empty if there is none."""
    if isinstance(loop, ast.While):
        return ""
    known = {ast.unparse(node) for node in ast.walk(loop.iter) if _is_name(node)}
    for node in (each for line in loop.body for each in ast.walk(line)):
        added = None
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
            added = node.func.value if node.func.attr in GROWS else None
        elif isinstance(node, ast.AugAssign) and isinstance(node.op, ast.Add):
            added = node.target
        if added is not None and ast.unparse(added) in known:
            return ast.unparse(added)
    return ""


def _is_name(node: ast.AST) -> bool:
    return isinstance(node, ast.Name | ast.Attribute)


def line_at(code: CodeType, instruction: int) -> int:
    """Return the line of an instruction, or the one before it for an instruction without a line.

    Python gives no line to some jumps back to a loop's head; ``frame.f_lineno`` and
    ``traceback.tb_lineno`` are None there.

    Args:
        code: the function's.
        instruction: offset of the instruction, such as ``frame.f_lasti``.
    """
    lines = [line for start, _end, line in code.co_lines() if line and start <= instruction]
    return lines[-1] if lines else code.co_firstlineno

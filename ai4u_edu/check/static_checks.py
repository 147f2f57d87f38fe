"""Checks of a block without running it: its docstring, and its form in a scene file."""

import json
from typing import Any

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.blocks import Actuator, Block, Brain, Controller, RewardFunc, Sensor
from ai4u_edu.check.report import Outcome, Report
from ai4u_edu.scenes.serialization import from_plain, is_serializable, to_plain

KINDS: tuple[type[Block], ...] = (Sensor, Actuator, RewardFunc, Brain, Controller)

HINT = "are all parameters declared as annotated fields, and left as they were given?"


def run_static_checks(report: Report, block: Block, says: str) -> None:
    """Check that a block has a docstring and survives being written to a scene file and read back.

    Args:
        report: receives the findings.
        block: the block.
        says: what its docstring should say, for the message.
    """
    cls = type(block)
    written = (cls.__dict__.get("__doc__") or "").strip()
    report.add(
        "documented",
        ""
        if written
        else f"expected a docstring that says {says}, got none; write one under the class line",
    )
    plain = to_plain(block)
    if not is_serializable(cls) or _holds_a_function(plain):
        why = "it holds a Python function, which no file can say"
        report.add("scene file", why, outcome=Outcome.NOT_APPLICABLE)
        return
    report.add("scene file", _lost(block, plain))


def _lost(block: Block, plain: Any) -> str:
    """Return the difference after writing and reading a block; empty if there is none."""
    kind = next(kind for kind in KINDS if isinstance(block, kind))
    try:
        again = to_plain(from_plain(kind, json.loads(json.dumps(plain))))
    except (AI4UError, TypeError, ValueError) as error:
        return f"expected {plain} to make the same block, got {error}; {HINT}"
    return "" if again == plain else f"expected {plain} back, got {again}; {HINT}"


def _holds_a_function(plain: Any) -> bool:
    if isinstance(plain, dict):
        return any(map(_holds_a_function, plain.values()))
    if isinstance(plain, list):
        return any(map(_holds_a_function, plain))
    return callable(plain)

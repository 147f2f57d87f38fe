"""What can be seen of a block without running it: its docstring, and its lines in a scene file."""

import json
from typing import Any

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.blocks import Actuator, Block, Brain, Controller, RewardFunc, Sensor
from ai4u_edu.check.report import Outcome, Report
from ai4u_edu.scenes.serialization import from_plain, is_serializable, to_plain

KINDS: tuple[type[Block], ...] = (Sensor, Actuator, RewardFunc, Brain, Controller)

MEND = "are all parameters declared as annotated fields, and left as they were given?"


def check_papers(report: Report, block: Block, says: str) -> None:
    """Looks at a block's docstring, and writes it to a scene file and back.

    Args:
        report: where the findings go.
        block: the block.
        says: what its docstring should say.
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
    """What is lost on the way to a file and back; empty for nothing."""
    kind = next(kind for kind in KINDS if isinstance(block, kind))
    try:
        again = to_plain(from_plain(kind, json.loads(json.dumps(plain))))
    except (AI4UError, TypeError, ValueError) as error:
        return f"expected {plain} to make the same block, got {error}; {MEND}"
    return "" if again == plain else f"expected {plain} back, got {again}; {MEND}"


def _holds_a_function(plain: Any) -> bool:
    if isinstance(plain, dict):
        return any(map(_holds_a_function, plain.values()))
    if isinstance(plain, list):
        return any(map(_holds_a_function, plain))
    return callable(plain)

"""An agent as a table of its blocks."""

from typing import TYPE_CHECKING

from ai4u_edu.blocks.block import Block

if TYPE_CHECKING:
    from ai4u_edu.agent.agent import BasicAgent

HIDDEN = {"perception_key", "action_name", "name", "is_active", "enabled", "sensors"}


def table(agent: "BasicAgent") -> str:
    """Return a line for each block: kind, class, name and parameters other than the default."""
    rows = [("", "block", "name", "parameters")]
    for kind, blocks in (
        ("sensor", agent.sensors),
        ("actuator", agent.actuators),
        ("reward", agent.rewards),
        ("brain", agent.brains),
    ):
        rows += [(kind, *_row(block)) for block in blocks]
    widths = [max(len(row[column]) for row in rows) for column in range(3)]
    lines = [
        "  ".join(cell.ljust(width) for cell, width in zip(row, [*widths, 0], strict=True)).rstrip()
        for row in rows
    ]
    return "\n".join([f"agent {agent.id!r} on body {agent.body_name!r}", *lines])


def _row(block: Block) -> tuple[str, str, str]:
    values = block.values()
    name = str(values.get("perception_key") or values.get("action_name") or values.get("name", ""))
    shown = ", ".join(
        f"{key}={value!r}" for key, value in block.given().items() if key not in HIDDEN
    )
    off = values.get("is_active") is False or values.get("enabled") is False
    return type(block).__name__, name, "off; " * off + shown

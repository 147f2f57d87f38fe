"""Programs of blocks, as Blockly keeps them, in short."""

from collections.abc import Mapping
from typing import Any

State = dict[str, Any]


def block(
    kind: str, fields: Mapping[str, Any] | None = None, /, **inputs: State | float | None
) -> State:
    """Return a block with others in its inputs; a number stands for a block with it."""
    filled = {
        name: {"block": number(each) if isinstance(each, int | float) else each}
        for name, each in inputs.items()
        if each is not None
    }
    return {"type": kind, "id": kind, "fields": dict(fields or {}), "inputs": filled}


def number(value: float) -> State:
    return {"type": "number", "fields": {"NUM": value}}


def stack(*blocks: State) -> State:
    """Return blocks, one below the other, as the first of them."""
    first, *rest = blocks
    return {**first, "next": {"block": stack(*rest)}} if rest else first


def program(*stacks: State, variables: Mapping[str, str] | None = None) -> State:
    """Return blocks as they are kept.

    Args:
        stacks: each begins with an event.
        variables: names by id.
    """
    kept = [{"id": key, "name": name} for key, name in (variables or {}).items()]
    return {"blocks": {"languageVersion": 0, "blocks": list(stacks)}, "variables": kept}


def act(index: int, value: State | float) -> State:
    return block(f"act:move:{index}", VALUE=value)


def compare(left: State | float, operator: str, right: State | float) -> State:
    return block("compare", {"OP": operator}, A=left, B=right)


def near(side: str) -> State:
    """Return the distance of what is nearest on a side, in metres."""
    return block("near:rays", {"SIDE": side})

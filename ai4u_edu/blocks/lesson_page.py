"""A block explained from its own declaration."""

import inspect
import json
import re
from typing import Any

from ai4u_edu.blocks.actuators.actuator import Actuator
from ai4u_edu.blocks.block import Block, is_built_in
from ai4u_edu.blocks.brains.brain import Brain
from ai4u_edu.blocks.brains.controllers.controller import Controller
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.errors import NameNotFoundError, suggest
from ai4u_edu.parameters import is_open

KINDS: dict[str, type[Block]] = {
    "sensors": Sensor,
    "actuators": Actuator,
    "rewards": RewardFunc,
    "brains": Brain,
    "controllers": Controller,
}


def built_in_blocks() -> dict[str, list[type[Block]]]:
    """All blocks of this package by kind, each kind in the order of their names."""
    blocks = [Block.types[name] for name in sorted(Block.types)]
    own = [cls for cls in blocks if is_built_in(cls) and not cls.__dict__.get("abstract")]
    return {
        name: [cls for cls in own if issubclass(cls, kind) and cls is not kind]
        for name, kind in KINDS.items()
    }


def summary(cls: type[Block]) -> str:
    """The first line of a block's description."""
    return (inspect.getdoc(cls) or "").split("\n", 1)[0]


def coming_from_ai4u() -> str:
    """AI4U's name and ours of each block that both have, as a Markdown table."""
    rows = ["| AI4U | here | what it is |", "|---|---|---|"]
    for cls in (cls for members in built_in_blocks().values() for cls in members):
        source = re.search(r"Source:\s+AI4U(?:'s\s+(\w+))?", inspect.getdoc(cls) or "")
        if source:
            what = summary(cls).split(" Source:")[0]
            rows.append(f"| `{source[1] or cls.__name__}` | `{cls.__name__}` | {what} |")
    return "\n".join(rows)


def lesson_page(name: str) -> str:
    """What a block is and what parameters it has, as text.

    Raises:
        NameNotFoundError: there is no such block; the message suggests the nearest.

    >>> print(lesson_page("BearingSensor").splitlines()[0])
    BearingSensor: [sine, cosine] of the angle to the target, counter-clockwise from the heading.
    """
    known = {cls.__name__: cls for kind in built_in_blocks().values() for cls in kind}
    if name not in known:
        raise NameNotFoundError(f"no block is called {name!r}; {suggest(name, known)}")
    cls = known[name]
    described = (inspect.getdoc(cls) or "").split("\n\n>>>")[0]
    rows = [("parameter", "default", "range", "")]
    schema = cls.json_schema()
    for field, about in schema.get("properties", {}).items():
        missing = "(needed)" if field in schema.get("required", ()) else "(own)"
        default = json.dumps(about["default"]) if "default" in about else missing
        rows.append((field, default, _range(about), about.get("description", "")))
    widths = [max(len(row[column]) for row in rows) for column in range(3)]
    lines = ["  ".join((*map(str.ljust, row[:3], widths), row[3])).rstrip() for row in rows]
    return "\n".join([f"{name}: {described}", "", *lines])


def _range(about: dict[str, Any]) -> str:
    """A parameter's type, bounds and unit, in a few characters."""
    if "enum" in about:
        return " | ".join(map(str, about["enum"]))
    options = [each for each in about.get("anyOf", ()) if each.get("type") != "null"]
    about = {**about, **options[0]} if options else about
    kind = {"number": "", "integer": "whole", "boolean": "true | false", "string": "text"}
    low = about.get("minimum", about.get("exclusiveMinimum"))
    high = about.get("maximum", about.get("exclusiveMaximum"))
    bounds = f"{_show(low)}..{_show(high)}" if _show(low) or _show(high) else ""
    name = str(about.get("type", ""))
    return " ".join(filter(None, (kind.get(name, name), bounds, about.get("unit", ""))))


def _show(bound: float | None) -> str:
    return "" if bound is None or is_open(bound) else f"{bound:g}"

"""The numbers that blocks, agents, things and worlds declare as parameters, with their ranges."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from pydantic import BaseModel

from ai4u_edu.base.parameters import is_open
from ai4u_edu.blocks.parameterized import Parameterized
from ai4u_edu.locale import Text, join
from ai4u_edu.locale import gettext as _

NO_QUANTITIES = {"collision_layer", "collision_mask"}
"""Numbers of a body that are sets of bits."""


@dataclass(frozen=True)
class DeclaredNumber:
    """A number that a block, an agent, a thing or the world declares, or a pair of them."""

    name: str
    value: Any
    """Its default; None if it has none."""
    low: float
    high: float
    is_whole: bool
    is_pair: bool
    unit: str
    limits: str
    """Its range in words; empty if it has none."""


@lru_cache(maxsize=256)
def declared_numbers(cls: type) -> tuple[DeclaredNumber, ...]:
    """Return the numbers, and pairs of numbers, that a class declares as parameters."""
    schema: dict[str, Any] = {"properties": {}}
    if issubclass(cls, BaseModel):
        schema = cls.model_json_schema()
    elif issubclass(cls, Parameterized):
        schema = cls.json_schema()
    found = (_declared(name, about) for name, about in schema["properties"].items())
    return tuple(each for each in found if each is not None and each.name not in NO_QUANTITIES)


def _declared(name: str, about: Mapping[str, Any]) -> DeclaredNumber | None:
    is_pair = False
    for form in (about, *about.get("anyOf", ())):
        parts = form.get("prefixItems", ())
        is_pair = form.get("type") == "array" and len(parts) == 2 and parts[0] == parts[1]
        number = parts[0] if is_pair else form
        if number.get("type") in ("number", "integer"):
            break
    else:
        return None
    low, high = number.get("minimum", -math.inf), number.get("maximum", math.inf)
    above, below = number.get("exclusiveMinimum"), number.get("exclusiveMaximum")
    bounds = (
        (_("at least {bound:g}"), number.get("minimum")),
        (_("more than {bound:g}"), above),
        (_("at most {bound:g}"), number.get("maximum")),
        (_("less than {bound:g}"), below),
    )
    return DeclaredNumber(
        name=name,
        value=about.get("default"),
        low=math.nextafter(above, math.inf) if above is not None else low,
        high=math.nextafter(below, -math.inf) if below is not None else high,
        is_whole=number["type"] == "integer",
        is_pair=is_pair,
        unit=str(number.get("unit", "")),
        limits=join(
            [
                Text(words.msgid, {"bound": end})
                for words, end in bounds
                if end is not None and not is_open(end)
            ],
            ", ",
        ),
    )

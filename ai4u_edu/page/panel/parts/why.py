"""The part "why": how far each slot of the percept moves the action."""

from typing import Any

from ai4u_edu.explain import LIMITS
from ai4u_edu.explain.live import Why
from ai4u_edu.explain.sentence import MIN_SHARE

TOP_SLOTS = 6
"""Most slots in the list of those that matter most."""


def why_part(why: Why) -> dict[str, Any]:
    """Return an explanation for the page.

    ``slots`` are in the order of the sensors' numbers; of rays from the leftmost on, row by row.
    ``share`` is the largest movement of any number of the action, as a share of its range.
    """
    sizes = [max(map(abs, shares), default=0.0) for shares in why.shares]
    slots = [
        {
            "key": group.key,
            "name": group.name,
            "sees": group.sees,
            "share": round(size, 4),
            "shares": [round(each, 4) for each in shares],
        }
        for group, size, shares in zip(why.groups, sizes, why.shares, strict=True)
    ]
    order = sorted(range(len(slots)), key=lambda index: -sizes[index])[:TOP_SLOTS]
    return {
        "type": "part",
        "name": "why",
        "agent": why.agent,
        "problem": why.problem,
        "sentence": why.sentence,
        "baseline": why.baseline,
        "also": why.also,
        "explained": why.explained,
        "limits": LIMITS,
        "components": [axis.name.replace("_", " ") for axis in why.axes],
        "slots": slots,
        "top": [slots[index] for index in order if sizes[index] >= MIN_SHARE],
    }

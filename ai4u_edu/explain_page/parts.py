"""Parts of the panel: why an agent acts as it does, and the maps over the floor."""

from collections import Counter
from collections.abc import Sequence
from typing import Any

from ai4u_edu.explain import LIMITS
from ai4u_edu.explain.live import Why
from ai4u_edu.explain.map_colours import CIVIDIS, value_range
from ai4u_edu.explain.map_maker import LiveMap
from ai4u_edu.explain.sentence import MIN_SHARE
from ai4u_edu.snapshot import AgentState, Snapshot
from ai4u_edu.world import AreaDescription, BodyDescription

TOP_SLOTS = 6
"""Most slots in the list of those that matter most."""
MAX_FACED = 12
"""Most things in the list of what the agent can look at."""
SOURCES = {
    "critic": "what its critic expects from there on, which may be wrong",
    "rollouts": "what one episode from there pays, later rewards counting less",
}
"""The sources of values in words."""


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


def maps_part(
    snapshot: Snapshot, agent: AgentState, maps: Sequence[LiveMap | None]
) -> dict[str, Any]:
    """Return the state of an agent's maps; those of which nothing is known yet are left out."""
    found = {each.request.kind: each for each in maps if each is not None}
    return {
        "type": "part",
        "name": "maps",
        "agent": agent.id,
        "problem": next((each.problem for each in found.values() if each.problem), ""),
        "faced": faced_things(snapshot, agent),
        "field": _progress(found.get("field")),
        "values": _values(found.get("values")),
    }


def faced_things(snapshot: Snapshot, agent: AgentState) -> list[str]:
    """Return the things that the agent could look at from each place.

    These are the targets of its sensors, and things that alone have one of their tags, as a goal
    has and walls have not.
    """
    scene = snapshot.static_scene
    all_things: tuple[BodyDescription | AreaDescription, ...] = (*scene.bodies, *scene.areas)
    things = [each for each in all_things if each.name != agent.body]
    counts = Counter(tag for each in things for tag in each.tags)
    targets = {name for info in agent.sensor_infos for name in info.targets}
    return [
        each.name
        for each in things
        if each.name in targets or any(counts[tag] == 1 for tag in each.tags)
    ][:MAX_FACED]


def _progress(told: LiveMap | None) -> dict[str, Any] | None:
    if told is None or told.problem:
        return None
    return {"done": told.done, "count": len(told.poses), "seconds": round(told.time, 2)}


def _values(told: LiveMap | None) -> dict[str, Any] | None:
    progress = _progress(told)
    if told is None or progress is None:
        return None
    low, high = value_range(told.values) or (None, None)
    words = SOURCES.get(told.source, "")
    return progress | {"low": low, "high": high, "words": words, "colours": CIVIDIS}

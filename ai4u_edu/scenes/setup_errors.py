"""Paths in a scene's data that setup errors are about."""

from collections.abc import Iterable, Mapping
from typing import Any

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.errors import AI4UError, SetupError
from ai4u_edu.base.parameters import DataPath

KINDS = ("sensors", "actuators", "rewards", "brains")
UNKNOWN_NAME_PHRASES = ("is named", "is called", "carries the tag", "the network")
"""Phrases in messages before a name that does not exist."""


def path_of(error: AI4UError, agents: Iterable[Mapping[str, Any]]) -> DataPath:
    """Return the path in the scene that an error is about; () if unknown.

    Args:
        error: raised while agents were set up in a world.
        agents: the agents' parameters in the scene.
    """
    where = error.where if isinstance(error, SetupError) else ()
    agent = where[0] if where else None
    if not isinstance(agent, BasicAgent):
        return ()
    plain = list(agents)
    index = [str(each.get("id", "0")) == agent.id for each in plain]
    if not any(index):
        return ()
    # of two agents with the same id the second one is wrong
    base: DataPath = ("agents", len(index) - 1 - index[::-1].index(True))
    return base + _inside(agent, where[-1], plain[int(base[1])], str(error))


def _inside(agent: BasicAgent, part: object, plain: Mapping[str, Any], text: str) -> DataPath:
    if isinstance(part, str):
        return (part,) if part in plain else ()
    for kind in KINDS:
        for index, block in enumerate(getattr(agent, kind)):
            given = plain.get(kind, ())
            if block is part and index < len(given):
                return (kind, index, *field_named_in(text, given[index]))
    return ()


def field_named_in(text: str, data: Any, path: DataPath = ()) -> DataPath:
    """Return the path of the value that a message names as unknown; () if there is none.

    >>> field_named_in("no body is called 'bxo'", {"type": "TouchSensor", "target": "bxo"})
    ('target',)
    """
    if isinstance(data, Mapping):
        parts: Iterable[tuple[str | int, Any]] = data.items()
    elif isinstance(data, list | tuple):
        parts = enumerate(data)
    else:
        unknown = isinstance(data, str) and any(
            f"{word} {data!r}" in text for word in UNKNOWN_NAME_PHRASES
        )
        return path if unknown else ()
    found = (field_named_in(text, each, (*path, part)) for part, each in parts)
    return next(filter(None, found), ())

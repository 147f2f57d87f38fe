"""Where in a scene's data stands what an error of the setup is about."""

from collections.abc import Iterable, Mapping
from typing import Any

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.errors import AI4UError, SetupError
from ai4u_edu.scenes.serialization import Path

KINDS = ("sensors", "actuators", "rewards", "brains")
COMPLAINTS = ("is named", "is called", "carries the tag", "the network")
"""Words that stand before a name that nothing has."""


def path_of(error: AI4UError, agents: Iterable[Mapping[str, Any]]) -> Path:
    """Return the path of what an error is about; () if that is not known.

    Args:
        error: raised while agents were put into a world.
        agents: those agents' parameters, as a scene has them.
    """
    where = error.where if isinstance(error, SetupError) else ()
    agent = where[0] if where else None
    if not isinstance(agent, BasicAgent):
        return ()
    plain = list(agents)
    index = [str(each.get("id", "0")) == agent.id for each in plain]
    if not any(index):
        return ()
    # of two with the same id the second one is the one too many
    base: Path = ("agents", len(index) - 1 - index[::-1].index(True))
    return base + _inside(agent, where[-1], plain[int(base[1])], str(error))


def _inside(agent: BasicAgent, part: object, plain: Mapping[str, Any], text: str) -> Path:
    if isinstance(part, str):
        return (part,) if part in plain else ()
    for kind in KINDS:
        for index, block in enumerate(getattr(agent, kind)):
            given = plain.get(kind, ())
            if block is part and index < len(given):
                return (kind, index, *field_named_in(text, given[index]))
    return ()


def field_named_in(text: str, data: Any, path: Path = ()) -> Path:
    """Return the path of the value that a message complains of; () if none is.

    >>> field_named_in("no body is called 'bxo'", {"type": "TouchSensor", "target": "bxo"})
    ('target',)
    """
    if isinstance(data, Mapping):
        parts: Iterable[tuple[str | int, Any]] = data.items()
    elif isinstance(data, list | tuple):
        parts = enumerate(data)
    else:
        unknown = isinstance(data, str) and any(f"{word} {data!r}" in text for word in COMPLAINTS)
        return path if unknown else ()
    found = (field_named_in(text, each, (*path, part)) for part, each in parts)
    return next(filter(None, found), ())

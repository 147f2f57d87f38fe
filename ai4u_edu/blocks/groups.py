"""Checks that the groups (tags) that a block names exist in its world."""

from collections.abc import Iterator, Mapping
from typing import Any

from ai4u_edu.base.errors import NameNotFoundError, suggest
from ai4u_edu.base.parameters import default_of
from ai4u_edu.blocks.block import Block
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join
from ai4u_edu.world import WorldView

_PARAMETERS = ("group", "target_group", "group_code", "channels", "blocked_by")
"""Names of the parameters that hold groups, in any block."""


def check_groups(block: Block, parameter: str, view: WorldView) -> None:
    """Raise an error if none of the groups in a parameter exists in the world.

    One table of groups may serve several worlds, so a single missing group is no error (the checks
    of ``ai4u_edu.check`` warn of it), nor is a default value of the parameter.

    Raises:
        NameNotFoundError: nothing carries any of the tags; the message suggests the nearest ones.
    """
    missing = _missing(block, parameter, view)
    if missing and len(missing) == len(_names(getattr(block, parameter))):
        raise NameNotFoundError(join(missing, "; "))


def missing_groups(block: Block, view: WorldView) -> list[str]:
    """Return a sentence for each group that a block (or one inside it) names and nothing has."""
    own = [parameter for parameter in _PARAMETERS if parameter in block.parameters()]
    found = [text for parameter in own for text in _missing(block, parameter, view)]
    return found + [text for part in _parts(block) for text in missing_groups(part, view)]


def names_groups(block: Block) -> bool:
    """Return True if a block, or a block inside it, names groups."""
    own = any(_names(getattr(block, parameter, None)) for parameter in _PARAMETERS)
    return own or any(map(names_groups, _parts(block)))


def _known_groups(block: Block, view: WorldView) -> set[str]:
    """Return the tags of everything that a block can perceive.

    The class attribute ``looks_at`` names the kinds of things (by default all), ``own_groups`` the
    groups that exist in any world.
    """
    return view.tags(*getattr(block, "looks_at", ())).union(getattr(block, "own_groups", ()))


def _missing(block: Block, parameter: str, view: WorldView) -> list[str]:
    by_default = _names(default_of(block.parameters()[parameter]))
    known = _known_groups(block, view)
    return [
        _(
            "{parameter}: nothing that it could find carries the tag {name!r}; {hint}",
            parameter=parameter,
            name=name,
            hint=suggest(name, known),
        )
        for name in _names(getattr(block, parameter))
        if name not in known and name not in by_default
    ]


def _names(value: Any) -> tuple[str, ...]:
    if isinstance(value, str):
        return (value,) if value else ()
    return tuple(map(str, value)) if isinstance(value, Mapping | list | tuple) else ()


def _parts(block: Block) -> Iterator[Block]:
    for value in block.values().values():
        parts = value if isinstance(value, list | tuple) else (value,)
        yield from (part for part in parts if isinstance(part, Block))

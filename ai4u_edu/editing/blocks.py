"""Changes of an agent's blocks, as data: an agent's parameters in, others out.

A block is named by its path in the agent: ``("sensors", 2)``, or of one that is part of another
``("rewards", 0, "children", 1)`` and ``("brains", 0, "controller")``.
"""

from collections.abc import Callable, Mapping
from typing import Any, cast

from ai4u_edu.base.errors import shown, suggest
from ai4u_edu.base.parameters import MAX_COUNT, Problem, dotted
from ai4u_edu.blocks import (
    Actuator,
    Block,
    Brain,
    Controller,
    HomeostaticVariable,
    RewardFunc,
    Sensor,
)
from ai4u_edu.editing.errors import ChangeError
from ai4u_edu.editing.typed import (
    MAX_DEPTH,
    check_name,
    check_number,
    check_plain,
    check_typed,
    check_typed_and,
    schema_of,
)
from ai4u_edu.scenes.serialization import from_plain, is_serializable

BlockPath = tuple[str | int, ...]
Plain = Mapping[str, Any]

KINDS: dict[str, type[Block]] = {
    "sensors": Sensor,
    "actuators": Actuator,
    "rewards": RewardFunc,
    "brains": Brain,
    "children": RewardFunc,
    "controller": Controller,
    "variables": HomeostaticVariable,
}
"""What kind of blocks stands in each parameter that holds some."""


def kind_at(path: BlockPath) -> type[Block]:
    """What kind of block stands at a path."""
    _check_path(path)
    names = [part for part in path if isinstance(part, str)]
    if not names or names[-1] not in KINDS:
        raise ChangeError([Problem((), f"{dotted(path)!r} is no place of blocks; {_places()}")])
    return KINDS[names[-1]]


def types_of(kind: str) -> list[type[Block]]:
    """All types of blocks that may stand in such a place, in the order of their names.

    Args:
        kind: ``sensors``, ``actuators``, ``rewards``, ``brains``, ``children``, ``controller``.
    """
    base = kind_at((kind,))
    return [
        cls
        for _, cls in sorted(Block.types.items())
        if issubclass(cls, base) and is_serializable(cls) and not cls.__dict__.get("abstract")
    ]


def block_at(agent: Plain, path: BlockPath) -> Plain:
    """A block as data."""
    here: Any = agent
    _check_path(path)
    for part in path:
        try:
            here = here[part]
        except (KeyError, IndexError, TypeError):
            raise ChangeError([Problem((), f"there is no block at {dotted(path)!r}")]) from None
    if not isinstance(here, Mapping) or "type" not in here:
        raise ChangeError([Problem((), f"there is no block at {dotted(path)!r}")])
    return here


def changed(agent: Plain, path: BlockPath, values: Plain) -> Plain:
    """With other parameters of a block; None, or the default, leaves a parameter out.

    Raises:
        ChangeError: some are wrong; each is told with its path, as seen from the block.
    """
    before = block_at(agent, path)
    check_plain(values)
    if not isinstance(values, Mapping):
        raise ChangeError([Problem((), f"expected parameters by name, got {shown(values)}")])
    block = dict(before) | dict(values)
    cls = Block.types.get(str(block["type"]))
    declared = cls.parameters() if cls else {}
    for name, value in values.items():
        default = declared[name].get_default(call_default_factory=True) if name in declared else ...
        if value is None or (value == default and type(value) is type(default)):
            del block[name]
    schema = schema_of(cls) if cls is not None else {}
    check_typed_and(values, schema, lambda: from_plain(kind_at(path), block))
    return _put(agent, path, lambda _: block)


def added(
    agent: Plain, where: BlockPath, block: Plain, index: int | None = None
) -> tuple[Plain, BlockPath]:
    """With one block more, and its path.

    Args:
        agent: as it is.
        where: ``("sensors",)``, or inside another block ``("rewards", 0, "children")``.
        block: as data.
        index: before which of its like; left out, it is the last one.

    Raises:
        ChangeError: there are no such blocks, or their parameters are wrong.
    """
    check_typed(block, {})
    if index is not None:
        check_number(index, "index", MAX_COUNT)
    from_plain(kind_at(where), block)
    *above, kind = where
    owner: Any = block_at(agent, tuple(above)) if above else agent
    blocks = list(owner.get(kind, ()))
    place = len(blocks) if index is None else max(0, min(index, len(blocks)))
    blocks.insert(place, dict(block))
    return _put(agent, tuple(above), lambda owner: {**owner, kind: blocks}), (*where, place)


def block_paths(agent: Plain, kind: str) -> list[BlockPath]:
    """The paths of all blocks of a kind, each followed by those that are part of it."""
    found: list[BlockPath] = []

    def look(blocks: Any, where: BlockPath) -> None:
        for index, block in enumerate(blocks):
            found.append((*where, index))
            for name, value in block.items():
                if name not in KINDS:
                    continue
                if isinstance(value, Mapping):
                    found.append((*where, index, name))
                elif isinstance(value, list | tuple):
                    look(value, (*where, index, name))

    look(agent.get(kind, ()), (kind,))
    return found


def removed(agent: Plain, path: BlockPath) -> Plain:
    """Without a block."""
    block_at(agent, path)
    *above, index = path
    if not isinstance(index, int):
        raise ChangeError([Problem((), f"{dotted(path)} can be changed, but not left out")])
    return _put(agent, tuple(above), lambda blocks: [*blocks[:index], *blocks[index + 1 :]])


def moved(agent: Plain, path: BlockPath, by: int) -> Plain:
    """With a block so many places further down among its like; negative for up."""
    block = block_at(agent, path)
    check_number(by, "by", MAX_COUNT)
    *above, index = path
    if not isinstance(index, int):
        raise ChangeError([Problem((), f"{dotted(path)} stands alone")])

    def move(blocks: list[Plain]) -> list[Plain]:
        others = [*blocks[:index], *blocks[index + 1 :]]
        others.insert(max(0, index + by), block)
        return others

    return _put(agent, tuple(above), move)


def switched(agent: Plain, path: BlockPath, on: bool) -> Plain:
    """With a block on or off; of brains exactly one is on."""
    block_at(agent, path)
    if not isinstance(on, bool):
        raise ChangeError([Problem((), f"expected true or false, got {shown(on)}")])
    if path[0] == "brains" and len(path) > 2:
        raise ChangeError([Problem((), f"{dotted(path)} is on whenever its brain is")])
    if path[0] != "brains":
        return changed(agent, path, {"is_active": on})
    if not on:
        text = "an agent has exactly one brain that is on; switch another one on in its place"
        raise ChangeError([Problem(("enabled",), text)])
    brains = [
        {**{k: v for k, v in brain.items() if k != "enabled"}}
        | ({} if index == path[1] else {"enabled": False})
        for index, brain in enumerate(agent["brains"])
    ]
    return {**agent, "brains": brains}


def is_enabled(path: BlockPath, block: Plain) -> bool:
    """Whether a block takes part."""
    return bool(block.get("enabled" if path[0] == "brains" else "is_active", True))


def _put(here: Any, path: BlockPath, change: Callable[[Any], Any]) -> Plain:
    if not path:
        return cast(Plain, change(here))
    part, *rest = path
    if isinstance(here, Mapping):
        return {**here, str(part): _put(here[part], tuple(rest), change)}
    copy = list(here)
    copy[cast(int, part)] = _put(here[part], tuple(rest), change)
    return cast(Plain, copy)


def _check_path(path: object) -> None:
    if not isinstance(path, tuple | list) or len(path) > MAX_DEPTH:
        raise ChangeError([Problem((), f"expected a block's path, got {shown(path)}")])
    if not all(type(part) in (str, int) for part in path):
        raise ChangeError([Problem((), f"expected names and numbers as path, got {shown(path)}")])
    for part in path:
        if isinstance(part, str):
            check_name(part, "a path of names")


def _places() -> str:
    return suggest("", KINDS)

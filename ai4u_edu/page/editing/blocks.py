"""Changes of an agent's blocks as data: each function takes an agent and returns another one.

A block is named by its path in the agent: ``("sensors", 2)``, or for a block inside another one
``("rewards", 0, "children", 1)`` and ``("brains", 0, "controller")``.
"""

from collections.abc import Callable, Mapping
from typing import Any, cast

from ai4u_edu.base.errors import shown, suggest
from ai4u_edu.base.parameters import MAX_COUNT, ParameterProblem, default_of, format_path
from ai4u_edu.blocks import (
    Actuator,
    Block,
    Brain,
    Controller,
    HomeostaticVariable,
    RewardFunc,
    Sensor,
)
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.errors import ChangeError
from ai4u_edu.page.editing.input_checks import (
    MAX_DEPTH,
    check_name,
    check_number,
    check_plain,
    check_typed,
    check_typed_and,
    schema_of,
)
from ai4u_edu.page.editing.plain import BlockPath, Plain
from ai4u_edu.scenes.serialization import from_plain, is_serializable

KINDS: dict[str, type[Block]] = {
    "sensors": Sensor,
    "actuators": Actuator,
    "rewards": RewardFunc,
    "brains": Brain,
    "children": RewardFunc,
    "controller": Controller,
    "variables": HomeostaticVariable,
}
"""Kind of the blocks that each parameter holds."""


def kind_at(path: BlockPath) -> type[Block]:
    """Return the kind of the block at a path."""
    _check_path(path)
    names = [part for part in path if isinstance(part, str)]
    if not names or names[-1] not in KINDS:
        text = _(
            "{path!r} is no place of blocks; {hint}",
            path=format_path(path),
            hint=suggest("", KINDS),
        )
        raise ChangeError([ParameterProblem((), text)])
    return KINDS[names[-1]]


def types_of(kind: str) -> list[type[Block]]:
    """Return all block types that a parameter can hold, sorted by name.

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
    """Return a block as plain data."""
    here: Any = agent
    _check_path(path)
    for part in path:
        try:
            here = here[part]
        except (KeyError, IndexError, TypeError):
            raise _no_block_at(path) from None
    if not isinstance(here, Mapping) or "type" not in here:
        raise _no_block_at(path)
    return here


def changed(agent: Plain, path: BlockPath, values: Plain) -> Plain:
    """Change parameters of a block; None, or the default, leaves a parameter out.

    Raises:
        ChangeError: some are wrong; each is listed with its path relative to the block.
    """
    before = block_at(agent, path)
    check_plain(values)
    if not isinstance(values, Mapping):
        raise ChangeError(
            [
                ParameterProblem(
                    (), _("expected parameters by name, got {values}", values=shown(values))
                )
            ]
        )
    block = dict(before) | dict(values)
    cls = Block.types.get(str(block["type"]))
    declared = cls.parameters() if cls else {}
    for name, value in values.items():
        default = default_of(declared[name]) if name in declared else ...
        if value is None or (value == default and type(value) is type(default)):
            del block[name]
    schema = schema_of(cls) if cls is not None else {}
    check_typed_and(values, schema, lambda: from_plain(kind_at(path), block))
    return _replace(agent, path, lambda _: block)


def added(
    agent: Plain, parent: BlockPath, block: Plain, index: int | None = None
) -> tuple[Plain, BlockPath]:
    """Add a block, and return the agent and the block's path.

    Args:
        agent: the agent as plain data.
        parent: ``("sensors",)``, or inside another block ``("rewards", 0, "children")``.
        block: the block as plain data.
        index: its position among the blocks of its kind; by default the last one.

    Raises:
        ChangeError: no blocks can be there, or the block's parameters are wrong.
    """
    check_typed(block, {})
    if index is not None:
        check_number(index, "index", MAX_COUNT)
    from_plain(kind_at(parent), block)
    *above, kind = parent
    owner: Any = block_at(agent, tuple(above)) if above else agent
    blocks = list(owner.get(kind, ()))
    place = len(blocks) if index is None else max(0, min(index, len(blocks)))
    blocks.insert(place, dict(block))
    return _replace(agent, tuple(above), lambda owner: {**owner, kind: blocks}), (*parent, place)


def removed(agent: Plain, path: BlockPath) -> Plain:
    """Remove a block."""
    block_at(agent, path)
    *above, index = path
    if not isinstance(index, int):
        text = _("{path} can be changed, but not left out", path=format_path(path))
        raise ChangeError([ParameterProblem((), text)])
    return _replace(agent, tuple(above), lambda blocks: [*blocks[:index], *blocks[index + 1 :]])


def moved(agent: Plain, path: BlockPath, by: int) -> Plain:
    """Move a block down by a number of positions among the blocks of its kind; negative for up."""
    block = block_at(agent, path)
    check_number(by, "by", MAX_COUNT)
    *above, index = path
    if not isinstance(index, int):
        text = _("{path} stands alone", path=format_path(path))
        raise ChangeError([ParameterProblem((), text)])

    def move(blocks: list[Plain]) -> list[Plain]:
        others = [*blocks[:index], *blocks[index + 1 :]]
        others.insert(max(0, index + by), block)
        return others

    return _replace(agent, tuple(above), move)


def with_enabled(agent: Plain, path: BlockPath, on: bool) -> Plain:
    """Enable or disable a block; exactly one brain is enabled."""
    block_at(agent, path)
    if not isinstance(on, bool):
        raise ChangeError(
            [ParameterProblem((), _("expected true or false, got {value}", value=shown(on)))]
        )
    if path[0] == "brains" and len(path) > 2:
        text = _("{path} is on whenever its brain is", path=format_path(path))
        raise ChangeError([ParameterProblem((), text)])
    if path[0] != "brains":
        return changed(agent, path, {"is_active": on})
    if not on:
        text = _("an agent has exactly one brain that is on; switch another one on in its place")
        raise ChangeError([ParameterProblem(("enabled",), text)])
    brains = [
        {**{k: v for k, v in brain.items() if k != "enabled"}}
        | ({} if index == path[1] else {"enabled": False})
        for index, brain in enumerate(agent["brains"])
    ]
    return {**agent, "brains": brains}


def is_enabled(path: BlockPath, block: Plain) -> bool:
    """Return True if a block is enabled."""
    return bool(block.get("enabled" if path[0] == "brains" else "is_active", True))


def _replace(here: Any, path: BlockPath, change: Callable[[Any], Any]) -> Plain:
    if not path:
        return cast(Plain, change(here))
    part, *rest = path
    if isinstance(here, Mapping):
        return {**here, str(part): _replace(here[part], tuple(rest), change)}
    copy = list(here)
    copy[cast(int, part)] = _replace(here[part], tuple(rest), change)
    return cast(Plain, copy)


def _check_path(path: object) -> None:
    if not isinstance(path, tuple | list) or len(path) > MAX_DEPTH:
        text = _("expected a block's path, got {path}", path=shown(path))
        raise ChangeError([ParameterProblem((), text)])
    if not all(type(part) in (str, int) for part in path):
        text = _("expected names and numbers as path, got {path}", path=shown(path))
        raise ChangeError([ParameterProblem((), text)])
    for part in path:
        if isinstance(part, str):
            check_name(part, _("a path of names"))


def _no_block_at(path: BlockPath) -> ChangeError:
    text = _("there is no block at {path!r}", path=format_path(path))
    return ChangeError([ParameterProblem((), text)])

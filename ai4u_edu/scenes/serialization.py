"""Serialization of blocks to plain data as in a scene file, and back."""

import inspect
from collections.abc import Mapping, Sequence
from typing import Any, get_args

from pydantic import ValidationError

from ai4u_edu.base.errors import AI4UError, ParameterError, shown, suggest, text_of
from ai4u_edu.base.parameters import MAX_HINTS, DataPath, ParameterProblem, explain, format_problems
from ai4u_edu.blocks import Actuator, Block, Brain, Controller, RewardFunc, ScriptController, Sensor
from ai4u_edu.blocks.parameterized import Parameterized
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join

KINDS: tuple[type[Block], ...] = (Sensor, Actuator, RewardFunc, Brain, Controller)

OWN = _("a block of your own is known once its file is imported, or named with --blocks FILE.py")
"""Hint for a type that is not built in."""


def is_serializable(cls: type[Block]) -> bool:
    """Return True if a scene file can name a class; abstract bases can't be named."""
    # a ScriptController holds a Python function, which can't be serialized
    return cls not in (*KINDS, ScriptController) and not cls.__dict__.get("abstract")


class PlainDataError(AI4UError):
    """All problems of plain data, with their paths."""

    def __init__(self, problems: Sequence[ParameterProblem]) -> None:
        super().__init__(format_problems(problems))
        self.problems = tuple(problems)


def to_plain(value: Any) -> Any:
    """Return a block as a mapping of its type and non-default parameters; lists, dicts alike."""
    if isinstance(value, Block):
        return {"type": type(value).__name__} | to_plain(value.given())
    if isinstance(value, Mapping):
        return {str(key): to_plain(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [to_plain(each) for each in value]
    return value


def from_plain(kind: type[Block], data: Any, path: DataPath = ()) -> Block:
    """Make a block from plain data.

    Args:
        kind: the expected base class, such as :class:`Sensor`.
        data: a mapping with a ``type`` and parameters.
        path: of the data, for messages.

    Raises:
        PlainDataError: the data are no block of that kind, or its parameters are wrong.
    """
    if not isinstance(data, Mapping):
        raise PlainDataError(
            [
                ParameterProblem(
                    path, _("expected a mapping with a 'type', got {got}", got=shown(data))
                )
            ]
        )
    known = {
        name: cls
        for name, cls in Block.types.items()
        if issubclass(cls, kind) and is_serializable(cls)
    }
    name = data.get("type")
    if name is None:
        raise PlainDataError(
            [ParameterProblem(path, _("needs a 'type'; {hint}", hint=suggest("", known)))]
        )
    if not isinstance(name, str) or name not in known:
        hint = suggest(name if isinstance(name, str) else "", known)
        unknown = _("unknown type of {kind} {got}", kind=kind.__name__.lower(), got=shown(name))
        text = join([unknown, hint, OWN], "; ")
        raise PlainDataError([ParameterProblem((*path, "type"), text)])
    given = {str(key): value for key, value in data.items() if key != "type"}
    made = make(known[name], given, path)
    if not isinstance(made, Block):  # pragma: no cover - known holds blocks only
        raise TypeError(name)
    return made


def make(cls: type[Parameterized], given: Mapping[str, Any], path: DataPath) -> Parameterized:
    """Make an object from plain parameters; some of them may be blocks."""
    problems: list[ParameterProblem] = []
    values: dict[str, Any] = {}
    fields = cls.parameters()
    for name, value in given.items():
        kind = _block_kind(fields[name].annotation) if name in fields else None
        try:
            values[name] = _convert(kind, value, (*path, name)) if kind else value
        except PlainDataError as error:
            problems += error.problems
    if problems:
        raise PlainDataError(problems)
    try:
        return cls(**values)
    except ParameterError as error:
        cause = error.details
        if not isinstance(cause, ValidationError):
            raise PlainDataError([ParameterProblem(path, text_of(error))]) from None
        found = explain(cause.errors(), fields)
        raise PlainDataError(
            [ParameterProblem((*path, *each.path), each.text) for each in found]
        ) from None
    except AI4UError as error:
        raise PlainDataError([ParameterProblem(path, text_of(error))]) from None


def _convert(kind: type[Block], value: Any, path: DataPath) -> Any:
    if not isinstance(value, list | tuple):
        return from_plain(kind, value, path)
    problems: list[ParameterProblem] = []
    blocks = []
    for index, each in enumerate(value):
        try:
            blocks.append(from_plain(kind, each, (*path, index)))
        except PlainDataError as error:
            problems += error.problems
            if len(problems) >= MAX_HINTS:  # more problems would not be shown, and each costs time
                break
    if problems:
        raise PlainDataError(problems)
    return blocks


def _block_kind(annotation: Any) -> type[Block] | None:
    """Return the kind of block that a parameter holds, alone or in a list, or None."""
    if inspect.isclass(annotation) and issubclass(annotation, Block):
        return annotation
    for part in get_args(annotation):
        kind = _block_kind(part)
        if kind is not None:
            return kind
    return None

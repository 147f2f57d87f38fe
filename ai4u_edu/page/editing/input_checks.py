"""Checks of what an edit from a page contains: plain data within limits, and numbers as numbers.

pydantic converts ``"5"`` and ``true`` to 5 and 1. Its strict mode would also refuse lists for
tuples and 5.0 for whole numbers, and can't check some of a block's parameters, or nested blocks.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any, TypeVar
from weakref import WeakKeyDictionary

from pydantic import BaseModel

from ai4u_edu.base.errors import MAX_SHOWN_CHARS, shown
from ai4u_edu.base.parameters import ParameterProblem
from ai4u_edu.blocks import Block
from ai4u_edu.blocks.parameterized import Parameterized
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.errors import ChangeError
from ai4u_edu.page.editing.plain import BlockPath
from ai4u_edu.scenes.serialization import PlainDataError
from ai4u_edu.world.pictures import MAX_PICTURE_CHARS

T = TypeVar("T")
MAX_TEXT_CHARS = 10_000
"""Length of a text in an edit."""
MAX_NAME_CHARS = 500
"""Length of a name in an edit; a file's path may be one."""
MAX_DEPTH = 50
"""Nesting depth of lists and mappings in an edit."""
MAX_VALUES = 100_000
"""Number of values in an edit."""


_schemas: "WeakKeyDictionary[Any, dict[str, Any]]" = WeakKeyDictionary()


def check_plain(values: Any) -> None:
    """Raise a ChangeError for values that a scene file can't hold, or too many of them."""
    problem = next(_not_plain(values), None)
    if problem is not None:
        raise ChangeError([problem])


def check_number(value: Any, what: str, largest: float) -> None:
    """Raise a ChangeError unless a value is a finite number within bounds.

    Args:
        value: a value in an edit.
        what: its name, for the message.
        largest: the bound of its absolute value.
    """
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    if is_number and isinstance(value, float) and not math.isfinite(value):
        text = _("expected finite numbers, got {value}", value=str(value))
        raise ChangeError([ParameterProblem((what,), text)])
    if not is_number or abs(value) > largest:
        text = _(
            "expected a number from {low} to {high}, got {value}",
            low=f"{-largest:g}",
            high=f"{largest:g}",
            value=shown(value),
        )
        raise ChangeError([ParameterProblem((what,), text)])


def check_name(value: Any, what: str) -> None:
    """Raise a ChangeError unless a value is a text short enough for a name."""
    if not isinstance(value, str) or len(value) > MAX_NAME_CHARS:
        text = _(
            "expected {what} of at most {most} characters, got {value}",
            what=what,
            most=MAX_NAME_CHARS,
            value=shown(value),
        )
        raise ChangeError([ParameterProblem((), text)])


def check_typed(values: Any, schema: Mapping[str, Any]) -> None:
    """Raise a ChangeError for text and booleans where the schema wants a number.

    The scene would keep ``"5"``, and the block that is made from it would have 5.

    Args:
        values: plain data of an edit.
        schema: its JSON Schema.
    """
    check_plain(values)
    problems = list(_type_problems(values, schema, schema.get("$defs", {}), ()))
    if problems:
        raise ChangeError(problems)


def check_typed_and(values: Any, schema: Mapping[str, Any], check: Callable[[], T]) -> T:
    """Check types and then everything else, and raise one ChangeError for all problems.

    Args:
        values: plain data of an edit.
        schema: its JSON Schema.
        check: raises a ChangeError or a PlainDataError for other problems.

    Returns:
        What ``check`` returns.
    """
    check_plain(values)
    problems = list(_type_problems(values, schema, schema.get("$defs", {}), ()))
    known = {problem.path for problem in problems}
    try:
        found = check()
    except (ChangeError, PlainDataError) as error:
        if not problems:
            raise
        problems += [problem for problem in error.problems if problem.path not in known]
    if problems:
        raise ChangeError(problems)
    return found


def schema_of(cls: type[Parameterized | BaseModel]) -> dict[str, Any]:
    """Return the JSON Schema of a block, an agent or a model; it is kept, and not to be changed.

    To derive it takes longer than all else that a form is made of.
    """
    found = _schemas.get(cls)
    if found is None:
        found = cls.model_json_schema() if issubclass(cls, BaseModel) else cls.json_schema()
        _schemas[cls] = found
    return found


def _not_plain(values: Any) -> Iterator[ParameterProblem]:
    """Yield values that are no plain data; iterative, since nesting could exceed the stack."""
    waiting: list[tuple[BlockPath, Any]] = [((), values)]
    count = 0
    while waiting:
        path, value = waiting.pop()
        count += 1
        if len(path) > MAX_DEPTH or count > MAX_VALUES:
            yield ParameterProblem(
                path[:1], _("expected less: it is nested too deep, or has too many values")
            )
            return
        if isinstance(value, str):
            most = MAX_PICTURE_CHARS if value.startswith("data:image/") else MAX_TEXT_CHARS
            if len(value) > most:
                yield ParameterProblem(path, _("expected at most {most} characters", most=most))
            elif not value.isprintable() and any("\ud800" <= char <= "\udfff" for char in value):
                yield ParameterProblem(path, _("expected text, got {value}", value=shown(value)))
        elif isinstance(value, int) and value.bit_length() > 64:
            yield ParameterProblem(
                path, _("expected a number of at most 64 bits, got a larger one")
            )
        elif isinstance(value, Mapping):
            for key, each in value.items():
                if not isinstance(key, str | int):
                    text = _("expected names as keys, got {key}", key=shown(key))
                    yield ParameterProblem(path, text)
                waiting.append(((*path, str(key)[:MAX_SHOWN_CHARS]), each))
        elif isinstance(value, list | tuple):
            waiting += [((*path, index), each) for index, each in enumerate(value)]
        elif not (value is None or isinstance(value, bool | int | float | BaseModel)):
            text = _(
                "expected plain data (numbers, text, lists, mappings), got {value}",
                value=shown(value),
            )
            yield ParameterProblem(path, text)


def _type_problems(
    value: Any, schema: Any, known: Mapping[str, Any], path: BlockPath
) -> Iterator[ParameterProblem]:
    schemas = _alternatives(schema, known)
    types = {str(each.get("type", "")) for each in schemas}
    if isinstance(value, bool | str):
        is_other = "" in types or ("boolean" if isinstance(value, bool) else "string") in types
        got = shown(value)
        if "number" in types and not is_other:
            yield ParameterProblem(path, _("expected a number, got {value}", value=got))
        elif "integer" in types and not is_other:
            yield ParameterProblem(path, _("expected a whole number, got {value}", value=got))
    elif isinstance(value, Mapping):
        if value.get("type") in Block.types:  # the enclosing schema has the base class only
            schema = schema_of(Block.types[value["type"]])
            schemas, known = [schema], schema.get("$defs", {})
        for name, each in value.items():
            inner = [found for s in schemas if (found := _property(s, name)) is not None]
            if inner:
                yield from _type_problems(each, {"anyOf": inner}, known, (*path, str(name)))
    elif isinstance(value, list | tuple):
        for index, each in enumerate(value):
            inner = [found for s in schemas if (found := _item(s, index)) is not None]
            if inner:
                yield from _type_problems(each, {"anyOf": inner}, known, (*path, index))


def _property(schema: Mapping[str, Any], name: str) -> Mapping[str, Any] | None:
    found = schema.get("properties", {}).get(name, schema.get("additionalProperties"))
    return found if isinstance(found, Mapping) else None


def _item(schema: Mapping[str, Any], index: int) -> Mapping[str, Any] | None:
    prefix = schema.get("prefixItems", ())
    found = prefix[index] if index < len(prefix) else schema.get("items")
    return found if isinstance(found, Mapping) else None


def _alternatives(schema: Any, known: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    """Return the alternatives of a schema, with references resolved."""
    if "$ref" in schema:
        return _alternatives(known.get(str(schema["$ref"]).rsplit("/", 1)[-1], {}), known)
    parts = [*schema.get("anyOf", ()), *schema.get("oneOf", ()), *schema.get("allOf", ())]
    return [each for part in parts for each in _alternatives(part, known)] if parts else [schema]

"""Numbers that are numbers: text and true/false are none, although pydantic would convert them."""

import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any, TypeVar
from weakref import WeakKeyDictionary

from pydantic import BaseModel

from ai4u_edu.base.errors import MAX_SHOWN_CHARS, shown
from ai4u_edu.base.parameters import Problem
from ai4u_edu.blocks import Block
from ai4u_edu.blocks.parameterized import Parameterized
from ai4u_edu.editing.errors import ChangeError
from ai4u_edu.scenes.serialization import PlainDataError

T = TypeVar("T")
Path = tuple[str | int, ...]
NUMBERS = {"number": "a number", "integer": "a whole number"}
MAX_TEXT_CHARS = 10_000
"""Length of a text that an edit may bring."""
MAX_NAME_CHARS = 500
"""Length of a name that an edit may ask for; a path may be one."""
MAX_DEPTH = 50
"""Depth to which lists and mappings of an edit may be nested."""
MAX_VALUES = 100_000
"""Values of an edit, all in all."""


def check_typed(values: Any, schema: Mapping[str, Any]) -> None:
    """Raise a ChangeError for values of the wrong type that pydantic would convert.

    ``"5"`` and ``true`` would become 5 and 1 in a block, and stay what they are in the scene.

    Args:
        values: plain data, as an edit brings it.
        schema: its JSON Schema.
    """
    check_plain(values)
    problems = list(_untyped(values, schema, schema.get("$defs", {}), ()))
    if problems:
        raise ChangeError(problems)


def check_typed_and(values: Any, schema: Mapping[str, Any], check: Callable[[], T]) -> T:
    """Check the types of values, and then all else; a person is told of everything at once.

    Args:
        values: plain data, as an edit brings it.
        schema: its JSON Schema.
        check: raises a ChangeError or a PlainDataError for what is wrong besides.

    Returns:
        What ``check`` returns.
    """
    check_plain(values)
    problems = list(_untyped(values, schema, schema.get("$defs", {}), ()))
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


def schema_of(cls: type[Parameterized]) -> dict[str, Any]:
    """Return the JSON Schema of a block or an agent; it takes a while to make, so it is kept."""
    found = _schemas.get(cls)
    if found is None:
        found = _schemas[cls] = cls.json_schema()
    return found


_schemas: "WeakKeyDictionary[Any, dict[str, Any]]" = WeakKeyDictionary()


def check_plain(values: Any) -> None:
    """Raise a ChangeError for what no scene file can hold, or what is too large for one."""
    problem = next(_not_plain(values), None)
    if problem is not None:
        raise ChangeError([problem])


def check_number(value: Any, what: str, largest: float) -> None:
    """Raise a ChangeError unless a value is a finite number within bounds.

    Args:
        value: what an edit brings.
        what: what it is, for the message.
        largest: the bound of its absolute value.
    """
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    if is_number and isinstance(value, float) and not math.isfinite(value):
        raise ChangeError([Problem((what,), f"expected finite numbers, got {value}")])
    if not is_number or abs(value) > largest:
        text = f"expected a number from {-largest:g} to {largest:g}, got {shown(value)}"
        raise ChangeError([Problem((what,), text)])


def check_name(value: Any, what: str) -> None:
    """Raise a ChangeError unless a value is a text that may be a name."""
    if not isinstance(value, str) or len(value) > MAX_NAME_CHARS:
        text = f"expected {what} of at most {MAX_NAME_CHARS} characters, got {shown(value)}"
        raise ChangeError([Problem((), text)])


def _not_plain(values: Any) -> Iterator[Problem]:
    """Yield what is no plain data; without recursion, which nested lists would break."""
    waiting: list[tuple[Path, Any]] = [((), values)]
    count = 0
    while waiting:
        path, value = waiting.pop()
        count += 1
        if len(path) > MAX_DEPTH or count > MAX_VALUES:
            yield Problem(path[:1], "expected less: it is nested too deep, or has too many values")
            return
        if isinstance(value, str):
            if len(value) > MAX_TEXT_CHARS:
                yield Problem(path, f"expected at most {MAX_TEXT_CHARS} characters")
            elif not value.isprintable() and any("\ud800" <= char <= "\udfff" for char in value):
                yield Problem(path, f"expected text, got {shown(value)}")
        elif isinstance(value, int) and value.bit_length() > 64:
            yield Problem(path, "expected a number of at most 64 bits, got a larger one")
        elif isinstance(value, Mapping):
            for key, each in value.items():
                if not isinstance(key, str | int):
                    yield Problem(path, f"expected names as keys, got {shown(key)}")
                waiting.append(((*path, str(key)[:MAX_SHOWN_CHARS]), each))
        elif isinstance(value, list | tuple):
            waiting += [((*path, index), each) for index, each in enumerate(value)]
        elif not (value is None or isinstance(value, bool | int | float | BaseModel)):
            text = f"expected plain data (numbers, text, lists, mappings), got {shown(value)}"
            yield Problem(path, text)


def _untyped(value: Any, schema: Any, known: Mapping[str, Any], path: Path) -> Iterator[Problem]:
    schemas = _options(schema, known)
    types = {str(each.get("type", "")) for each in schemas}
    if isinstance(value, bool | str):
        is_other = "" in types or ("boolean" if isinstance(value, bool) else "string") in types
        wanted = [words for name, words in NUMBERS.items() if name in types]
        if wanted and not is_other:
            yield Problem(path, f"expected {wanted[0]}, got {shown(value)}")
    elif isinstance(value, Mapping):
        if value.get("type") in Block.types:  # the schema around it knows only the base class
            schema = schema_of(Block.types[value["type"]])
            schemas, known = [schema], schema.get("$defs", {})
        for name, each in value.items():
            inner = [found for s in schemas if (found := _property(s, name)) is not None]
            if inner:
                yield from _untyped(each, {"anyOf": inner}, known, (*path, str(name)))
    elif isinstance(value, list | tuple):
        for index, each in enumerate(value):
            inner = [found for s in schemas if (found := _item(s, index)) is not None]
            if inner:
                yield from _untyped(each, {"anyOf": inner}, known, (*path, index))


def _property(schema: Mapping[str, Any], name: str) -> Mapping[str, Any] | None:
    found = schema.get("properties", {}).get(name, schema.get("additionalProperties"))
    return found if isinstance(found, Mapping) else None


def _item(schema: Mapping[str, Any], index: int) -> Mapping[str, Any] | None:
    prefix = schema.get("prefixItems", ())
    found = prefix[index] if index < len(prefix) else schema.get("items")
    return found if isinstance(found, Mapping) else None


def _options(schema: Any, known: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    """All that a schema allows, with references looked up."""
    if "$ref" in schema:
        return _options(known.get(str(schema["$ref"]).rsplit("/", 1)[-1], {}), known)
    parts = [*schema.get("anyOf", ()), *schema.get("oneOf", ()), *schema.get("allOf", ())]
    return [each for part in parts for each in _options(part, known)] if parts else [schema]

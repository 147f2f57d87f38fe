"""Refusal of text and booleans where a number is expected.

pydantic converts ``"5"`` and ``true`` to 5 and 1. Its strict mode would also refuse lists for
tuples and 5.0 for whole numbers, and can't check some of a block's parameters, or nested blocks.
"""

from collections.abc import Callable, Iterator, Mapping
from typing import Any, TypeVar
from weakref import WeakKeyDictionary

from ai4u_edu.base.errors import shown
from ai4u_edu.base.parameters import Problem
from ai4u_edu.blocks import Block
from ai4u_edu.blocks.parameterized import Parameterized
from ai4u_edu.page.editing.errors import ChangeError
from ai4u_edu.page.editing.input_checks import check_plain
from ai4u_edu.page.editing.plain import BlockPath
from ai4u_edu.scenes.serialization import PlainDataError

T = TypeVar("T")
NUMBERS = {"number": "a number", "integer": "a whole number"}


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


def schema_of(cls: type[Parameterized]) -> dict[str, Any]:
    """Return the cached JSON Schema of a block or an agent."""
    found = _schemas.get(cls)
    if found is None:
        found = _schemas[cls] = cls.json_schema()
    return found


_schemas: "WeakKeyDictionary[Any, dict[str, Any]]" = WeakKeyDictionary()


def _type_problems(
    value: Any, schema: Any, known: Mapping[str, Any], path: BlockPath
) -> Iterator[Problem]:
    schemas = _alternatives(schema, known)
    types = {str(each.get("type", "")) for each in schemas}
    if isinstance(value, bool | str):
        is_other = "" in types or ("boolean" if isinstance(value, bool) else "string") in types
        wanted = [words for name, words in NUMBERS.items() if name in types]
        if wanted and not is_other:
            yield Problem(path, f"expected {wanted[0]}, got {shown(value)}")
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

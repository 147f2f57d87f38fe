"""Field types of messages with their limits, and texts that explain a message that breaks them.

msgspec decodes and validates messages. Its own errors name a type and a path; :func:`find_mistake`
finds the text for people: what was expected, and what was there.
"""

import sys
from collections.abc import Iterable, Mapping, Sequence
from typing import Annotated, Any

from msgspec import Meta
from msgspec import inspect as types

from ai4u_edu.base import errors
from ai4u_edu.base.errors import AI4UError
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join

MAX_INT = 2**53 - 1
"""The largest integer that every language has."""
MAX_FLOAT = sys.float_info.max
MAX_TEXT_CHARS = 400
"""Limit of texts that have no limit of their own."""
MAX_ENTRIES = 1024
"""Limit of lists and mappings."""
MAX_SHOWN_CHARS = 40

Int = Annotated[int, Meta(ge=0, le=MAX_INT)]
Text = Annotated[str, Meta(max_length=MAX_TEXT_CHARS)]
Finite = Annotated[float, Meta(ge=-MAX_FLOAT, le=MAX_FLOAT)]
LIST = Meta(max_length=MAX_ENTRIES)
"""The limit of a list or a mapping, for ``Annotated``."""


class WireError(AI4UError):
    """The bytes that were received are no message; the text says what was expected."""


def shown(value: object) -> str:
    """Return the beginning of a value, for an error's text."""
    return errors.shown(value, MAX_SHOWN_CHARS)


def find_mistake(kind: types.Type, value: Any) -> str:
    """Explain the first mistake in a decoded value.

    Args:
        kind: the type that was expected, from ``msgspec.inspect``.
        value: built of lists, dicts and scalars.

    Returns:
        A text, such as "seq: expected a whole number from 0 on, got -1"; empty if all is well.

    >>> find_mistake(types.type_info(tuple[Finite, ...]), [1, float("nan")])
    'expected a finite number, got nan'
    """
    match kind:
        case types.UnionType(types=kinds):  # of None and one other type
            inner = [each for each in kinds if not isinstance(each, types.NoneType)]
            return "" if value is None else find_mistake(inner[0], value)
        case types.VarTupleType(item_type=item) if _is_short(value, list):
            return _first(find_mistake(item, each) for each in value)
        case types.DictType(key_type=key, value_type=item) if _is_short(value, dict):
            pairs = value.items()
            return _first(find_mistake(key, k) or find_mistake(item, v) for k, v in pairs)
        case types.StructType(fields=fields) if _is_short(value, list):
            return find_wrong_field(fields, value)
    expected = _expected(kind, value)
    if not expected:
        return ""
    return _("expected {expected}, got {value}", expected=expected, value=shown(value))


def find_wrong_field(fields: Sequence[types.Field], values: Sequence[Any]) -> str:
    """Explain the first mistake in the fields of a message; return an empty text for none."""
    least, most = sum(field.required for field in fields), len(fields)
    if not least <= len(values) <= most:
        count = str(most) if least == most else _("{least} to {most}", least=least, most=most)
        names = ", ".join(field.name for field in fields)
        return _(
            "expected {count} fields ({names}), got {got}",
            count=count,
            names=names,
            got=len(values),
        )
    for field, value in zip(fields, values, strict=False):
        mistake = find_mistake(field.type, value)
        if mistake:
            return join([field.name, mistake], ": ")
    return ""


def _expected(kind: types.Type, value: Any) -> str:
    """Return a description of the type, or an empty text if the value has it."""
    match kind:
        case types.IntType(le=most):
            if type(value) is int and 0 <= value <= (most or MAX_INT):
                return ""
            is_too_large = type(value) is int and value > 0
            if is_too_large:
                return _("a whole number from 0 to {most}", most=most or MAX_INT)
            return _("a whole number from 0 on")
        case types.FloatType(ge=low, le=high):
            if type(value) not in (int, float):
                return _("a number")
            return "" if low is None or low <= value <= (high or 0.0) else _range(low, high)
        case types.BoolType():
            return "" if type(value) is bool else _("true or false")
        case types.StrType(max_length=most):
            is_fine = type(value) is str and len(value) <= (most or 0)
            return "" if is_fine else _("text of up to {most} characters", most=most or 0)
        case types.BytesType(max_length=most):
            is_fine = type(value) is bytes and len(value) <= (most or 0)
            return "" if is_fine else _("up to {most} bytes", most=most or 0)
        case types.LiteralType(values=known):
            is_known = type(value) is str and value in known
            return "" if is_known else _("one of {names}", names=", ".join(map(repr, known)))
        case types.DictType():
            return _("names and values, up to {most}", most=MAX_ENTRIES)
    return _("a list of up to {most}", most=MAX_ENTRIES)


def _range(low: float, high: float | None) -> str:
    if low == -MAX_FLOAT or high is None:
        return _("a finite number")
    return _("a number from {low:g} to {high:g}", low=low, high=high)


def _is_short(value: Any, kind: type[list[Any] | Mapping[Any, Any]]) -> bool:
    return type(value) is kind and len(value) <= MAX_ENTRIES


def _first(mistakes: Iterable[str]) -> str:
    return next(filter(None, mistakes), "")

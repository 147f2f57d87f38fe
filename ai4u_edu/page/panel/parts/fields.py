"""Fields of forms."""

from collections.abc import Collection
from typing import Any

from msgspec import Struct

from ai4u_edu.locale import Text
from ai4u_edu.page.editing.forms import Kind, ParameterField
from ai4u_edu.page.panel.field_hints import detail, plain_hint, plain_label


class FormField(Struct, frozen=True):
    """A field of a form."""

    name: str
    """Name of the parameter, as in the values of a command."""
    label: str
    kind: Kind
    """Kind of its control; ``whole`` is a whole number, ``data`` JSON."""
    value: Any
    """The present value."""
    shown: str
    """The present value as text in an input, or as one of the choices."""
    hint: str
    """A short sentence about it."""
    detail: str
    """The meaning of the parameter in the words of its class, with its range."""
    choices: list[str]
    """Values to choose from, for the kind ``choice``; else suggestions."""
    words: list[str]
    """Words for these values in the reader's language."""
    is_common: bool
    """True if every block of the kind has it."""
    is_first: bool
    """True for the few fields that matter most."""
    unit: str
    """Unit of a number; empty if it has none."""
    low: float | None
    """Lower bound of a number; null if it has none."""
    high: float | None
    """Upper bound of a number; null if it has none."""


def form_field(field: ParameterField, first: Collection[str] = (), block: str = "") -> FormField:
    """Return a field for the page.

    Args:
        field: the field.
        first: names of the fields that matter most.
        block: class name of its block; empty if it is no block's.
    """
    return FormField(
        name=field.name,
        label=plain_label(field),
        kind=field.kind,
        value=field.value,
        shown=str(field.shown),
        hint=plain_hint(field, block),
        detail=detail(field),
        choices=[str(choice) for choice in field.choices],
        words=[choice if isinstance(choice, Text) else str(choice) for choice in field.choices],
        is_common=field.is_common,
        is_first=field.name in first,
        unit=field.unit,
        low=field.low,
        high=field.high,
    )

"""Fields of forms as JSON."""

from collections.abc import Collection
from typing import Any

from ai4u_edu.page.editing.forms import Field
from ai4u_edu.page.panel.field_hints import detail, plain_hint


def field_json(field: Field, first: Collection[str] = (), block: str = "") -> dict[str, Any]:
    """Return a field.

    Args:
        field: the field.
        first: names of the fields that matter most.
        block: class name of its block; empty if it is no block's.
    """
    return {
        "name": field.name,
        "label": field.label,
        "kind": field.kind,
        "value": field.value,
        "shown": field.shown,
        "hint": plain_hint(field, block),
        "detail": detail(field),
        "choices": [str(each) for each in field.choices],
        "is_common": field.is_common,
        "is_first": field.name in first,
        "unit": field.unit,
        "low": field.low,
        "high": field.high,
    }

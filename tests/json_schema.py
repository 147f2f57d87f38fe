"""Validators of JSON Schema 2020-12."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from jsonschema import Draft202012Validator


def validator_of(schema: dict[str, Any]) -> "Draft202012Validator":
    """Return a validator of a schema that is a schema.

    Raises:
        SchemaError: it isn't one.
    """
    # here, since it takes two seconds, which every process that collects tests would spend
    from jsonschema import Draft202012Validator

    Draft202012Validator.check_schema(schema)
    return Draft202012Validator(schema)

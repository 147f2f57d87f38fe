"""Things whose parameters are declared once, as annotated fields.

From the declaration come the constructor and its checks, the JSON Schema, the form in the browser
and the tables.
"""

from collections.abc import Callable
from functools import wraps
from typing import Any, Self, dataclass_transform

from pydantic import ConfigDict, Field, TypeAdapter, ValidationError
from pydantic.dataclasses import dataclass
from pydantic.fields import FieldInfo

from ai4u_edu.blocks.field_docs import field_docs
from ai4u_edu.errors import ParameterError
from ai4u_edu.parameters import explain, listed

_CONFIG = ConfigDict(
    extra="forbid",
    allow_inf_nan=False,
    arbitrary_types_allowed=True,
)


@dataclass_transform(kw_only_default=True, eq_default=False, field_specifiers=(Field,))
class Declared:
    """The base of blocks and agents.

    A subclass declares parameters; it writes no ``__init__``. Attributes of its own it may set
    at any time later.

    >>> class Thermometer(Declared):
    ...     '''Reads how warm it is.'''
    ...     offset: float = 0.0
    >>> Thermometer(offset=2)
    Thermometer(offset=2.0)
    >>> Thermometer(ofset=2)
    Traceback (most recent call last):
    ...
    ai4u_edu.errors.ParameterError: Thermometer: ofset: unknown parameter; did you mean 'offset'?
    """

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        dataclass(cls, kw_only=True, eq=False, repr=False, config=_CONFIG)
        # the constructor that was just made raises pydantic's errors; a student gets ours
        setattr(cls, "__init__", _explained(cls.__init__, cls))  # noqa: B010 - mypy: it is no method

    @classmethod
    def parameters(cls) -> dict[str, FieldInfo]:
        """The declared parameters by name, with type, default, range and unit."""
        fields: dict[str, FieldInfo] = getattr(cls, "__pydantic_fields__", {})
        return {field.alias or name: field for name, field in fields.items()}

    @classmethod
    def json_schema(cls) -> dict[str, Any]:
        """The JSON Schema of the parameters; what is written under a field is its description."""
        schema = TypeAdapter(cls).json_schema()
        plain_type: type = cls  # mypy takes a class that says __hash__ for one that has no hash
        for name, text in field_docs(plain_type).items():
            if name in schema.get("properties", {}):
                schema["properties"][name].setdefault("description", text)
        return schema

    def values(self) -> dict[str, Any]:
        """The parameters' values by name, as they are now."""
        fields: dict[str, FieldInfo] = getattr(self, "__pydantic_fields__", {})
        return {field.alias or name: getattr(self, name) for name, field in fields.items()}

    def given(self) -> dict[str, Any]:
        """The values that are not as by default."""
        declared = self.parameters()
        return {
            name: value
            for name, value in self.values().items()
            if value != declared[name].get_default(call_default_factory=True)
        }

    def changed(self, **values: Any) -> Self:
        """A new one of the same kind with some other parameters."""
        return type(self)(**(self.values() | values))

    def __repr__(self) -> str:
        shown = ", ".join(f"{name}={value!r}" for name, value in self.given().items())
        return f"{type(self).__name__}({shown})"


def _explained(construct: Callable[..., None], cls: type[Declared]) -> Callable[..., None]:
    inner = getattr(construct, "_inner", construct)

    @wraps(inner)
    def explained(self: Declared, *args: Any, **values: Any) -> None:
        try:
            inner(self, *args, **values)
        except ValidationError as error:
            problems = listed(explain(error.errors(), cls.parameters()))
            told = ParameterError(f"{type(self).__name__}: {problems}")
            told.details = error
            raise told from None

    explained._inner = inner  # type: ignore[attr-defined]  # a subclass wraps its own, once
    return explained

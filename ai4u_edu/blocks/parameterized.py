"""Things whose parameters are declared once, as annotated fields.

From the declaration come the constructor and its checks, the JSON Schema, the form in the browser
and the tables.
"""

from collections.abc import Callable, Mapping
from functools import wraps
from typing import Any, Self, dataclass_transform

from pydantic import ConfigDict, Field, GetCoreSchemaHandler, TypeAdapter, ValidationError
from pydantic.dataclasses import dataclass
from pydantic.fields import FieldInfo
from pydantic_core import ArgsKwargs, core_schema

from ai4u_edu.base.errors import ParameterError, shown
from ai4u_edu.base.parameters import explain, listed
from ai4u_edu.blocks.field_docs import field_docs

_CONFIG = ConfigDict(
    extra="forbid",
    allow_inf_nan=False,
    arbitrary_types_allowed=True,
)


@dataclass_transform(kw_only_default=True, eq_default=False, field_specifiers=(Field,))
class Parameterized:
    """The base of blocks and agents.

    A subclass declares parameters; it writes no ``__init__``. Attributes of its own it may set
    at any time later.

    >>> class Thermometer(Parameterized):
    ...     '''Reads how warm it is.'''
    ...     offset: float = 0.0
    >>> Thermometer(offset=2)
    Thermometer(offset=2.0)
    >>> Thermometer(ofset=2)
    Traceback (most recent call last):
    ...
    ai4u_edu.base.errors.ParameterError: Thermometer: ofset: unknown parameter; did you mean \
'offset'?
    """

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        dataclass(cls, kw_only=True, eq=False, repr=False, config=_CONFIG)
        # the constructor that was just made raises pydantic's errors; a student gets ours
        setattr(cls, "__init__", _explained(cls.__init__, cls))  # noqa: B010 - mypy: it is no method

    @classmethod
    def __get_pydantic_core_schema__(
        cls, source: Any, handler: GetCoreSchemaHandler
    ) -> core_schema.CoreSchema:
        """Say of a parameter that holds one of these: it takes one that is made, and no mapping.

        Pydantic would make one of a mapping: of ``sensors=[{"perception_key": "x"}]`` a bare
        Sensor, which reads nothing.
        """
        return core_schema.no_info_before_validator_function(cls._refuse_unmade, handler(source))

    @classmethod
    def _refuse_unmade(cls, value: Any) -> Any:
        if isinstance(value, cls | ArgsKwargs):  # the latter is what the constructor got
            return value
        name = cls.__name__
        got, hint = shown(value), ""
        if isinstance(value, type):
            got = f"the class {value.__name__}"
            hint = f"; make one, as in {value.__name__}(...)" if issubclass(value, cls) else ""
        elif isinstance(value, Mapping):
            hint = "; make it here, mappings with a 'type' stand in scene files only"
        article = "an" if name[0] in "AEIOU" else "a"
        # pydantic takes a ValueError for a finding, and lets a TypeError through
        problem = ValueError(f"expected {article} {name}, got {got}{hint}")
        raise problem

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
        given = ", ".join(f"{name}={value!r}" for name, value in self.given().items())
        return f"{type(self).__name__}({given})"


def _explained(construct: Callable[..., None], cls: type[Parameterized]) -> Callable[..., None]:
    inner = getattr(construct, "_inner", construct)

    @wraps(inner)
    def explained(self: Parameterized, *args: Any, **values: Any) -> None:
        try:
            inner(self, *args, **values)
        except ValidationError as error:
            problems = listed(explain(error.errors(), cls.parameters()))
            told = ParameterError(f"{type(self).__name__}: {problems}")
            told.details = error
            raise told from None

    explained._inner = inner  # type: ignore[attr-defined]  # a subclass wraps its own, once
    return explained

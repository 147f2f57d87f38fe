"""Objects whose parameters are declared once, as annotated fields.

The constructor and its checks, the JSON Schema, the form in the browser and the tables are derived
from the declaration.
"""

import ast
from collections.abc import Callable, Mapping
from functools import cache, wraps
from inspect import signature
from itertools import pairwise
from typing import Any, Self, dataclass_transform

from pydantic import ConfigDict, Field, GetCoreSchemaHandler, TypeAdapter, ValidationError
from pydantic.dataclasses import dataclass
from pydantic.fields import FieldInfo
from pydantic_core import ArgsKwargs, core_schema

from ai4u_edu.base.errors import ParameterError, shown
from ai4u_edu.base.parameters import default_of, explain, format_problems
from ai4u_edu.base.syntax import parsed_class
from ai4u_edu.locale import Text, join
from ai4u_edu.locale import gettext as _

_CONFIG = ConfigDict(
    extra="forbid",
    allow_inf_nan=False,
    arbitrary_types_allowed=True,
)


_A, _AN = _("expected a {name}, got {got}"), _("expected an {name}, got {got}")


@dataclass_transform(kw_only_default=True, eq_default=False, field_specifiers=(Field,))
class Parameterized:
    """The base of blocks and agents.

    A subclass declares parameters and needs no ``__init__``. It may set other attributes at any
    time later; an ``__init__(self)`` of its own runs once the parameters are set.

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
        own = vars(cls).get("__init__")
        if own is not None:
            setattr(cls, "__post_init__", _run_once(own, cls.__name__))  # noqa: B010 - mypy: it is no method
        dataclass(cls, kw_only=True, eq=False, repr=False, config=_CONFIG)
        # the constructor that pydantic made raises its own errors; convert them to ours
        setattr(cls, "__init__", _explained(cls.__init__, cls))  # noqa: B010 - mypy: it is no method

    @classmethod
    def __get_pydantic_core_schema__(
        cls, source: Any, handler: GetCoreSchemaHandler
    ) -> core_schema.CoreSchema:
        """Accept only instances as values of a parameter of this type, no mappings.

        Pydantic would construct one from a mapping: ``sensors=[{"perception_key": "x"}]`` would
        make a bare Sensor, which reads nothing.
        """
        return core_schema.no_info_before_validator_function(cls._refuse_unmade, handler(source))

    @classmethod
    def _refuse_unmade(cls, value: Any) -> Any:
        if isinstance(value, cls | ArgsKwargs):  # pydantic passes the constructor's arguments too
            return value
        name, got = cls.__name__, shown(value)
        expected = _AN if name[0] in "AEIOU" else _A
        if isinstance(value, type):
            got = _("the class {name}", name=value.__name__)
            if issubclass(value, cls):
                got = _("the class {name}; make one, as in {name}(...)", name=value.__name__)
        elif isinstance(value, Mapping):
            got = _(
                "{mapping}; make it here, mappings with a 'type' stand in scene files only",
                mapping=got,
            )
        # pydantic collects a ValueError, and would let a TypeError through
        problem = ValueError(Text(expected.msgid, {"name": name, "got": got}))
        raise problem

    @classmethod
    def parameters(cls) -> dict[str, FieldInfo]:
        """Return the declared parameters by name, with type, default, range and unit."""
        fields: dict[str, FieldInfo] = getattr(cls, "__pydantic_fields__", {})
        return {field.alias or name: field for name, field in fields.items()}

    @classmethod
    def json_schema(cls) -> dict[str, Any]:
        """Return the JSON Schema of the parameters; the text under a field is its description."""
        schema = TypeAdapter(cls).json_schema()
        plain_type: type = cls  # mypy believes that a class that defines __hash__ has no hash
        for name, text in field_docs(plain_type).items():
            if name in schema.get("properties", {}):
                schema["properties"][name].setdefault("description", text)
        return schema

    def values(self) -> dict[str, Any]:
        """Return the parameters' present values by name."""
        fields: dict[str, FieldInfo] = getattr(self, "__pydantic_fields__", {})
        return {field.alias or name: getattr(self, name) for name, field in fields.items()}

    def given(self) -> dict[str, Any]:
        """Return the values that differ from their defaults."""
        declared = self.parameters()
        return {
            name: value
            for name, value in self.values().items()
            if value != default_of(declared[name])
        }

    def changed(self, **values: Any) -> Self:
        """Return a new object of the same class with some parameters changed."""
        return type(self)(**(self.values() | values))

    def __repr__(self) -> str:
        given = ", ".join(f"{name}={value!r}" for name, value in self.given().items())
        return f"{type(self).__name__}({given})"


def _run_once(own: Callable[..., None], name: str) -> Callable[[Any], None]:
    """Return a class's own ``__init__`` as a step after the generated constructor.

    Raises:
        ParameterError: it takes parameters, which have to be declared as fields.
    """
    extra = list(signature(own).parameters.values())[1:]
    if extra:
        fields = ", ".join(f"`{each.name}: float = ...`" for each in extra)
        raise ParameterError(
            _(
                "{name}: expected no parameters of __init__ besides self, got {names}; declare "
                "each under the class line, as in {fields}, and read it as self.{first}",
                name=name,
                names=", ".join(each.name for each in extra),
                fields=fields,
                first=extra[0].name,
            )
        )
    running: set[int] = set()

    def initialise(self: Any) -> None:
        if id(self) in running:  # it called super().__init__(), which comes back here
            return
        running.add(id(self))
        try:
            own(self)
        finally:
            running.discard(id(self))

    return initialise


def _explained(construct: Callable[..., None], cls: type[Parameterized]) -> Callable[..., None]:
    inner = getattr(construct, "_inner", construct)

    @wraps(inner)
    def explained(self: Parameterized, *args: Any, **values: Any) -> None:
        try:
            inner(self, *args, **values)
        except ValidationError as error:
            problems = format_problems(explain(error.errors(), cls.parameters()))
            told = ParameterError(join([type(self).__name__, problems], ": "))
            told.details = error
            raise told from None

    explained._inner = inner  # type: ignore[attr-defined]  # so that a subclass wraps it only once
    return explained


@cache
def field_docs(cls: type) -> dict[str, str]:
    """Return the text under each annotated field of a class and its bases; {} without source.

    It parses the source on demand, not when the class is made: most runs need no descriptions.
    """
    docs: dict[str, str] = {}
    for each in reversed(cls.__mro__[:-1]):
        try:
            tree = parsed_class(each)
        except (OSError, TypeError, SyntaxError):
            continue  # defined in a console, or built into Python
        body = tree.body[0].body if isinstance(tree.body[0], ast.ClassDef) else []
        for field, text in pairwise(body):
            if (
                isinstance(field, ast.AnnAssign)
                and isinstance(field.target, ast.Name)
                and isinstance(text, ast.Expr)
                and isinstance(text.value, ast.Constant)
                and isinstance(text.value.value, str)
            ):
                docs[field.target.id] = " ".join(text.value.value.split())
    return docs

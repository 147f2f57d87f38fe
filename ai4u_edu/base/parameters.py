"""Declaration of parameters and explanation of wrong ones, for blocks, bodies and scenes.

A parameter is an annotated field. The annotation carries type, range and unit; validation at
construction, the JSON Schema, forms and tables are derived from it::

    reach: PositiveMetres = 20.0
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Annotated, Any, NamedTuple, cast, get_args

from pydantic import AfterValidator, BaseModel, Field, StringConstraints
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from ai4u_edu.base.errors import shown, suggest, text_of
from ai4u_edu.locale import Text, join
from ai4u_edu.locale import gettext as _


def quantity(
    unit: str,
    *,
    gt: float | None = None,
    ge: float | None = None,
    lt: float | None = None,
    le: float | None = None,
) -> Any:
    """Return the metadata of a number with unit and bounds; the default is +-``MAX_NUMBER``."""
    ge = -MAX_NUMBER if ge is None and gt is None else ge
    le = MAX_NUMBER if le is None and lt is None else le
    return Field(json_schema_extra={"unit": unit}, gt=gt, ge=ge, lt=lt, le=le)


def default_of(field: FieldInfo) -> Any:
    """Return a parameter's default; a list or a mapping is a new one each time.

    pydantic's ``get_default`` asks each time which arguments the maker of a default takes. Python
    parses a text for that: it takes up to 2 ms, and in CPython 3.11 it may fail where two threads
    do so at once; see base/syntax.py.
    """
    if field.default_factory is None:
        return field.get_default()
    return cast(Callable[[], Any], field.default_factory)()


MAX_NUMBER = 1e9
"""Default bound of numbers: products of a few of them still fit a 32-bit float."""
MAX_COUNT = 2**31 - 1
"""Default bound of whole numbers."""
MIN_LENGTH_M = 1e-4
"""Smallest length, metres: the physics computes neither area nor inertia of smaller bodies."""


def not_below(least: float) -> AfterValidator:
    """Return a check that a positive number is not too small to compute with."""

    def check(number: float) -> float:
        if number < least:
            raise ValueError(
                _("expected at least {least:g}, got {number}", least=least, number=repr(number))
            )
        return number

    return AfterValidator(check)


Name = Annotated[str, StringConstraints(min_length=1, max_length=80, pattern=r"^[\w .:\-]+$")]
Metres = Annotated[float, quantity("m", ge=-1e4, le=1e4)]
PositiveMetres = Annotated[float, quantity("m", gt=0, le=1e4), not_below(MIN_LENGTH_M)]
NonNegativeMetres = Annotated[float, quantity("m", ge=0, le=1e4)]
Degrees = Annotated[float, quantity("deg", ge=-3600, le=3600)]
Seconds = Annotated[float, quantity("s", ge=0)]
Number = Annotated[float, quantity("")]
Count = Annotated[int, Field(ge=0, le=MAX_COUNT)]
WholeNumber = Annotated[int, Field(ge=-MAX_COUNT, le=MAX_COUNT)]
Point = tuple[Metres, Metres]
Bits = Annotated[int, Field(ge=0, le=0xFFFFFFFF)]


MAX_LISTED = 20
"""Maximum number of problems in one message."""
MAX_HINTS = 50
"""Maximum number of problems that get a suggested name; comparing names is the slowest part."""
MAX_EXPLAINED = 100
"""Maximum number of problems that are explained; of more, only the number is told."""


def is_open(bound: float) -> bool:
    """Return True for a default bound, which a parameter has only if it declares none."""
    return abs(bound) in (MAX_NUMBER, MAX_COUNT)


DataPath = tuple[str | int, ...]
"""Path of a value in nested data: ``("agents", 0, "sensors", 2, "reach")``."""


class ParameterProblem(NamedTuple):
    """The path of a wrong parameter, and what is wrong with it."""

    path: DataPath
    text: str

    def __str__(self) -> str:
        """Return ``path: text``, as in a message."""
        return str(self.message)

    @property
    def message(self) -> str:
        """``path: text``, as a text that can be translated."""
        return join([format_path(self.path), self.text], ": ") if self.path else self.text


_UNEXPLAINED = ParameterProblem((), _("is wrong"))


def format_path(path: Sequence[str | int]) -> str:
    """Return a path as text.

    >>> format_path(("agents", 0, "sensors", 2, "reach"))
    'agents[0].sensors[2].reach'
    """
    text = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in path)
    return text.removeprefix(".")


def explain(
    errors: Iterable[ErrorDetails], known: type[BaseModel] | Iterable[str]
) -> list[ParameterProblem]:
    """Translate pydantic's errors into our form: expected, got, how to mend it.

    Args:
        errors: pydantic's errors.
        known: the model, or the names of its parameters.
    """
    names = known if isinstance(known, type) else list(known)
    all_errors = list(errors)
    found = [(error, *_walk(error["loc"], names)) for error in all_errors[:MAX_EXPLAINED]]
    holders = {path[:length] for _, path, _ in found for length in range(len(path))}
    explained = [
        ParameterProblem(path, _sentence(error, names_there, hints=place < MAX_HINTS))
        for place, (error, path, names_there) in enumerate(found)
        # pydantic also reports a list with wrong entries as too short; the entries' errors suffice
        if not (error["type"] == "too_short" and path in holders)
    ]
    # nobody reads more: of the rest the number counts
    return explained + [_UNEXPLAINED] * (len(all_errors) - len(found))


def format_problems(problems: Sequence[ParameterProblem]) -> str:
    """Join problems into one text: the first ones, and how many more there are.

    >>> format_problems([ParameterProblem((), "is wrong")] * 22)[-28:]
    'wrong; and 2 more like these'
    """
    told = [problem.message for problem in problems[:MAX_LISTED]]
    if len(problems) > MAX_LISTED:
        told.append(_("and {count} more like these", count=len(problems) - MAX_LISTED))
    return join(told, "; ")


def _walk(
    location: tuple[int | str, ...], known: type[BaseModel] | list[str]
) -> tuple[tuple[str | int, ...], list[str]]:
    """Return an error's path as in the file, and the names that are known at that place.

    Pydantic adds the tag of a union's member ("circle") to the path; this removes it.
    """
    if isinstance(known, list):
        return location, known
    path: list[str | int] = []
    here: list[type[BaseModel]] = [known]
    for part in location:
        tagged = [model for model in here if _tag(model) == part]
        if tagged and not any(part in model.model_fields for model in here):
            here = tagged
            continue
        path.append(part)
        if isinstance(part, str):
            fields = [model.model_fields[part] for model in here if part in model.model_fields]
            if not fields:
                break
            here = [each for field in fields for each in _models(field.annotation)]
    return tuple(path), [name for model in here for name in model.model_fields]


def _tag(model: type[BaseModel]) -> object:
    field = model.model_fields.get("type")
    return field.default if field else None


def _models(annotation: Any) -> list[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [model for part in get_args(annotation) for model in _models(part)]


EXPECTED = {
    "int_type": _("expected a whole number, got {got}"),
    "int_parsing": _("expected a whole number, got {got}"),
    "int_from_float": _("expected a whole number, got {got}"),
    "float_type": _("expected a number, got {got}"),
    "float_parsing": _("expected a number, got {got}"),
    "finite_number": _("expected a finite number, got {got}"),
    "string_type": _("expected text, got {got}"),
    "bool_type": _("expected true or false, got {got}"),
    "bool_parsing": _("expected true or false, got {got}"),
    "list_type": _("expected a list, got {got}"),
    "tuple_type": _("expected a list, got {got}"),
    "dict_type": _("expected a mapping, got {got}"),
    "mapping_type": _("expected a mapping, got {got}"),
    "model_type": _("expected a mapping, got {got}"),
    "model_attributes_type": _("expected a mapping, got {got}"),
    "literal_error": _("expected {expected}, got {got}"),
    "too_short": _("expected at least {min_length} entries, got {got}"),
    "too_long": _("expected at most {max_length} entries, got {got}"),
    "string_too_short": _("expected at least {min_length} characters, got {got}"),
    "string_too_long": _("expected at most {max_length} characters, got {got}"),
    "string_pattern_mismatch": _("expected text that matches {pattern}, got {got}"),
    "greater_than": _("expected more than {gt:g}, got {got}"),
    "greater_than_equal": _("expected at least {ge:g}, got {got}"),
    "less_than": _("expected less than {lt:g}, got {got}"),
    "less_than_equal": _("expected at most {le:g}, got {got}"),
}
"""Sentences by pydantic's type of error, with values of its context in braces."""


def _sentence(error: ErrorDetails, known: Sequence[str], *, hints: bool) -> str:
    kind, got = error["type"], error.get("input")
    context: Mapping[str, Any] = error.get("ctx", {})
    if kind in {"missing", "missing_argument", "missing_keyword_only_argument"}:
        return _("is missing and has no default")
    if kind == "unexpected_positional_argument":
        return _(
            "parameters are given by name, as in {example}=...; got {got}",
            example=next(iter(known), "size"),
            got=shown(got),
        )
    if kind in {"extra_forbidden", "unexpected_keyword_argument"}:
        unknown = _("unknown parameter")
        return join([unknown, suggest(str(error["loc"][-1]), known)], "; ") if hints else unknown
    if kind == "union_tag_invalid":
        tags = [tag.strip().strip("'") for tag in str(context["expected_tags"]).split(",")]
        unknown = _("unknown type {type}", type=shown(context["tag"]))
        return join([unknown, suggest(str(context["tag"]), tags)], "; ") if hints else unknown
    if kind == "union_tag_not_found":
        return _("needs a 'type'")
    if kind == "value_error":
        cause = context.get("error")
        if isinstance(cause, Exception):
            return text_of(cause)
        return error["msg"].removeprefix("Value error, ")
    what = shown(got)  # only here: it may be the whole input
    if kind in EXPECTED:
        pattern = EXPECTED[kind].msgid
        values = {name: value for name, value in context.items() if f"{{{name}" in pattern}
        if kind == "literal_error":
            values["expected"] = _choices(str(context["expected"]))
        return Text(pattern, {**values, "got": what})
    message = error["msg"].replace("Input should be ", "expected ").replace("valid ", "")
    return _("{message}, got {got}", message=message, got=what)


def _choices(expected: str) -> str:
    """Return pydantic's list of values, such as "'a', 'b' or 'c'", as a text."""
    first, _or, last = expected.rpartition(" or ")
    return _("{choices} or {last}", choices=first, last=last) if first else expected

"""How parameters are declared and how a wrong one is explained, for blocks, bodies and scenes.

A parameter is an annotated field. The annotation carries type, range and unit; validation at
construction, the JSON Schema, forms and tables are derived from it::

    reach: PositiveMetres = 20.0
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import Annotated, Any, NamedTuple

from pydantic import Field, StringConstraints
from pydantic_core import ErrorDetails

from ai4u_edu.errors import suggest


def quantity(
    unit: str,
    *,
    gt: float | None = None,
    ge: float | None = None,
    lt: float | None = None,
    le: float | None = None,
) -> Any:
    """The metadata of a number with a unit and, where it has any, bounds."""
    return Field(json_schema_extra={"unit": unit}, gt=gt, ge=ge, lt=lt, le=le)


Name = Annotated[str, StringConstraints(min_length=1, max_length=80, pattern=r"^[\w .:\-]+$")]
Metres = Annotated[float, quantity("m", ge=-1e4, le=1e4)]
PositiveMetres = Annotated[float, quantity("m", gt=0, le=1e4)]
NonNegativeMetres = Annotated[float, quantity("m", ge=0, le=1e4)]
Degrees = Annotated[float, quantity("deg", ge=-3600, le=3600)]
Seconds = Annotated[float, quantity("s", ge=0)]
Number = Annotated[float, quantity("")]
Count = Annotated[int, Field(ge=0)]
Point = tuple[Metres, Metres]
Bits = Annotated[int, Field(ge=0, le=0xFFFFFFFF)]


class Problem(NamedTuple):
    """One wrong parameter: where it is and what is wrong with it."""

    path: tuple[str | int, ...]
    text: str

    def __str__(self) -> str:
        """``path: text``, as it stands in a message."""
        return f"{dotted(self.path)}: {self.text}" if self.path else self.text


def dotted(path: Sequence[str | int]) -> str:
    """A path as a person writes it.

    >>> dotted(("agents", 0, "sensors", 2, "reach"))
    'agents[0].sensors[2].reach'
    """
    text = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in path)
    return text.removeprefix(".")


def explain(errors: Iterable[ErrorDetails], known: Iterable[str] = ()) -> list[Problem]:
    """Pydantic's findings in our words: expected, got, how to mend it."""
    known = list(known)
    return [Problem(_clean(error["loc"]), _sentence(error, known)) for error in errors]


def _clean(location: tuple[int | str, ...]) -> tuple[str | int, ...]:
    # pydantic puts names of union members into the path ("box", "function-wrap[...]"); a person
    # never wrote those
    return tuple(part for part in location if isinstance(part, int) or not part.endswith("]"))


def _sentence(error: ErrorDetails, known: Sequence[str]) -> str:
    kind, got = error["type"], error.get("input")
    if kind in {"missing", "missing_argument", "missing_keyword_only_argument"}:
        return "is missing and has no default"
    if kind == "unexpected_positional_argument":
        return f"parameters are given by name, as in {next(iter(known), 'size')}=...; got {got!r}"
    if kind in {"extra_forbidden", "unexpected_keyword_argument"}:
        return "unknown parameter; " + suggest(str(error["loc"][-1]), known)
    if kind == "union_tag_invalid":
        context: Mapping[str, Any] = error.get("ctx", {})
        tags = [tag.strip().strip("'") for tag in str(context["expected_tags"]).split(",")]
        return f"unknown type {context['tag']!r}; {suggest(str(context['tag']), tags)}"
    if kind == "union_tag_not_found":
        return "needs a 'type'"
    if kind == "value_error":
        return error["msg"].removeprefix("Value error, ")
    message = error["msg"].replace("Input should be ", "expected ").replace("valid ", "")
    shown = repr(got) if len(repr(got)) <= 60 else repr(got)[:57] + "..."
    return f"{message}, got {shown}"

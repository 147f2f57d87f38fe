"""Form fields for a block's parameters, derived from its declaration."""

import json
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from inspect import get_annotations
from typing import Any, Literal, get_args

from ai4u_edu.base.errors import suggest, text_of
from ai4u_edu.base.parameters import ParameterProblem, is_open
from ai4u_edu.blocks import Actuator, Block, Brain, Controller, RewardFunc, Sensor
from ai4u_edu.locale import Text, join
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.blocks import KINDS
from ai4u_edu.page.editing.errors import ChangeError
from ai4u_edu.page.editing.input_checks import schema_of
from ai4u_edu.page.editing.plain import Plain
from ai4u_edu.page.editing.scene_names import SceneNames
from ai4u_edu.scenes.yaml.tree import NotYamlError, read_tree

Kind = Literal["number", "whole", "switch", "choice", "text", "data"]
BASES = (Sensor, Actuator, RewardFunc, Brain, Controller)
SWITCHES = {"is_active", "enabled"}
"""Parameters that are not in a form; a page has a button for them."""
NONE_LABEL = _("(none)")
UNITS: Mapping[str, str] = {
    "deg": _("deg"),
    "decisions": _("decisions"),
    "the reading's": _("the reading's"),
}
"""Units that are words; symbols such as m/s are the same everywhere."""
LIMITS: Mapping[str, Callable[[str], str]] = {
    "minimum": lambda bound: _("at least {bound}", bound=bound),
    "exclusiveMinimum": lambda bound: _("more than {bound}", bound=bound),
    "maximum": lambda bound: _("at most {bound}", bound=bound),
    "exclusiveMaximum": lambda bound: _("less than {bound}", bound=bound),
}
"""Bounds in words, by their names in a JSON Schema."""


@dataclass(frozen=True)
class ParameterField:
    """A form field for one parameter."""

    name: str
    label: str
    kind: Kind
    value: Any
    """The present value, as plain data."""
    hint: str
    """Meaning of the parameter, in the words of its class."""
    choices: tuple[Any, ...] = ()
    """Values to choose from; those that are shown in other words in other languages are texts."""
    is_common: bool = False
    """True if every block of the kind has it; such fields come last."""
    unit: str = ""
    """Unit of a number; empty if it has none."""
    low: float | None = None
    """Lower bound of a number; None if it has none."""
    high: float | None = None
    """Upper bound, likewise."""
    limits: str = ""
    """The range in words; empty if there is none."""
    note: str = ""
    """A sentence to add to the hint; usually empty."""

    @property
    def shown(self) -> str:
        """The value as text in an input, or as an option of a list."""
        if self.value is None:
            return NONE_LABEL if self.kind == "choice" else ""
        if self.kind == "data":
            return _format(self.value)
        if isinstance(self.value, float):
            return f"{self.value:.10g}"
        return str(self.value) if self.value != "" or self.kind != "choice" else NONE_LABEL

    def read(self, entered: Any) -> Any:
        """Parse what a person entered; None stands for the default.

        Raises:
            ChangeError: it can't be parsed.
        """
        if self.kind == "switch":
            return bool(entered)
        if self.kind == "choice":
            known = {str(each): _plain_choice(each) for each in self.choices}
            return {**known, NONE_LABEL: None}.get(entered, entered)
        if isinstance(entered, str) and not entered.strip():
            return None
        if self.kind in {"number", "whole"}:
            return _number(entered)
        return _data(self.name, str(entered)) if self.kind == "data" else str(entered)


def read_values(fields: Iterable[ParameterField], entered: Mapping[str, Any]) -> dict[str, Any]:
    """Return the values of a form that differ from the fields', as plain data.

    Args:
        fields: the form.
        entered: what a person entered, by name: texts are parsed, other values are kept.

    Raises:
        ChangeError: some can't be parsed, or no field has such a name.
    """
    known = {field.name: field for field in fields}
    values: dict[str, Any] = {}
    problems: list[ParameterProblem] = []
    for name, value in entered.items():
        field = known.get(name)
        if field is None:
            text = _("expected a field, {hint}", hint=suggest(name, known))
            problems.append(ParameterProblem((name,), text))
            continue
        try:
            read = field.read(value) if isinstance(value, str | bool) else value
        except ChangeError as error:
            problems += error.problems
            continue
        if read != field.value and (read, field.value) != (None, ""):
            values[name] = read
    if problems:
        raise ChangeError(problems)
    return values


def block_form(block: Plain, names: SceneNames) -> list[ParameterField]:
    """Return the fields of a block; its own parameters come before those of all of its kind.

    Args:
        block: its type, and the parameters that differ from the default.
        names: names in the scene to choose from.
    """
    cls = Block.types[str(block["type"])]
    schema = schema_of(cls)
    common = {name for base in BASES if issubclass(cls, base) for name in base.parameters()}
    fields = [
        field_of(
            name,
            about,
            block.get(name, about.get("default")),
            known=names.fitting(name),
            is_common=name in common,
        )
        for name, about in schema.get("properties", {}).items()
        if name not in SWITCHES and not _holds_blocks(cls, name)
    ]
    needed = schema.get("required", ())

    def sort_key(field: ParameterField) -> tuple[bool, bool, int]:
        return field.is_common, field.name not in needed, _distance(cls, field.name)

    return sorted(fields, key=sort_key)


def _distance(cls: type[Block], name: str) -> int:
    """Return how many classes above a class a parameter is declared."""
    declared = [name in get_annotations(base) for base in cls.__mro__]
    return declared.index(True) if True in declared else len(declared)


def field_of(
    name: str,
    about: Mapping[str, Any],
    value: Any,
    *,
    known: Iterable[str] | None = None,
    is_common: bool = False,
) -> ParameterField:
    """Make the field of a parameter.

    Args:
        name: of the parameter.
        about: its JSON Schema.
        value: its present value, as plain data.
        known: names in the scene that it can have, if it is a name.
        is_common: True if every block of the kind has it.
    """
    options = [each for each in about.get("anyOf", ()) if each.get("type") != "null"]
    can_be_none = len(options) < len(about.get("anyOf", ()))
    what = {**about, **options[0]} if options else dict(about)
    unit = str(what.get("unit", ""))
    is_number = what.get("type") in {"number", "integer"}
    label: str = Text(name.replace("_", " "))
    if is_number and unit not in {"", "1"}:
        label = with_unit(label, unit)
    # the whole text, which may be one to translate
    hint = about.get("description", "")
    hint = hint if isinstance(hint, Text) else Text(str(hint))
    choices: tuple[Any, ...] = ()
    kind: Kind = "text"
    if "enum" in what:
        kind, choices = "choice", tuple(what["enum"])
    elif known is not None and what.get("type") == "string":
        kind, choices = "choice", tuple(dict.fromkeys((*known, *([value] if value else []))))
        can_be_none = can_be_none or value == "" or about.get("default") == ""
    elif what.get("type") == "boolean":
        kind = "switch"
    elif what.get("type") in {"array", "object"}:
        kind = "data"
    elif is_number:
        kind = "whole" if what["type"] == "integer" else "number"
    if kind == "choice" and (can_be_none or value is None):
        choices = (NONE_LABEL, *(each for each in choices if each != ""))
    low, high = (_bound(what, end) if is_number else None for end in ("inimum", "aximum"))
    return ParameterField(
        name,
        label,
        kind,
        value,
        hint,
        choices,
        is_common,
        UNITS.get(unit, unit) if is_number and unit != "1" else "",
        low,
        high,
        _range(what),
    )


def with_unit(label: str, unit: str) -> str:
    """Return a label with the unit of its field."""
    return _("{label} ({unit})", label=label, unit=UNITS.get(unit, unit))


def _plain_choice(choice: Any) -> Any:
    return str(choice) if isinstance(choice, Text) else choice


def _bound(what: Mapping[str, Any], end: str) -> float | None:
    """Return a parameter's minimum or maximum; None if it has none.

    >>> _bound({"exclusiveMinimum": 0}, "inimum"), _bound({"maximum": 4}, "inimum")
    (0, None)
    """
    given: float | None = what.get(f"m{end}", what.get(f"exclusiveM{end}"))
    return None if given is None or is_open(given) else given


def _range(what: Mapping[str, Any]) -> str:
    words = [
        words_for(f"{what[key]:g}")
        for key, words_for in LIMITS.items()
        if key in what and not is_open(what[key])
    ]
    unit = str(what.get("unit", ""))
    bounds = join(words, ", ")
    if not words or unit in {"", "1"}:
        return bounds
    return _("{bounds} {unit}", bounds=bounds, unit=UNITS.get(unit, unit))


def _holds_blocks(cls: type[Block], name: str) -> bool:
    annotation = cls.parameters()[name].annotation
    parts = (annotation, *get_args(annotation))
    return name in KINDS and any(isinstance(p, type) and issubclass(p, Block) for p in parts)


def _number(entered: Any) -> Any:
    text = str(entered).strip()
    if re.fullmatch(r"[+-]?\d+,\d+", text):
        text = text.replace(",", ".")  # the decimal comma of many countries
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return entered


def _format(value: Any) -> str:
    """Format a value on one line, as in a scene file."""
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_word(k)}: {_format(v)}" for k, v in value.items()) + "}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(_format, value)) + "]"
    return f"{value:.10g}" if isinstance(value, float) else _word(value)


def _word(value: Any) -> str:
    plain = isinstance(value, str) and re.fullmatch(r"[A-Za-z][\w -]*\w|[A-Za-z]", value)
    if plain and value.lower() not in {"true", "false", "yes", "no", "on", "off", "null", "y", "n"}:
        return str(value)
    return json.dumps(value)


def _data(name: str, entered: str) -> Any:
    text = entered.strip()
    try:
        return read_tree(f"x: {text}").data["x"]
    except NotYamlError as error:
        told = _(
            "{problem}; write {list} for a list, {mapping} for a mapping",
            problem=text_of(error),
            list="[1, 2]",
            mapping="{name: 1}",
        )
        raise ChangeError([ParameterProblem((name,), told)]) from None

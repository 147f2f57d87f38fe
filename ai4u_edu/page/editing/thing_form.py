"""Forms for bodies, floors and areas with their most used properties."""

import math
from collections.abc import Mapping
from typing import Any

from ai4u_edu.base.colors import PALETTE
from ai4u_edu.base.parameters import DataPath, ParameterProblem
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.errors import ChangeError
from ai4u_edu.page.editing.forms import NONE_LABEL, UNITS, ParameterField, with_unit
from ai4u_edu.page.editing.things import Thing
from ai4u_edu.world import (
    AreaDescription,
    BodyDescription,
    BoxShape,
    CapsuleShape,
    CircleShape,
    FloorDescription,
    RingShape,
    SegmentShape,
)
from ai4u_edu.world.descriptions import RANGES

RANGE_UNITS = {"x": "m", "y": "m", "heading_deg": "deg", "scale": ""}
"""Units of the ranges of random starts."""
EASY_LABELS: Mapping[str, str] = {
    "x": _("easy start: x"),
    "y": _("easy start: y"),
    "heading_deg": _("easy start: heading"),
    "scale": _("easy start: scale"),
}
"""Labels of the fields with ranges of easy starts."""
KINDS = {
    "static": _("stands still"),
    "dynamic": _("can be pushed"),
    "kinematic": _("moves, can't be pushed"),
}
"""Labels of the kinds of bodies."""
LENGTHS = {
    "length": _("length"),
    "width": _("width"),
    "radius": _("radius"),
    "thickness": _("thickness"),
    "inner": _("inner radius"),
    "outer": _("outer radius"),
}
"""Labels of the lengths of shapes."""
COLOURS = {
    "black": _("black"),
    "orange": _("orange"),
    "sky blue": _("sky blue"),
    "green": _("green"),
    "yellow": _("yellow"),
    "blue": _("blue"),
    "vermillion": _("vermillion"),
    "purple": _("purple"),
    "grey": _("grey"),
    "light grey": _("light grey"),
    "white": _("white"),
}
"""Names of the palette's colours as a page shows them."""
EASY = "easy_"
"""Beginning of the names of fields with ranges of easy starts."""
POSE_FIELDS = ("x", "y", "heading_deg")


def thing_form(thing: Thing) -> list[ParameterField]:
    """Return the fields of a thing's form, with their current values.

    Properties that are not among them are changed in the scene file.
    """
    x, y = thing.position
    place = [
        _number("x", "x", "m", x),
        _number("y", "y", "m", y),
        _number("heading_deg", _("heading"), "deg", thing.heading_deg),
        *(_number(name, LENGTHS[name], "m", value) for name, value in _lengths(thing).items()),
    ]
    if isinstance(thing, AreaDescription) and thing.picture is not None:
        return place  # it has its own colours, and nothing is written on it
    colours: tuple[str, ...] = (NONE_LABEL, *(COLOURS[name] for name in PALETTE))
    if thing.colour is not None and thing.colour not in PALETTE:
        colours = (*colours, thing.colour)
    return [
        *place,
        *_own_fields(thing),
        ParameterField("colour", _("colour"), "choice", thing.colour, "", colours),
        ParameterField("label", _("label"), "text", thing.label, ""),
        *_easy_fields(thing),
    ]


def pose_and_changes(
    thing: Thing, entered: Mapping[str, Any]
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Read what a person entered into a thing's form.

    Args:
        thing: the thing before.
        entered: values by field; texts are parsed.

    Returns:
        The new pose as arguments of ``move_body``, {} if it is unchanged; and all other
        changes, as fields of the thing's description.

    Raises:
        ChangeError: a value is invalid, or no field has such a name.
    """
    known = {field.name: field for field in thing_form(thing)}
    values: dict[str, Any] = {}
    for name, value in entered.items():
        if name not in known:
            text = _("expected one of {names}", names=", ".join(known))
            raise ChangeError([ParameterProblem((name,), text)])
        read = _read(known[name], value)
        if read != _read(known[name], known[name].value):
            values[name] = read
    pose = {name: values.pop(name) for name in POSE_FIELDS if name in values}
    if pose:
        (x, y), heading = thing.position, thing.heading_deg
        pose = {"x": x, "y": y, "heading_deg": heading} | pose
    easy = {name: values.pop(name) for name in (*values,) if name.startswith(EASY)}
    if easy:
        values["curriculum"] = _curriculum(thing, easy)
    lengths = {name: values.pop(name) for name in _lengths(thing) if name in values}
    if lengths:
        values["shape"] = _resized_shape(thing, lengths)
    return pose, values


def field_of_problem(thing: Thing, path: DataPath) -> str:
    """Return the name of the field that a problem is about; empty if it is about none."""
    lengths = tuple(_lengths(thing))
    inner = [part for part in path if part not in {"shape", thing.shape.type}]
    name = str(inner[0]) if inner else ""
    if name == "curriculum" and len(inner) > 1:
        name = f"{EASY}{inner[1]}"
    if name in {"size", "position"} and len(inner) > 1 and isinstance(inner[1], int):
        name = (lengths if name == "size" else POSE_FIELDS)[inner[1]]
    return name


def _number(name: str, label: str, unit: str, value: float) -> ParameterField:
    return ParameterField(
        name, with_unit(label, unit), "number", value, "", unit=UNITS.get(unit, unit)
    )


def _easy_fields(thing: Thing) -> list[ParameterField]:
    """Return the fields with the ranges of easy starts, one for each range of all starts."""
    fields = []
    easy = {} if thing.curriculum is None else thing.curriculum.given
    for name in RANGES:
        full = None if thing.random is None else getattr(thing.random, name)
        if full is not None:
            unit = RANGE_UNITS[name]
            label = EASY_LABELS[name]
            if unit:
                label = with_unit(label, unit)
            hint = _(
                "from, to, such as {ends}, which are all starts; learning by rewards begins with "
                "the easy ones; empty for none",
                ends=_ends(full),
            )
            value = _ends(easy[name]) if name in easy else ""
            fields.append(ParameterField(f"{EASY}{name}", label, "text", value, hint))
    return fields


def _ends(ends: tuple[float, float]) -> str:
    return f"{ends[0]:g}, {ends[1]:g}"


def _curriculum(thing: Thing, entered: Mapping[str, str]) -> dict[str, Any] | None:
    """Return the easy ranges with what was entered; None if there are none.

    Raises:
        ChangeError: it is no range.
    """
    ranges: dict[str, Any] = {} if thing.curriculum is None else {**thing.curriculum.given}
    for field, text in entered.items():
        name = field.removeprefix(EASY)
        if not (text or "").strip():
            ranges.pop(name, None)
            continue
        try:
            low, high = (float(part) for part in text.split(","))
        except ValueError:
            low = high = math.nan
        full = getattr(thing.random, name)
        if not full[0] <= low <= high <= full[1]:
            problem = _(
                "expected two numbers within {ends}, the smaller one first, got {text!r}",
                ends=_ends(full),
                text=text,
            )
            raise ChangeError([ParameterProblem((field,), problem)])
        ranges[name] = (low, high)
    return ranges or None


def _own_fields(thing: Thing) -> list[ParameterField]:
    """Return the fields that only things of this kind have."""
    if isinstance(thing, BodyDescription):
        kinds = tuple(KINDS.values())
        return [
            _number("height", _("height"), "m", thing.height),
            ParameterField("kind", _("kind"), "choice", str(KINDS[thing.kind]), "", kinds),
        ]
    if isinstance(thing, FloorDescription):
        return [_number("top", _("top"), "m", thing.top)]
    hint = _("paint: drawn in its full colour, for line sensors to follow")
    return [ParameterField("paint", _("paint"), "switch", thing.paint, hint)]


def _read(field: ParameterField, entered: Any) -> Any:
    """Return an entered value as plain data."""
    if field.name == "kind":
        return next((kind for kind, words in KINDS.items() if words == entered), entered)
    value = field.read(entered) if isinstance(entered, str | bool) else entered
    if field.name in POSE_FIELDS and (
        isinstance(value, bool) or not isinstance(value, int | float)
    ):
        text = _("expected a number, got {value}", value=repr(entered))
        raise ChangeError([ParameterProblem((field.name,), text)])
    if field.name in POSE_FIELDS and not math.isfinite(value):
        text = _("expected a finite number, got {value}", value=repr(entered))
        raise ChangeError([ParameterProblem((field.name,), text)])
    return value


def _lengths(thing: Thing) -> Mapping[str, float]:
    """Return the lengths that describe a thing's outline; empty for shapes with many corners."""
    match thing.shape:
        case BoxShape(size=(length, width)):
            return {"length": length, "width": width}
        case CircleShape(radius=radius):
            return {"radius": radius}
        case CapsuleShape(length=length, radius=radius):
            return {"length": length, "radius": radius}
        case SegmentShape(thickness=thickness):
            return {"thickness": thickness}
        case RingShape(inner=inner, outer=outer):
            return {"inner": inner, "outer": outer}
    return {}


def _resized_shape(thing: Thing, lengths: Mapping[str, Any]) -> dict[str, Any]:
    plain: dict[str, Any] = thing.shape.model_dump(mode="json")
    if isinstance(thing.shape, BoxShape):
        both: Mapping[str, Any] = {**_lengths(thing), **lengths}
        return plain | {"size": [both["length"], both["width"]]}
    return plain | dict(lengths)

"""The form of a body, a floor or an area: its most used parameters, not all of the file's."""

import math
from collections.abc import Mapping
from typing import Any

from ai4u_edu.base.colors import PALETTE
from ai4u_edu.base.parameters import Problem
from ai4u_edu.editing import ChangeError
from ai4u_edu.editing.forms import NONE_LABEL, Field
from ai4u_edu.editing.things import Thing
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

KINDS = {
    "static": "stands still",
    "dynamic": "can be pushed",
    "kinematic": "moves, can't be pushed",
}
"""Words for the kinds of bodies."""
_POSE = ("x", "y", "heading_deg")


def thing_fields(thing: Thing) -> list[Field]:
    """Return the fields of a thing's form, with their values."""
    (x, y), heading = thing.position, thing.heading_deg
    fields = [
        _number("x", "x (m)", x),
        _number("y", "y (m)", y),
        _number("heading_deg", "heading (deg)", heading),
        *(_number(name, f"{name} (m)", value) for name, value in _lengths(thing).items()),
    ]
    if isinstance(thing, BodyDescription):
        kinds = tuple(KINDS.values())
        fields += [
            _number("height", "height (m)", thing.height),
            _number("mass", "mass (kg)", thing.mass),
            Field("kind", "kind", "choice", KINDS[thing.kind], "", kinds),
        ]
    elif isinstance(thing, FloorDescription):
        fields.append(_number("top", "height of its top (m)", thing.top))
    elif isinstance(thing, AreaDescription):
        fields.append(Field("paint", "paint on the ground", "switch", thing.paint, ""))
    colours = (NONE_LABEL, *PALETTE)
    if thing.colour is not None and thing.colour not in PALETTE:
        colours = (*colours, thing.colour)
    return [
        *fields,
        Field("colour", "colour", "choice", thing.colour, "", colours),
        _number("label", "label", thing.label, kind="text"),
        Field("tags", "tags", "data", list(thing.tags), "Groups that it belongs to: [wall, red]"),
    ]


def thing_first(thing: Thing) -> list[str]:
    """Return the names of the fields that matter most: place, size and colour."""
    return ["x", "y", "heading_deg", *_lengths(thing), "colour"]


def thing_changes(thing: Thing, entered: Mapping[str, Any]) -> dict[str, Any]:
    """Return what a person entered as parameters of a thing's description.

    Args:
        thing: its description before.
        entered: texts and truth values by the names of :func:`thing_fields`.

    Raises:
        ChangeError: an entry can't be read, or no field has its name.
    """
    fields = {field.name: field for field in thing_fields(thing)}
    unknown = [name for name in entered if name not in fields]
    if unknown:
        raise ChangeError([Problem((unknown[0],), "no field has this name")])
    values = {name: _read(fields[name], each) for name, each in entered.items()}
    changes = {name: value for name, value in values.items() if value != fields[name].value}
    place = {name: changes.pop(name) for name in _POSE if name in changes}
    if {"x", "y"} & place.keys():
        x, y = thing.position
        changes["position"] = (place.get("x", x), place.get("y", y))
    if "heading_deg" in place:
        changes["heading_deg"] = place["heading_deg"]
    lengths = {name: changes.pop(name) for name in _lengths(thing) if name in changes}
    if lengths:
        changes["shape"] = _resized(thing, lengths)
    return changes


def thing_problems(thing: Thing, problems: tuple[Problem, ...]) -> list[Problem]:
    """Return problems of a thing's description with the names of its form's fields."""
    return [Problem((_field_of(thing, problem),), problem.text) for problem in problems]


def _field_of(thing: Thing, problem: Problem) -> str:
    path = [part for part in problem.path if part not in {"shape", thing.shape.type}]
    name = str(path[0]) if path else ""
    if name in {"size", "position"} and len(path) > 1:
        return (tuple(_lengths(thing)) if name == "size" else _POSE)[int(path[1])]
    return name


def _number(name: str, label: str, value: Any, *, kind: Any = "number") -> Field:
    return Field(name, label, kind, value, "")


def _read(field: Field, entered: Any) -> Any:
    """Return the value of an entry as plain data."""
    if field.name == "kind":
        return next((kind for kind, words in KINDS.items() if words == entered), entered)
    value = field.read(entered)
    if field.name in _POSE and not (isinstance(value, int | float) and math.isfinite(value)):
        raise ChangeError([Problem((field.name,), f"expected a number, got {entered!r:.60}")])
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
        case RingShape(inner=inner, outer=outer):
            return {"inner": inner, "outer": outer}
        case SegmentShape(thickness=thickness):
            return {"thickness": thickness}
    return {}


def _resized(thing: Thing, lengths: Mapping[str, Any]) -> dict[str, Any]:
    plain: dict[str, Any] = thing.shape.model_dump(mode="json")
    if isinstance(thing.shape, BoxShape):
        both: Mapping[str, Any] = {**_lengths(thing), **lengths}
        return plain | {"size": [both["length"], both["width"]]}
    return plain | dict(lengths)

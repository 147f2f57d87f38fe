"""Changes of bodies as data: each function takes a state and returns another one."""

import math
from collections.abc import Mapping
from typing import Any

from pydantic import ValidationError

from ai4u_edu.base.errors import NameNotFoundError, shown, suggest
from ai4u_edu.base.parameters import MAX_NUMBER, Problem, explain
from ai4u_edu.editing.errors import ChangeError
from ai4u_edu.editing.input_checks import check_name, check_number, check_plain
from ai4u_edu.editing.state import EditState
from ai4u_edu.editing.type_checks import (
    check_typed,
    check_typed_and,
)
from ai4u_edu.world import BodyDescription

MAX_POSITION_M, MAX_HEADING_DEG = 1e4, 3600.0
"""Bounds of a position and a heading, as in a body's description."""
_SCHEMA = BodyDescription.model_json_schema()


def body_named(state: EditState, name: str) -> BodyDescription:
    """Return the description of a body."""
    bodies = {body.name: body for body in state.description.bodies}
    check_name(name, "the name of a body")
    if name not in bodies:
        raise NameNotFoundError(f"no body is named {name!r}; {suggest(name, bodies)}")
    return bodies[name]


def checked_description(given: BodyDescription | Mapping[str, Any]) -> BodyDescription:
    """Validate a body's description.

    Raises:
        ChangeError: some parameters are wrong; each is told with its path.
    """
    if isinstance(given, BodyDescription):
        return given
    check_typed(given, _SCHEMA)
    if not isinstance(given, Mapping):
        raise ChangeError([Problem((), f"expected parameters by name, got {shown(given)}")])
    try:
        return BodyDescription.model_validate(dict(given))
    except ValidationError as error:
        raise ChangeError(explain(error.errors(), BodyDescription)) from None


def with_body(state: EditState, body: BodyDescription) -> EditState:
    """Add a body, as the last one."""
    if any(thing.name == body.name for thing in state.description.things):
        text = f"something is named {body.name!r} already; expected another name, such as "
        raise ChangeError([Problem(("name",), text + repr(free_name(state, body.name)))])
    return state.describing(bodies=(*state.description.bodies, body))


def without_body(state: EditState, name: str) -> EditState:
    """Remove a body."""
    body_named(state, name)
    for agent in state.description.agents:
        if agent.get("body") == name:
            text = f"it is the body of agent {agent.get('id', '0')!r}; an agent needs its body"
            raise ChangeError([Problem((), text)])
    bodies = tuple(body for body in state.description.bodies if body.name != name)
    return state.describing(bodies=bodies)


def with_changed_body(state: EditState, name: str, values: Mapping[str, Any]) -> EditState:
    """Change parameters of a body; None resets one to its default."""
    body = body_named(state, name)
    check_plain(values)
    given = body.model_dump(exclude_unset=True, exclude_defaults=True) | dict(values)
    given["name"] = values.get("name", name)
    if "shape" not in values:
        given["shape"] = body.shape
    named = {key: value for key, value in given.items() if value is not None}
    other = check_typed_and(values, _SCHEMA, lambda: checked_description(named))
    bodies = state.description.bodies
    if other.name != name and any(each.name == other.name for each in state.description.things):
        raise ChangeError([Problem(("name",), f"something is named {other.name!r} already")])
    return state.describing(bodies=tuple(other if each is body else each for each in bodies))


def with_pose(state: EditState, name: str, x: float, y: float, heading_deg: float) -> EditState:
    """Move a body (m, m, degrees)."""
    check_place(x, y, heading_deg)
    values = {"position": (round(x, 4), round(y, 4)), "heading_deg": round(heading_deg, 3)}
    return with_changed_body(state, name, values)


def check_place(x: float, y: float, heading_deg: float | None) -> None:
    """Raise a ChangeError unless a pose is made of finite numbers; the body checks its bounds."""
    for what, value in (
        ("x", x),
        ("y", y),
        ("heading_deg", 0.0 if heading_deg is None else heading_deg),
    ):
        check_number(value, what, MAX_NUMBER)


def check_dragged(x: float, y: float, heading_deg: float | None) -> None:
    """Raise a ChangeError for a pose out of bounds during a drag; the world itself refuses NaN."""
    bounds = (MAX_POSITION_M, MAX_POSITION_M, MAX_HEADING_DEG)
    heading: object = 0.0 if heading_deg is None else heading_deg
    values: tuple[tuple[str, object], ...] = (("x", x), ("y", y), ("heading_deg", heading))
    for (what, value), bound in zip(values, bounds, strict=True):
        if not (isinstance(value, float) and not math.isfinite(value)):
            check_number(value, what, bound)


def free_name(state: EditState, like: str) -> str:
    """Return an unused name: ``box``, ``box 2``, ``box 3``."""
    taken = {thing.name for thing in state.description.things}
    stem = like.rstrip("0123456789 ") or like
    name, number = like, 2
    while name in taken:
        name, number = f"{stem} {number}", number + 1
    return name

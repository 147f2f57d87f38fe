"""Changes of what is in a world, as data: a scene's state in, another one out."""

import math
from collections.abc import Mapping
from typing import Any

from pydantic import ValidationError

from ai4u_edu.base.errors import NameNotFoundError, shown, suggest
from ai4u_edu.base.parameters import MAX_NUMBER, Problem, explain
from ai4u_edu.editing.errors import ChangeError
from ai4u_edu.editing.state import EditState
from ai4u_edu.editing.typed import (
    check_name,
    check_number,
    check_plain,
    check_typed,
    check_typed_and,
)
from ai4u_edu.world import BodyDescription

MAX_POSITION_M, MAX_HEADING_DEG = 1e4, 3600.0
"""Bounds of a place, as a body's description has them."""
_SCHEMA = BodyDescription.model_json_schema()


def body_named(state: EditState, name: str) -> BodyDescription:
    """The description of a body."""
    bodies = {body.name: body for body in state.description.bodies}
    check_name(name, "the name of a body")
    if name not in bodies:
        raise NameNotFoundError(f"no body is named {name!r}; {suggest(name, bodies)}")
    return bodies[name]


def described(given: BodyDescription | Mapping[str, Any]) -> BodyDescription:
    """A body's description, checked.

    Raises:
        ChangeError: some of it is wrong; each is told with its path.
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
    """With one body more, the last of them."""
    if any(thing.name == body.name for thing in state.description.things):
        text = f"something is named {body.name!r} already; expected another name, such as "
        raise ChangeError([Problem(("name",), text + repr(free_name(state, body.name)))])
    return state.describing(bodies=(*state.description.bodies, body))


def without_body(state: EditState, name: str) -> EditState:
    """Without a body."""
    body_named(state, name)
    for agent in state.description.agents:
        if agent.get("body") == name:
            text = f"it is the body of agent {agent.get('id', '0')!r}; an agent needs its body"
            raise ChangeError([Problem((), text)])
    bodies = tuple(body for body in state.description.bodies if body.name != name)
    return state.describing(bodies=bodies)


def with_other_body(state: EditState, name: str, values: Mapping[str, Any]) -> EditState:
    """With other parameters of a body; None leaves one out, so that it is as by default."""
    body = body_named(state, name)
    check_plain(values)
    given = body.model_dump(exclude_unset=True, exclude_defaults=True) | dict(values)
    given["name"] = values.get("name", name)
    if "shape" not in values:
        given["shape"] = body.shape
    named = {key: value for key, value in given.items() if value is not None}
    other = check_typed_and(values, _SCHEMA, lambda: described(named))
    bodies = state.description.bodies
    if other.name != name and any(each.name == other.name for each in state.description.things):
        raise ChangeError([Problem(("name",), f"something is named {other.name!r} already")])
    return state.describing(bodies=tuple(other if each is body else each for each in bodies))


def placed(state: EditState, name: str, x: float, y: float, heading_deg: float) -> EditState:
    """With a body somewhere else."""
    check_place(x, y, heading_deg)
    values = {"position": (round(x, 4), round(y, 4)), "heading_deg": round(heading_deg, 3)}
    return with_other_body(state, name, values)


def check_place(x: float, y: float, heading_deg: float | None) -> None:
    """Raise a ChangeError unless a place is made of finite numbers; a body has its own bounds."""
    for what, value in (
        ("x", x),
        ("y", y),
        ("heading_deg", 0.0 if heading_deg is None else heading_deg),
    ):
        check_number(value, what, MAX_NUMBER)


def check_held(x: float, y: float, heading_deg: float | None) -> None:
    """Raise a ChangeError if a hand holds a body where none can be; NaN the world refuses."""
    bounds = (MAX_POSITION_M, MAX_POSITION_M, MAX_HEADING_DEG)
    heading: object = 0.0 if heading_deg is None else heading_deg
    values: tuple[tuple[str, object], ...] = (("x", x), ("y", y), ("heading_deg", heading))
    for (what, value), bound in zip(values, bounds, strict=True):
        if not (isinstance(value, float) and not math.isfinite(value)):
            check_number(value, what, bound)


def free_name(state: EditState, like: str) -> str:
    """A name that nothing has: ``box``, ``box 2``, ``box 3``."""
    taken = {thing.name for thing in state.description.things}
    stem = like.rstrip("0123456789 ") or like
    name, number = like, 2
    while name in taken:
        name, number = f"{stem} {number}", number + 1
    return name

"""Changes of bodies, floors and areas as data: a function takes a state and returns another one."""

import math
from collections.abc import Iterable, Mapping
from typing import Any, Literal

from pydantic import ValidationError

from ai4u_edu.base.errors import NameNotFoundError, shown, suggest, text_of
from ai4u_edu.base.parameters import MAX_NUMBER, ParameterProblem, explain
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.errors import ChangeError
from ai4u_edu.page.editing.input_checks import (
    check_name,
    check_number,
    check_plain,
    check_typed,
    check_typed_and,
    schema_of,
)
from ai4u_edu.page.editing.state import EditState
from ai4u_edu.world import AreaDescription, BodyDescription, FloorDescription
from ai4u_edu.world.pictures import check_pictures

MAX_POSITION_M, MAX_HEADING_DEG = 1e4, 3600.0
"""Bounds of a position and a heading, as in a body's description."""
Thing = BodyDescription | FloorDescription | AreaDescription
ThingKind = Literal["bodies", "floors", "areas"]
"""Entry of a scene's description that holds things of one kind."""
KINDS: Mapping[ThingKind, type[Thing]] = {
    "bodies": BodyDescription,
    "floors": FloorDescription,
    "areas": AreaDescription,
}


def thing_named(state: EditState, name: str) -> Thing:
    """Return the description of a body, a floor or an area."""
    things = {thing.name: thing for thing in state.description.things}
    check_name(name, _("the name of a thing"))
    if name not in things:
        raise NameNotFoundError(
            _("nothing is named {name!r}; {hint}", name=name, hint=suggest(name, things))
        )
    return things[name]


def body_named(state: EditState, name: str) -> BodyDescription:
    """Return the description of a body."""
    bodies = {body.name: body for body in state.description.bodies}
    check_name(name, _("the name of a body"))
    if name not in bodies:
        raise NameNotFoundError(
            _("no body is named {name!r}; {hint}", name=name, hint=suggest(name, bodies))
        )
    return bodies[name]


def kind_of(thing: Thing) -> ThingKind:
    """Return the entry of a scene's description that holds a thing."""
    return next(kind for kind, cls in KINDS.items() if type(thing) is cls)


def checked_description(given: Thing | Mapping[str, Any], kind: ThingKind = "bodies") -> Thing:
    """Validate a thing's description.

    Raises:
        ChangeError: some parameters are wrong; each is listed with its path.
    """
    cls = KINDS[kind]
    if isinstance(given, cls):
        return given
    check_typed(given, schema_of(KINDS[kind]))
    if not isinstance(given, Mapping):
        text = _("expected parameters by name, got {values}", values=shown(given))
        raise ChangeError([ParameterProblem((), text)])
    try:
        return cls.model_validate(dict(given))
    except ValidationError as error:
        raise ChangeError(explain(error.errors(), cls)) from None


def with_thing(state: EditState, thing: Thing) -> EditState:
    """Add a thing, as the last one of its kind."""
    if any(other.name == thing.name for other in state.description.things):
        text = _(
            "something is named {name!r} already; expected another name, such as {other!r}",
            name=thing.name,
            other=free_name(state, thing.name),
        )
        raise ChangeError([ParameterProblem(("name",), text)])
    kind = kind_of(thing)
    return _with_things(state, kind, (*getattr(state.description, kind), thing))


def without_thing(state: EditState, name: str) -> EditState:
    """Remove a thing."""
    kind = kind_of(thing_named(state, name))
    for agent in state.description.agents:
        if agent.get("body") == name:
            text = _(
                "it is the body of agent {agent!r}; an agent needs its body",
                agent=str(agent.get("id", "0")),
            )
            raise ChangeError([ParameterProblem((), text)])
    others = tuple(each for each in getattr(state.description, kind) if each.name != name)
    return state.describing(**{kind: others})


def with_changed_thing(state: EditState, name: str, values: Mapping[str, Any]) -> EditState:
    """Change parameters of a thing; None resets one to its default."""
    thing = thing_named(state, name)
    kind = kind_of(thing)
    check_plain(values)
    given = thing.model_dump(exclude_unset=True, exclude_defaults=True) | dict(values)
    given["name"] = values.get("name", name)
    if "shape" not in values:
        given["shape"] = thing.shape
    named = {key: value for key, value in given.items() if value is not None}
    other = check_typed_and(
        values, schema_of(KINDS[kind]), lambda: checked_description(named, kind)
    )
    if other.name != name and any(each.name == other.name for each in state.description.things):
        text = _("something is named {name!r} already", name=other.name)
        raise ChangeError([ParameterProblem(("name",), text)])
    things = getattr(state.description, kind)
    return _with_things(state, kind, tuple(other if each is thing else each for each in things))


def _with_things(state: EditState, kind: ThingKind, things: tuple[Thing, ...]) -> EditState:
    changed = state.describing(**{kind: things})
    try:
        check_pictures(changed.description.pictures)
    except ValueError as error:
        raise ChangeError([ParameterProblem((), text_of(error))]) from None
    return changed


def with_pose(state: EditState, name: str, x: float, y: float, heading_deg: float) -> EditState:
    """Move a thing (m, m, degrees)."""
    check_place(x, y, heading_deg)
    values = {"position": (round(x, 4), round(y, 4)), "heading_deg": round(heading_deg, 3)}
    return with_changed_thing(state, name, values)


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
    return free_names(state, [like])[0]


def free_names(state: EditState, likes: Iterable[str]) -> list[str]:
    """Return an unused name for each of several new things."""
    taken, names = {thing.name for thing in state.description.things}, []
    for like in likes:
        stem = like.rstrip("0123456789 ") or like
        name, number = like, 2
        while name in taken:
            name, number = f"{stem} {number}", number + 1
        taken.add(name)
        names.append(name)
    return names

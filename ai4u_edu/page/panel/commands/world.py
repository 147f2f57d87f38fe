"""Commands that change the things in the world, and the scene's settings."""

import math
import re
from collections.abc import Callable, Mapping, Sequence
from typing import Annotated, Any, Literal

from msgspec import Meta

from ai4u_edu.base.errors import NameNotFoundError, SetupError, suggest, text_of
from ai4u_edu.base.parameters import ParameterProblem
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join, ngettext
from ai4u_edu.page.editing import ChangeError, SceneEditor
from ai4u_edu.page.editing.forms import read_values
from ai4u_edu.page.editing.proposals import Goal, NewThing
from ai4u_edu.page.editing.settings import field_form, scene_form
from ai4u_edu.page.editing.thing_form import field_of_problem, pose_and_changes
from ai4u_edu.page.editing.things import (
    Thing,
    ThingKind,
    checked_description,
    kind_of,
    thing_named,
)
from ai4u_edu.page.messages import (
    Degrees,
    Metres,
    Name,
    Names,
    Number,
    Others,
    PageCommand,
    Values,
)
from ai4u_edu.page.panel.answers import Answer, change_answer
from ai4u_edu.page.panel.commands.handler import Handler
from ai4u_edu.page.panel.new_things import (
    TEMPLATES,
    Template,
    aligned_places,
    free_offset,
    free_position,
    picture_of,
    thing_at,
    things_within,
)
from ai4u_edu.page.panel.page import Page
from ai4u_edu.snapshot import StaticScene
from ai4u_edu.world import BodyDescription, Pose
from ai4u_edu.world.pictures import picture_data, picture_size

COPY_OFFSET_M = 0.5
"""Distance (m) of a copy from the original, to the right and down."""
PICTURE_SHARE = 0.6
"""Share of the world's sides that a new picture takes at most."""
MIN_PICTURE_M, MAX_PICTURE_M = 0.1, 30.0
"""Least and greatest length of the sides of a new picture."""
MAX_CORNERS = 8
"""Most corners of a frame around things."""
Corner = tuple[Metres, Metres]


class MoveMode(PageCommand, tag="move_mode"):
    """Let the user move things with the mouse, or not."""

    on: bool
    knob: Annotated[float, Meta(ge=0.005, le=0.2)] = 0.025
    """Radius of the knobs that turn and resize a thing, as a share of the picture's height."""


async def _move_mode(page: Page, command: MoveMode) -> Answer:
    page.context.required_editor()
    page.view.set_move_mode(command.on, command.knob)
    return Answer()


class Snap(PageCommand, tag="snap"):
    """Set the grid (m) to which moved things snap; 0 for none."""

    distance: Annotated[float, Meta(ge=0, le=100)]


async def _snap(page: Page, command: Snap) -> Answer:
    page.view.set_snap(command.distance)
    return Answer()


class SelectBody(PageCommand, tag="select"):
    """Select a thing, and others with it."""

    body: Name | None
    others: Others = ()


async def _select(page: Page, command: SelectBody) -> Answer:
    page.view.select(command.body, command.others)
    return Answer()


class FindThings(PageCommand, tag="find_things"):
    """Name the bodies and areas whose middle is within a frame; of one point (m), what is there."""

    corners: Annotated[tuple[Corner, ...], Meta(min_length=1, max_length=MAX_CORNERS)]


async def _find(page: Page, command: FindThings) -> Answer:
    snapshot = page.context.runner.latest
    if len(command.corners) == 1:
        name = thing_at(snapshot, *command.corners[0])
        return Answer(more={"names": [name] if name else []})
    return Answer(more={"names": things_within(snapshot, command.corners)})


class ListThings(PageCommand, tag="palette"):
    """List the things that can be added, each with its picture from above."""


async def _palette(page: Page, _command: ListThings) -> Answer:
    editor = page.context.required_editor()
    items = []
    for name, template in TEMPLATES.items():
        described = dict(_described(page, editor, template))
        kind: ThingKind = "bodies" if template.kind == "agents" else template.kind
        thing = checked_description(described, kind)
        picture = picture_of(thing, is_agent=template.kind == "agents")
        items.append({"name": name, "title": template.title, **picture._asdict()})
    return Answer(more={"items": items})


class Ground(PageCommand, tag="ground"):
    """Return the map from the page's picture to the ground, 3 x 3, row by row.

    It takes (across, down, 1), shares of the picture's width and height, to (w x, w y, w): metres.
    """


async def _ground(page: Page, _command: Ground) -> Answer:
    static_scene = page.context.runner.latest.static_scene
    matrix = page.view.ground_matrix(static_scene.lowest_floor)
    if matrix is None:
        raise SetupError(
            _("the picture of the world is not there yet; wait a moment, and try again")
        )
    return Answer(more={"matrix": matrix})


class AddBody(PageCommand, tag="add_body"):
    """Add a thing at a place (m), or beside it if it is taken; by default where there is room."""

    template: Name
    x: Metres | None = None
    y: Metres | None = None


async def _add(page: Page, command: AddBody) -> Answer:
    editor = page.context.required_editor()
    template = TEMPLATES.get(command.template)
    if template is None:
        hint = suggest(command.template, TEMPLATES)
        raise NameNotFoundError(
            _("nothing is called {name!r}; {hint}", name=command.template, hint=hint)
        )
    described = _described(page, editor, template)
    new = _new_thing(page, template, described)
    if command.x is None or command.y is None:
        at = _place_for(page, described, template)
        return await _add_all(page, [new], at, _added, has_room=True)
    return await _add_all(page, [new], (command.x, command.y), _added)


async def _add_all(
    page: Page,
    new_things: Sequence[NewThing],
    offset: tuple[float, float],
    done: Callable[[Sequence[str]], str],
    *,
    has_room: bool = False,
) -> Answer:
    """Add things together, and select them.

    Args:
        page: gets the answer.
        new_things: with any names.
        offset: by which they are moved (m); if bodies have no room, to the nearest place with some.
        done: returns the answer, of the names that the things got.
        has_room: True if that was looked for.
    """
    editor = page.context.required_editor()
    free = offset if has_room else _free_offset(page, new_things, offset)
    names = editor.free_names([str(new.description["name"]) for new in new_things])
    placed = []
    for new, name in zip(new_things, names, strict=True):
        x, y = new.description.get("position", (0.0, 0.0))
        position = round(x + free[0], 4), round(y + free[1], 4)
        described = {**new.description, "name": name, "position": position}
        placed.append(new._replace(description=described))
    result = await page.result(editor.add_things(placed))
    page.view.select(names[0], tuple(names[1:]))
    text = done(names)
    if free != offset:
        text = join([text, _("There was no room right there, so it is beside.")])
    return change_answer(text, result, bodies=names)


def _free_offset(
    page: Page, new_things: Sequence[NewThing], offset: tuple[float, float]
) -> tuple[float, float]:
    """Return the offset nearest to another one at which new bodies have room.

    Raises:
        SetupError: there is none near.
    """
    snapshot = page.context.runner.latest
    bodies = [
        BodyDescription.model_validate(new.description)
        for new in new_things
        if new.kind == "bodies"
    ]
    free = free_offset(snapshot, bodies, *offset)
    if free is not None:
        return free
    (x, y) = bodies[0].position
    if snapshot.static_scene.floor_under(x + offset[0], y + offset[1]) is None:
        raise SetupError(_("there is no floor: put it on a floor, or add a floor first"))
    raise SetupError(_("there is no room: put it where nothing else stands"))


class LayPicture(PageCommand, tag="lay_picture"):
    """Lay the PNG or JPEG file that was sent in binary messages before on the ground."""

    name: Name
    size: Number


async def _lay(page: Page, command: LayPicture) -> Answer:
    page.context.required_editor()
    file = page.upload.take(command.size)
    try:
        data = await page.in_thread(lambda: picture_data(file))
    except ValueError as error:
        text = _("{file}: {problem}", file=command.name, problem=text_of(error))
        raise SetupError(text) from None
    rows, columns = picture_size(data)
    static_scene = page.context.runner.latest.static_scene
    (left, low), (right, high) = static_scene.bounds
    scale = PICTURE_SHARE * min((right - left) / columns, (high - low) / rows)
    scale = min(scale, MAX_PICTURE_M / max(rows, columns))
    described = {
        "name": _name_from(command.name),
        "shape": {"type": "box", "size": [_length(columns * scale), _length(rows * scale)]},
        "position": (0.0, 0.0),
        "picture": data,
    }
    center = page.view.ground_center or _middle(static_scene)
    at = round(center[0], 1), round(center[1], 1)
    return await _add_all(page, [NewThing(described, "areas")], at, _laid, has_room=True)


def _length(metres: float) -> float:
    return max(round(metres, 2), MIN_PICTURE_M)


def _name_from(file_name: str) -> str:
    """Return a name for a thing from a file's name.

    >>> _name_from("C:/mats/My mat (2).png"), _name_from("???.png")
    ('My mat 2', 'picture')
    """
    stem = file_name.replace("\\", "/").rpartition("/")[2].rpartition(".")[0]
    return re.sub(r"[^\w .:-]", "", stem)[:40].strip(" .") or "picture"


class Duplicate(PageCommand, tag="duplicate"):
    """Add copies of things beside them."""

    names: Names


async def _duplicate(page: Page, command: Duplicate) -> Answer:
    copies = _copies(page, command.names)
    return await _add_all(page, copies, (COPY_OFFSET_M, -COPY_OFFSET_M), _copied)


class Copy(PageCommand, tag="copy"):
    """Keep copies of things, which can be pasted, into another scene too."""

    names: Names


async def _copy(page: Page, command: Copy) -> Answer:
    page.clipboard[:] = _copies(page, command.names)
    names = tuple(dict.fromkeys(command.names))
    if len(names) == 1:
        return Answer(_("Copied {name}. Ctrl+V pastes it.", name=names[0]))
    text = ngettext(
        "Copied {n} thing. Ctrl+V pastes it.", "Copied {n} things. Ctrl+V pastes them.", len(names)
    )
    return Answer(text)


class Paste(PageCommand, tag="paste"):
    """Add what was copied, with its middle at a place (m); by default beside where it was."""

    x: Metres | None = None
    y: Metres | None = None


async def _paste(page: Page, command: Paste) -> Answer:
    agents = page.context.required_editor().state.description.agents
    ids = {str(agent.get("id", "0")) for agent in agents}
    copies = [
        new._replace(like=page.view.agent) if new.like and new.like not in ids else new
        for new in page.clipboard
    ]
    if not copies:
        raise SetupError(_("nothing was copied yet: select a thing, and press Ctrl+C"))
    offset = COPY_OFFSET_M, -COPY_OFFSET_M
    if command.x is not None and command.y is not None:
        places = [new.description.get("position", (0.0, 0.0)) for new in copies]
        xs, ys = zip(*places, strict=True)
        offset = command.x - (min(xs) + max(xs)) / 2, command.y - (min(ys) + max(ys)) / 2
    return await _add_all(page, copies, offset, _pasted)


class ChangeBody(PageCommand, tag="change_body"):
    """Change properties of a thing."""

    name: Name
    values: Values


async def _change(page: Page, command: ChangeBody) -> Answer:
    editor = page.context.required_editor()
    thing = thing_named(editor.state, command.name)
    pose, values = pose_and_changes(thing, command.values)
    if pose and values:
        values |= {"position": (pose["x"], pose["y"]), "heading_deg": pose["heading_deg"]}
    future = (
        editor.move_body(thing.name, **pose)
        if pose and not values
        else editor.change_body(thing.name, values)
    )
    try:
        result = await page.result(future)
    except ChangeError as error:
        raise ChangeError(_named(thing, error)) from None
    text = _("Moved {name}.", name=thing.name)
    if values:
        text = _("Changed {name}.", name=thing.name)
    return change_answer(text, result)


class MoveBody(PageCommand, tag="move_body"):
    """Put a thing somewhere (m, degrees)."""

    name: Name
    x: Metres
    y: Metres
    heading_deg: Degrees | None = None


async def _move(page: Page, command: MoveBody) -> Answer:
    future = page.context.required_editor().move_body(
        command.name, command.x, command.y, command.heading_deg
    )
    return change_answer(_("Moved {name}.", name=command.name), await page.result(future))


class Nudge(PageCommand, tag="nudge"):
    """Move things a bit (m, degrees)."""

    names: Names
    dx: Metres = 0.0
    dy: Metres = 0.0
    turn_deg: Degrees = 0.0


async def _nudge(page: Page, command: Nudge) -> Answer:
    """Move things from where they are; several nudges follow one another."""
    editor = page.context.required_editor()
    async with page.moves:
        poses = await _present_poses(page, command.names)
        goals = {
            name: (
                x + command.dx,
                y + command.dy,
                math.degrees(heading) + command.turn_deg if command.turn_deg else None,
            )
            for name, (x, y, heading) in poses.items()
        }
        result = await page.result(editor.move_things(goals, is_nudge=True))
    return change_answer(_moved(goals), result)


def _moved(goals: Mapping[str, Goal]) -> str:
    if len(goals) > 1:
        return ngettext("Moved {n} thing.", "Moved {n} things.", len(goals))
    ((name, (x, y, heading_deg)),) = goals.items()
    place = {"name": name, "x": f"{x:.2f}", "y": f"{y:.2f}"}
    if heading_deg is None:
        return _("Moved {name} to x {x} m, y {y} m.", **place)
    degrees = f"{heading_deg:.0f}"
    return _("Moved {name} to x {x} m, y {y} m, turned to {degrees}°.", degrees=degrees, **place)


class Align(PageCommand, tag="align"):
    """Put things into a row or a column through their middle, or at equal distances."""

    names: Names
    how: Literal["row", "column", "spread"]


async def _align(page: Page, command: Align) -> Answer:
    editor = page.context.required_editor()
    async with page.moves:
        poses = await _present_poses(page, command.names)
        places = {name: (x, y) for name, (x, y, _heading) in poses.items()}
        aligned = aligned_places(places, command.how)
        goals = {name: (x, y, None) for name, (x, y) in aligned.items()}
        result = await page.result(editor.move_things(goals))
    if len(places) == 1:
        return change_answer(_("Aligned {name}.", name=command.names[0]), result)
    text = ngettext("Aligned {n} thing.", "Aligned {n} things.", len(places))
    return change_answer(text, result)


class RemoveBodies(PageCommand, tag="remove_bodies"):
    """Delete things; the body of an agent goes with its agent."""

    names: Names


async def _remove(page: Page, command: RemoveBodies) -> Answer:
    names = tuple(dict.fromkeys(command.names))
    result = await page.result(page.context.required_editor().remove_things(names))
    if len(names) == 1:
        return change_answer(_("Deleted {name}.", name=names[0]), result)
    text = ngettext("Deleted {n} thing.", "Deleted {n} things.", len(names))
    return change_answer(text, result)


class ChangeSettings(PageCommand, tag="change_settings"):
    """Change texts or settings of the scene."""

    values: Values


async def _settings(page: Page, command: ChangeSettings) -> Answer:
    editor = page.context.required_editor()
    values = read_values(scene_form(editor.state.description), command.values)
    result = await page.result(editor.change_settings(values))
    return change_answer(_("Settings of the scene changed."), result)


class ChangeField(PageCommand, tag="change_field"):
    """Change the field that is generated at each start; a new episode begins with it."""

    values: Values


async def _field(page: Page, command: ChangeField) -> Answer:
    editor = page.context.required_editor()
    values = read_values(field_form(editor.state.description), command.values)
    result = await page.result(editor.change_field(values))
    return change_answer(_("Here is the new field."), result)


def _described(page: Page, editor: SceneEditor, template: Template) -> Mapping[str, Any]:
    if template.kind != "agents":
        return template.description
    body = str(editor.state.agent(page.view.agent)["body"])
    return _copy_of(thing_named(editor.state, body))


def _copy_of(thing: Thing) -> dict[str, Any]:
    return {
        **thing.model_dump(mode="json", exclude_defaults=True),
        "shape": thing.shape.model_dump(mode="json"),
    }


def _new_thing(page: Page, template: Template, described: Mapping[str, Any]) -> NewThing:
    """Return a thing of a template, in the middle of the world."""
    described = {**described, "position": (0.0, 0.0)}
    if template.kind == "agents":
        return NewThing(described, "bodies", page.view.agent)
    return NewThing(described, template.kind)


def _copies(page: Page, names: Sequence[str]) -> list[NewThing]:
    """Return copies of things."""
    state = page.context.required_editor().state
    things = [thing_named(state, name) for name in dict.fromkeys(names)]
    return [
        NewThing(_copy_of(thing), kind_of(thing), state.agent_with(thing.name) or "")
        for thing in things
    ]


def _added(names: Sequence[str]) -> str:
    if len(names) == 1:
        return _("Added {name}.", name=names[0])
    return ngettext("Added {n} thing.", "Added {n} things.", len(names))


def _laid(names: Sequence[str]) -> str:
    return _("Laid {name}.", name=names[0])


def _copied(names: Sequence[str]) -> str:
    if len(names) == 1:
        return _("Copied as {name}.", name=names[0])
    return ngettext("Copied as {n} thing.", "Copied as {n} things.", len(names))


def _pasted(names: Sequence[str]) -> str:
    if len(names) == 1:
        return _("Pasted {name}.", name=names[0])
    return ngettext("Pasted {n} thing.", "Pasted {n} things.", len(names))


def _place_for(page: Page, described: Mapping[str, Any], template: Template) -> tuple[float, float]:
    """Return a place in the middle of the picture, for a body one where it touches nothing."""
    snapshot = page.context.runner.latest
    center = page.view.ground_center or _middle(snapshot.static_scene)
    if template.kind in {"floors", "areas"}:
        return round(center[0], 1), round(center[1], 1)
    found = free_position(snapshot, dict(described), *center)
    if found is None:
        raise SetupError(_("there is no room for it around the middle of the picture"))
    return found


def _middle(static_scene: StaticScene) -> tuple[float, float]:
    (left, low), (right, high) = static_scene.bounds
    return (left + right) / 2, (low + high) / 2


async def _present_poses(page: Page, names: Sequence[str]) -> dict[str, Pose]:
    """Return where things are now, by name."""
    editor = page.context.required_editor()
    return await page.result(
        page.context.runner.submit(
            lambda: {name: _present_pose(page, editor, name) for name in names}
        )
    )


def _present_pose(page: Page, editor: SceneEditor, name: str) -> Pose:
    """Return a thing's pose now; in the runner's thread."""
    thing = thing_named(editor.state, name)
    if isinstance(thing, BodyDescription):
        x, y, _z, heading = page.context.runner.sim.world[name].pose
        return x, y, heading
    return (*thing.position, math.radians(thing.heading_deg))


def _named(thing: Thing, error: ChangeError) -> list[ParameterProblem]:
    """Return problems with the names of the form's fields as paths."""
    return [
        ParameterProblem((name,), text)
        if (name := field_of_problem(thing, path))
        else ParameterProblem(path, text)
        for path, text in error.problems
    ]


HANDLERS: Mapping[type[PageCommand], Handler] = {
    ListThings: _palette,
    Ground: _ground,
    MoveMode: _move_mode,
    Snap: _snap,
    SelectBody: _select,
    FindThings: _find,
    AddBody: _add,
    LayPicture: _lay,
    Duplicate: _duplicate,
    Copy: _copy,
    Paste: _paste,
    Align: _align,
    ChangeBody: _change,
    MoveBody: _move,
    Nudge: _nudge,
    RemoveBodies: _remove,
    ChangeSettings: _settings,
    ChangeField: _field,
}
"""Handlers by the type of their command."""

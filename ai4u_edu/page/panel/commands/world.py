"""Commands that change the things in the world, and the scene's settings."""

import math
from collections.abc import Mapping
from concurrent.futures import Future
from typing import Annotated, Any

from msgspec import Meta

from ai4u_edu.base.errors import NameNotFoundError, SetupError, suggest
from ai4u_edu.base.parameters import ParameterProblem
from ai4u_edu.page.editing import ChangeError, ChangeResult, SceneEditor
from ai4u_edu.page.editing.forms import read_values
from ai4u_edu.page.editing.settings import scene_form
from ai4u_edu.page.editing.thing_form import field_of_problem, pose_and_changes
from ai4u_edu.page.editing.things import Thing, checked_description, kind_of, thing_named
from ai4u_edu.page.messages import Degrees, Metres, Name, PageCommand, Values
from ai4u_edu.page.panel.answers import Answer, change_answer
from ai4u_edu.page.panel.commands.handler import Handler
from ai4u_edu.page.panel.new_things import (
    TEMPLATES,
    Template,
    free_position,
    free_position_beside,
    picture_of,
)
from ai4u_edu.page.panel.page import Page
from ai4u_edu.snapshot import StaticScene
from ai4u_edu.world import BodyDescription, Pose

COPY_OFFSET_M = 0.5
"""Distance (m) of a copied floor or area from the original, to the right and down."""


class MoveMode(PageCommand, tag="move_mode"):
    """Let the user move things with the mouse, or not."""

    on: bool


async def _move_mode(page: Page, command: MoveMode) -> Answer:
    page.context.required_editor()
    page.view.set_move_mode(command.on)
    return Answer()


class Snap(PageCommand, tag="snap"):
    """Set the grid (m) to which moved things snap; 0 for none."""

    distance: Annotated[float, Meta(ge=0, le=100)]


async def _snap(page: Page, command: Snap) -> Answer:
    page.view.set_snap(command.distance)
    return Answer()


class SelectBody(PageCommand, tag="select"):
    """Select a thing."""

    body: Name | None


async def _select(page: Page, command: SelectBody) -> Answer:
    page.view.select(command.body)
    return Answer()


class ListThings(PageCommand, tag="palette"):
    """List the things that can be added, each with its picture from above."""


async def _palette(page: Page, _command: ListThings) -> Answer:
    editor = page.context.required_editor()
    items = []
    for name, template in TEMPLATES.items():
        described = dict(_described(page, editor, template))
        is_agent = template.kind == "agents"
        thing = checked_description(described, "bodies" if is_agent else template.kind)
        picture = picture_of(thing, is_agent=is_agent)
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
        raise SetupError("the picture of the world is not there yet; wait a moment, and try again")
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
        raise NameNotFoundError(f"nothing is called {command.template!r}; {hint}")
    at = None if command.x is None or command.y is None else (command.x, command.y)
    return await _add_thing(page, template, _described(page, editor, template), at, "Added")


async def _add_thing(
    page: Page,
    template: Template,
    described: Mapping[str, Any],
    at: tuple[float, float] | None,
    done: str,
) -> Answer:
    """Add a thing at a place, or where there is room in the picture; then select it."""
    editor = page.context.required_editor()
    name = editor.free_name(str(described["name"]))
    chosen, at = at, _place_for(page, described, template, at)
    thing = dict(described) | {"name": name, "position": at}
    future: Future[ChangeResult]
    if template.kind == "agents":
        future = editor.add_agent(thing, page.view.agent)
    elif template.kind == "bodies":
        future = editor.add_body(thing)
    else:
        future = editor.add_region(thing, template.kind)
    result = await page.result(future)
    page.view.select(name)
    aside = "" if chosen in (None, at) else " There was no room right there, so it is beside."
    return change_answer(f"{done} {name}.{aside}", result, body=name)


class DuplicateBody(PageCommand, tag="duplicate_body"):
    """Add a copy of a thing."""

    name: Name


async def _duplicate(page: Page, command: DuplicateBody) -> Answer:
    editor = page.context.required_editor()
    thing = thing_named(editor.state, command.name)
    described = _copy_of(thing)
    is_agent = _agent_of(editor, thing.name) is not None
    kind = "agents" if is_agent else kind_of(thing)
    at = None
    if not isinstance(thing, BodyDescription):
        x, y = thing.position
        at = x + COPY_OFFSET_M, y - COPY_OFFSET_M
    return await _add_thing(page, Template("", kind, {}), described, at, "Copied it as")


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
    return change_answer(f"{'Changed' if values else 'Moved'} {thing.name}.", result)


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
    return change_answer(f"Moved {command.name}.", await page.result(future))


class Nudge(PageCommand, tag="nudge"):
    """Move a thing a bit (m, degrees)."""

    name: Name
    dx: Metres = 0.0
    dy: Metres = 0.0
    turn_deg: Degrees = 0.0


async def _nudge(page: Page, command: Nudge) -> Answer:
    """Move a thing from where it is; several nudges follow one another."""
    editor = page.context.required_editor()
    async with page.moves:
        x, y, heading = await page.result(
            page.context.runner.submit(lambda: _present_pose(page, editor, command.name))
        )
        heading_deg = math.degrees(heading) + command.turn_deg if command.turn_deg else None
        result = await page.result(
            editor.move_body(
                command.name, x + command.dx, y + command.dy, heading_deg, is_nudge=True
            )
        )
    return change_answer(f"Moved {command.name}.", result)


class RemoveBody(PageCommand, tag="remove_body"):
    """Delete a thing; the body of an agent goes with its agent."""

    name: Name


async def _remove(page: Page, command: RemoveBody) -> Answer:
    editor = page.context.required_editor()
    agent = _agent_of(editor, command.name)
    future = editor.remove_body(command.name) if agent is None else editor.remove_agent(agent)
    return change_answer(f"Deleted {command.name}.", await page.result(future))


class ChangeSettings(PageCommand, tag="change_settings"):
    """Change texts or settings of the scene."""

    values: Values


async def _settings(page: Page, command: ChangeSettings) -> Answer:
    editor = page.context.required_editor()
    values = read_values(scene_form(editor.state.description), command.values)
    result = await page.result(editor.change_settings(values))
    return change_answer("Settings of the scene changed.", result)


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


def _place_for(
    page: Page,
    described: Mapping[str, Any],
    template: Template,
    at: tuple[float, float] | None,
) -> tuple[float, float]:
    """Return a place for a thing; a body needs a floor, and room.

    Args:
        page: has the picture.
        described: the thing.
        template: its kind.
        at: the place that a person chose; by default the middle of the picture.

    Raises:
        SetupError: there is no such place.
    """
    snapshot = page.context.runner.latest
    if at is not None:
        if template.kind in {"floors", "areas"}:
            return at
        beside = free_position_beside(snapshot, dict(described), *at)
        if beside is None:
            if snapshot.static_scene.floor_under(*at) is None:
                raise SetupError("there is no floor: put it on a floor, or add a floor first")
            raise SetupError("there is no room: put it where nothing else stands")
        return beside
    center = page.view.ground_center or _middle(snapshot.static_scene)
    if template.kind in {"floors", "areas"}:
        return round(center[0], 1), round(center[1], 1)
    found = free_position(snapshot, dict(described), *center)
    if found is None:
        raise SetupError("there is no room for it around the middle of the picture")
    return found


def _middle(static_scene: StaticScene) -> tuple[float, float]:
    (left, low), (right, high) = static_scene.bounds
    return (left + right) / 2, (low + high) / 2


def _present_pose(page: Page, editor: SceneEditor, name: str) -> Pose:
    """Return a thing's pose now; in the runner's thread."""
    thing = thing_named(editor.state, name)
    if isinstance(thing, BodyDescription):
        x, y, _, heading = page.context.runner.sim.world[name].pose
        return x, y, heading
    return (*thing.position, math.radians(thing.heading_deg))


def _agent_of(editor: SceneEditor, body: str) -> str | None:
    """Return the id of the agent that a body belongs to; None if it belongs to none."""
    for agent in editor.state.description.agents:
        if agent.get("body") == body:
            return str(agent.get("id", "0"))
    return None


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
    AddBody: _add,
    DuplicateBody: _duplicate,
    ChangeBody: _change,
    MoveBody: _move,
    Nudge: _nudge,
    RemoveBody: _remove,
    ChangeSettings: _settings,
}
"""Handlers by the type of their command."""

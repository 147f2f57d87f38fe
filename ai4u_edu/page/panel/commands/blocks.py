"""Commands that change an agent's blocks, settings and driver, and undo."""

import asyncio
from collections.abc import Mapping
from typing import Annotated

import msgspec
from msgspec import Meta

from ai4u_edu.base.errors import NameNotFoundError, suggest
from ai4u_edu.base.parameters import ParameterProblem
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing import ChangeError, SceneEditor
from ai4u_edu.page.editing.blocks import block_at, types_of
from ai4u_edu.page.editing.drivers import Driver
from ai4u_edu.page.editing.forms import block_form, read_values
from ai4u_edu.page.editing.goals import with_goal_values
from ai4u_edu.page.editing.plain import BlockPath, Plain
from ai4u_edu.page.editing.scene_names import SceneNames
from ai4u_edu.page.editing.settings import agent_form, problems_in_agent_form
from ai4u_edu.page.editing.suggestion import copy_of_block, suggest_block
from ai4u_edu.page.messages import Kind, Name, PageCommand, Path, Values
from ai4u_edu.page.panel.answers import Answer, change_answer
from ai4u_edu.page.panel.commands.handler import Handler
from ai4u_edu.page.panel.gallery import driver_title, gallery_items, words_of
from ai4u_edu.page.panel.labels import change_label, driven_by
from ai4u_edu.page.panel.page import Page


class ListDrivers(PageCommand, tag="drivers"):
    """List the drivers that the agent can have."""


async def _drivers(page: Page, _command: ListDrivers) -> Answer:
    editor, agent_id = page.context.required_editor(), page.view.agent
    present = editor.driver_of(agent_id)

    def listed() -> list[dict[str, object]]:
        return [
            {
                "name": each.name,
                "title": driver_title(each),
                "reason": editor.reason_against_driver(agent_id, each.name),
                "is_chosen": each.name == present,
            }
            for each in editor.drivers(agent_id)
        ]

    # each driver is tried in a copy of the world
    return Answer(more={"items": await page.in_thread(listed)})


class SetDriver(PageCommand, tag="driver"):
    """Choose the agent's driver."""

    name: Name
    agent: Name | None = None


async def _driver(page: Page, command: SetDriver) -> Answer:
    editor = page.context.required_editor()
    agent_id = page.view.agent if command.agent is None else command.agent
    agent = page.context.runner.sim.agent(agent_id)
    offered = await asyncio.to_thread(editor.drivers, agent_id)
    driver = next((each for each in offered if each.name == command.name), None)
    result = await page.result(editor.set_driver(agent_id, command.name))
    text = driven_by(agent.body_name, driver or Driver(command.name, command.name))
    return Answer(text, {"when": result.when})


class ListBlocks(PageCommand, tag="gallery"):
    """List the blocks that can be added."""

    kind: Kind


async def _gallery(page: Page, command: ListBlocks) -> Answer:
    state, agent_id = page.context.required_editor().state, page.view.agent
    items = await page.in_thread(lambda: gallery_items(state, agent_id, command.kind))
    return Answer(
        more={
            "items": [
                {
                    "class": each.type_name,
                    "title": each.title,
                    "question": each.question,
                    "summary": each.summary,
                    "picture": each.picture,
                    "reason": each.reason,
                }
                for each in items
            ]
        }
    )


class AddBlock(PageCommand, tag="add_block"):
    """Add a block to the agent, or to one of its blocks."""

    type_name: Name = msgspec.field(name="class")
    parent: Path
    index: Annotated[int, Meta(ge=0, le=1000)] | None = None


async def _add(page: Page, command: AddBlock) -> Answer:
    editor, agent_id = page.context.required_editor(), page.view.agent
    parent = tuple(command.parent)
    known = [cls.__name__ for cls in types_of(str(parent[-1]))]
    if command.type_name not in known:
        hint = suggest(command.type_name, known)
        raise NameNotFoundError(
            _("no block is called {name!r}; {hint}", name=command.type_name, hint=hint)
        )
    block = suggest_block(editor.state, agent_id, command.type_name)
    if parent == ("rewards",):
        block = with_goal_values(editor.state, block)
    text = _("{block} added.", block=_title(block))
    return await _add_to(page, block, parent, command.index, text)


class DuplicateBlock(PageCommand, tag="duplicate_block"):
    """Add a copy of a block of the agent."""

    path: Path


async def _duplicate(page: Page, command: DuplicateBlock) -> Answer:
    editor, agent_id = page.context.required_editor(), page.view.agent
    *parent, index = command.path
    if not isinstance(index, int):
        text = _("it stands alone; expected a block in a list")
        raise ChangeError([ParameterProblem((), text)])
    block = _block_of(editor, agent_id, tuple(command.path))
    copy = copy_of_block(editor.state, agent_id, block)
    text = _("{block} duplicated.", block=_title(block))
    return await _add_to(page, copy, tuple(parent), index + 1, text)


async def _add_to(
    page: Page, block: Plain, parent: BlockPath, index: int | None, done: str
) -> Answer:
    editor, agent_id = page.context.required_editor(), page.view.agent
    result = await page.result(editor.add_block(agent_id, parent, block, index))
    if index is None:
        owner = editor.state.agent(agent_id)
        for part in parent:
            owner = owner[part]  # type: ignore[index]
        index = len(owner) - 1
    return change_answer(done, result, path=[*parent, index])


class RemoveBlock(PageCommand, tag="remove_block"):
    """Remove a block of the agent."""

    path: Path


async def _remove(page: Page, command: RemoveBlock) -> Answer:
    editor, agent_id = page.context.required_editor(), page.view.agent
    path = tuple(command.path)
    title = _title(_block_of(editor, agent_id, path))
    result = await page.result(editor.remove_block(agent_id, path))
    return change_answer(_("{block} deleted.", block=title), result)


class MoveBlock(PageCommand, tag="move_block"):
    """Move a block of the agent up (-1) or down (1)."""

    path: Path
    by: Annotated[int, Meta(ge=-1000, le=1000)]


async def _move(page: Page, command: MoveBlock) -> Answer:
    editor, agent_id = page.context.required_editor(), page.view.agent
    *above, index = command.path
    title = _title(_block_of(editor, agent_id, tuple(command.path)))
    result = await page.result(editor.move_block(agent_id, tuple(command.path), command.by))
    where = max(0, index + command.by) if isinstance(index, int) else index
    text = _("{block} moved down.", block=title)
    if command.by < 0:
        text = _("{block} moved up.", block=title)
    return change_answer(text, result, path=[*above, where])


class SwitchBlock(PageCommand, tag="switch_block"):
    """Switch a block of the agent on or off."""

    path: Path
    on: bool


async def _switch(page: Page, command: SwitchBlock) -> Answer:
    editor, agent_id = page.context.required_editor(), page.view.agent
    path = tuple(command.path)
    title = _title(_block_of(editor, agent_id, path))
    result = await page.result(editor.switch_block(agent_id, path, command.on))
    text = _("{block} turned off.", block=title)
    if command.on:
        text = _("{block} turned on.", block=title)
    return change_answer(text, result)


class ChangeBlock(PageCommand, tag="change_block"):
    """Change parameters of a block of the agent."""

    path: Path
    values: Values


async def _change(page: Page, command: ChangeBlock) -> Answer:
    editor, agent_id = page.context.required_editor(), page.view.agent
    path = tuple(command.path)
    block = _block_of(editor, agent_id, path)
    fields = block_form(block, SceneNames(editor.state, agent_id))
    values = read_values(fields, command.values)
    result = await page.result(editor.change_block(agent_id, path, values))
    return change_answer(_("{block} changed.", block=_title(block)), result)


class ChangeAgent(PageCommand, tag="change_agent"):
    """Change parameters of the agent itself."""

    values: Values


async def _change_agent(page: Page, command: ChangeAgent) -> Answer:
    editor, agent_id = page.context.required_editor(), page.view.agent
    values = read_values(agent_form(editor.state.agent(agent_id)), command.values)
    name = page.context.runner.sim.agent(agent_id).body_name
    try:
        result = await page.result(editor.change_agent(agent_id, values))
    except ChangeError as error:
        raise ChangeError(list(problems_in_agent_form(error.problems))) from None
    return change_answer(_("Settings of {name} changed.", name=name), result)


class Undo(PageCommand, tag="undo"):
    """Take back the last change."""


async def _undo(page: Page, _command: Undo) -> Answer:
    result = await page.result(page.context.required_editor().undo())
    return Answer(_("Undone: {change}.", change=change_label(result.label)))


class Redo(PageCommand, tag="redo"):
    """Make the change again that was undone last."""


async def _redo(page: Page, _command: Redo) -> Answer:
    result = await page.result(page.context.required_editor().redo())
    return Answer(_("Done again: {change}.", change=change_label(result.label)))


def _block_of(editor: SceneEditor, agent_id: str, path: BlockPath) -> Plain:
    return block_at(editor.state.agent(agent_id), path)


def _title(block: Plain) -> str:
    return words_of(str(block["type"])).title


HANDLERS: Mapping[type[PageCommand], Handler] = {
    ListDrivers: _drivers,
    SetDriver: _driver,
    ListBlocks: _gallery,
    AddBlock: _add,
    DuplicateBlock: _duplicate,
    RemoveBlock: _remove,
    MoveBlock: _move,
    SwitchBlock: _switch,
    ChangeBlock: _change,
    ChangeAgent: _change_agent,
    Undo: _undo,
    Redo: _redo,
}
"""Handlers by the type of their command."""

"""Commands that open, save and restore scenes."""

import asyncio
from collections.abc import Mapping
from functools import partial
from typing import Any

from ai4u_edu.base.errors import SetupError
from ai4u_edu.locale import Text, library_text
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.scene_cards import Card, stored_cards
from ai4u_edu.page.editing.scene_pictures import LibraryScene, library_scenes
from ai4u_edu.page.messages import Name, Number, PageCommand
from ai4u_edu.page.panel.answers import Answer
from ai4u_edu.page.panel.commands.handler import Handler
from ai4u_edu.page.panel.page import Page
from ai4u_edu.page.server.library_pictures import picture_address
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.yaml.file import MAX_SCENE_BYTES

MAX_FILE_NAME_CHARS = 60


class ListScenes(PageCommand, tag="scenes"):
    """List the scenes that can be opened."""


async def _scenes(page: Page, _command: ListScenes) -> Answer:
    store = page.context.required_editor().scene_store

    def listed() -> list[dict[str, Any]]:
        saved = [] if store is None else stored_cards(store)
        return [
            *(_card(each, each.picture_url, is_saved=True) for each in saved),
            *(_card(each, picture_address(each.name)) for each in library_scenes()),
        ]

    return Answer(more={"items": await page.in_thread(listed)})


class OpenScene(PageCommand, tag="open_scene"):
    """Open a scene of the library, or a saved one."""

    name: Name
    is_saved: bool = False


async def _open(page: Page, command: OpenScene) -> Answer:
    editor = page.context.required_editor()
    load = partial(Scene.load, command.name)
    if command.is_saved:
        if editor.scene_store is None:
            raise SetupError(_("no scenes are saved here"))
        load = partial(editor.scene_store.load, command.name)
    elif command.name not in Scene.names():
        raise SetupError(_("no scene of the library is called {name!r}", name=command.name))
    scene = await page.in_thread(load)
    await page.result(editor.open(scene))
    return Answer(_("Opened {title}.", title=library_text(editor.title)))


class SaveScene(PageCommand, tag="save_scene"):
    """Save the scene under a name."""

    name: Name
    over: bool = False


async def _save(page: Page, command: SaveScene) -> Answer:
    editor = page.context.required_editor()
    if editor.scene_store is None:
        raise SetupError(_("scenes can't be saved here; download the file"))
    scene = editor.scene
    save = partial(editor.scene_store.save, command.name, scene, over=command.over)
    name = await asyncio.to_thread(save)
    editor.recovery.mark_saved(scene)
    text = _("Saved as “{name}”. Find it under Choose a scene.", name=name)
    return Answer(text, {"saved_as": name})


class Download(PageCommand, tag="download"):
    """Return the scene's file."""


async def _download(page: Page, _command: Download) -> Answer:
    editor = page.context.required_editor()
    scene = editor.scene
    text = await asyncio.to_thread(scene.dumps)
    editor.recovery.mark_saved(scene)
    more = {"file": f"{file_name(scene)}.yaml", "content": text}
    return Answer(_("The scene's file is in your downloads."), more)


class LoadText(PageCommand, tag="load_text"):
    """Open the scene file that was sent in binary messages before."""

    name: Name
    size: Number


async def _load(page: Page, command: LoadText) -> Answer:
    editor = page.context.required_editor()
    data = page.upload.take(command.size)
    if len(data) > MAX_SCENE_BYTES:
        raise SetupError(
            _("{file}: expected at most {most} bytes", file=command.name, most=MAX_SCENE_BYTES)
        )
    try:
        text = data.decode()
    except UnicodeDecodeError:
        raise SetupError(_("{file}: expected a text file, YAML", file=command.name)) from None
    await page.result(await page.in_thread(lambda: editor.load(text, command.name)))
    return Answer(_("Opened {title}.", title=library_text(editor.title)))


class Restore(PageCommand, tag="restore"):
    """Open the unsaved scene."""


async def _restore(page: Page, _command: Restore) -> Answer:
    editor = page.context.required_editor()
    await page.result(await page.in_thread(editor.recovery.restore))
    return Answer(_("Restored {title}.", title=library_text(editor.title)))


class Discard(PageCommand, tag="discard"):
    """Delete the unsaved scene."""


async def _discard(page: Page, _command: Discard) -> Answer:
    page.context.required_editor().recovery.discard()
    return Answer(_("The unsaved scene is deleted."))


def file_name(scene: Scene) -> str:
    """Return a name for a scene's file, without a suffix."""
    name = "".join(c if c.isalnum() or c in "-_" else "_" for c in scene.description.name)
    return name[:MAX_FILE_NAME_CHARS].strip("_") or "scene"


def _card(card: Card | LibraryScene, picture: str, *, is_saved: bool = False) -> dict[str, Any]:
    return {
        "name": card.name,
        "title": library_text(card.title),
        "goal": card.goal if isinstance(card.goal, Text) else library_text(card.goal),
        "level": card.level,
        "minutes": card.minutes,
        "stars": card.stars if isinstance(card, LibraryScene) else 0,
        "picture": picture,
        "is_saved": is_saved,
    }


HANDLERS: Mapping[type[PageCommand], Handler] = {
    ListScenes: _scenes,
    OpenScene: _open,
    SaveScene: _save,
    Download: _download,
    LoadText: _load,
    Restore: _restore,
    Discard: _discard,
}
"""Handlers by the type of their command."""

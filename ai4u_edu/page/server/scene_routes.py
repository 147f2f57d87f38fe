"""HTTP routes for a room's scene: what runs, a link to share it, and another one to open."""

import asyncio
from collections.abc import Callable
from typing import Annotated, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import JSONResponse, Response

from ai4u_edu.agent.block_errors import message_of
from ai4u_edu.base.errors import AI4UError, text_of
from ai4u_edu.base.seeding import MAX_SEED
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import library_text, translate
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.editing.scene_pictures import load_by_name
from ai4u_edu.page.editing.sharing import SharedScene, shared_link
from ai4u_edu.page.server.limits.json_body import read_json
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes.scene_link import LINK, MAX_LINK_CHARS, decode_link

MAX_BODY_BYTES = 2 * MAX_LINK_CHARS + 1000
MAX_WAITING = 8
"""Requests that wait until another one's scene was read, which takes up to a second."""
RETRY_AFTER_S = 5


class SceneView(BaseModel):
    """The scene that runs."""

    model_config = ConfigDict(extra="forbid")

    name: str
    title: str
    is_changed: bool = Field(description="true if it has changes that are not saved")
    is_autosaved: bool = Field(description="true if changes are kept under Unsaved")


class LinkView(BaseModel):
    """A link to share the scene."""

    model_config = ConfigDict(extra="forbid")

    fragment: str = Field(description="to be put after the page's address and a #")
    title: str
    needs: list[str] = Field(description="files, own blocks and hosts that a link can't carry")


class SharedView(BaseModel):
    """The scene in a link."""

    model_config = ConfigDict(extra="forbid")

    name: str
    title: str
    seed: Annotated[int, Field(ge=0, le=MAX_SEED)] | None


class LinkRequest(BaseModel):
    """A link, whole or its fragment."""

    model_config = ConfigDict(extra="forbid", strict=True)

    link: str


class OpenRequest(BaseModel):
    """The scene to open: from a link, by its name, or a saved one by its name.

    The name ``my_scene`` stands for an empty one.
    """

    model_config = ConfigDict(extra="forbid", strict=True)

    link: str = ""
    name: str = ""
    saved: str = ""

    @model_validator(mode="after")
    def _check(self) -> Self:
        if sum(map(bool, (self.link, self.name, self.saved))) != 1:
            raise ValueError(_("expected either a link, a name or the name of a saved scene"))
        return self


class SceneRoutes:
    """Routes for the scene of a room.

    They are async; scenes are read in worker threads, one at a time.

    Args:
        runner: runs the world.
        editor: changes the world, so that opening a scene can be undone.
        open_timeout: time (s) for the world to open a scene.
    """

    def __init__(self, runner: Runner, editor: SceneEditor, open_timeout: float) -> None:
        self._runner, self._editor, self._open_timeout = runner, editor, open_timeout
        self._reading = asyncio.Lock()
        self._waiting = 0

    async def present(self, _: Request) -> Response:
        """Return the name and the title of the scene that runs."""
        editor = self._editor
        return _json(
            SceneView(
                name=editor.state.description.name,
                title=translate(library_text(editor.title)),
                is_changed=editor.recovery.has_unsaved_changes,
                is_autosaved=editor.recovery.autosave is not None,
            )
        )

    async def link(self, _: Request) -> Response:
        """Return a link to the scene that runs, with the seed of its present episode."""
        scene, seed = self._editor.scene, self._runner.latest.seed
        try:
            link = await asyncio.to_thread(shared_link, scene, seed)
        except AI4UError as error:
            raise HTTPException(409, translate(text_of(error))) from None
        return _json(
            LinkView(
                fragment=link.fragment,
                title=translate(library_text(self._editor.title)),
                needs=list(link.needs),
            )
        )

    async def describe(self, request: Request) -> Response:
        """Return the name and the title of the scene in a link, after all checks."""
        wanted = await read_json(request, LinkRequest, MAX_BODY_BYTES)
        shared = await self._read(lambda: self._shared(wanted.link))
        return _json(_view(shared))

    async def open(self, request: Request) -> Response:
        """Open a scene, and begin an episode with the link's seed."""
        wanted = await read_json(request, OpenRequest, MAX_BODY_BYTES)
        if wanted.link:
            shared = await self._read(lambda: self._shared(wanted.link))
        elif wanted.saved:
            shared = await self._read(lambda: self._saved(wanted.saved))
        else:
            shared = await self._read(lambda: _named(wanted.name))
        try:
            async with asyncio.timeout(self._open_timeout):
                await asyncio.wrap_future(self._editor.open(shared.scene))
                if shared.seed is not None:
                    await asyncio.wrap_future(self._runner.reset(shared.seed))
        except TimeoutError:
            stall = self._runner.stall
            why = (
                _("{title} does not return", title=stall.title)
                if stall
                else _("the world does not answer")
            )
            headers = {"Retry-After": str(RETRY_AFTER_S)}
            raise HTTPException(
                503, translate(_("the scene can't be opened now: {why}", why=why)), headers
            ) from None
        except Exception as error:  # a student's block may raise anything
            raise HTTPException(409, translate(message_of(error))) from None
        return _json(_view(shared))

    def _shared(self, link: str) -> SharedScene:
        content = decode_link(link)
        return SharedScene(self._editor.read(content.text, LINK), content.seed)

    def _saved(self, name: str) -> SharedScene:
        store = self._editor.scene_store
        if store is None:
            raise HTTPException(404, translate(_("no scenes are saved here")))
        return SharedScene(store.load(name), None)

    async def _read(self, read: Callable[[], SharedScene]) -> SharedScene:
        if self._waiting >= MAX_WAITING:
            headers = {"Retry-After": str(RETRY_AFTER_S)}
            raise HTTPException(
                503, translate(_("too many scenes wait to be read; try again soon")), headers
            )
        self._waiting += 1
        try:
            async with self._reading:
                return await asyncio.to_thread(read)
        except AI4UError as error:
            raise HTTPException(422, translate(text_of(error))) from None
        finally:
            self._waiting -= 1


def _named(name: str) -> SharedScene:
    scene = load_by_name(name)
    if scene is None:
        raise HTTPException(
            404, translate(_("no scene is called {name!r}; see api/scenes", name=name[:80]))
        )
    return SharedScene(scene, None)


def _view(shared: SharedScene) -> SharedView:
    description = shared.scene.description
    title = translate(library_text(description.title or description.name))
    return SharedView(name=description.name, title=title, seed=shared.seed)


def _json(view: BaseModel) -> Response:
    return JSONResponse(view.model_dump(mode="json"), headers={"Cache-Control": "no-store"})

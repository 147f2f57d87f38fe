"""HTTP routes of the start page: the page, the library's scenes with pictures, and the missions."""

import asyncio
from collections.abc import Callable
from typing import Literal

from pydantic import BaseModel, ConfigDict, Field
from starlette.requests import Request
from starlette.responses import Response

from ai4u_edu.locale import library_text, translate
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.editing.scene_cards import Card, stored_cards
from ai4u_edu.page.editing.scene_pictures import library_scenes
from ai4u_edu.page.server.library_pictures import picture_address
from ai4u_edu.page.server.standalone import standalone_page


class LibrarySceneView(BaseModel):
    """A scene of the library, or one that somebody saved."""

    model_config = ConfigDict(extra="forbid")

    name: str
    title: str
    goal: str
    level: Literal["", "easy", "medium", "hard"]
    minutes: int | None = Field(description="to reach the goal for the first time")
    stars: int = Field(0, description="number of stars that a program can earn")
    key: str = Field("", description="key of its task, under which a page keeps best times")
    picture: str = Field(
        description="address of a PNG file, relative to the page, or a data URL; empty if the "
        "scene can't be read"
    )


class ScenesView(BaseModel):
    """The library's scenes, the easiest first, and those that people saved."""

    model_config = ConfigDict(extra="forbid")

    scenes: list[LibrarySceneView]
    saved: list[LibrarySceneView]


class MissionView(BaseModel):
    """A mission, as the map shows it."""

    model_config = ConfigDict(extra="forbid")

    name: str
    title: str
    island: str
    minutes: int
    steps: int
    stars: int = Field(description="number of stars that can be earned")
    idea: str = Field("", description="the word that it is about")
    scene: str


class MissionsView(BaseModel):
    """All missions, in the order of the map."""

    model_config = ConfigDict(extra="forbid")

    missions: list[MissionView] = Field(default_factory=list)
    problems: list[str] = Field(
        default_factory=list, description="sentences about files that can't be read"
    )


class StartPage:
    """Routes of the start page.

    They are async; scenes are read, and saved ones drawn, in worker threads, one at a time.

    Args:
        missions: returns the missions of the map.
        editor: has the store of saved scenes, if there is one.
    """

    def __init__(self, missions: Callable[[], MissionsView], editor: SceneEditor) -> None:
        self._missions, self._editor = missions, editor
        self._drawing = asyncio.Lock()

    async def page(self, _: Request) -> Response:
        """Return the page."""
        return standalone_page("start.html")

    async def scenes(self, _: Request) -> Response:
        """Return the library's scenes, and the saved ones."""
        store = self._editor.scene_store
        async with self._drawing:
            library = await asyncio.to_thread(_library_views)
            saved = [] if store is None else await asyncio.to_thread(stored_cards, store)
        return _json(
            ScenesView(
                scenes=library,
                saved=[_saved_view(each) for each in saved],
            )
        )

    async def missions(self, _: Request) -> Response:
        """Return the missions."""
        return _json(await asyncio.to_thread(self._missions))


def _library_views() -> list[LibrarySceneView]:
    return [
        LibrarySceneView.model_validate(
            each._asdict()
            | {
                "title": translate(library_text(each.title)),
                "goal": translate(library_text(each.goal)),
                "picture": picture_address(each.name),
            }
        )
        for each in library_scenes()
    ]


def _saved_view(card: Card) -> LibrarySceneView:
    about = {name: value for name, value in card._asdict().items() if name != "png"}
    return LibrarySceneView.model_validate(about | {"picture": card.picture_url})


def _json(view: BaseModel) -> Response:
    headers = {"Cache-Control": "no-store"}
    return Response(view.model_dump_json(), media_type="application/json", headers=headers)

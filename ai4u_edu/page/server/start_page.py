"""HTTP routes of the start page: the page, the library's scenes with pictures, and the lessons."""

import asyncio
from collections.abc import Callable, Sequence
from typing import Literal, Protocol

from pydantic import BaseModel, ConfigDict, Field
from starlette.requests import Request
from starlette.responses import Response

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


class ListedLesson(Protocol):
    """A lesson of the course, as the start page lists it."""

    @property
    def number(self) -> str:
        """Two digits."""

    @property
    def title(self) -> str:
        """Its heading, which may begin with the number."""

    @property
    def duration(self) -> str:
        """The time that it takes, in words."""


class LessonView(BaseModel):
    """A lesson of the course."""

    model_config = ConfigDict(extra="forbid")

    number: str
    title: str
    duration: str = Field(description="in words, such as 45 minutes")


class LessonsView(BaseModel):
    """The lessons of the course, in order."""

    model_config = ConfigDict(extra="forbid")

    lessons: list[LessonView]


class StartPage:
    """Routes of the start page.

    They are async; scenes are read, and saved ones drawn, in worker threads, one at a time.

    Args:
        lessons: returns the lessons of the course.
        editor: has the store of saved scenes, if there is one.
    """

    def __init__(self, lessons: Callable[[], Sequence[ListedLesson]], editor: SceneEditor) -> None:
        self._lessons, self._editor = lessons, editor
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

    async def lessons(self, _: Request) -> Response:
        """Return the lessons."""
        return _json(await asyncio.to_thread(self._lesson_views))

    def _lesson_views(self) -> LessonsView:
        return LessonsView(lessons=[_lesson_view(lesson) for lesson in self._lessons()])


def _library_views() -> list[LibrarySceneView]:
    return [
        LibrarySceneView.model_validate(each._asdict() | {"picture": picture_address(each.name)})
        for each in library_scenes()
    ]


def _saved_view(card: Card) -> LibrarySceneView:
    about = {name: value for name, value in card._asdict().items() if name != "png"}
    return LibrarySceneView.model_validate(about | {"picture": card.picture_url})


def _lesson_view(lesson: ListedLesson) -> LessonView:
    title = lesson.title.removeprefix(lesson.number).strip()
    return LessonView(number=lesson.number, title=title, duration=lesson.duration)


def _json(view: BaseModel) -> Response:
    headers = {"Cache-Control": "no-store"}
    return Response(view.model_dump_json(), media_type="application/json", headers=headers)

"""Scenes that a teacher gives to rooms: of the library, of a file, or of a student's room."""

from pydantic import BaseModel, ConfigDict, Field

from ai4u_edu.base.errors import SceneError, shorten
from ai4u_edu.classroom.assignments import AssignedScene
from ai4u_edu.classroom.course_index import course_lessons
from ai4u_edu.classroom.errors import CommandError
from ai4u_edu.classroom.live_class import LiveClass
from ai4u_edu.classroom.scene_file import NAME as SCENE_FILE
from ai4u_edu.page.editing.errors import ChangeError
from ai4u_edu.page.editing.permissions import Permissions
from ai4u_edu.scenes import Scene
from ai4u_edu.wire.class_link import MAX_SCENE_CHARS

MAX_SENTENCE_CHARS = 400


class SceneOfRoom(BaseModel):
    """The present scene of a room."""

    model_config = ConfigDict(extra="forbid")

    room: str = Field(max_length=40)


class SceneText(BaseModel):
    """A scene's YAML."""

    model_config = ConfigDict(extra="forbid")

    yaml: str = Field(max_length=MAX_SCENE_CHARS)


class SceneOfLesson(BaseModel):
    """The scene that a lesson begins with."""

    model_config = ConfigDict(extra="forbid")

    lesson: str = Field(max_length=2)


SceneSource = str | SceneOfRoom | SceneText
LessonOrScene = SceneOfLesson | SceneSource


def find_scene(live: LiveClass, source: LessonOrScene) -> AssignedScene:
    """Return a scene that rooms can open; a thread may do it.

    That of a lesson is empty if the lesson shows no scene of the library.

    Raises:
        CommandError: there is none, or something in it is wrong.
    """
    if isinstance(source, SceneOfLesson):
        return _scene_of_lesson(source.lesson)
    if isinstance(source, str):
        if source not in Scene.names():
            raise CommandError(f"scene: expected a scene of the library, got {source[:40]!r}")
        return AssignedScene(Scene.load(source).description.title or source, source)
    text = source.yaml if isinstance(source, SceneText) else text_of_room(live, source.room)
    try:
        scene = Scene.loads(text)
        Permissions(()).check(scene.description.agents)
    except (SceneError, ChangeError) as error:
        raise CommandError(f"scene: {shorten(str(error), MAX_SENTENCE_CHARS)}") from None
    title = scene.description.title or scene.description.name
    # a text without a line break would be taken for a name
    return AssignedScene(title, text if "\n" in text else f"{text}\n")


def _scene_of_lesson(number: str) -> AssignedScene:
    for each in course_lessons():
        if each.number == number:
            return AssignedScene(each.title, each.scene, f"{number} {each.title}")
    last = course_lessons()[-1].number
    raise CommandError(f"lesson: expected a number from 00 to {last}, got {number!r}")


def text_of_room(live: LiveClass, room: str) -> str:
    """Return the YAML of a room's present scene.

    Raises:
        CommandError: there is no such room, or nothing is known of its scene.
    """
    if room not in live.rooms and room not in live.seats.scenes():
        raise CommandError(f"room: there is no room {room[:40]!r}")
    state = live.rooms.get(room)
    if state is not None and state.work is not None:
        return state.work.scene
    try:
        return (live.store.folder / "rooms" / room / SCENE_FILE).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        raise CommandError("room: its scene is not known yet; it was not changed") from None

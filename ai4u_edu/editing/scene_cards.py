"""Cards of scenes to choose from: a picture from above, title and goal."""

import base64
from functools import cache, lru_cache
from typing import NamedTuple

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.editing.scene_pictures import scene_picture
from ai4u_edu.editing.scene_store import MAX_SCENES, SceneStore
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.star_goals import star_goals

PICTURE_SIZE_PX = 144
"""Longer side of a picture: twice its size on the page, for high-resolution screens."""


class Card(NamedTuple):
    """A scene of the library or of a store."""

    name: str
    title: str
    goal: str
    png: bytes
    """The scene from above at the start of an episode; empty if it can't be read."""
    level: str = ""
    """Level of difficulty; empty if nobody has given one."""
    minutes: int | None = None
    """Time (minutes) that a person needs to reach the goal for the first time."""
    stars: int = 0
    """Number of stars that a program can earn; 0 for a saved scene."""

    @property
    def picture_url(self) -> str:
        """The picture as a data URL; empty if there is none."""
        picture = base64.b64encode(self.png).decode()
        return f"data:image/png;base64,{picture}" if picture else ""


@cache
def card(name: str) -> Card:
    """Return the card of a library scene; cached, because drawing takes a moment."""
    scene = Scene.load(name)
    found = _card(name, scene.description.title or name, scene)
    return found._replace(stars=star_goals(scene.description).count)


def library_cards() -> list[Card]:
    """Return the cards of all library scenes, sorted by title."""
    return sorted((card(name) for name in Scene.names()), key=lambda each: each.title.lower())


def stored_cards(store: SceneStore) -> list[Card]:
    """Return the cards of all scenes in a store; the card of an unreadable scene says why."""
    return [_stored_card(store, name, _modified_at(store, name)) for name in store.names()]


@lru_cache(MAX_SCENES)
def _stored_card(store: SceneStore, name: str, _modified_at: float) -> Card:
    try:
        return _card(name, name, store.load(name))
    except AI4UError as error:
        return Card(name, name, f"can't be read: {error}", b"")


def _modified_at(store: SceneStore, name: str) -> float:
    """Return a stored scene's modification time; 0 if it was deleted meanwhile."""
    file = store.file(name)
    return file.stat().st_mtime if file is not None else 0.0


def _card(name: str, title: str, scene: Scene) -> Card:
    about = scene.description
    picture = scene_picture(scene, PICTURE_SIZE_PX)
    return Card(name, title, about.goal, picture, about.level or "", about.minutes)

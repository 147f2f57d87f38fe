"""Cards of saved scenes to choose from: a picture from above, title and goal."""

import base64
from functools import lru_cache
from typing import NamedTuple

from ai4u_edu.base.errors import AI4UError, text_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.scene_pictures import scene_picture
from ai4u_edu.page.editing.scene_store import MAX_SCENES, SceneStore

PICTURE_SIZE_PX = 288
"""Longer side of a picture: twice its size in the panel, for high-resolution screens."""


class Card(NamedTuple):
    """A scene of a store."""

    name: str
    title: str
    goal: str
    png: bytes
    """The scene from above at the start of an episode; empty if it can't be read."""
    level: str = ""
    """Level of difficulty; empty if nobody has given one."""
    minutes: int | None = None
    """Time (minutes) that a person needs to reach the goal for the first time."""

    @property
    def picture_url(self) -> str:
        """The picture as a data URL; empty if there is none."""
        picture = base64.b64encode(self.png).decode()
        return f"data:image/png;base64,{picture}" if picture else ""


def stored_cards(store: SceneStore) -> list[Card]:
    """Return the cards of all scenes in a store; the card of an unreadable scene says why."""
    return [_stored_card(store, name, _modified_at(store, name)) for name in store.names()]


@lru_cache(MAX_SCENES)
def _stored_card(store: SceneStore, name: str, _modified_at: float) -> Card:
    try:
        scene = store.load(name)
        picture = scene_picture(scene, PICTURE_SIZE_PX)
    except AI4UError as error:
        return Card(name, name, _("can't be read: {problem}", problem=text_of(error)), b"")
    about = scene.description
    return Card(name, name, about.goal, picture, about.level or "", about.minutes)


def _modified_at(store: SceneStore, name: str) -> float:
    """Return a stored scene's modification time; 0 if it was deleted meanwhile."""
    file = store.file(name)
    return file.stat().st_mtime if file is not None else 0.0

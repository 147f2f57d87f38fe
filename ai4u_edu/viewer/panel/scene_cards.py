"""Cards of scenes for the gallery: a picture from above, title and goal."""

import base64
from functools import cache, lru_cache
from html import escape
from typing import NamedTuple

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.editing.scene_pictures import scene_picture
from ai4u_edu.editing.scene_store import MAX_SCENES, SceneStore
from ai4u_edu.scenes import Scene

PICTURE_SIZE_PX = 144
"""Longer side of a picture: twice its size on the page, for high-resolution screens."""


class Card(NamedTuple):
    """A scene of the library or of a store."""

    name: str
    title: str
    goal: str
    png: bytes
    """The scene from above at the start of an episode; empty if it can't be read."""

    @property
    def html(self) -> str:
        """The picture with the texts beside it; the style sheet lays the next button over it."""
        source = f"data:image/png;base64,{base64.b64encode(self.png).decode()}"
        image = f'<img src="{source}" alt="">' if self.png else ""
        return (
            f'<div class="ai4u card">{image}<div><b>{escape(self.title)}</b>'
            f"<br><small>{escape(self.goal)}</small></div></div>"
        )


STYLE = """<style>
.ai4u.card {display: flex; gap: .9em; align-items: center; height: 68px; margin: 0 0 8px;
  padding: 0 .6em; border: 1px solid var(--line); border-radius: 6px; overflow: hidden}
.ai4u.card img {flex: 0 0 72px; width: 72px; height: 62px; object-fit: contain}
.ai4u.card small {display: -webkit-box; -webkit-box-orient: vertical; -webkit-line-clamp: 3;
  overflow: hidden; line-height: 1.3}
.ai4u.card br {display: none}
div:has(> .ai4u.card) + div {margin: -76px 0 6px !important; padding: 0 !important}
div:has(> .ai4u.card) + div button {height: 68px !important; padding: 0;
  background: none; border: 2px solid transparent; color: transparent}
div:has(> .ai4u.card) + div button:hover, div:has(> .ai4u.card) + div button:focus-visible
  {background: none; border-color: var(--mantine-primary-color-filled)}
</style>"""
"""Styles that lay the button after a card over it, so that the picture can be clicked."""


@cache
def card(name: str) -> Card:
    """Return the card of a library scene; cached, because drawing takes a moment."""
    scene = Scene.load(name)
    return _card(name, scene.description.title or name, scene)


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
    return Card(name, title, scene.description.goal, scene_picture(scene, PICTURE_SIZE_PX))

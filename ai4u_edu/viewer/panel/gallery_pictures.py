"""Scenes as pictures, to choose one by what it looks like."""

import base64
import io
from functools import cache, lru_cache
from html import escape
from typing import NamedTuple

from PIL import Image

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.editing.scene_store import MAX_SCENES, SceneStore
from ai4u_edu.scenes import Scene
from ai4u_edu.snapshot import capture_snapshot
from ai4u_edu.snapshot.raster import draw_snapshot

LONGEST = 144
"""Pixels of a picture's longer side: twice what is shown, for sharp screens."""
COLOURS = 32
"""In a picture: there are few in a scene, and so a file has two kB or three."""


class Card(NamedTuple):
    """A scene, of the library or of a store."""

    name: str
    title: str
    goal: str
    png: bytes
    """What it looks like from above when an episode begins."""

    @property
    def html(self) -> str:
        """The picture, and the words beside it; a button comes to lie over it."""
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
"""Lays the button that follows a card over it, so that the picture is what is clicked on."""


@cache
def card(name: str) -> Card:
    """A scene of the library; drawn once, which takes a moment."""
    scene = Scene.load(name)
    return _card(name, scene.description.title or name, scene)


def cards() -> list[Card]:
    """All scenes of the library, by title."""
    return sorted((card(name) for name in Scene.names()), key=lambda each: each.title.lower())


def cards_of(store: SceneStore) -> list[Card]:
    """All scenes of a store, by name; one that can't be read says why."""
    return [_kept(store, name, _stamp(store, name)) for name in store.names()]


@lru_cache(MAX_SCENES)
def _kept(store: SceneStore, name: str, _stamp: float) -> Card:
    try:
        return _card(name, name, store.load(name))
    except AI4UError as error:
        return Card(name, name, f"can't be read: {error}", b"")


def _stamp(store: SceneStore, name: str) -> float:
    """When a scene was kept; it may have been taken away meanwhile."""
    file = store.file(name)
    return file.stat().st_mtime if file is not None else 0.0


def _card(name: str, title: str, scene: Scene) -> Card:
    sim = scene.build()
    sim.reset(1)
    picture = Image.fromarray(draw_snapshot(capture_snapshot(sim), longest=LONGEST))
    out = io.BytesIO()
    picture.quantize(COLOURS).save(out, "PNG", optimize=True)
    return Card(name, title, scene.description.goal, out.getvalue())

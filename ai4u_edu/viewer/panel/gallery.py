"""A modal window in which a page chooses another scene by its picture."""

import asyncio
import base64
from collections.abc import Awaitable, Callable
from functools import partial
from html import escape
from typing import Any

from viser import ClientHandle, GuiButtonHandle
from viser._gui_handles import GuiModalHandle

from ai4u_edu.editing.scene_cards import Card, library_cards, stored_cards
from ai4u_edu.editing.scene_store import SceneStore
from ai4u_edu.scenes import Scene
from ai4u_edu.viewer.panel.html_parts import section

Load = Callable[[], Scene]

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


class Gallery:
    """The scenes of the library and of a store, as pictures with buttons.

    It is created at each opening, so a closed gallery costs a page nothing.

    Args:
        client: the page.
        on_choose: called in viser's event loop with a function that loads the chosen scene.
    """

    def __init__(self, client: ClientHandle, on_choose: Callable[[Load], Awaitable[None]]) -> None:
        self._client, self._on_choose = client, on_choose
        self._window: GuiModalHandle | None = None
        self._is_opening = False
        self.buttons: dict[str, GuiButtonHandle] = {}
        """Buttons of the library's scenes, by name."""
        self.stored_buttons: dict[str, GuiButtonHandle] = {}
        """Buttons of the store's scenes, by name."""

    async def open(self, store: SceneStore | None) -> None:
        """Show the window."""
        if self._window is None and not self._is_opening:
            self._is_opening = True
            try:
                stored = await asyncio.to_thread(stored_cards, store) if store is not None else []
                self._show(await asyncio.to_thread(library_cards), stored, store)
            finally:
                self._is_opening = False

    def close(self) -> None:
        """Close the window."""
        window, self._window = self._window, None
        self.buttons, self.stored_buttons = {}, {}
        if window is not None:
            window.close()

    def _show(self, library: list[Card], stored: list[Card], store: SceneStore | None) -> None:
        gui = self._client.gui
        with self._client.atomic(), gui.add_modal("Choose a scene") as self._window:
            gui.add_button("Stay here").on_click(self._on_close)
            gui.add_html(STYLE)
            if store is not None and stored:
                gui.add_html(section("<b>Saved here</b>"))
                for each in stored:
                    load = partial(store.load, each.name)
                    self.stored_buttons[each.name] = self._add(each, load)
                gui.add_html(section("<b>The library</b>"))
            for each in library:
                self.buttons[each.name] = self._add(each, partial(Scene.load, each.name))

    def _add(self, card: Card, load: Load) -> GuiButtonHandle:
        self._client.gui.add_html(card_html(card))
        button = self._client.gui.add_button(f"Open {card.title}")
        button.on_click(partial(self._on_card, load))
        return button

    async def _on_card(self, load: Load, _event: Any) -> None:
        self.close()
        await self._on_choose(load)

    async def _on_close(self, _event: Any) -> None:
        self.close()


def card_html(card: Card) -> str:
    """Return the picture with the texts beside it; the style sheet lays the next button over it."""
    source = f"data:image/png;base64,{base64.b64encode(card.png).decode()}"
    image = f'<img src="{source}" alt="">' if card.png else ""
    return (
        f'<div class="ai4u card">{image}<div><b>{escape(card.title)}</b>'
        f"<br><small>{escape(card.goal)}</small></div></div>"
    )

"""A window in which one page chooses another scene, by its picture."""

import asyncio
from collections.abc import Awaitable, Callable
from functools import partial
from typing import Any

from viser import ClientHandle, GuiButtonHandle
from viser._gui_handles import GuiModalHandle

from ai4u_edu.editing.scene_store import SceneStore
from ai4u_edu.scenes import Scene
from ai4u_edu.viewer.panel.gallery_pictures import STYLE, Card, cards, cards_of
from ai4u_edu.viewer.panel.readings import block

Load = Callable[[], Scene]


class Gallery:
    """Shows the library's scenes, and those that were kept in a store.

    It is made when somebody asks for it, so that pages cost nothing.

    Args:
        client: the page.
        on_choose: called in viser's loop with what reads the scene that was clicked on.
    """

    def __init__(self, client: ClientHandle, on_choose: Callable[[Load], Awaitable[None]]) -> None:
        self._client, self._on_choose = client, on_choose
        self._window: GuiModalHandle | None = None
        self._is_opening = False
        self.buttons: dict[str, GuiButtonHandle] = {}
        """Of the library's scenes, by name."""
        self.kept: dict[str, GuiButtonHandle] = {}
        """Of the store's."""

    async def open(self, store: SceneStore | None) -> None:
        """Shows the window."""
        if self._window is None and not self._is_opening:
            self._is_opening = True
            try:
                kept = await asyncio.to_thread(cards_of, store) if store is not None else []
                self._show(await asyncio.to_thread(cards), kept, store)
            finally:
                self._is_opening = False

    def close(self) -> None:
        """Takes it away."""
        window, self._window = self._window, None
        self.buttons, self.kept = {}, {}
        if window is not None:
            window.close()

    def _show(self, found: list[Card], kept: list[Card], store: SceneStore | None) -> None:
        gui = self._client.gui
        with self._client.atomic(), gui.add_modal("Choose a scene") as self._window:
            gui.add_button("Stay here").on_click(self._on_close)
            gui.add_html(STYLE)
            if store is not None and kept:
                gui.add_html(block("<b>Saved here</b>"))
                for each in kept:
                    self.kept[each.name] = self._add(each, partial(store.load, each.name))
                gui.add_html(block("<b>The library</b>"))
            for each in found:
                self.buttons[each.name] = self._add(each, partial(Scene.load, each.name))

    def _add(self, card: Card, load: Load) -> GuiButtonHandle:
        self._client.gui.add_html(card.html)
        button = self._client.gui.add_button(f"Open {card.title}")
        button.on_click(partial(self._on_card, load))
        return button

    async def _on_card(self, load: Load, _event: Any) -> None:
        self.close()
        await self._on_choose(load)

    async def _on_close(self, _event: Any) -> None:
        self.close()

"""A window in which one page chooses another scene, by its picture."""

import asyncio
from collections.abc import Awaitable, Callable
from functools import partial
from typing import Any

from viser import ClientHandle, GuiButtonHandle
from viser._gui_handles import GuiModalHandle

from ai4u_edu.viewer.gallery_pictures import STYLE, Card, cards


class Gallery:
    """Shows the library's scenes; made when somebody asks for it, so that pages cost nothing.

    Args:
        client: the page.
        on_choose: called with the name of the scene that was clicked on, in viser's loop.
    """

    def __init__(self, client: ClientHandle, on_choose: Callable[[str], Awaitable[None]]) -> None:
        self._client, self._on_choose = client, on_choose
        self._window: GuiModalHandle | None = None
        self._is_opening = False
        self.buttons: dict[str, GuiButtonHandle] = {}

    async def open(self) -> None:
        """Shows the window."""
        if self._window is None and not self._is_opening:
            self._is_opening = True
            try:
                self._show(await asyncio.to_thread(cards))
            finally:
                self._is_opening = False

    def close(self) -> None:
        """Takes it away."""
        window, self._window = self._window, None
        self.buttons = {}
        if window is not None:
            window.close()

    def _show(self, found: list[Card]) -> None:
        gui = self._client.gui
        with self._client.atomic(), gui.add_modal("Choose a scene") as self._window:
            gui.add_button("Stay here").on_click(self._on_close)
            gui.add_html(STYLE)
            for each in found:
                gui.add_html(each.html)
                button = gui.add_button(f"Open {each.title}")
                button.on_click(partial(self._on_card, each.name))
                self.buttons[each.name] = button

    async def _on_card(self, name: str, _event: Any) -> None:
        self.close()
        await self._on_choose(name)

    async def _on_close(self, _event: Any) -> None:
        self.close()

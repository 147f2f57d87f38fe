"""A modal window in which a page saves the scene under a name."""

import asyncio
from collections.abc import Callable
from html import escape
from typing import Any

from viser import ClientHandle, GuiButtonHandle, GuiHtmlHandle, GuiTextHandle
from viser._gui_handles import GuiModalHandle

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.editing.scene_store import SceneExistsError, SceneStore
from ai4u_edu.scenes import Scene
from ai4u_edu.viewer.panel.html_parts import section

SAVE, REPLACE = "Save", "Replace it"


class SaveWindow:
    """A form for the name; replacing a scene of that name takes a confirmation.

    Args:
        client: the page.
        store: the store that the scene is saved to.
        scene: returns the scene to save.
        on_saved: called with the name, in viser's event loop.
    """

    def __init__(
        self,
        client: ClientHandle,
        store: SceneStore,
        scene: Callable[[], Scene],
        on_saved: Callable[[str], None],
    ) -> None:
        self._client, self._store, self._scene = client, store, scene
        self._on_saved = on_saved
        self._window: GuiModalHandle | None = None
        self._taken, self._is_saving = "", False
        self.name: GuiTextHandle
        self.save: GuiButtonHandle
        self.message: GuiHtmlHandle

    @property
    def is_open(self) -> bool:
        """True while the window is shown."""
        return self._window is not None

    def open(self, name: str) -> None:
        """Show the window with a suggested name."""
        if self._window is not None:
            return
        self._taken, gui = "", self._client.gui
        with self._client.atomic(), gui.add_modal("Save the scene") as window:
            with gui.add_form(None) as form:
                self.name = gui.add_text("Name", name)
                self.message = gui.add_html("")
                self.save = gui.add_button(SAVE, color="blue")
            cancel = gui.add_button("Cancel")
        form.on_submit(self._on_save)
        self.save.on_click(self._on_save)
        cancel.on_click(self._on_cancel)
        self._window = window

    def close(self) -> None:
        """Close the window."""
        window, self._window = self._window, None
        if window is not None:
            window.close()

    async def _on_save(self, _event: Any) -> None:
        if self._is_saving or self._window is None:
            return  # the second click of a double click
        name, scene = self.name.value, self._scene()
        over = bool(self._taken) and self._taken == name
        self._is_saving = True
        try:
            saved_name = await asyncio.to_thread(self._store.save, name, scene, over=over)
        except SceneExistsError as error:
            self._taken = name
            self._show_error(f"{error}; press “{REPLACE}”, or choose another name", REPLACE)
        except AI4UError as error:
            self._taken = ""
            self._show_error(str(error), SAVE)
        else:
            self.close()
            self._on_saved(saved_name)
        finally:
            self._is_saving = False

    def _show_error(self, text: str, label: str) -> None:
        self.message.content = section(f'<strong role="alert">{escape(text)}</strong>')
        if self.save.label != label:
            self.save.label = label

    async def _on_cancel(self, _event: Any) -> None:
        if not self._is_saving:
            self.close()

"""Settings of each page: its camera and its color scheme."""

from viser import GuiButtonGroupHandle, GuiCheckboxHandle, GuiEvent

from ai4u_edu.snapshot import Snapshot, StaticScene
from ai4u_edu.viewer.panel.block_labels import selected_button_mark
from ai4u_edu.viewer.scene.view import Mode
from ai4u_edu.viewer.viewer_client import ViewerClient, ViewerClients

MODES = tuple(mode.value for mode in Mode)


class PageControls:
    """The widgets of each page's own settings, in the main panel below the shared ones."""

    def __init__(self, viewer_clients: ViewerClients) -> None:
        self._viewer_clients = viewer_clients
        self.pages: dict[int, _Page] = {}

    def build(self, static_scene: StaticScene) -> None:
        """Do nothing: the settings don't depend on the scene."""

    def draw(self, _snapshot: Snapshot) -> None:
        """Add widgets to new pages, and forget closed ones."""
        for gone in self.pages.keys() - self._viewer_clients.keys():
            del self.pages[gone]
        for new in self._viewer_clients.keys() - self.pages.keys():
            if not self._viewer_clients[new].page_id:
                self.pages[new] = _Page(self._viewer_clients[new])


class _Page:
    def __init__(self, viewer_client: ViewerClient) -> None:
        gui = viewer_client.client.gui
        self._viewer_client = viewer_client
        self.mark = gui.add_html("")
        self.camera = gui.add_button_group("Camera", MODES)
        # web/dark.js finds this box by its label, to store the choice in the browser
        self.dark = gui.add_checkbox("Dark", initial_value=viewer_client.is_dark)
        self.camera.on_click(self._on_camera)
        self.dark.on_update(self._on_dark)
        self._show_mode()

    async def _on_camera(self, event: GuiEvent[GuiButtonGroupHandle]) -> None:
        if event.target.value in MODES:
            self._viewer_client.view.choose(Mode(event.target.value))
            self._show_mode()

    async def _on_dark(self, event: GuiEvent[GuiCheckboxHandle]) -> None:
        self._viewer_client.set_dark(bool(event.target.value))

    def _show_mode(self) -> None:
        """Highlight the button of the current camera mode."""
        position = 1 + MODES.index(self._viewer_client.view.mode)
        self.mark.content = selected_button_mark(position)

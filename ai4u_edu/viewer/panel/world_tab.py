"""The tab in which a page changes the world: another scene, other things, elsewhere."""

import asyncio
from concurrent.futures import Future
from html import escape
from typing import Any

from viser import (
    GuiButtonGroupHandle,
    GuiButtonHandle,
    GuiCheckboxHandle,
    GuiDropdownHandle,
    GuiEvent,
    GuiUploadButtonHandle,
)

from ai4u_edu.agent.block_errors import message_of
from ai4u_edu.base.errors import AI4UError
from ai4u_edu.base.parameters import Problem
from ai4u_edu.editing import ChangeError, ChangeResult, SceneEditor
from ai4u_edu.editing.forms import Field
from ai4u_edu.editing.settings import scene_form
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.yaml.file import MAX_SCENE_CHARS
from ai4u_edu.snapshot import Snapshot
from ai4u_edu.viewer.backend.reporting import reporting
from ai4u_edu.viewer.panel.add_menu import BODY_TEMPLATES, free_position, ground_at_center
from ai4u_edu.viewer.panel.block_labels import WAITS
from ai4u_edu.viewer.panel.body_form import BodyForm
from ai4u_edu.viewer.panel.gallery import Gallery, Load
from ai4u_edu.viewer.panel.notify import notify_stall
from ai4u_edu.viewer.panel.readings import block
from ai4u_edu.viewer.panel.save_window import SaveWindow
from ai4u_edu.viewer.panel.settings_form import SettingsForm
from ai4u_edu.viewer.panel.tabs import TabKind
from ai4u_edu.viewer.panel.uploads import limit_uploads, take_file
from ai4u_edu.viewer.scene.handles import Handles
from ai4u_edu.viewer.viewer_client import ViewerClient
from ai4u_edu.world import BodyDescription

UNDO, REDO = "Undo", "Redo"
CHOOSE, SAVE, DOWNLOAD = "Choose a scene", "Save", "Download"
RESTORE, DISCARD = "Restore", "Discard"
NOTHING = "choose one, or click on it"
BARE = block(kind="mark bare")
HINT = "Switch on <b>Move things</b>, then drag with the mouse what you like in the picture."
MOVING = "Drag anything in the picture; Escape puts it back. Click on it, and a knob turns it."


class WorldTab:
    """One page's hands on the world.

    Args:
        viewer_client: the page.
        editor: carries out what is asked for.
    """

    def __init__(self, viewer_client: ViewerClient, editor: SceneEditor) -> None:
        gui = viewer_client.client.gui
        self._viewer_client, self._editor = viewer_client, editor
        self._chosen, self._message, self._is_wrong = "", "", False
        self._problems: tuple[Problem, ...] | None = None
        self._form: BodyForm | None = None
        self._is_applied = False
        self._seen: tuple[object, ...] = ()
        self._latest: Snapshot | None = None
        self.gallery = Gallery(viewer_client.client, self._open)
        self.saving: SaveWindow | None = None
        """There if scenes can be kept here."""
        if editor.scene_store is not None:
            client, store = viewer_client.client, editor.scene_store
            self.saving = SaveWindow(client, store, lambda: editor.scene, self._on_saved)
        self.handles = Handles(viewer_client, editor, self._choose, self._ask)
        self._offer = gui.add_html("", visible=False)
        self._bare = gui.add_html(BARE, visible=False)
        self.offered = gui.add_button_group("Unsaved", (RESTORE, DISCARD), visible=False)
        self.said = gui.add_html("")
        gui.add_html(BARE)
        words = (CHOOSE, DOWNLOAD) if self.saving is None else (CHOOSE, SAVE, DOWNLOAD)
        self.scene = gui.add_button_group("Scene", words)
        gui.add_html(BARE)
        self.changes = gui.add_button_group("Changes", (UNDO, REDO))
        self.settings = SettingsForm(
            viewer_client.client, "Scene's settings", self._settings, self._on_settings
        )
        self.moves = gui.add_checkbox("Move things", False)
        self._hint = gui.add_html(block(f"<small>{HINT}</small>"))
        self.thing = gui.add_dropdown("Thing", (NOTHING,))
        self.new = gui.add_button_group("Add", tuple(BODY_TEMPLATES))
        self._place = gui.add_folder(None)
        self.delete = gui.add_button("Delete", visible=False)
        self.upload = gui.add_upload_button("Open a scene file", hint="A .yaml file")
        limit_uploads(viewer_client.client, 4 * MAX_SCENE_CHARS)  # no character takes more bytes
        self.offered.on_click(self._on_offer)
        self.scene.on_click(self._on_scene)
        self.changes.on_click(self._on_changes)
        self.moves.on_update(self._on_moves)
        self.thing.on_update(self._on_thing)
        self.new.on_click(self._on_new)
        self.delete.on_click(self._on_delete)
        self.upload.on_upload(reporting(self._on_upload))

    def draw(self, snapshot: Snapshot) -> None:
        """Shows what there is to change, when that is other than before."""
        editor, self._latest = self._editor, snapshot
        self.handles.draw(snapshot, self._chosen, on=self.moves.value)
        unsaved = editor.unsaved
        self.settings.draw("scene", editor.version)
        waits, autosave = editor.waits_for_reset, editor.autosave
        problem = autosave.problem if autosave is not None else ""
        seen = (editor.version, self._chosen, self._message, unsaved, waits, problem)
        if self._is_applied:
            self._seen = ()
        if seen != self._seen:
            self._seen = seen
            self._show(problem)
            is_offered = unsaved is not None
            for handle in (self._offer, self._bare, self.offered):
                handle.visible = is_offered
            if unsaved is not None:
                told = f"<b>A scene from {escape(unsaved.when)} was never saved.</b>"
                self._offer.content = block(told)
        if self._problems is not None:
            problems, self._problems = self._problems, None
            if self._form is not None:
                self._form.explain(problems)

    # -- what is shown ---------------------------------------------------------------------------

    def _show(self, problem: str) -> None:
        editor, description = self._editor, self._editor.state.description
        bodies = {body.name: body for body in description.bodies}
        options = (NOTHING, *bodies)
        if self.thing.options != options:
            self.thing.options = options
        value = self._chosen if self._chosen in bodies else NOTHING
        if self.thing.value != value:
            self.thing.value = value  # type: ignore[misc]  # a method parts getter from setter
        self._show_form(bodies.get(self._chosen))
        back, forth = editor.undo_label, editor.redo_label
        steps = [
            f"{word}: {escape(label)}" for word, label in (("undo", back), ("redo", forth)) if label
        ]
        word = "alert" if self._is_wrong else "status"
        style = "white-space: normal"
        told = escape(self._message).replace("\n", "<br>")
        lines = [
            f"<b>{escape(editor.title)}</b>",
            told and f'<span role="{word}" style="{style}">{told}</span>',
            f"<small>{WAITS}</small>" if editor.waits_for_reset else "",
            problem and f'<small role="alert" style="{style}">{escape(problem)}</small>',
            f"<small>{' · '.join(steps)}</small>" if steps else "",
        ]
        self.said.content = block("<br>".join(line for line in lines if line))

    def _show_form(self, body: BodyDescription | None) -> None:
        anew, self._is_applied = self._is_applied, False
        if self._form is not None and not self._form.takes(body, anew=anew):
            self._form.remove()
            self._form = None
        if body is not None and self._form is None:
            with self._place:
                self._form = BodyForm(self._viewer_client.client, body, self._on_apply)
        self.delete.visible = body is not None
        if body is not None:
            self.delete.label = f"Delete {body.name}"

    def _choose(self, name: str) -> None:
        self._chosen = name

    def _settings(self) -> list[Field]:
        return scene_form(self._editor.state.description)

    # -- what people ask for; in viser's loop, one after the other -------------------------------

    async def _open(self, load: Load) -> None:
        try:
            scene = await asyncio.to_thread(load)
        except AI4UError as error:
            self._tell(str(error), is_wrong=True)
            return
        self._chosen = ""
        self._ask(self._editor.open(scene))

    def _on_saved(self, name: str) -> None:
        self._editor.mark_saved()
        self._tell(f"the scene is saved as {name!r}; it is among the scenes that you can choose")

    async def _on_scene(self, event: GuiEvent[GuiButtonGroupHandle]) -> None:
        if event.target.value == CHOOSE:
            await self.gallery.open(self._editor.scene_store)
        elif event.target.value == SAVE and self.saving is not None:
            self.saving.open(_file_name(self._editor.scene))
        elif event.target.value == DOWNLOAD:
            scene = self._editor.scene
            self._viewer_client.client.send_file_download(
                f"{_file_name(scene)}.yaml", scene.dumps().encode(), save_immediately=True
            )
            self._editor.mark_saved()
            self._tell("the scene's file is among your downloads")

    async def _on_changes(self, event: GuiEvent[GuiButtonGroupHandle]) -> None:
        undoes = event.target.value == UNDO
        self._ask(self._editor.undo() if undoes else self._editor.redo())

    async def _on_moves(self, event: GuiEvent[GuiCheckboxHandle]) -> None:
        words = MOVING if event.target.value else HINT
        self._hint.content = block(f"<small>{words}</small>")

    async def _on_thing(self, event: GuiEvent[GuiDropdownHandle[str]]) -> None:
        if event.client is not None:
            name = event.target.value
            self._chosen = "" if name == NOTHING else name

    async def _on_new(self, event: GuiEvent[GuiButtonGroupHandle]) -> None:
        thing, snapshot = BODY_TEMPLATES.get(event.target.value), self._latest
        if thing is None or snapshot is None:
            return
        camera = self._viewer_client.client.camera
        place = free_position(snapshot, thing, *ground_at_center(camera.position, camera.look_at))
        if place is None:
            self._tell("there is no room for it around the middle of the picture", is_wrong=True)
            return
        name = self._editor.free_name(thing["name"])
        # it is put where there is room; mostly it is to be elsewhere
        self.moves.value = True  # type: ignore[misc]
        self._ask(self._editor.add_body(thing | {"name": name, "position": place}), name)

    def _on_settings(self, values: dict[str, Any]) -> "Future[ChangeResult]":
        future = self._editor.change_settings(values)
        self._ask(future)
        return future

    async def _on_apply(self, _event: Any) -> None:
        form = self._form
        if form is None:
            return
        try:
            place, values = form.changes()
        except ChangeError as error:
            self._problems = error.problems
            return
        name = form.body.name
        if not values and place:
            future = self._editor.move_body(name, **place)
        else:
            if place:
                values["position"] = (place["x"], place["y"])
                values["heading_deg"] = place["heading_deg"]
            future = self._editor.change_body(name, values)
        self._ask(future, of_form=True)

    async def _on_delete(self, _event: GuiEvent[GuiButtonHandle]) -> None:
        if self._chosen:
            self._ask(self._editor.remove_body(self._chosen))

    async def _on_upload(self, event: GuiEvent[GuiUploadButtonHandle]) -> None:
        file = take_file(event)
        try:
            text = file.content.decode()
        except UnicodeDecodeError:
            self._tell(f"{file.name[:80]}: expected a text file, YAML", is_wrong=True)
            return
        self._chosen = ""
        self._ask(await asyncio.to_thread(self._editor.load, text, file.name[:80]))

    async def _on_offer(self, event: GuiEvent[GuiButtonGroupHandle]) -> None:
        if event.target.value == RESTORE:
            self._ask(self._editor.restore_unsaved())
        elif event.target.value == DISCARD:
            self._editor.discard_unsaved()

    def _tell(self, message: str, *, is_wrong: bool = False) -> None:
        self._message, self._is_wrong = message, is_wrong
        if is_wrong:
            client = self._viewer_client.client
            client.add_notification("That didn't work", message, auto_close_seconds=8.0)

    def _ask(
        self, future: "Future[ChangeResult]", then: str | None = None, *, of_form: bool = False
    ) -> None:
        """Says when it applies, or what is wrong; ``then`` is the body that is chosen then."""
        notify_stall(self._viewer_client.client, self._editor.stall, future)

        def tell(done: "Future[ChangeResult]") -> None:
            if done.cancelled():
                return
            error = done.exception()
            if error is None:
                outcome = done.result()
                self._chosen = self._chosen if then is None else then
                self._problems, self._is_applied = (), self._is_applied or of_form
                self._tell(f"{outcome.label}: {outcome}" if outcome.label else str(outcome))
            else:
                if of_form and isinstance(error, ChangeError):
                    self._problems = error.problems
                self._tell(message_of(error), is_wrong=True)

        future.add_done_callback(tell)


def _file_name(scene: Scene) -> str:
    name = "".join(c if c.isalnum() or c in "-_" else "_" for c in scene.description.name)
    return name[:60].strip("_") or "scene"


def world_tab(editor: SceneEditor) -> TabKind:
    """The tab for the world."""
    return TabKind("World", lambda viewer_client: WorldTab(viewer_client, editor))

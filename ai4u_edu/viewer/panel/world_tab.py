"""The "World" tab: opens, saves and changes scenes, and edits bodies."""

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
from ai4u_edu.viewer.backend.reporting import report_errors
from ai4u_edu.viewer.panel.block_labels import WAITS, undo_line
from ai4u_edu.viewer.panel.body_form import BodyForm
from ai4u_edu.viewer.panel.gallery import Gallery, Load
from ai4u_edu.viewer.panel.html_parts import section
from ai4u_edu.viewer.panel.notify import notify_stall
from ai4u_edu.viewer.panel.save_window import SaveWindow
from ai4u_edu.viewer.panel.settings_form import SettingsForm
from ai4u_edu.viewer.panel.tabs import TabKind
from ai4u_edu.viewer.panel.uploads import limit_uploads, take_file
from ai4u_edu.viewer.panel.widgets import set_options, set_value
from ai4u_edu.viewer.scene.handles import Handles
from ai4u_edu.viewer.scene.new_things import BODY_TEMPLATES, free_position, ground_at_center
from ai4u_edu.viewer.viewer_client import ViewerClient
from ai4u_edu.world import BodyDescription

UNDO, REDO = "Undo", "Redo"
CHOOSE, SAVE, DOWNLOAD = "Choose a scene", "Save", "Download"
RESTORE, DISCARD = "Restore", "Discard"
NO_BODY = "choose one, or click on it"
BARE = section(kind="mark bare")
HINT_OFF = "Switch on <b>Move things</b>, then drag with the mouse what you like in the picture."
HINT_ON = "Drag anything in the picture; Escape puts it back. Click on it, and a knob turns it."


class WorldTab:
    """The "World" tab of one page.

    viser's event loop calls the event handlers, the viewer's thread calls :meth:`draw`, and the
    world's thread completes the changes. They share plain attributes, each replaced as a whole.

    Args:
        viewer_client: the page.
        editor: applies the changes.
    """

    def __init__(self, viewer_client: ViewerClient, editor: SceneEditor) -> None:
        gui = viewer_client.client.gui
        self.viewer_client, self._editor = viewer_client, editor
        self._chosen, self._message, self._is_wrong = "", "", False
        self._problems: tuple[Problem, ...] | None = None
        self.form: BodyForm | None = None
        self._is_applied = False
        self._shown: tuple[object, ...] = ()
        self._latest: Snapshot | None = None
        self.gallery = Gallery(viewer_client.client, self._open)
        self.saving: SaveWindow | None = None
        """The window to save the scene; None without a store."""
        if editor.scene_store is not None:
            client, store = viewer_client.client, editor.scene_store
            self.saving = SaveWindow(client, store, lambda: editor.scene, self._on_saved)
        self.handles = Handles(viewer_client, editor, self._choose_body, self._follow_change)
        self._unsaved_text = gui.add_html("", visible=False)
        self._unsaved_mark = gui.add_html(BARE, visible=False)
        self.unsaved_actions = gui.add_button_group("Unsaved", (RESTORE, DISCARD), visible=False)
        self.status = gui.add_html("")
        gui.add_html(BARE)
        words = (CHOOSE, DOWNLOAD) if self.saving is None else (CHOOSE, SAVE, DOWNLOAD)
        self.scene = gui.add_button_group("Scene", words)
        gui.add_html(BARE)
        self.changes = gui.add_button_group("Changes", (UNDO, REDO))
        self.settings = SettingsForm(
            viewer_client.client, "Scene's settings", self._settings, self._on_settings
        )
        self.drag_enabled = gui.add_checkbox("Move things", False)
        self._hint = gui.add_html(section(f"<small>{HINT_OFF}</small>"))
        self.body_list = gui.add_dropdown("Thing", (NO_BODY,))
        self.new = gui.add_button_group("Add", tuple(BODY_TEMPLATES))
        self._form_folder = gui.add_folder(None)
        self.delete = gui.add_button("Delete", visible=False)
        self.upload = gui.add_upload_button("Open a scene file", hint="A .yaml file")
        limit_uploads(viewer_client.client, 4 * MAX_SCENE_CHARS)  # no character takes more bytes
        self.unsaved_actions.on_click(self._on_unsaved)
        self.scene.on_click(self._on_scene)
        self.changes.on_click(self._on_changes)
        self.drag_enabled.on_update(self._on_drag_enabled)
        self.body_list.on_update(self._on_body)
        self.new.on_click(self._on_new)
        self.delete.on_click(self._on_delete)
        self.upload.on_upload(report_errors(self._on_upload))

    def draw(self, snapshot: Snapshot) -> None:
        """Show the scene and its bodies, if they have changed."""
        editor, self._latest = self._editor, snapshot
        self.handles.draw(snapshot, self._chosen, on=self.drag_enabled.value)
        unsaved = editor.recovery.unsaved
        self.settings.draw("scene", editor.version)
        waits, autosave = editor.waits_for_reset, editor.recovery.autosave
        problem = autosave.problem if autosave is not None else ""
        state = (editor.version, self._chosen, self._message, unsaved, waits, problem)
        if self._is_applied:
            self._shown = ()
        if state != self._shown:
            self._shown = state
            self._show(problem)
            for handle in (self._unsaved_text, self._unsaved_mark, self.unsaved_actions):
                handle.visible = unsaved is not None
            if unsaved is not None:
                text = f"<b>A scene from {escape(unsaved.when)} was never saved.</b>"
                self._unsaved_text.content = section(text)
        if self._problems is not None:
            problems, self._problems = self._problems, None
            if self.form is not None:
                self.form.explain(problems)

    # -- drawing; on the viewer's thread ---------------------------------------------------------

    def _show(self, problem: str) -> None:
        editor, description = self._editor, self._editor.state.description
        bodies = {body.name: body for body in description.bodies}
        set_options(self.body_list, (NO_BODY, *bodies))
        set_value(self.body_list, self._chosen if self._chosen in bodies else NO_BODY)
        self._show_form(bodies.get(self._chosen))
        role = "alert" if self._is_wrong else "status"
        style = "white-space: normal"
        message = escape(self._message).replace("\n", "<br>")
        lines = [
            f"<b>{escape(editor.title)}</b>",
            message and f'<span role="{role}" style="{style}">{message}</span>',
            f"<small>{WAITS}</small>" if editor.waits_for_reset else "",
            problem and f'<small role="alert" style="{style}">{escape(problem)}</small>',
            undo_line(editor),
        ]
        self.status.content = section("<br>".join(line for line in lines if line))

    def _show_form(self, body: BodyDescription | None) -> None:
        overwrite, self._is_applied = self._is_applied, False
        if self.form is not None and not self.form.show_body(body, overwrite=overwrite):
            self.form.remove()
            self.form = None
        if body is not None and self.form is None:
            with self._form_folder:
                self.form = BodyForm(self.viewer_client.client, body, self._on_apply)
        self.delete.visible = body is not None
        if body is not None:
            self.delete.label = f"Delete {body.name}"

    def _choose_body(self, name: str) -> None:
        self._chosen = name

    def _settings(self) -> list[Field]:
        return scene_form(self._editor.state.description)

    # -- events; in viser's event loop, one after the other --------------------------------------

    async def _open(self, load: Load) -> None:
        try:
            scene = await asyncio.to_thread(load)
        except AI4UError as error:
            self._show_message(str(error), is_wrong=True)
            return
        self._chosen = ""
        self._follow_change(self._editor.open(scene))

    def _on_saved(self, name: str) -> None:
        self._editor.recovery.mark_saved()
        self._show_message(
            f"the scene is saved as {name!r}; it is among the scenes that you can choose"
        )

    async def _on_scene(self, event: GuiEvent[GuiButtonGroupHandle]) -> None:
        if event.target.value == CHOOSE:
            await self.gallery.open(self._editor.scene_store)
        elif event.target.value == SAVE and self.saving is not None:
            self.saving.open(_file_name(self._editor.scene))
        elif event.target.value == DOWNLOAD:
            scene = self._editor.scene
            self.viewer_client.client.send_file_download(
                f"{_file_name(scene)}.yaml", scene.dumps().encode(), save_immediately=True
            )
            self._editor.recovery.mark_saved()
            self._show_message("the scene's file is among your downloads")

    async def _on_changes(self, event: GuiEvent[GuiButtonGroupHandle]) -> None:
        undoes = event.target.value == UNDO
        self._follow_change(self._editor.undo() if undoes else self._editor.redo())

    async def _on_drag_enabled(self, event: GuiEvent[GuiCheckboxHandle]) -> None:
        hint = HINT_ON if event.target.value else HINT_OFF
        self._hint.content = section(f"<small>{hint}</small>")

    async def _on_body(self, event: GuiEvent[GuiDropdownHandle[str]]) -> None:
        if event.client is not None:
            name = event.target.value
            self._chosen = "" if name == NO_BODY else name

    async def _on_new(self, event: GuiEvent[GuiButtonGroupHandle]) -> None:
        template, snapshot = BODY_TEMPLATES.get(event.target.value), self._latest
        if template is None or snapshot is None:
            return
        camera = self.viewer_client.client.camera
        center = ground_at_center(camera.position, camera.look_at)
        position = free_position(snapshot, template, *center)
        if position is None:
            self._show_message(
                "there is no room for it around the middle of the picture", is_wrong=True
            )
            return
        name = self._editor.free_name(template["name"])
        set_value(self.drag_enabled, True)  # because most new bodies are dragged next
        change = self._editor.add_body(template | {"name": name, "position": position})
        self._follow_change(change, name)

    def _on_settings(self, values: dict[str, Any]) -> "Future[ChangeResult]":
        future = self._editor.change_settings(values)
        self._follow_change(future)
        return future

    async def _on_apply(self, _event: Any) -> None:
        form = self.form
        if form is None:
            return
        try:
            pose, values = form.changes()
        except ChangeError as error:
            self._problems = error.problems
            return
        name = form.body.name
        if not values and pose:
            future = self._editor.move_body(name, **pose)
        else:
            if pose:
                values["position"] = (pose["x"], pose["y"])
                values["heading_deg"] = pose["heading_deg"]
            future = self._editor.change_body(name, values)
        self._follow_change(future, of_form=True)

    async def _on_delete(self, _event: GuiEvent[GuiButtonHandle]) -> None:
        if self._chosen:
            self._follow_change(self._editor.remove_body(self._chosen))

    async def _on_upload(self, event: GuiEvent[GuiUploadButtonHandle]) -> None:
        file = take_file(event)
        try:
            text = file.content.decode()
        except UnicodeDecodeError:
            self._show_message(f"{file.name[:80]}: expected a text file, YAML", is_wrong=True)
            return
        self._chosen = ""
        self._follow_change(await asyncio.to_thread(self._editor.load, text, file.name[:80]))

    async def _on_unsaved(self, event: GuiEvent[GuiButtonGroupHandle]) -> None:
        if event.target.value == RESTORE:
            self._follow_change(self._editor.recovery.restore())
        elif event.target.value == DISCARD:
            self._editor.recovery.discard()

    def _show_message(self, message: str, *, is_wrong: bool = False) -> None:
        self._message, self._is_wrong = message, is_wrong
        if is_wrong:
            client = self.viewer_client.client
            client.add_notification("That didn't work", message, auto_close_seconds=8.0)

    def _follow_change(
        self, future: "Future[ChangeResult]", then: str | None = None, *, of_form: bool = False
    ) -> None:
        """Show the result of a change.

        Args:
            future: the change's result.
            then: name of the body to choose after success.
            of_form: True if problems belong into the body's form.
        """
        notify_stall(self.viewer_client.client, self._editor.stall, future)

        def on_done(done: "Future[ChangeResult]") -> None:
            if done.cancelled():
                return
            error = done.exception()
            if error is None:
                result = done.result()
                self._chosen = self._chosen if then is None else then
                self._problems, self._is_applied = (), self._is_applied or of_form
                self._show_message(f"{result.label}: {result}" if result.label else str(result))
            else:
                if of_form and isinstance(error, ChangeError):
                    self._problems = error.problems
                self._show_message(message_of(error), is_wrong=True)

        future.add_done_callback(on_done)


def _file_name(scene: Scene) -> str:
    name = "".join(c if c.isalnum() or c in "-_" else "_" for c in scene.description.name)
    return name[:60].strip("_") or "scene"


def world_tab(editor: SceneEditor) -> TabKind:
    """Return the "World" tab."""
    return TabKind("World", lambda viewer_client: WorldTab(viewer_client, editor))

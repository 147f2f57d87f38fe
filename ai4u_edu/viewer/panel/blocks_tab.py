"""The "Blocks" tab: changes the blocks and the driver of the agent that a page shows."""

from concurrent.futures import Future
from html import escape
from typing import Any

from viser import GuiButtonGroupHandle, GuiButtonHandle, GuiDropdownHandle, GuiEvent

from ai4u_edu.agent.block_errors import message_of
from ai4u_edu.base.errors import AI4UError
from ai4u_edu.base.parameters import Problem
from ai4u_edu.editing import ChangeError, ChangeResult, SceneEditor
from ai4u_edu.editing.blocks import block_at, is_enabled
from ai4u_edu.editing.forms import Field
from ai4u_edu.editing.plain import BlockPath
from ai4u_edu.editing.scene_names import SceneNames
from ai4u_edu.editing.settings import agent_form
from ai4u_edu.editing.suggestion import suggest_block
from ai4u_edu.snapshot import Snapshot
from ai4u_edu.viewer.panel.block_form import BlockForm
from ai4u_edu.viewer.panel.block_labels import (
    ADD,
    BARE,
    KINDS,
    NO_BLOCK,
    block_lines,
    edit_status,
    selected_button_mark,
    type_labels,
)
from ai4u_edu.viewer.panel.notify import notify_stall
from ai4u_edu.viewer.panel.settings_form import SettingsForm
from ai4u_edu.viewer.panel.tabs import TabKind
from ai4u_edu.viewer.panel.widgets import set_options, set_value
from ai4u_edu.viewer.viewer_client import ViewerClient

UNDO, REDO = "Undo", "Redo"
ON, OFF, UP, DOWN, REMOVE = "On", "Off", "Up", "Down", "Remove"
BRING_BACK, FORGET = "Bring it back", "Forget it"


class BlocksTab:
    """The "Blocks" tab of one page.

    A block's form is created when the block is chosen.

    viser's event loop calls the event handlers, the viewer's thread calls :meth:`draw`, and the
    world's thread completes the changes. They share plain attributes, each replaced as a whole.

    Args:
        viewer_client: the page.
        editor: applies the changes.
    """

    def __init__(self, viewer_client: ViewerClient, editor: SceneEditor) -> None:
        gui = viewer_client.client.gui
        self._viewer_client, self._editor = viewer_client, editor
        self._kind, self._path, self.form = "sensors", None, None
        self._shown: tuple[object, ...] = ()
        self._message, self._problems, self._agent = "", None, viewer_client.agent
        self.unsaved_text = gui.add_html("", visible=False)
        self.unsaved_actions = gui.add_button_group("", (BRING_BACK, FORGET), visible=False)
        self.status = gui.add_html("")
        gui.add_html(BARE)
        self.changes = gui.add_button_group("Changes", (UNDO, REDO))
        self.driver = gui.add_dropdown("Driven by", ("",))
        self.settings = SettingsForm(
            viewer_client.client, "Agent's settings", self._settings, self._on_settings
        )
        self._kind_mark = gui.add_html(_kind_mark(self._kind))
        self.kind = gui.add_button_group("Blocks", tuple(KINDS))
        self.new = gui.add_dropdown("New", (ADD,))
        self.add = gui.add_button("Add", disabled=True)
        self.block = gui.add_dropdown("Block", (NO_BLOCK,))
        self._actions_mark = gui.add_html(BARE, visible=False)
        self.block_actions = gui.add_button_group(
            "This block", (OFF, UP, DOWN, REMOVE), visible=False
        )
        self._form_folder = gui.add_folder(None)
        self._type_names: dict[str, str] = {}
        self._paths: dict[str, BlockPath] = {}
        self._drivers: dict[str, str] = {}
        self.unsaved_actions.on_click(self._on_unsaved)
        self.changes.on_click(self._on_changes)
        self.driver.on_update(self._on_driver)
        self.kind.on_click(self._on_kind)
        self.block.on_update(self._on_block)
        self.block_actions.on_click(self._on_block_action)
        self.new.on_update(self._on_new)
        self.add.on_click(self._on_add)

    _path: BlockPath | None
    form: BlockForm | None
    _problems: tuple[Problem, ...] | None

    def draw(self, snapshot: Snapshot) -> None:
        """Show the agent's blocks, if they have changed."""
        editor, agent = self._editor, self._viewer_client.agent
        if not any(each.id == agent for each in snapshot.agents):
            return
        if agent != self._agent:
            self._agent, self._path = agent, None
        brains = next(each.brain for each in snapshot.agents if each.id == agent)
        state = (editor.version, agent, self._kind, self._path, brains)
        if state != self._shown:
            try:
                self._show(agent)
            except AI4UError:
                return  # the editor has another scene already; wait for its snapshot
            self._shown = state
        self.settings.draw(agent, editor.version)
        if self._problems is not None and self.form is not None:
            problems, self._problems = self._problems, None
            self.form.explain(problems)
            if not problems:
                self.form.show_message(self._message)
        html = edit_status(
            editor, next(each for each in snapshot.agents if each.id == agent), self._message
        )
        if self.status.content != html:
            self.status.content = html
        self._show_unsaved()

    # -- drawing; on the viewer's thread ---------------------------------------------------------

    def _show(self, agent_id: str) -> None:
        state = self._editor.state
        agent = state.agent(agent_id)
        self._kind_mark.content = _kind_mark(self._kind)
        self._paths = block_lines(agent, self._kind)
        if self._path not in self._paths.values():
            self._path = None
        chosen = next((t for t, path in self._paths.items() if path == self._path), NO_BLOCK)
        set_options(self.block, (NO_BLOCK, *self._paths))
        set_value(self.block, chosen)
        self._type_names = type_labels(self._kind)
        set_options(self.new, (ADD, *self._type_names))
        if self.new.value not in self._type_names:
            set_value(self.new, ADD)
        self.add.disabled = self.new.value not in self._type_names
        offered = self._editor.drivers(agent_id)
        self._drivers = {each.title: each.name for each in reversed(offered)}
        drives = self._editor.driver_of(agent_id)
        title = next((t for t, name in self._drivers.items() if name == drives), "somebody else")
        names = tuple(dict.fromkeys((*(each.title for each in offered), title)))
        set_options(self.driver, names)
        set_value(self.driver, title)
        self._show_form(state, agent, agent_id)

    def _show_form(self, state: Any, agent: Any, agent_id: str) -> None:
        path = self._path
        block = None if path is None else block_at(agent, path)
        if self.form is not None and not self.form.show_block(block, path):
            self.form.remove()
            self.form = None
        if block is not None and path is not None:
            if self.form is None:
                with self._form_folder:
                    names = SceneNames(state, agent_id)
                    client = self._viewer_client.client
                    self.form = BlockForm(client, block, path, names, self._on_apply)
            self.block_actions.options = (OFF if is_enabled(path, block) else ON, UP, DOWN, REMOVE)
        self._actions_mark.visible = self.block_actions.visible = path is not None and isinstance(
            path[-1], int
        )

    def _show_unsaved(self) -> None:
        unsaved = self._editor.recovery.unsaved
        if (unsaved is not None) != self.unsaved_text.visible:
            self.unsaved_text.visible = self.unsaved_actions.visible = unsaved is not None
        if unsaved is not None:
            text = f"<b>An unsaved scene from {escape(unsaved.when)} is there.</b>"
            self.unsaved_text.content = f'<div class="ai4u">{text}</div>'

    def _settings(self) -> list[Field]:
        return agent_form(self._editor.state.agent(self._viewer_client.agent))

    # -- events; in viser's event loop, one after the other --------------------------------------

    async def _on_apply(self, _event: Any) -> None:
        form, path = self.form, self._path
        if form is None or path is None:
            return
        try:
            values = form.changes()
        except ChangeError as error:
            self._problems = error.problems
            return
        self._follow_change(
            self._editor.change_block(self._viewer_client.agent, path, values), of_form=True
        )

    def _on_settings(self, values: dict[str, Any]) -> "Future[ChangeResult]":
        future = self._editor.change_agent(self._viewer_client.agent, values)
        self._follow_change(future)
        return future

    async def _on_block_action(self, event: GuiEvent[GuiButtonGroupHandle]) -> None:
        agent, path = self._viewer_client.agent, self._path
        if path is None or not isinstance(path[-1], int):
            return  # a part of a block, such as a brain's controller, is in no list
        match event.target.value:
            case "On" | "Off" as word:
                self._follow_change(self._editor.switch_block(agent, path, word == ON))
            case "Up" | "Down" as word:
                by = -1 if word == UP else 1
                *above, index = path
                future = self._editor.move_block(agent, path, by)
                self._follow_change(future, (*above, max(0, int(index) + by)))
            case "Remove":
                self._follow_change(self._editor.remove_block(agent, path))

    async def _on_add(self, _event: GuiEvent[GuiButtonHandle]) -> None:
        name, agent, state = self._type_names.get(self.new.value), self._viewer_client.agent, None
        if name is None:
            return
        state = self._editor.state
        path, count = (self._kind,), len(state.agent(agent).get(self._kind, ()))
        future = self._editor.add_block(agent, path, suggest_block(state, agent, name))
        self._follow_change(future, (*path, count))

    async def _on_changes(self, event: GuiEvent[GuiButtonGroupHandle]) -> None:
        undoes = event.target.value == UNDO
        self._follow_change(self._editor.undo() if undoes else self._editor.redo())

    async def _on_driver(self, event: GuiEvent[GuiDropdownHandle[str]]) -> None:
        name = self._drivers.get(event.target.value)
        if event.client is not None and name is not None:
            self._shown = ()  # if the change fails, the dropdown shows the current driver again
            self._follow_change(self._editor.set_driver(self._viewer_client.agent, name))

    async def _on_kind(self, event: GuiEvent[GuiButtonGroupHandle]) -> None:
        self._kind = KINDS.get(event.target.value, self._kind)

    async def _on_block(self, event: GuiEvent[GuiDropdownHandle[str]]) -> None:
        if event.client is not None:
            self._path = self._paths.get(event.target.value)

    async def _on_new(self, event: GuiEvent[GuiDropdownHandle[str]]) -> None:
        self.add.disabled = event.target.value not in self._type_names

    async def _on_unsaved(self, event: GuiEvent[GuiButtonGroupHandle]) -> None:
        if event.target.value == BRING_BACK:
            self._follow_change(self._editor.recovery.restore())
        else:
            self._editor.recovery.discard()

    def _follow_change(
        self,
        future: "Future[ChangeResult]",
        then: BlockPath | None = None,
        *,
        of_form: bool = False,
    ) -> None:
        """Show the result of a change.

        Args:
            future: the change's result.
            then: path of the block to show after success.
            of_form: True if problems belong into the block's form.
        """
        notify_stall(self._viewer_client.client, self._editor.stall, future)

        def on_done(done: "Future[ChangeResult]") -> None:
            error = None if done.cancelled() else done.exception()
            if error is None and not done.cancelled():
                result = done.result()
                self._message = f"{result.label}: {result}" if result.label else str(result)
                self._problems = ()
                self._path = then or self._path
            elif isinstance(error, ChangeError) and of_form:
                self._message, self._problems = (
                    "That can't be; see what is said below.",
                    error.problems,
                )
            elif error is not None:
                self._message = message_of(error)

        future.add_done_callback(on_done)


def _kind_mark(kind: str) -> str:
    return selected_button_mark(1 + list(KINDS.values()).index(kind))


def blocks_tab(editor: SceneEditor) -> TabKind:
    """Return the "Blocks" tab."""
    return TabKind("Blocks", lambda viewer_client: BlocksTab(viewer_client, editor))

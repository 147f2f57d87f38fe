"""A button that unfolds a form for settings, on one page."""

from collections.abc import Callable
from concurrent.futures import Future
from typing import Any

from viser import ClientHandle, GuiButtonHandle, GuiEvent

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.base.parameters import Problem
from ai4u_edu.editing import ChangeError, ChangeResult
from ai4u_edu.editing.forms import Field
from ai4u_edu.editing.settings import problems_in_agent_form
from ai4u_edu.viewer.panel.field_form import FieldForm
from ai4u_edu.viewer.panel.html_parts import section

OPEN, CLOSE = "▸", "▾"
FOLD = section(kind="fold mark")
"""Marker before a button that unfolds something, which the style sheet draws differently."""


class SettingsForm:
    """A folded form for settings; the form is created when it is unfolded.

    Args:
        client: the page; the form is added to the current container of its ``gui``.
        name: label of the button.
        fields: returns the settings with their current values.
        on_values: called with the changed values, in viser's event loop.
    """

    def __init__(
        self,
        client: ClientHandle,
        name: str,
        fields: Callable[[], list[Field]],
        on_values: Callable[[dict[str, Any]], "Future[ChangeResult]"],
    ) -> None:
        self._client, self._name = client, name
        self._fields, self._on_values = fields, on_values
        self._is_open = False
        self._shown: tuple[object, object] | None = None
        self._problems: tuple[Problem, ...] | None = None
        self.form: FieldForm | None = None
        client.gui.add_html(FOLD)
        self.button: GuiButtonHandle = client.gui.add_button(f"{OPEN} {name}")
        self._folder = client.gui.add_folder(None)
        self.button.on_click(self._on_button)

    def draw(self, owner: object, version: object) -> None:
        """Show the form while it is unfolded.

        Args:
            owner: identifies the thing that has the settings; another one needs another form.
            version: changes whenever the settings may have changed.
        """
        wanted = (owner, version) if self._is_open else None
        if wanted != self._shown:
            self._build(owner)
            self._shown = wanted
        if self._problems is not None and self.form is not None:
            problems, self._problems = self._problems, None
            self.form.explain(problems)

    def _build(self, owner: object) -> None:
        try:
            fields = self._fields() if self._is_open else None
        except AI4UError:
            fields = None  # the editor has another scene already
        same = self._shown is not None and self._shown[0] == owner
        if self.form is not None and not (same and fields and self.form.show_fields(fields)):
            self.form.remove()
            self.form = None
        if fields is not None and self.form is None:
            with self._folder:
                self.form = FieldForm(self._client, "", fields, self._on_apply)

    async def _on_button(self, _event: GuiEvent[GuiButtonHandle]) -> None:
        self._is_open = not self._is_open
        self.button.label = f"{CLOSE if self._is_open else OPEN} {self._name}"

    async def _on_apply(self, _event: Any) -> None:
        if self.form is None:
            return
        try:
            values = self.form.changes()
        except ChangeError as error:
            self._problems = error.problems
            return
        self._on_values(values).add_done_callback(self._on_done)

    def _on_done(self, done: "Future[ChangeResult]") -> None:
        error = None if done.cancelled() else done.exception()
        if isinstance(error, ChangeError):
            self._problems = tuple(problems_in_agent_form(error.problems))
        elif error is None:
            self._problems = ()

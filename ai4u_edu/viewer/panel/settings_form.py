"""A button that opens a form for settings, on one page; and what becomes of it."""

from collections.abc import Callable, Iterable
from concurrent.futures import Future
from typing import Any

from viser import ClientHandle, GuiButtonHandle, GuiEvent

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.base.parameters import Problem
from ai4u_edu.editing import ChangeError, ChangeResult
from ai4u_edu.editing.forms import Field
from ai4u_edu.viewer.panel.field_form import FieldForm
from ai4u_edu.viewer.panel.readings import block

OPEN, CLOSE = "▸", "▾"
FOLD = block(kind="fold mark")
"""Before a button that opens something: it is not to look like one that does something."""


class SettingsForm:
    """Made when somebody asks for it: until then it is a button.

    Args:
        client: the page; it comes to stand where its ``gui`` is.
        name: on the button.
        fields: the settings as they are now.
        on_values: called with what a person has made other than it was, in viser's loop.
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
        self._place = client.gui.add_folder(None)
        self.button.on_click(self._on_button)

    def draw(self, whose: object, version: object) -> None:
        """Shows the form, or no longer.

        Args:
            whose: settings they are; those of another have a form of their own.
            version: another one where they may be other than before.
        """
        wanted = (whose, version) if self._is_open else None
        if wanted != self._shown:
            self._build(whose)
            self._shown = wanted
        if self._problems is not None and self.form is not None:
            problems, self._problems = self._problems, None
            self.form.explain(problems)

    def _build(self, whose: object) -> None:
        try:
            fields = self._fields() if self._is_open else None
        except AI4UError:
            fields = None  # another scene has just come
        same = self._shown is not None and self._shown[0] == whose
        if self.form is not None and not (same and fields and self.form.shows(fields)):
            self.form.remove()
            self.form = None
        if fields is not None and self.form is None:
            with self._place:
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
        self._on_values(values).add_done_callback(self._tell)

    def _tell(self, done: "Future[ChangeResult]") -> None:
        error = None if done.cancelled() else done.exception()
        if isinstance(error, ChangeError):
            self._problems = tuple(_in_the_form(error.problems))
        elif error is None:
            self._problems = ()


def _in_the_form(problems: Iterable[Problem]) -> Iterable[Problem]:
    """A brain's parameter stands in the form as if it were the agent's own."""
    for path, text in problems:
        yield Problem(path[-1:] if path[:1] == ("brains",) else path, text)

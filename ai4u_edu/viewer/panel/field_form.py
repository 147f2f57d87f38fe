"""A form with a box for each parameter of something, on one page."""

from collections.abc import Callable, Coroutine, Iterable
from html import escape
from typing import Any

from viser import (
    ClientHandle,
    GuiCheckboxHandle,
    GuiDropdownHandle,
    GuiFolderHandle,
    GuiHtmlHandle,
    GuiNumberHandle,
    GuiTextHandle,
)

from ai4u_edu.base.parameters import Problem, format_path
from ai4u_edu.editing import ChangeError
from ai4u_edu.editing.forms import Field
from ai4u_edu.viewer.panel.html_parts import section

Box = GuiCheckboxHandle | GuiDropdownHandle[str] | GuiNumberHandle[int] | GuiTextHandle

MAX_BOX_CHARS = 28
"""Longest text that fits into a box of one line."""


class FieldForm:
    """A form with a box for each parameter; a problem is shown right below its box.

    Args:
        client: the page; the form is added to the current container of its ``gui``.
        heading: HTML above the boxes.
        fields: the parameters.
        on_apply: called when the form is submitted.
    """

    def __init__(
        self,
        client: ClientHandle,
        heading: str,
        fields: list[Field],
        on_apply: Callable[[Any], Coroutine[Any, Any, None]],
    ) -> None:
        self._gui = client.gui
        self.fields = fields
        self.boxes: dict[str, Box] = {}
        self.problem_texts: dict[str, GuiHtmlHandle] = {}
        self._form = self._gui.add_form(None)
        self._form.on_submit(on_apply)
        self._more: GuiFolderHandle | None = None
        with self._form:
            if heading:
                self._gui.add_html(section(heading), order=-1.0)
            for index, field in enumerate(self.fields):
                if not field.is_common:
                    self.boxes[field.name] = self._box(field, index)
            if any(field.is_common for field in self.fields):
                more = self._gui.add_folder("More", expand_by_default=False, order=1000.0)
                self._more = more
                with more:
                    for index, field in enumerate(self.fields):
                        if field.is_common:
                            self.boxes[field.name] = self._box(field, index)
            self.message = self._gui.add_html("", order=1999.0)
            self.apply = self._gui.add_button("Apply", order=2000.0, color="blue")
        self.apply.on_click(on_apply)

    def show_fields(self, fields: list[Field]) -> bool:
        """Show the parameters' current values; return False if they need another form."""
        if fields == self.fields:
            return True
        if [_box_key(each) for each in fields] != [_box_key(each) for each in self.fields]:
            return False
        self.fields = fields
        for field in fields:
            box: Any = self.boxes[field.name]
            box.value = _box_value(field, box.value)
        self.explain(())
        return True

    def show_message(self, text: str) -> None:
        """Show a message above the button."""
        self.message.content = section(f"<small>{escape(text)}</small>") if text else ""

    def changes(self) -> dict[str, Any]:
        """Read the values that differ from the parameters', as plain data.

        Raises:
            ChangeError: a box has an invalid value.
        """
        values: dict[str, Any] = {}
        problems: list[Problem] = []
        for field in self.fields:
            entered = self.boxes[field.name].value
            if entered == (bool(field.value) if field.kind == "switch" else field.shown):
                continue
            try:
                value = field.read(entered)
            except ChangeError as error:
                problems += error.problems
                continue
            if value != field.value and (value, field.value) != (None, ""):
                values[field.name] = value
        if problems:
            raise ChangeError(problems)
        return values

    def explain(self, problems: Iterable[Problem]) -> None:
        """Show each problem below its box, and all of them above the button."""
        texts: dict[str, list[str]] = {}
        rest = []
        for problem in problems:
            name = str(problem.path[0]) if problem.path else ""
            if name in self.boxes:
                inside = format_path(problem.path[1:])
                texts.setdefault(name, []).append(
                    f"{inside}: {problem.text}" if inside else problem.text
                )
            else:
                rest.append(str(problem))
        for name in self.problem_texts.keys() - texts.keys():
            self.problem_texts.pop(name).remove()
        for index, field in enumerate(self.fields):
            if field.name in texts:
                self._show_problem(field, index, "; ".join(texts[field.name]))
        # again above the button: the box may be scrolled away or in the folded part
        labelled = [
            f"{field.label}: {'; '.join(texts[field.name])}"
            for field in self.fields
            if field.name in texts
        ]
        text = "; ".join((*rest, *labelled))
        self.message.content = section(f"<strong>{escape(text)}</strong>") if text else ""

    def remove(self) -> None:
        """Remove the form from the page."""
        self._form.remove()

    def _show_problem(self, field: Field, index: int, text: str) -> None:
        html = section(f'<strong role="alert">{escape(text)}</strong>')
        if field.name in self.problem_texts:
            self.problem_texts[field.name].content = html
            return
        with self._more if field.is_common and self._more else self._form:
            self.problem_texts[field.name] = self._gui.add_html(html, order=index + 0.5)

    def _box(self, field: Field, index: int) -> Box:
        gui, order = self._gui, float(index)
        hint = field.hint or None
        match field.kind:
            case "switch":
                on = bool(field.value)
                return gui.add_checkbox(field.label, on, hint=hint, order=order)
            case "choice":
                choices = tuple(str(each) for each in field.choices)
                shown = field.shown
                if shown not in choices:
                    choices = (shown, *choices)
                return gui.add_dropdown(
                    field.label, choices, initial_value=shown, hint=hint, order=order
                )
            case "whole" if isinstance(field.value, int):
                # without its bounds: the box would clip values that are out of range silently
                return gui.add_number(field.label, field.value, step=1, hint=hint, order=order)
            case _:
                # a number box would round to the number of digits of the previous value
                is_long = field.kind == "text" and len(field.shown) > MAX_BOX_CHARS
                return gui.add_text(
                    field.label, field.shown, multiline=is_long, hint=hint, order=order
                )


def _box_key(field: Field) -> tuple[object, ...]:
    """Return all properties of a field, except the value, that its box depends on."""
    return field.name, field.kind, field.choices, field.value is None


def _box_value(field: Field, before: Any) -> Any:
    """Return a field's value in the type of its box."""
    if field.kind == "switch":
        return bool(field.value)
    return field.value if isinstance(before, int) else field.shown

"""A form with a box for each parameter, on one page."""

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

from ai4u_edu.base.parameters import Problem, dotted
from ai4u_edu.editing import ChangeError
from ai4u_edu.editing.forms import Field
from ai4u_edu.viewer.panel.readings import block as paragraph

Box = GuiCheckboxHandle | GuiDropdownHandle[str] | GuiNumberHandle[int] | GuiTextHandle

LINE = 28
"""Characters that fit into a box; longer text gets several lines."""


class FieldForm:
    """A box for each parameter; what is wrong stands right below the box that it is about.

    Args:
        client: the page; the form comes to stand where its ``gui`` is.
        heading: what stands above, as HTML.
        fields: the parameters.
        on_apply: called when the form is handed in.
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
        self._complaints: dict[str, GuiHtmlHandle] = {}
        self._form = self._gui.add_form(None)
        self._form.on_submit(on_apply)
        self._more: GuiFolderHandle | None = None
        with self._form:
            if heading:
                self._gui.add_html(paragraph(heading), order=-1.0)
            for place, field in enumerate(self.fields):
                if not field.is_common:
                    self.boxes[field.name] = self._box(field, place)
            if any(field.is_common for field in self.fields):
                more = self._gui.add_folder("More", expand_by_default=False, order=1000.0)
                self._more = more
                with more:
                    for place, field in enumerate(self.fields):
                        if field.is_common:
                            self.boxes[field.name] = self._box(field, place)
            self._told = self._gui.add_html("", order=1999.0)
            self.apply = self._gui.add_button("Apply", order=2000.0, color="blue")
        self.apply.on_click(on_apply)

    def shows(self, fields: list[Field]) -> bool:
        """Shows the parameters as they are now, if they are still those whose form this is."""
        if fields == self.fields:
            return True
        if [_sort_of(each) for each in fields] != [_sort_of(each) for each in self.fields]:
            return False
        self.fields = fields
        for field in fields:
            box: Any = self.boxes[field.name]
            box.value = _of_its_kind(field, box.value)
        self.explain(())
        return True

    def tell(self, text: str) -> None:
        """Says something above the button."""
        self._told.content = paragraph(f"<small>{escape(text)}</small>") if text else ""

    def changes(self) -> dict[str, Any]:
        """What a person has written that is other than it was, as plain data.

        Raises:
            ChangeError: some of it can't be read at all.
        """
        values: dict[str, Any] = {}
        problems: list[Problem] = []
        for field in self.fields:
            said = self.boxes[field.name].value
            if said == (bool(field.value) if field.kind == "switch" else field.shown):
                continue
            try:
                value = field.read(said)
            except ChangeError as error:
                problems += error.problems
                continue
            if value != field.value and (value, field.value) != (None, ""):
                values[field.name] = value
        if problems:
            raise ChangeError(problems)
        return values

    def explain(self, problems: Iterable[Problem]) -> None:
        """Says what is wrong, each beside its box; above the button what belongs to none."""
        told: dict[str, list[str]] = {}
        rest = []
        for problem in problems:
            name = str(problem.path[0]) if problem.path else ""
            if name in self.boxes:
                inside = dotted(problem.path[1:])
                told.setdefault(name, []).append(
                    f"{inside}: {problem.text}" if inside else problem.text
                )
            else:
                rest.append(str(problem))
        for name in self._complaints.keys() - told.keys():
            self._complaints.pop(name).remove()
        for place, field in enumerate(self.fields):
            if field.name in told:
                self._complain(field, place, "; ".join(told[field.name]))
        # said again here: the box may be out of sight, or folded away
        wrong = [
            f"{field.label}: {'; '.join(told[field.name])}"
            for field in self.fields
            if field.name in told
        ]
        text = "; ".join((*rest, *wrong))
        self._told.content = paragraph(f"<strong>{escape(text)}</strong>") if text else ""

    def remove(self) -> None:
        """Takes it off the page."""
        self._form.remove()

    def _complain(self, field: Field, place: int, text: str) -> None:
        html = paragraph(f'<strong role="alert">{escape(text)}</strong>')
        if field.name in self._complaints:
            self._complaints[field.name].content = html
            return
        with self._more if field.is_common and self._more else self._form:
            self._complaints[field.name] = self._gui.add_html(html, order=place + 0.5)

    def _box(self, field: Field, place: int) -> Box:
        gui, order = self._gui, float(place)
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
                # without its bounds: the box would cut what is out of range, without a word
                return gui.add_number(field.label, field.value, step=1, hint=hint, order=order)
            case _:
                # a box for numbers would round what has more digits than the value before
                is_long = field.kind == "text" and len(field.shown) > LINE
                return gui.add_text(
                    field.label, field.shown, multiline=is_long, hint=hint, order=order
                )


def _sort_of(field: Field) -> tuple[object, ...]:
    """What a box is made for; only its value can change."""
    return field.name, field.kind, field.choices, field.value is None


def _of_its_kind(field: Field, before: Any) -> Any:
    """A field's value as its box takes it."""
    if field.kind == "switch":
        return bool(field.value)
    return field.value if isinstance(before, int) else field.shown

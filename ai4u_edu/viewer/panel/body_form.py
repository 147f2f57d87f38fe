"""The form for one body, on one page."""

from collections.abc import Callable, Coroutine, Iterable
from html import escape
from typing import Any

from viser import ClientHandle, GuiDropdownHandle, GuiTextHandle

from ai4u_edu.base.parameters import Problem
from ai4u_edu.editing.thing_form import field_of_problem, pose_and_changes, thing_form
from ai4u_edu.viewer.panel.html_parts import section
from ai4u_edu.world import BodyDescription

Box = GuiDropdownHandle[str] | GuiTextHandle


class BodyForm:
    """A form with a body's most used properties; the others are changed in the scene file.

    Args:
        client: the page; the form is added to the current container of its ``gui``.
        body: the body's description in the scene.
        on_apply: called when the form is submitted.
    """

    def __init__(
        self,
        client: ClientHandle,
        body: BodyDescription,
        on_apply: Callable[[Any], Coroutine[Any, Any, None]],
    ) -> None:
        gui = client.gui
        self.body, self.fields = body, thing_form(body)
        self.boxes: dict[str, Box] = {}
        self._form = gui.add_form(None)
        self._form.on_submit(on_apply)
        with self._form:
            for field in self.fields:
                if field.kind == "choice":
                    choices = tuple(map(str, field.choices))
                    self.boxes[field.name] = gui.add_dropdown(
                        field.label, choices, initial_value=field.shown
                    )
                else:
                    self.boxes[field.name] = gui.add_text(field.label, field.shown)
            self.message = gui.add_html("")
            self.apply = gui.add_button("Apply", color="blue")
        self.apply.on_click(on_apply)

    def show_body(self, body: BodyDescription | None, *, overwrite: bool) -> bool:
        """Show a body's current values; return False if the body needs another form.

        Args:
            body: the body to show.
            overwrite: True after the form was applied; else boxes keep what a person has typed,
                unless the body's value has changed.
        """
        if body is None or body.name != self.body.name:
            return False
        if body == self.body and not overwrite:
            return True
        new_fields = thing_form(body)
        if [each.name for each in new_fields] != [each.name for each in self.fields]:
            return False
        for old, new in zip(self.fields, new_fields, strict=True):
            box: Any = self.boxes[new.name]
            if overwrite or old.value != new.value:
                box.value = new.shown
        self.body, self.fields = body, new_fields
        self.explain(())
        return True

    def changes(self) -> tuple[dict[str, Any], dict[str, Any]]:
        """Read the values that differ from the body's.

        Returns:
            The new pose as arguments of ``move_body``, {} if it is unchanged; and all other
            changes, as fields of the body's description.

        Raises:
            ChangeError: a box has an invalid value.
        """
        entered = {
            field.name: self.boxes[field.name].value
            for field in self.fields
            if self.boxes[field.name].value != field.shown
        }
        return pose_and_changes(self.body, entered)

    def explain(self, problems: Iterable[Problem]) -> None:
        """Show problems above the button, each with the label of its box."""
        text = "; ".join(self._describe(problem) for problem in problems)
        html = f'<strong role="alert">{escape(text)}</strong>'
        self.message.content = section(html) if text else ""

    def remove(self) -> None:
        """Remove the form from the page."""
        self._form.remove()

    def _describe(self, problem: Problem) -> str:
        name = field_of_problem(self.body, problem.path)
        label = next((each.label for each in self.fields if each.name == name), "")
        return f"{label}: {problem.text}" if label else str(problem)

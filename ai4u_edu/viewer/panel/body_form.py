"""The form for one body, on one page."""

import math
from collections.abc import Callable, Coroutine, Iterable, Mapping
from html import escape
from typing import Any

from viser import ClientHandle, GuiDropdownHandle, GuiTextHandle

from ai4u_edu.base.colors import PALETTE
from ai4u_edu.base.parameters import Problem
from ai4u_edu.editing import ChangeError
from ai4u_edu.editing.forms import NONE_LABEL, Field
from ai4u_edu.viewer.panel.html_parts import section
from ai4u_edu.world import BodyDescription, BoxShape, CapsuleShape, CircleShape, SegmentShape

KINDS = {
    "static": "stands still",
    "dynamic": "can be pushed",
    "kinematic": "moves, can't be pushed",
}
"""Labels of the kinds of bodies."""
POSE_FIELDS = ("x", "y", "heading_deg")
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
        self.body, self.fields = body, fields(body)
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
        new_fields = fields(body)
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
        values: dict[str, Any] = {}
        for field in self.fields:
            text = self.boxes[field.name].value
            if text != field.shown:
                values[field.name] = _read(field, text)
        pose = {name: values.pop(name) for name in POSE_FIELDS if name in values}
        if pose:
            (x, y), heading = self.body.position, self.body.heading_deg
            pose = {"x": x, "y": y, "heading_deg": heading} | pose
        lengths = {name: values.pop(name) for name in _lengths(self.body) if name in values}
        if lengths:
            values["shape"] = _resized_shape(self.body, lengths)
        return pose, values

    def explain(self, problems: Iterable[Problem]) -> None:
        """Show problems above the button, each with the label of its box."""
        text = "; ".join(self._describe(problem) for problem in problems)
        html = f'<strong role="alert">{escape(text)}</strong>'
        self.message.content = section(html) if text else ""

    def remove(self) -> None:
        """Remove the form from the page."""
        self._form.remove()

    def _describe(self, problem: Problem) -> str:
        lengths = tuple(_lengths(self.body))
        path = [part for part in problem.path if part not in {"shape", self.body.shape.type}]
        name = str(path[0]) if path else ""
        if name in {"size", "position"} and len(path) > 1:
            name = (lengths if name == "size" else POSE_FIELDS)[int(path[1])]
        label = next((each.label for each in self.fields if each.name == name), "")
        return f"{label}: {problem.text}" if label else str(problem)


def fields(body: BodyDescription) -> list[Field]:
    """Return the fields of a body's form, with their current values."""
    colours = (NONE_LABEL, *PALETTE)
    if body.colour is not None and body.colour not in PALETTE:
        colours = (*colours, body.colour)
    (x, y), kind = body.position, KINDS[body.kind]
    return [
        Field("x", "x (m)", "number", x, ""),
        Field("y", "y (m)", "number", y, ""),
        Field("heading_deg", "heading (deg)", "number", body.heading_deg, ""),
        *(
            Field(name, f"{name} (m)", "number", value, "")
            for name, value in _lengths(body).items()
        ),
        Field("height", "height (m)", "number", body.height, ""),
        Field("kind", "kind", "choice", kind, "", tuple(KINDS.values())),
        Field("colour", "colour", "choice", body.colour, "", colours),
        Field("label", "label", "text", body.label, ""),
    ]


def _read(field: Field, text: str) -> Any:
    """Return the value of a box as plain data."""
    if field.name == "kind":
        return next((kind for kind, words in KINDS.items() if words == text), text)
    value = field.read(text)
    if field.name in POSE_FIELDS and not isinstance(value, int | float):
        raise ChangeError([Problem((field.name,), f"expected a number, got {text!r}")])
    if field.name in POSE_FIELDS and not math.isfinite(value):
        raise ChangeError([Problem((field.name,), f"expected a finite number, got {text!r}")])
    return value


def _lengths(body: BodyDescription) -> Mapping[str, float]:
    """Return the lengths that describe a body's outline; empty for shapes with many corners."""
    match body.shape:
        case BoxShape(size=(length, width)):
            return {"length": length, "width": width}
        case CircleShape(radius=radius):
            return {"radius": radius}
        case CapsuleShape(length=length, radius=radius):
            return {"length": length, "radius": radius}
        case SegmentShape(thickness=thickness):
            return {"thickness": thickness}
    return {}


def _resized_shape(body: BodyDescription, lengths: Mapping[str, Any]) -> dict[str, Any]:
    plain: dict[str, Any] = body.shape.model_dump(mode="json")
    if isinstance(body.shape, BoxShape):
        both: Mapping[str, Any] = {**_lengths(body), **lengths}
        return plain | {"size": [both["length"], both["width"]]}
    return plain | dict(lengths)

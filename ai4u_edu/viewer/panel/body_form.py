"""The form of one body, on one page."""

import math
from collections.abc import Callable, Coroutine, Iterable, Mapping
from html import escape
from typing import Any

from viser import ClientHandle, GuiDropdownHandle, GuiTextHandle

from ai4u_edu.base.colors import PALETTE
from ai4u_edu.base.parameters import Problem
from ai4u_edu.editing import ChangeError
from ai4u_edu.editing.forms import NONE_LABEL, Field
from ai4u_edu.viewer.panel.readings import block as paragraph
from ai4u_edu.world import BodyDescription, BoxShape, CapsuleShape, CircleShape, SegmentShape

KINDS = {
    "static": "stands still",
    "dynamic": "can be pushed",
    "kinematic": "moves, can't be pushed",
}
PLACE = ("x", "y", "heading_deg")
Box = GuiDropdownHandle[str] | GuiTextHandle


class BodyForm:
    """A box for each thing about a body that a person changes mostly; the file has the rest.

    Args:
        client: the page; the form comes to stand where its ``gui`` is.
        body: as the scene describes it.
        on_apply: called when the form is handed in.
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
            self._told = gui.add_html("")
            self.apply = gui.add_button("Apply", color="blue")
        self.apply.on_click(on_apply)

    def takes(self, body: BodyDescription | None, *, anew: bool) -> bool:
        """Shows a body as it is now, if it is still the one whose form this is.

        Args:
            body: the one that is to be shown.
            anew: whether all that a person wrote was handed in; else what is in the boxes stays,
                but for what has changed meanwhile.
        """
        if body is None or body.name != self.body.name:
            return False
        if body == self.body and not anew:
            return True
        others = fields(body)
        if [each.name for each in others] != [each.name for each in self.fields]:
            return False
        for old, new in zip(self.fields, others, strict=True):
            box: Any = self.boxes[new.name]
            if anew or old.value != new.value:
                box.value = new.shown
        self.body, self.fields = body, others
        self.explain(())
        return True

    def changes(self) -> tuple[dict[str, Any], dict[str, Any]]:
        """What a person has made other than it was.

        Returns:
            Where it is to be, as arguments of ``move_body``, {} if it is to stay there; and all of
            the rest, as fields of its description.

        Raises:
            ChangeError: some of it can't be read at all.
        """
        values: dict[str, Any] = {}
        for field in self.fields:
            said = self.boxes[field.name].value
            if said != field.shown:
                values[field.name] = _read(field, said)
        place = {name: values.pop(name) for name in PLACE if name in values}
        if place:
            (x, y), heading = self.body.position, self.body.heading_deg
            place = {"x": x, "y": y, "heading_deg": heading} | place
        lengths = {name: values.pop(name) for name in _lengths(self.body) if name in values}
        if lengths:
            values["shape"] = _shaped(self.body, lengths)
        return place, values

    def explain(self, problems: Iterable[Problem]) -> None:
        """Says what is wrong, above the button, each with the label of its box."""
        text = "; ".join(self._worded(problem) for problem in problems)
        told = f'<strong role="alert">{escape(text)}</strong>'
        self._told.content = paragraph(told) if text else ""

    def remove(self) -> None:
        """Takes it off the page."""
        self._form.remove()

    def _worded(self, problem: Problem) -> str:
        lengths = tuple(_lengths(self.body))
        path = [part for part in problem.path if part not in {"shape", self.body.shape.type}]
        name = str(path[0]) if path else ""
        if name in {"size", "position"} and len(path) > 1:
            name = (lengths if name == "size" else PLACE)[int(path[1])]
        label = next((each.label for each in self.fields if each.name == name), "")
        return f"{label}: {problem.text}" if label else str(problem)


def fields(body: BodyDescription) -> list[Field]:
    """What can be changed of a body, and how it is now."""
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


def _read(field: Field, said: str) -> Any:
    """What a box says, as plain data."""
    if field.name == "kind":
        return next((kind for kind, words in KINDS.items() if words == said), said)
    value = field.read(said)
    if field.name in PLACE and not isinstance(value, int | float):
        raise ChangeError([Problem((field.name,), f"expected a number, got {said!r}")])
    if field.name in PLACE and not math.isfinite(value):
        raise ChangeError([Problem((field.name,), f"expected a finite number, got {said!r}")])
    return value


def _lengths(body: BodyDescription) -> Mapping[str, float]:
    """How large a body is from above; nothing where that takes more than a few numbers."""
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


def _shaped(body: BodyDescription, lengths: Mapping[str, Any]) -> dict[str, Any]:
    plain: dict[str, Any] = body.shape.model_dump(mode="json")
    if isinstance(body.shape, BoxShape):
        both: Mapping[str, Any] = {**_lengths(body), **lengths}
        return plain | {"size": [both["length"], both["width"]]}
    return plain | dict(lengths)

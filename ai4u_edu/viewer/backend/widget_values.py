"""Checks of the values that a page may give to a widget."""

import math
from typing import Any

from viser import (
    GuiButtonGroupHandle,
    GuiButtonHandle,
    GuiCheckboxHandle,
    GuiDropdownHandle,
    GuiNumberHandle,
    GuiSliderHandle,
    GuiTextHandle,
)

from ai4u_edu.base.limits import MAX_EXACT_INT

MAX_TEXT_CHARS = 20_000
"""Length of a text box's value."""


class ValueRefusedError(ValueError):
    """A page gave a widget a value that this widget can't have.

    Attributes:
        is_typed: True if a person may have typed it; else only a program sends such a value, or a
            page that does not know yet that the choices have changed.
    """

    def __init__(self, text: str, *, is_typed: bool = False) -> None:
        super().__init__(text)
        self.is_typed = is_typed


def checked_value(widget: Any, value: object) -> object:
    """Return a value in the type that the widget has.

    Args:
        widget: viser's handle.
        value: from the page.

    Raises:
        ValueRefusedError: the widget can't have it.
    """
    match widget:
        case GuiButtonHandle():
            return _only(value is True, value, "a button to be pressed")
        case GuiCheckboxHandle():
            return _only(isinstance(value, bool), value, "true or false")
        case GuiDropdownHandle() | GuiButtonGroupHandle():
            is_known = isinstance(value, str) and value in widget.options
            return _only(is_known, value, f"one of {widget.options!r:.200}")
        case GuiTextHandle():
            _only(isinstance(value, str), value, "text")
            if isinstance(value, str) and len(value) > MAX_TEXT_CHARS:
                raise ValueRefusedError(
                    f"{widget.label}: expected at most {MAX_TEXT_CHARS} characters, got "
                    f"{len(value)}",
                    is_typed=True,
                )
            return value
        case GuiNumberHandle() | GuiSliderHandle():
            return _number(widget, value)
    raise ValueRefusedError(f"{type(widget).__name__} takes no value from a page")


def _only(is_right: bool, value: object, expected: str) -> object:
    if not is_right:
        raise ValueRefusedError(f"expected {expected}, got {value!r:.80}")
    return value


def _number(widget: Any, value: object) -> float:
    is_whole = isinstance(widget.value, int)
    low = -MAX_EXACT_INT if widget.min is None else widget.min
    high = MAX_EXACT_INT if widget.max is None else widget.max
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ValueRefusedError(f"expected a number, got {value!r:.80}")
    if isinstance(value, float) and not math.isfinite(value):
        raise ValueRefusedError(f"expected a finite number, got {value!r}")
    if not low <= value <= high or (is_whole and value != int(value)):
        kind = "a whole number" if is_whole else "a number"
        raise ValueRefusedError(
            f"{widget.label}: expected {kind} from {_shown(low)} to {_shown(high)}, got "
            f"{_shown(value):.80}",
            is_typed=True,
        )
    return int(value) if is_whole else float(value)


def _shown(number: float) -> str:
    return str(int(number)) if number == int(number) and abs(number) < 1e21 else repr(number)

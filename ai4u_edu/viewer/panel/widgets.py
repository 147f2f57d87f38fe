"""Setters for viser's widgets that send only changed values."""

from typing import TypeVar

from viser import GuiButtonGroupHandle, GuiDropdownHandle, GuiInputHandle

T = TypeVar("T")


def set_value(handle: GuiInputHandle[T], value: T) -> None:
    """Set a widget's value, if it differs."""
    if handle.value != value:
        handle.value = value  # type: ignore[misc]  # viser types `value` as read-only


def set_options(
    handle: GuiButtonGroupHandle | GuiDropdownHandle[str], options: tuple[str, ...]
) -> None:
    """Set a widget's options, if they differ."""
    if handle.options != options:
        handle.options = options

"""The base of the panel's parts."""

from msgspec import Struct


class PanelPart(Struct, frozen=True, tag_field="type", tag="part"):
    """A part of what the panel shows; as JSON, an object of type ``part`` with a ``name``.

    Keys come in the order of the fields. A key whose field is UNSET is left out.
    ``python -m tests.web_messages`` derives the page's types from the fields and their docstrings.
    """

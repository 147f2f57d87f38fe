"""Colours as CSS has them."""

from ai4u_edu.snapshot.theme import Rgb


def hex_colour(colour: Rgb) -> str:
    """Return a colour as CSS has it.

    >>> hex_colour((0, 114, 178))
    '#0072b2'
    """
    return "#" + "".join(f"{channel:02x}" for channel in colour)

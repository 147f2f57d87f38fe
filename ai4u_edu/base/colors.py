"""Colours that colour-blind people can tell apart (Okabe and Ito, 2008), and greys."""

import re
from typing import Annotated

from pydantic import AfterValidator

from ai4u_edu.base.errors import suggest
from ai4u_edu.locale import gettext as _

PALETTE = {
    "black": "#000000",
    "orange": "#e69f00",
    "sky blue": "#56b4e9",
    "green": "#009e73",
    "yellow": "#f0e442",
    "blue": "#0072b2",
    "vermillion": "#d55e00",
    "purple": "#cc79a7",
    "grey": "#7f8790",
    "light grey": "#c9ced4",
    "white": "#ffffff",
}
FLOOR_RGB = (228, 232, 236)
"""Colour of a floor that has none of its own."""


def rgb(colour: str) -> tuple[int, int, int]:
    """Return a colour's red, green and blue, each 0..255.

    Args:
        colour: a key of :data:`PALETTE`, or ``#rrggbb``.

    >>> rgb("orange")
    (230, 159, 0)
    """
    digits = PALETTE.get(colour, colour).removeprefix("#")
    return int(digits[0:2], 16), int(digits[2:4], 16), int(digits[4:6], 16)


def hex_colour(colour: tuple[int, int, int]) -> str:
    """Return a colour as CSS has it.

    >>> hex_colour((0, 114, 178))
    '#0072b2'
    """
    red, green, blue = colour
    return f"#{red:02x}{green:02x}{blue:02x}"


def _known(colour: str) -> str:
    if colour in PALETTE or re.fullmatch(r"#[0-9a-fA-F]{6}", colour):
        return colour
    hint = suggest(colour, PALETTE)
    raise ValueError(
        _(
            "expected '#rrggbb' or a colour's name, got {colour}; {hint}",
            colour=repr(colour),
            hint=hint,
        )
    )


Colour = Annotated[str, AfterValidator(_known)]

"""Draws the mat of the scene ``printed_track``: ``python -m tests.scenes.printed_track``."""

import math

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from ai4u_edu.base.colors import PALETTE
from ai4u_edu.scenes.scene import LIBRARY

FILE = LIBRARY / "printed_track.png"
SIZE_M = 12.0, 8.0
PIXELS_PER_M = 80
DRAWN_LARGER = 4
"""Factor by which it is drawn larger and then reduced, for smooth edges."""
LINE_M = 0.26
PAPER, GRASS, SAND = "#f7f4ea", "#d8e6cf", "#efe0b9"
Point = tuple[float, float]

# the middle of the line; it is smooth in between, and goes round counter-clockwise
KNOTS: list[Point] = [
    (-4.6, -2.6),
    (-2.6, -3.0),
    (-0.6, -2.2),
    (1.2, -2.9),
    (3.4, -3.0),
    (5.0, -1.8),
    (4.6, 0.0),
    (2.9, 0.5),
    (2.6, 1.9),
    (1.0, 2.9),
    (-0.6, 1.9),
    (-0.9, 0.4),
    (-2.4, -0.2),
    (-3.2, 1.2),
    (-3.0, 2.6),
    (-4.6, 2.8),
    (-5.2, 1.0),
    (-4.6, -0.6),
    (-5.3, -1.7),
]


def route(steps: int = 24) -> list[Point]:
    """Return points on the middle of the line, about 8 cm apart (Catmull and Rom's curve)."""
    points = []
    knots = np.array(KNOTS)
    for index in range(len(knots)):
        a, b, c, d = (knots[(index + shift) % len(knots)] for shift in (-1, 0, 1, 2))
        for t in np.arange(steps) / steps:
            place = 0.5 * (
                2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t**2
                + (3 * b - a - 3 * c + d) * t**3
            )  # fmt: skip
            points.append((float(place[0]), float(place[1])))
    return points


def pixels(point: Point) -> Point:
    """Return a place (m) in the picture."""
    (x, y), (length, width) = point, SIZE_M
    scale = PIXELS_PER_M * DRAWN_LARGER
    return (x + length / 2) * scale, (width / 2 - y) * scale


def draw() -> Image.Image:
    """Return the mat."""
    scale = PIXELS_PER_M * DRAWN_LARGER
    length, width = (round(side * scale) for side in SIZE_M)
    image = Image.new("RGB", (length, width), PAPER)
    pen = ImageDraw.Draw(image)
    edge = 0.15 * scale
    frame = (edge, edge, length - edge, width - edge)
    pen.rectangle(frame, outline=PALETTE["grey"], width=round(0.05 * scale))
    for (x, y), reach, colour in (
        ((-1.4, -1.2), 0.7, GRASS),
        ((3.6, -1.4), 0.9, GRASS),
        ((0.9, 1.2), 0.8, SAND),
        ((4.3, 2.45), 1.3, GRASS),
        ((-4.1, 1.4), 0.5, SAND),
    ):
        (u, v), r = pixels((x, y)), reach * scale
        pen.ellipse((u - r, v - 0.6 * r, u + r, v + 0.6 * r), fill=colour)
    font = ImageFont.load_default(0.5 * scale)
    pen.text(pixels((4.3, 2.45)), "AI4U GP", fill=PALETTE["blue"], font=font, anchor="mm")
    thick = LINE_M * scale
    for point in route(96):
        u, v = pixels(point)
        pen.ellipse((u - thick / 2, v - thick / 2, u + thick / 2, v + thick / 2), fill="#111111")
    _finish(pen)
    smooth = image.reduce(DRAWN_LARGER)
    return smooth.quantize(16, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)


def _finish(pen: ImageDraw.ImageDraw) -> None:
    """Draw a chequered band beside the line at its beginning, on both sides."""
    side = 0.1
    half = side * PIXELS_PER_M * DRAWN_LARGER / 2
    x0, y0 = KNOTS[1]
    for column in range(3):
        for row in (-6, -5, -4, -3, 2, 3, 4, 5):
            colour = PALETTE["vermillion"] if (column + row) % 2 else "#ffffff"
            u, v = pixels((x0 + (column - 1) * side, y0 + (row + 0.5) * side))
            pen.rectangle((u - half, v - half, u + half, v + half), fill=colour)


def main() -> None:
    """Write the picture beside the scene."""
    draw().save(FILE, "PNG", optimize=True)
    print(FILE, FILE.stat().st_size, "bytes", "length", length_m(), "m")


def length_m() -> float:
    """Return the length of the line."""
    way = route()
    return sum(math.dist(a, b) for a, b in zip(way, [*way[1:], way[0]], strict=True))


if __name__ == "__main__":
    main()

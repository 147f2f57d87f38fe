"""Takes the README's picture of all scenes, without a browser: ``python -m tests.gallery``."""

from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from ai4u_edu import Scene
from ai4u_edu.snapshot import capture_snapshot
from ai4u_edu.snapshot.raster import draw_snapshot
from ai4u_edu.snapshot.theme import VOID

PICTURE = Path(__file__).parent / "pictures" / "scenes.png"
COLUMNS = 5
TILE, TITLE, SPACE = 240, 26, 8
"""Pixels: a tile's side, its title's height, what is between two tiles."""
PAPER = (255, 255, 255)
INK = (27, 37, 48)


def contact_sheet(names: list[str], seed: int = 1) -> Image.Image:
    """Scenes side by side, each as it begins, with its title."""
    rows = -(-len(names) // COLUMNS)
    size = (COLUMNS * (TILE + SPACE) + SPACE, rows * (TILE + TITLE + SPACE) + SPACE)
    sheet = Image.new("RGB", size, PAPER)
    pen, font = ImageDraw.Draw(sheet), ImageFont.load_default(15)
    for index, name in enumerate(names):
        row, column = divmod(index, COLUMNS)
        left, top = SPACE + column * (TILE + SPACE), SPACE + row * (TILE + TITLE + SPACE)
        scene = Scene.load(name)
        sheet.paste(tile(scene, seed), (left, top))
        title = scene.description.title or name
        pen.text((left + TILE / 2, top + TILE + 19), title, INK, font, anchor="ms")
    return sheet


def tile(scene: Scene, seed: int) -> Image.Image:
    """A scene as it begins, in the middle of a square."""
    sim = scene.build()
    sim.reset(seed)
    picture = Image.fromarray(np.asarray(draw_snapshot(capture_snapshot(sim), longest=TILE)))
    square = Image.new("RGB", (TILE, TILE), VOID)
    square.paste(picture, ((TILE - picture.width) // 2, (TILE - picture.height) // 2))
    return square


def main() -> None:
    """Draws the scenes of the library."""
    PICTURE.parent.mkdir(exist_ok=True)
    contact_sheet(Scene.names()).quantize(128).save(PICTURE, optimize=True)
    print(PICTURE)


if __name__ == "__main__":
    main()

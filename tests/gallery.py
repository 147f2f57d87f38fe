"""Draws the README's picture of all scenes, without a browser: ``python -m tests.gallery``."""

from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from ai4u_edu import Scene
from ai4u_edu.snapshot import capture_snapshot
from ai4u_edu.snapshot.raster import draw_snapshot
from ai4u_edu.snapshot.theme import VOID

PICTURE = Path(__file__).parent / "pictures" / "scenes.png"
COLUMNS = 5
TILE_PX, TITLE_PX, GAP_PX = 240, 26, 8
"""Side of a tile, height of its title, gap between two tiles."""
BACKGROUND = (255, 255, 255)
TEXT_COLOUR = (27, 37, 48)


def contact_sheet(names: list[str], seed: int = 1) -> Image.Image:
    """Draw the starts of scenes side by side, each with its title."""
    rows = -(-len(names) // COLUMNS)
    size = (COLUMNS * (TILE_PX + GAP_PX) + GAP_PX, rows * (TILE_PX + TITLE_PX + GAP_PX) + GAP_PX)
    sheet = Image.new("RGB", size, BACKGROUND)
    pen, font = ImageDraw.Draw(sheet), ImageFont.load_default(15)
    for index, name in enumerate(names):
        row, column = divmod(index, COLUMNS)
        left, top = (
            GAP_PX + column * (TILE_PX + GAP_PX),
            GAP_PX + row * (TILE_PX + TITLE_PX + GAP_PX),
        )
        scene = Scene.load(name)
        sheet.paste(tile(scene, seed), (left, top))
        title = scene.description.title or name
        pen.text((left + TILE_PX / 2, top + TILE_PX + 19), title, TEXT_COLOUR, font, anchor="ms")
    return sheet


def tile(scene: Scene, seed: int) -> Image.Image:
    """Draw the start of a scene, centred in a square."""
    sim = scene.build()
    sim.reset(seed)
    picture = Image.fromarray(np.asarray(draw_snapshot(capture_snapshot(sim), longest=TILE_PX)))
    square = Image.new("RGB", (TILE_PX, TILE_PX), VOID)
    square.paste(picture, ((TILE_PX - picture.width) // 2, (TILE_PX - picture.height) // 2))
    return square


def main() -> None:
    """Draw the scenes of the library."""
    PICTURE.parent.mkdir(exist_ok=True)
    contact_sheet(Scene.names()).quantize(128).save(PICTURE, optimize=True)
    print(PICTURE)


if __name__ == "__main__":
    main()

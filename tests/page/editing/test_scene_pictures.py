"""Pictures of the library's scenes: each has one, and it shows the scene as it is."""

import io

import numpy as np
import numpy.typing as npt
from PIL import Image

from ai4u_edu.page.editing.scene_pictures import (
    LIBRARY_PICTURE_PX,
    PICTURES,
    library_picture,
    library_scenes,
    scene_picture,
)
from ai4u_edu.scenes import Scene

CELL_PX = 4
"""Side of the squares that are compared, so that the edges of letters and bodies don't count."""
MAX_DIFFERENCE, MAX_CELLS = 32, 2
"""Difference of a square's colour, and number of squares that may differ by more."""
MAX_BYTES = 200_000
AGAIN = "draw them again: ai4u-edu scenes --pictures ai4u_edu/scenes/library/pictures"


def cells(png: bytes) -> npt.NDArray[np.int16]:
    picture = Image.open(io.BytesIO(png)).convert("RGB")
    return np.asarray(picture.reduce(CELL_PX), np.int16)


def differ(one: bytes, other: bytes) -> bool:
    a, b = cells(one), cells(other)
    if a.shape != b.shape:
        return True
    return int((np.abs(a - b).max(axis=2) > MAX_DIFFERENCE).sum()) > MAX_CELLS


def test_each_scene_has_a_picture_that_shows_it_as_it_is() -> None:
    assert {path.stem for path in PICTURES.glob("*.png")} == set(Scene.names()), AGAIN
    assert sum(path.stat().st_size for path in PICTURES.iterdir()) < MAX_BYTES
    old = [
        name
        for name in Scene.names()
        if differ(library_picture(name), scene_picture(Scene.load(name), LIBRARY_PICTURE_PX))
    ]
    assert old == [], AGAIN


def test_a_picture_of_a_scene_that_was_changed_is_told() -> None:
    # a large scene, in which half a metre is a small part of the picture
    scene = Scene.load("platform")
    moved = Scene.loads(scene.source.replace("position: [9.5, 2]", "position: [10, 2]"))
    assert moved.description != scene.description
    assert differ(library_picture("platform"), scene_picture(moved, LIBRARY_PICTURE_PX))


def test_a_scene_of_the_library_tells_level_and_time() -> None:
    (found,) = [each for each in library_scenes() if each.name == "box_chase"]
    assert (found.level, found.minutes, found.stars) == ("easy", 2, 3)

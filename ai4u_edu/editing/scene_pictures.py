"""Pictures of scenes from above, and the library's scenes with their pictures."""

import io
from functools import cache
from typing import NamedTuple

from PIL import Image

from ai4u_edu.scenes import Scene, SceneDescription
from ai4u_edu.scenes.description import LEVELS
from ai4u_edu.scenes.scene import LIBRARY
from ai4u_edu.scenes.star_goals import star_goals
from ai4u_edu.scenes.yaml.file import YamlFile
from ai4u_edu.snapshot import capture_snapshot
from ai4u_edu.snapshot.raster import draw_snapshot

PALETTE_SIZE = 32
"""Number of colours in a picture: scenes have few, so a small one takes 2 or 3 kB."""
LIBRARY_PICTURE_PX = 400
"""Longer side of a library scene's picture."""
EMPTY_SCENE = "my_scene"
"""Name of the empty plate with a robot, which is not among the library's scenes."""
TEMPLATES = LIBRARY.parent / "templates"


class LibraryScene(NamedTuple):
    """A scene of the library, in words."""

    name: str
    title: str
    goal: str
    level: str
    """``easy``, ``medium``, ``hard``, or empty."""
    minutes: int | None
    """Time that a person needs to reach the goal for the first time."""
    stars: int
    """Number of stars that a program can earn."""


def scene_picture(scene: Scene, longest_px: int) -> bytes:
    """Return a picture of a scene at the start of an episode, as a PNG file.

    Args:
        scene: the scene.
        longest_px: longer side of the picture.
    """
    sim = scene.build()
    sim.reset(1)
    picture = Image.fromarray(draw_snapshot(capture_snapshot(sim), longest=longest_px))
    out = io.BytesIO()
    picture.quantize(PALETTE_SIZE).save(out, "PNG", optimize=True)
    return out.getvalue()


@cache
def library_scenes() -> tuple[LibraryScene, ...]:
    """Return the library's scenes, the easiest first; cached, because reading takes a moment."""
    scenes = [_in_words(name) for name in Scene.names()]
    order = (*LEVELS, "")
    return tuple(sorted(scenes, key=lambda each: (order.index(each.level), each.title.lower())))


@cache
def library_picture(name: str) -> bytes:
    """Return the picture of a scene of the library, as a PNG file."""
    return scene_picture(Scene.load(name), LIBRARY_PICTURE_PX)


def load_by_name(name: str) -> Scene | None:
    """Return a scene of the library, or the empty one; None if there is none of that name."""
    if name == EMPTY_SCENE:
        return Scene.load(TEMPLATES / f"{EMPTY_SCENE}.yaml")
    return Scene.load(name) if name in Scene.names() else None  # a path would lead elsewhere


def _in_words(name: str) -> LibraryScene:
    # its world is not built, as loading does, since nobody needs it here
    text = (LIBRARY / f"{name}.yaml").read_text(encoding="utf-8")
    about = SceneDescription.model_validate(YamlFile(text, name).data)
    title = about.title or about.name
    level, stars = about.level or "", star_goals(about).count
    return LibraryScene(about.name, title, about.goal, level, about.minutes, stars)

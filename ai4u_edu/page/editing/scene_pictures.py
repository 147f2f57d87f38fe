"""Pictures of scenes from above, and the library's scenes with their pictures."""

import io
import re
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import NamedTuple

from PIL import Image

from ai4u_edu.base.atomic_write import make_folder, write_atomically
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.dry_run import IdleBrain
from ai4u_edu.scenes import Scene, SceneDescription
from ai4u_edu.scenes.description import LEVELS
from ai4u_edu.scenes.scene import LIBRARY
from ai4u_edu.scenes.star_goals import star_goals
from ai4u_edu.scenes.yaml.file import YamlFile, with_pictures
from ai4u_edu.snapshot import capture_snapshot
from ai4u_edu.snapshot.raster import draw_snapshot

PALETTE_SIZE = 64
"""Number of colours in a picture: scenes have few, so a picture takes 3 kB."""
PICTURE_SUFFIX = ".png"
LIBRARY_PICTURE_PX = 400
"""Longer side of a library scene's picture."""
PICTURES = LIBRARY / "pictures"
"""Pictures of the library's scenes. They are part of the package, so that no room of a class builds
all these worlds when its first page asks for them; ``ai4u-edu scenes --pictures`` draws them."""
MAX_FILE_NAME_CHARS = 60
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
    key: str
    """Key of its task, under which a page keeps best times."""


def scene_picture(scene: Scene, longest_px: int, seed: int = 1) -> bytes:
    """Return a picture of a scene at the start of an episode, as a PNG file.

    It has no rays of sensors, which would hide a small scene.

    Args:
        scene: the scene.
        longest_px: longer side of the picture.
        seed: of the episode.
    """
    sim = scene.build(brains=lambda _: IdleBrain())
    sim.reset(seed)
    snapshot = capture_snapshot(sim)
    agents = tuple(each._replace(rays={}) for each in snapshot.agents)
    picture = Image.fromarray(draw_snapshot(replace(snapshot, agents=agents), longest=longest_px))
    out = io.BytesIO()
    # by coverage, small things keep their colours; by means, the large areas do
    picture.quantize(PALETTE_SIZE, Image.Quantize.MAXCOVERAGE, kmeans=1).save(
        out, "PNG", optimize=True
    )
    return out.getvalue()


def write_picture(scene: Scene, folder: Path) -> Path:
    """Draw a scene as a PNG file that has its name, and return the path.

    Args:
        scene: the scene.
        folder: is made if it is not there.

    Raises:
        SetupError: the folder can't be created.
    """
    make_folder(folder, _("pictures"))
    name = re.sub(r"[^\w-]", "_", scene.description.name)[:MAX_FILE_NAME_CHARS]
    path = folder / f"{name}{PICTURE_SUFFIX}"
    write_atomically(path, scene_picture(scene, LIBRARY_PICTURE_PX))
    return path


@cache
def library_scenes() -> tuple[LibraryScene, ...]:
    """Return the library's scenes, the easiest first; cached, because reading takes a moment."""
    scenes = [_in_words(name) for name in Scene.names()]
    order = (*LEVELS, "")
    return tuple(sorted(scenes, key=lambda each: (order.index(each.level), each.title.lower())))


@cache
def library_picture(name: str) -> bytes:
    """Return the picture of a scene of the library, as a PNG file.

    That of a scene that somebody has just added is drawn.
    """
    file = picture_file(name)
    return (
        scene_picture(Scene.load(name), LIBRARY_PICTURE_PX) if file is None else file.read_bytes()
    )


def picture_file(name: str) -> Path | None:
    """Return the file with the picture of a scene of the library; None if there is none."""
    file = PICTURES / f"{name}{PICTURE_SUFFIX}"
    return file if name in Scene.names() and file.is_file() else None


def load_by_name(name: str) -> Scene | None:
    """Return a scene of the library, or a template of one; None if there is none of that name."""
    if name in template_names():
        return Scene.load(TEMPLATES / f"{name}.yaml")
    return Scene.load(name) if name in Scene.names() else None  # a path would lead elsewhere


@cache
def template_names() -> tuple[str, ...]:
    """Return the names of scenes that are no goal of the library: the empty one, and lessons'."""
    return tuple(sorted(path.stem for path in TEMPLATES.glob("*.yaml")))


def _in_words(name: str) -> LibraryScene:
    # its world is not built, as loading does, since nobody needs it here
    text = with_pictures((LIBRARY / f"{name}.yaml").read_text(encoding="utf-8"), name, LIBRARY)
    about = SceneDescription.model_validate(YamlFile(text, name).data)
    title = about.title or about.name
    level, stars = about.level or "", star_goals(about).count
    key = about.task_key()
    return LibraryScene(about.name, title, about.goal, level, about.minutes, stars, key)

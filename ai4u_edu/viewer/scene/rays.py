"""What the ray sensors saw: a line for each ray, a dot where it met something."""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
from viser import SceneApi

from ai4u_edu.blocks import RayPicture
from ai4u_edu.snapshot import StaticScene
from ai4u_edu.snapshot.theme import RAY_MISS, UNKNOWN_GROUP, group_colours
from ai4u_edu.viewer.scene.geometry import Array, cap, circle
from ai4u_edu.viewer.scene.layers import Layers
from ai4u_edu.viewer.scene.light import strokes, surfaces
from ai4u_edu.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.viewer.scene.placing import size
from ai4u_edu.viewer.scene.subtree import Subtree

Points = npt.NDArray[np.float32]
DOT = 0.0055
"""A dot's radius, as a share of the arena's size."""


class StageLook:
    """How rays are drawn on a static_scene: the colours of its groups, the size of the dots."""

    def __init__(self, static_scene: StaticScene) -> None:
        colours = {"?": UNKNOWN_GROUP, "": RAY_MISS} | group_colours(static_scene)
        self.numbers = {group: number for number, group in enumerate(colours)}
        self.strokes = strokes(list(colours.values()))
        self.fills = surfaces(list(colours.values()))
        self.layers = Layers.of(static_scene)
        self.dot = DOT * size(static_scene)


class Rays:
    """Draws rays on one page.

    Args:
        scene: the page's.
        look: how large things are on the static_scene, and which colours they have.
    """

    def __init__(self, scene: SceneApi, look: StageLook) -> None:
        self._scene = scene
        self._subtree = Subtree(scene, "rays")
        self._look, self._count = look, 0

    def build(self, look: StageLook) -> None:
        """Draws anew from now on, on another static_scene."""
        self._look, self._count = look, -1

    def draw(self, pictures: Sequence[RayPicture]) -> None:
        """Draws these rays, and no others."""
        groups = [group for picture in pictures for group in picture.groups]
        if len(groups) != self._count:
            self._make(len(groups))
        if not groups:
            return
        look = self._look
        lines = np.concatenate([ray_lines(picture) for picture in pictures], dtype=np.float32)
        lines[..., 2] += look.layers.body
        numbers = np.array([look.numbers.get(group, 0) for group in groups])
        met = np.array([group != "" for group in groups])
        self._lines.points = lines
        self._lines.colors = look.strokes[numbers][:, None].repeat(2, axis=1)
        self._dots.batched_positions = ray_dots(lines, look.dot)
        self._dots.batched_scales = met.astype(np.float32)
        # a point cloud would do, but the page compiles its shader anew for every change of colour
        self._dots.batched_colors = look.fills[numbers]

    def _make(self, count: int) -> None:
        with self._subtree.rebuild() as parent:
            if count:
                drawer = MeshDrawer(self._scene, parent)
                self._lines = drawer.moving_lines("lines", count)
                dot = cap(circle(self._look.dot, corners=12))
                self._dots = drawer.batch("dots", dot, count * [RAY_MISS])
        self._count = count


def ray_lines(picture: RayPicture) -> Array:
    """A picture's rays as (n, 2, 3) line segments."""
    origins = np.broadcast_to(np.array(picture.origin), picture.ends.shape)
    return np.stack([origins, picture.ends], axis=1)


def ray_dots(lines: Points, radius: float) -> Points:
    """The centres of the dots, (n, 3).

    A dot touches what the ray met from outside, so that what it met doesn't cover it.

    Args:
        lines: (n, 2, 3) from the eye to the end.
        radius: of a dot.
    """
    back = lines[:, 0] - lines[:, 1]
    lengths = np.maximum(np.linalg.norm(back, axis=1, keepdims=True), 1e-9)
    dots: Points = lines[:, 1] + back * np.minimum(radius / lengths, 1.0)
    return dots

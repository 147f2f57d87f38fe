"""Readings of ray sensors: a line for each ray, with a dot where it hit something."""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
from viser import SceneApi

from ai4u_edu.base.colors import rgb
from ai4u_edu.blocks import RayPicture
from ai4u_edu.page.viewer.scene.arena import arena_size
from ai4u_edu.page.viewer.scene.geometry import Array, cap, circle, rotate
from ai4u_edu.page.viewer.scene.layers import Layers
from ai4u_edu.page.viewer.scene.light import line_colours, surface_colours
from ai4u_edu.page.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.page.viewer.scene.subtree import Subtree
from ai4u_edu.snapshot import StaticScene
from ai4u_edu.snapshot.theme import RAY_MISS, UNKNOWN_GROUP, group_colours

Points = npt.NDArray[np.float32]
Weights = npt.NDArray[np.float64]
NOT_COLOURED: tuple[list[str], list[list[float]]] = ([], [])
DOT_RADIUS = 0.0055
"""Radius of a dot, as a share of the arena's size."""


class RayStyle:
    """Colours and dot size of the rays on a static scene."""

    def __init__(self, static_scene: StaticScene) -> None:
        colours = {"?": UNKNOWN_GROUP, "": RAY_MISS} | group_colours(static_scene)
        self.index_of_group = {group: index for index, group in enumerate(colours)}
        self.line_colours = line_colours(list(colours.values()))
        self.dot_colours = surface_colours(list(colours.values()))
        self.layers = Layers.of(static_scene)
        self.dot_radius = DOT_RADIUS * arena_size(static_scene)


class Rays:
    """The rays drawn on one page.

    Args:
        scene: viser's scene of the page.
        style: colours and sizes for the static scene.
    """

    def __init__(self, scene: SceneApi, style: RayStyle) -> None:
        self._scene = scene
        self._subtree = Subtree(scene, "rays")
        self._style, self._count = style, 0
        self._coloured = NOT_COLOURED

    def build(self, style: RayStyle) -> None:
        """Rebuild the rays at the next drawing, in the style of another static scene."""
        self._style, self._count = style, -1

    def draw(
        self,
        pictures: Sequence[RayPicture],
        heading: float = 0.0,
        weights: Sequence[Weights | None] = (),
    ) -> None:
        """Draw these rays, and remove all others.

        A page moves nodes at once, and shows new points some frames later. So the points are
        relative to a node at the eye, which turns with the body: late, they still fit the body.

        Args:
            pictures: the rays of each sensor.
            heading: heading (rad) of the sensors' body.
            weights: for each sensor how much each ray matters, 0..1, as its colour; by default, and
                for None, the colour is that of what the ray hits.
        """
        groups = [group for picture in pictures for group in picture.groups]
        if len(groups) != self._count:
            self._rebuild(len(groups))
        if not groups:
            return
        style = self._style
        lines = np.concatenate([ray_lines(picture) for picture in pictures])
        eye = lines[0, 0].copy()
        lines -= eye
        lines[..., :2] = rotate(lines[..., :2].reshape(-1, 2), -heading).reshape(-1, 2, 2)
        lines = lines.astype(np.float32)
        self._subtree.place(eye + np.array([0.0, 0.0, style.layers.body]), heading)
        self.lines.points = lines
        self.dots.batched_positions = ray_dots(lines, style.dot_radius)
        rounded = [[] if each is None else each.round(2).tolist() for each in weights]
        if (groups, rounded) == self._coloured:
            return
        self._coloured = groups, rounded
        indices = np.array([style.index_of_group.get(group, 0) for group in groups])
        colours = style.line_colours[indices]
        ends = np.cumsum([len(picture.groups) for picture in pictures])
        for end, each in zip(ends, weights, strict=False):
            if each is not None:
                colours[end - len(each) : end] = line_colours(weight_colours(each))
        self.lines.colors = colours[:, None].repeat(2, axis=1)
        self.dots.batched_scales = np.array([group != "" for group in groups], dtype=np.float32)
        # meshes, because the page recompiles a point cloud's shader at every change of colour
        self.dots.batched_colors = style.dot_colours[indices]

    def _rebuild(self, count: int) -> None:
        with self._subtree.rebuild() as parent:
            if count:
                drawer = MeshDrawer(self._scene, parent)
                self.lines = drawer.moving_lines("lines", count)
                dot = cap(circle(self._style.dot_radius, corners=12))
                self.dots = drawer.batch("dots", dot, count * [RAY_MISS])
        self._count, self._coloured = count, NOT_COLOURED


def weight_colours(weights: Weights) -> npt.NDArray[np.uint8]:
    """Return the colours of rays by how much they matter: from grey to vermillion.

    >>> weight_colours(np.array([0.0, 1.0])).tolist()
    [[201, 206, 212], [213, 94, 0]]
    """
    ends = np.array([rgb("light grey"), rgb("vermillion")], np.float64)
    shares = np.clip(weights, 0, 1)[:, None]
    colours: npt.NDArray[np.uint8] = np.rint(ends[0] + shares * (ends[1] - ends[0])).astype(
        np.uint8
    )
    return colours


def ray_lines(picture: RayPicture) -> Array:
    """Return a picture's rays as (n, 2, 3) line segments."""
    origins = np.broadcast_to(np.array(picture.origin), picture.ends.shape)
    return np.stack([origins, picture.ends], axis=1)


def ray_dots(lines: Points, radius: float) -> Points:
    """Return the centres of the dots, (n, 3).

    A dot touches the surface that the ray hit from outside, so that the body doesn't cover it.

    Args:
        lines: (n, 2, 3) from the eye to the hit.
        radius: radius of a dot.
    """
    back = lines[:, 0] - lines[:, 1]
    lengths = np.maximum(np.linalg.norm(back, axis=1, keepdims=True), 1e-9)
    dots: Points = lines[:, 1] + back * np.minimum(radius / lengths, 1.0)
    return dots

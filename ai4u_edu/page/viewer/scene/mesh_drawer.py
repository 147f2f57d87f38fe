"""Adds meshes, lines and labels below one scene node, with colours corrected for lighting."""

from typing import Literal

import numpy as np
from viser import BatchedMeshHandle, LabelHandle, LineSegmentsHandle, SceneApi

from ai4u_edu.page.viewer.scene.geometry import Array, Mesh
from ai4u_edu.page.viewer.scene.light import line_colours, surface_colours
from ai4u_edu.snapshot.theme import Rgb

LINE_PX = 1.55
"""Thickness of lines: one pixel at the lowest resolution of a page, which may have no smooth edges
(``web/page/resolution.js``), so that none vanishes."""


class MeshDrawer:
    """Adds things below a scene node; :meth:`finish` adds all collected lines at once.

    Args:
        scene: viser's scene.
        parent: name of the scene node.
    """

    def __init__(self, scene: SceneApi, parent: str) -> None:
        self._scene = scene
        self._parent = parent
        self._lines: list[Array] = []
        self._colours: list[Rgb] = []

    def mesh(
        self, name: str, mesh: Mesh, z: float, colour: Rgb, opacity: float | None = None
    ) -> BatchedMeshHandle:
        """Add a static mesh at a height.

        It is a batch of one mesh: single meshes would need shaders of their own, and compiling
        those takes long without a graphics card.
        """
        batch = self.batch(name, mesh, [colour], opacity)
        batch.position = (0.0, 0.0, z)  # on the node itself: the page sorts nodes by distance
        batch.batched_scales = np.ones(1, np.float32)
        return batch

    def batch(
        self, name: str, mesh: Mesh, colours: list[Rgb], opacity: float | None = None
    ) -> BatchedMeshHandle:
        """Add a mesh once for each colour, all at the origin and with scale 0."""
        count = len(colours)
        return self._scene.add_batched_meshes_simple(
            f"{self._parent}/{name}",
            mesh.vertices,
            mesh.faces,
            np.tile([1.0, 0.0, 0.0, 0.0], (count, 1)),
            np.zeros((count, 3)),
            batched_scales=np.zeros(count),
            batched_colors=surface_colours(colours),
            opacity=opacity,
            # shading in steps, with all light on upward faces; without a graphics card, 1.5 times
            # the frame rate of viser's physically based material
            material="toon5",
            lod="off",  # level of detail would simplify distant meshes, and ours are always distant
            cast_shadow=False,
            receive_shadow=False,
        )

    def moving_lines(self, name: str, count: int, thickness: float = 1.5) -> LineSegmentsHandle:
        """Add line segments whose points and colours are set later; thickness in pixels."""
        return self._scene.add_line_segments(
            f"{self._parent}/{name}",
            np.zeros((count, 2, 3)),
            np.zeros((count, 2, 3), np.uint8),
            thickness=thickness,
            thickness_units="screen",
        )

    def line(self, lines: Array, colour: Rgb) -> None:
        """Collect (n, 2, 3) line segments for :meth:`finish`."""
        self._lines.append(lines)
        self._colours.extend([colour] * len(lines))

    def label(
        self,
        name: str,
        text: str,
        offset: tuple[float, float, float] = (0.0, 0.0, 0.0),
        anchor: Literal["center-center", "top-center", "bottom-center"] = "center-center",
    ) -> LabelHandle:
        """Add a text with a constant size on the screen."""
        return self._scene.add_label(f"{self._parent}/{name}", text, position=offset, anchor=anchor)

    def finish(self) -> None:
        """Add the collected lines as one node."""
        if self._colours:
            colours = line_colours(self._colours)
            lines = self.moving_lines("lines", len(colours), LINE_PX)
            lines.points = np.concatenate(self._lines).astype(np.float32)
            lines.colors = np.stack([colours, colours], axis=1)

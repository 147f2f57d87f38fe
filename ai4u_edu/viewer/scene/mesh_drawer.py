"""Puts meshes, lines and labels under one node of the scene, in the colours they shall have."""

from typing import Literal

import numpy as np
from viser import BatchedMeshHandle, LabelHandle, LineSegmentsHandle, SceneApi

from ai4u_edu.snapshot.theme import Rgb
from ai4u_edu.viewer.scene.geometry import Array, Mesh
from ai4u_edu.viewer.scene.light import strokes, surfaces


class MeshDrawer:
    """Draws below a node; lines are collected and drawn as one by :meth:`finish`.

    Args:
        scene: viser's scene.
        parent: the name of the node.
    """

    def __init__(self, scene: SceneApi, parent: str) -> None:
        self._scene = scene
        self._parent = parent
        self._lines: list[Array] = []
        self._colours: list[Rgb] = []

    def mesh(
        self, name: str, mesh: Mesh, z: float, colour: Rgb, opacity: float | None = None
    ) -> None:
        """Draws a mesh that stays where it is, at a height.

        It is a batch of one: for single meshes a page would have to compile programs of their own
        that do the same, which takes long where there is no graphics card.
        """
        batch = self.batch(name, mesh, [colour], opacity)
        batch.position = (0.0, 0.0, z)  # for the page, which draws what is nearest first
        batch.batched_scales = np.ones(1, np.float32)

    def batch(
        self, name: str, mesh: Mesh, colours: list[Rgb], opacity: float | None = None
    ) -> BatchedMeshHandle:
        """Draws a mesh many times, once for each colour; all of them still at the origin."""
        count = len(colours)
        return self._scene.add_batched_meshes_simple(
            f"{self._parent}/{name}",
            mesh.vertices,
            mesh.faces,
            np.tile([1.0, 0.0, 0.0, 0.0], (count, 1)),
            np.zeros((count, 3)),
            batched_scales=np.zeros(count),
            batched_colors=surfaces(colours),
            opacity=opacity,
            # light by steps: what faces up has all of it, and a page without a graphics card draws
            # half as much again as with viser's physical material
            material="toon5",
            lod="off",  # it would thin out meshes that are far from the camera, as ours always are
            cast_shadow=False,
            receive_shadow=False,
        )

    def moving_lines(self, name: str, count: int, thickness: float = 1.5) -> LineSegmentsHandle:
        """Draws line segments that are to be moved and coloured later; thickness in pixels."""
        return self._scene.add_line_segments(
            f"{self._parent}/{name}",
            np.zeros((count, 2, 3)),
            np.zeros((count, 2, 3), np.uint8),
            thickness=thickness,
            thickness_units="screen",
        )

    def line(self, lines: Array, colour: Rgb) -> None:
        """Adds (n, 2, 3) line segments to what :meth:`finish` draws."""
        self._lines.append(lines)
        self._colours.extend([colour] * len(lines))

    def label(
        self,
        name: str,
        text: str,
        place: tuple[float, float, float] = (0.0, 0.0, 0.0),
        anchor: Literal["center-center", "top-center"] = "center-center",
    ) -> LabelHandle:
        """Writes a text that keeps its size on the screen."""
        return self._scene.add_label(f"{self._parent}/{name}", text, position=place, anchor=anchor)

    def finish(self) -> None:
        """Draws the collected lines."""
        if self._colours:
            colours = strokes(self._colours)
            lines = self.moving_lines("lines", len(colours), 1.3)
            lines.points = np.concatenate(self._lines).astype(np.float32)
            lines.colors = np.stack([colours, colours], axis=1)

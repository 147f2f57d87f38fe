"""Where sensors look at single places of the world: dots that light up where something is."""

from collections.abc import Sequence

import numpy as np
from viser import SceneApi

from ai4u_edu.blocks import SpotPicture
from ai4u_edu.snapshot.theme import SPOT_LIT, SPOT_RADIUS_M, SPOT_UNLIT
from ai4u_edu.viewer.scene.geometry import cap, circle
from ai4u_edu.viewer.scene.light import surfaces
from ai4u_edu.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.viewer.scene.subtree import Subtree


class Spots:
    """Draws dots on one page.

    Args:
        scene: the page's.
    """

    def __init__(self, scene: SceneApi) -> None:
        self._scene = scene
        self._subtree = Subtree(scene, "spots")
        self._colours = surfaces([SPOT_UNLIT, SPOT_LIT])
        self._count = 0

    def draw(self, pictures: Sequence[SpotPicture], lift: float) -> None:
        """Draws these spots, and no others.

        Args:
            pictures: where sensors looked.
            lift: how far above (m): an eye below the body's edge is to be seen too.
        """
        lit = np.array([each for spots in pictures for each in spots.lit], np.intp)
        if len(lit) != self._count:
            self._make(len(lit))
        if len(lit):
            self._dots.batched_positions = np.concatenate(
                [spots.places + np.array([0.0, 0.0, lift]) for spots in pictures],
                dtype=np.float32,
            )
            self._dots.batched_colors = self._colours[lit]

    def _make(self, count: int) -> None:
        with self._subtree.rebuild() as parent:
            if count:
                dot = cap(circle(SPOT_RADIUS_M, corners=16))
                self._dots = MeshDrawer(self._scene, parent).batch(
                    "dots", dot, count * [SPOT_UNLIT]
                )
                self._dots.batched_scales = np.ones(count, np.float32)
        self._count = count

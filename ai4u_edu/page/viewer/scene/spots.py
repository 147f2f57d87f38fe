"""Points at which sensors probe the world: dots that light up where something is detected."""

from collections.abc import Sequence

import numpy as np
from viser import SceneApi

from ai4u_edu.blocks import SpotPicture
from ai4u_edu.page.viewer.scene.geometry import cap, circle
from ai4u_edu.page.viewer.scene.light import surface_colours
from ai4u_edu.page.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.page.viewer.scene.subtree import Subtree
from ai4u_edu.snapshot.theme import SPOT_LIT, SPOT_RADIUS_M, SPOT_UNLIT


class Spots:
    """The probed points, drawn as dots on one page.

    Args:
        scene: viser's scene of the page.
    """

    def __init__(self, scene: SceneApi) -> None:
        self._scene = scene
        self._subtree = Subtree(scene, "spots")
        self._colours = surface_colours([SPOT_UNLIT, SPOT_LIT])
        self._count = 0

    def draw(self, pictures: Sequence[SpotPicture], height: float) -> None:
        """Draw these spots, and remove all others.

        Args:
            pictures: the probed points of each sensor.
            height: height (m) added to the points, so that the agent's body doesn't hide them.
        """
        lit = np.array([each for spots in pictures for each in spots.lit], np.intp)
        if len(lit) != self._count:
            self._rebuild(len(lit))
        if len(lit):
            places = np.concatenate([spots.places for spots in pictures])
            places[:, 2] += height
            # a page moves a node at once, and its instances some frames later
            self.dots.position = places[0]
            self.dots.batched_positions = (places - places[0]).astype(np.float32)
            self.dots.batched_colors = self._colours[lit]

    def _rebuild(self, count: int) -> None:
        with self._subtree.rebuild() as parent:
            if count:
                dot = cap(circle(SPOT_RADIUS_M, corners=16))
                self.dots = MeshDrawer(self._scene, parent).batch("dots", dot, count * [SPOT_UNLIT])
                self.dots.batched_scales = np.ones(count, np.float32)
        self._count = count

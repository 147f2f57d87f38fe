"""Arrows over the floor: where an agent would go from each place, and to which side it turns."""

import numpy as np
import numpy.typing as npt
from viser import BatchedMeshHandle, SceneApi

from ai4u_edu.base.colors import rgb
from ai4u_edu.explain.map_maker import LiveMap
from ai4u_edu.page.viewer.scene.geometry import Array, Mesh, cap, join_meshes
from ai4u_edu.page.viewer.scene.layers import Layers
from ai4u_edu.page.viewer.scene.light import surface_colours
from ai4u_edu.page.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.page.viewer.scene.subtree import Subtree
from ai4u_edu.snapshot.theme import Rgb

MIN_TURN_RAD = 0.02
"""Turn of a decision from which an arrow has the colour of its side."""
MIN_DRIVE_M = 1e-3
"""Way of a decision below which an agent only turns."""
MIN_LENGTH = 0.45
"""Length of the arrow of an agent that stands, relative to that of the fastest one."""
ARROW_LENGTH = 0.85
"""Length of the longest arrow, relative to the distance of two places."""
RIM = 0.05
"""Width of the light rim around an arrow, relative to its length."""
LEFT: Rgb = rgb("blue")
RIGHT: Rgb = rgb("vermillion")
STRAIGHT: Rgb = rgb("black")
"""Colours of arrows by the side that the agent turns to."""


class FieldArrows:
    """The arrows of one map, each with a light rim, as it may lie on dark colours.

    Args:
        scene: viser's scene of the page.
        name: of the scene node.
    """

    def __init__(self, scene: SceneApi, name: str) -> None:
        self._scene, self._subtree = scene, Subtree(scene, name)
        self.arrows: BatchedMeshHandle | None = None
        """An arrow for each place; None if there is no map."""
        self._rims: BatchedMeshHandle | None = None
        self._count = 0

    def clear(self) -> None:
        """Remove all arrows."""
        self._subtree.remove()
        self.arrows = self._rims = None
        self._count = 0

    def set_opacity(self, share: float) -> None:
        """Draw the arrows as opaque as that, 0..1."""
        for handle in (self.arrows, self._rims):
            if handle is not None:
                handle.opacity = share if share < 1 else None  # opaque ones are cheaper to draw

    def draw(self, told: LiveMap | None, grounds: Array, layers: Layers) -> None:
        """Draw a map's arrows, and remove all others.

        Args:
            told: the map.
            grounds: (n,) heights (m) of the floor at its places.
            layers: heights above the floor.
        """
        if told is None or not len(told.poses):
            self.clear()
            return
        if len(told.poses) != self._count:
            self._build(len(told.poses))
        if self.arrows is None or self._rims is None:
            return
        lengths, angles = arrow_shapes(told)
        positions = np.column_stack([told.poses[:, :2], grounds + layers.trail]).astype(np.float32)
        wxyzs = np.zeros((len(angles), 4), np.float32)
        wxyzs[:, 0], wxyzs[:, 3] = np.cos(angles / 2), np.sin(angles / 2)
        for handle, lift in ((self._rims, -0.5 * layers.unit), (self.arrows, 0.0)):
            handle.batched_positions = positions + np.array([0, 0, lift], np.float32)
            handle.batched_wxyzs = wxyzs
            handle.batched_scales = lengths.astype(np.float32)
        self.arrows.batched_colors = surface_colours(arrow_colours(told))

    def _build(self, count: int) -> None:
        self._count = count
        with self._subtree.rebuild() as parent:
            drawer = MeshDrawer(self._scene, parent)
            self._rims = drawer.batch("rims", arrow(RIM), [rgb("white")] * count)
            self.arrows = drawer.batch("arrows", arrow(0.0), [STRAIGHT] * count)


def arrow(rim: float) -> Mesh:
    """Return a flat arrow of length 1 along x around the origin, wider by a rim."""
    shaft = np.array([(0.12, 0.07), (-0.5, 0.07), (-0.5, -0.07), (0.12, -0.07)])
    shaft += rim * np.array([(0.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (0.0, -1.0)])
    head = [(0.5 + 2 * rim, 0.0), (0.1 - rim, 0.24 + 2 * rim), (0.1 - rim, -0.24 - 2 * rim)]
    return join_meshes([cap(shaft), cap(head)])


def arrow_shapes(told: LiveMap) -> tuple[Array, Array]:
    """Return the lengths (m) and the directions (rad) of a field's arrows, (n,) each.

    Who drives goes where the arrow points; who only turns looks there then. The length is 0 where
    nothing is known, or nobody can stand.
    """
    moves = np.nan_to_num(told.moves)
    drives = np.hypot(moves[:, 0], moves[:, 1])
    shares = drives / max(float(drives.max(initial=0.0)), MIN_DRIVE_M)
    lengths = min(told.cell) * ARROW_LENGTH * (MIN_LENGTH + (1 - MIN_LENGTH) * shares)
    lengths[np.isnan(told.moves).any(axis=1)] = 0.0
    looks = told.poses[:, 2] + moves[:, 2]
    angles = np.where(drives > MIN_DRIVE_M, np.arctan2(moves[:, 1], moves[:, 0]), looks)
    return lengths, angles


def arrow_colours(told: LiveMap) -> npt.NDArray[np.int64]:
    """Return the colours of a field's arrows (n, 3), by the side that the agent turns to."""
    turns = np.nan_to_num(told.moves[:, 2])
    sides = np.where(turns > MIN_TURN_RAD, 1, np.where(turns < -MIN_TURN_RAD, 2, 0))
    return np.array([STRAIGHT, LEFT, RIGHT])[sides]

"""The outline of the chosen thing with knobs to rotate and resize it, on one page."""

import numpy as np
import numpy.typing as npt
from viser import BatchedMeshHandle, FrameHandle, LineSegmentsHandle

from ai4u_edu.base.colors import rgb
from ai4u_edu.page.viewer.scene.arena import arena_size
from ai4u_edu.page.viewer.scene.drags import Thing
from ai4u_edu.page.viewer.scene.geometry import cap, circle, grow, heading_wxyz, prism, segments
from ai4u_edu.page.viewer.scene.light import line_colours
from ai4u_edu.page.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.page.viewer.scene.resize import corner_of, outline_of
from ai4u_edu.page.viewer.scene.subtree import Subtree
from ai4u_edu.page.viewer.viewer_client import ViewerClient
from ai4u_edu.snapshot import StaticScene
from ai4u_edu.snapshot.theme import Rgb
from ai4u_edu.world import BodyDescription
from ai4u_edu.world.shapes import Shape

KNOB_RADIUS, KNOB_DISTANCE = 0.02, 0.05
"""Radius of the knobs and the rotation knob's distance, as shares of the arena's size."""
OUTLINE_MARGIN = 0.006
"""Distance of the outline from the thing, as a share of the arena's size."""
INK: Rgb = rgb("vermillion")
SIZE_INK: Rgb = rgb("blue")


class ChosenMark:
    """The mark around the chosen thing: outline, rotation knob, resize knob.

    Args:
        viewer_client: the page.
    """

    def __init__(self, viewer_client: ViewerClient) -> None:
        self._scene = viewer_client.client.scene
        self._subtree = Subtree(self._scene, "chosen")
        self.thing: Thing | None = None
        self.frame: FrameHandle | None = None
        self.turn_knob: BatchedMeshHandle | None = None
        self.size_knob: BatchedMeshHandle | None = None
        self.plate: BatchedMeshHandle | None = None
        """An invisible plate over a chosen floor or area, by which it is moved."""
        self._edge: LineSegmentsHandle | None = None
        self._unit = 1.0

    def build(self, thing: Thing | None, static_scene: StaticScene, plate_z: float = 0.0) -> None:
        """Build the mark for another thing.

        Args:
            thing: None removes the mark.
            static_scene: has the arena's size.
            plate_z: height (m) of a floor's or an area's plate relative to the mark.
        """
        self.thing, self._unit = thing, arena_size(static_scene)
        self.frame = self.turn_knob = self.size_knob = self.plate = self._edge = None
        with self._subtree.rebuild() as parent:
            if thing is None:
                return
            node = f"{parent}/frame"
            self.frame = self._scene.add_frame(node, show_axes=False)
            lines = self._lines(thing.shape)
            self._edge = self._scene.add_line_segments(
                f"{node}/edge",
                lines,
                line_colours(INK),
                thickness=3.0,
                thickness_units="screen",
            )
            drawer = MeshDrawer(self._scene, node)
            self.turn_knob = self._knob(drawer, "knob", self._turn_place(thing.shape), INK)
            self.size_knob = self._knob(drawer, "size", corner_of(thing.shape), SIZE_INK)
            if not isinstance(thing, BodyDescription):
                plate = cap(outline_of(thing.shape))
                self.plate = drawer.batch("plate", plate, [INK], opacity=0.0)
                self.plate.batched_scales = np.ones(1, np.float32)
                self.plate.batched_positions = np.array([(0.0, 0.0, plate_z)], np.float32)

    def place(
        self, x: float, y: float, z: float, heading: float, *, is_visible: bool = True
    ) -> None:
        """Move the mark (m, radians)."""
        if self.frame is not None:
            self.frame.visible = is_visible
            self.frame.position = (x, y, z)
            self.frame.wxyz = heading_wxyz(heading)

    def show_shape(self, shape: Shape) -> None:
        """Show another shape as the outline, during a drag."""
        if self._edge is not None and self.size_knob is not None and self.turn_knob is not None:
            self._edge.points = self._lines(shape)
            self.size_knob.batched_positions = np.array([(*corner_of(shape), 0.0)], np.float32)
            self.turn_knob.batched_positions = np.array(
                [(*self._turn_place(shape), 0.0)], np.float32
            )

    def _lines(self, shape: Shape) -> npt.NDArray[np.float32]:
        outline = np.asarray(outline_of(shape))
        near, far = float(outline[:, 0].max()), self._turn_place(shape)[0]
        edge = segments(grow(outline, OUTLINE_MARGIN * self._unit))
        lines = np.concatenate([edge, np.array([[(near, 0, 0), (far, 0, 0)]])])
        return lines.astype(np.float32)

    def _turn_place(self, shape: Shape) -> tuple[float, float]:
        return max(x for x, _ in outline_of(shape)) + KNOB_DISTANCE * self._unit, 0.0

    def _knob(
        self, drawer: MeshDrawer, name: str, place: tuple[float, float], ink: Rgb
    ) -> BatchedMeshHandle:
        radius = KNOB_RADIUS * self._unit
        knob = drawer.batch(name, prism(circle(radius, corners=24), radius, 0.0), [ink])
        knob.batched_scales = np.ones(1, np.float32)
        knob.batched_positions = np.array([(*place, 0.0)], np.float32)
        return knob

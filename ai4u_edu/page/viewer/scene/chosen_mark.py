"""The mark around the chosen thing: its outline, and knobs with signs that turn and resize it."""

import itertools
import math
from collections.abc import Mapping

import numpy as np
from viser import BatchedMeshHandle, FrameHandle, LabelHandle, LineSegmentsHandle

from ai4u_edu.base.colors import rgb
from ai4u_edu.locale import translate
from ai4u_edu.page.viewer.scene.arena import arena_size
from ai4u_edu.page.viewer.scene.drags import DragAction, Goal, Thing, edge_of, outline_of
from ai4u_edu.page.viewer.scene.geometry import cap, circle, grow, heading_wxyz, prism, segments
from ai4u_edu.page.viewer.scene.light import line_colours
from ai4u_edu.page.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.page.viewer.scene.subtree import Subtree
from ai4u_edu.page.viewer.viewer_client import ViewerClient
from ai4u_edu.snapshot import StaticScene
from ai4u_edu.snapshot.theme import Rgb
from ai4u_edu.world import BodyDescription, BoxShape, CapsuleShape
from ai4u_edu.world.shapes import Shape

INK: Rgb = rgb("vermillion")
_OUTLINE_MARGIN = 0.006
"""Distance of the outline from the thing, as a share of the arena's size."""
_COLOURS: Mapping[DragAction, Rgb] = {
    DragAction.TURN: INK,
    DragAction.RESIZE: rgb("blue"),
    DragAction.LENGTH: rgb("blue"),
    DragAction.WIDTH: rgb("blue"),
    DragAction.HEIGHT: (0, 112, 84),
}
_KNOB = prism(circle(1.0, corners=24), 0.5, 0.0)
_SIGN_Z = 0.55
"""Height of a sign over the bottom of its knob, in radii of the knob."""

_Line = tuple[tuple[float, float], tuple[float, float]]


def _arrow(angle_deg: float) -> list[_Line]:
    """Return an arrow with two heads, as lines in a circle of radius 1."""
    turn = math.radians(angle_deg)
    cos, sin = math.cos(turn), math.sin(turn)
    lines = [((-0.6, 0.0), (0.6, 0.0))]
    for tip in (-0.6, 0.6):
        back = tip - math.copysign(0.3, tip)
        lines += [((tip, 0.0), (back, 0.3)), ((tip, 0.0), (back, -0.3))]
    return [
        (
            (cos * x0 - sin * y0, sin * x0 + cos * y0),
            (cos * x1 - sin * y1, sin * x1 + cos * y1),
        )
        for (x0, y0), (x1, y1) in lines
    ]


def _round_arrow() -> list[_Line]:
    """Return an arrow around the middle."""
    angles = np.radians(np.linspace(60, 350, 11))
    arc = [(0.5 * math.cos(a), 0.5 * math.sin(a)) for a in angles]
    lines = list(itertools.pairwise(arc))
    (x, y) = arc[-1]
    return [*lines, ((x, y), (x - 0.35, y - 0.05)), ((x, y), (x + 0.12, y - 0.34))]


def _up_arrow() -> list[_Line]:
    """Return an arrow from a line on the ground."""
    return [
        ((-0.45, -0.5), (0.45, -0.5)),
        ((0.0, -0.5), (0.0, 0.6)),
        ((0.0, 0.6), (-0.3, 0.25)),
        ((0.0, 0.6), (0.3, 0.25)),
    ]


_SIGNS: Mapping[DragAction, list[_Line]] = {
    DragAction.TURN: _round_arrow(),
    DragAction.RESIZE: _arrow(45),
    DragAction.LENGTH: _arrow(0),
    DragAction.WIDTH: _arrow(90),
    DragAction.HEIGHT: _up_arrow(),
}


class ChosenMark:
    """The mark around the chosen thing.

    Args:
        viewer_client: the page.
    """

    def __init__(self, viewer_client: ViewerClient) -> None:
        self._scene = viewer_client.client.scene
        self._subtree = Subtree(self._scene, "chosen")
        self.thing: Thing | None = None
        self.frame: FrameHandle | None = None
        self.knobs: dict[DragAction, BatchedMeshHandle] = {}
        """The knobs, by what they change."""
        self.plate: BatchedMeshHandle | None = None
        """An invisible plate over a chosen floor or area, by which it is moved."""
        self._edge: LineSegmentsHandle | None = None
        self._signs: LineSegmentsHandle | None = None
        self._value: LabelHandle | None = None
        self._shape: Shape | None = None
        self._unit = self._radius = 1.0

    def build(
        self, thing: Thing | None, static_scene: StaticScene, plate_z: float, radius: float
    ) -> None:
        """Build the mark for another thing.

        Args:
            thing: None removes the mark.
            static_scene: has the arena's size.
            plate_z: height (m) of a floor's or an area's plate relative to the mark.
            radius: of the knobs (m).
        """
        self.thing, self._unit, self._radius = thing, arena_size(static_scene), radius
        self.frame = self.plate = self._edge = self._signs = self._value = None
        self.knobs = {}
        with self._subtree.rebuild() as parent:
            if thing is None:
                return
            node = f"{parent}/frame"
            self.frame = self._scene.add_frame(node, show_axes=False)
            drawer = MeshDrawer(self._scene, node)
            for action in _actions(thing):
                self.knobs[action] = drawer.batch(action.value, _KNOB, [_COLOURS[action]])
            self._edge = self._lines(f"{node}/edge", INK, 3.0)
            self._signs = self._lines(f"{node}/signs", (255, 255, 255), 2.0)
            self._value = self._scene.add_label(f"{node}/value", "", visible=False)
            self.show_shape(thing.shape)
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

    def scale(self, radius: float) -> None:
        """Give the knobs another radius (m), because the camera came nearer or went away."""
        if self._shape is not None and abs(radius - self._radius) > 0.05 * self._radius:
            self._radius = radius
            self.show_shape(self._shape)

    def show_shape(self, shape: Shape) -> None:
        """Show a shape as the outline, with the knobs around it."""
        self._shape = shape
        if self._edge is None or self._signs is None or self._value is None:
            return
        outline = np.asarray(outline_of(shape))
        edge = segments(grow(outline, _OUTLINE_MARGIN * self._unit))
        places = _places(shape, self._radius)
        far = places[DragAction.TURN][0]
        axis = np.array([[(edge[..., 0].max(), 0, 0), (far, 0, 0)]])
        self._edge.points = np.concatenate([edge, axis]).astype(np.float32)
        signs = []
        for action, knob in self.knobs.items():
            knob.batched_scales = np.full(1, self._radius, np.float32)
            knob.batched_positions = np.array([(*places[action], 0.0)], np.float32)
            (x, y), r = places[action], self._radius
            signs += [
                [(x + r * u, y + r * v, _SIGN_Z * r) for u, v in line] for line in _SIGNS[action]
            ]
        self._signs.points = np.array(signs, np.float32)
        self._value.position = (0.0, float(outline[:, 1].min()) - self._radius, 0.0)

    def show_value(self, goal: Goal | None) -> None:
        """Show in words what a drag has reached; None hides it."""
        if self._value is not None:
            self._value.visible = goal is not None and bool(goal.words)
            if goal is not None:
                self._value.text = translate(goal.words)

    def _lines(self, name: str, ink: Rgb, thickness: float) -> LineSegmentsHandle:
        nothing = np.zeros((1, 2, 3), np.float32)
        return self._scene.add_line_segments(
            name, nothing, line_colours(ink), thickness=thickness, thickness_units="screen"
        )


def _actions(thing: Thing) -> list[DragAction]:
    """Return what can be changed by a knob."""
    sides = (
        [DragAction.LENGTH, DragAction.WIDTH]
        if isinstance(thing.shape, BoxShape | CapsuleShape)
        else []
    )
    height = [DragAction.HEIGHT] if isinstance(thing, BodyDescription) else []
    return [DragAction.TURN, DragAction.RESIZE, *sides, *height]


def _places(shape: Shape, radius: float) -> dict[DragAction, tuple[float, float]]:
    """Return the places of knobs, outside the shape and beside each other, in its own frame (m)."""
    left = min(x for x, _ in outline_of(shape)) - radius
    low = min(y for _, y in outline_of(shape))
    high = max(y for _, y in outline_of(shape))
    right = max(x for x, _ in outline_of(shape)) + radius
    middle = (low + high) / 2
    edge_x, edge_y = edge_of(shape, DragAction.RESIZE)
    size = math.hypot(edge_x, edge_y) or 1.0
    if isinstance(shape, BoxShape | CapsuleShape):  # beside the knobs of both sides
        corner = max(right, 2.1 * radius), max(high + radius, middle + 2.1 * radius)
    else:
        out = 1 + radius / size
        corner = out * edge_x, out * edge_y
    return {
        DragAction.TURN: (right + 2.4 * radius, 0.0),
        DragAction.RESIZE: corner,
        DragAction.LENGTH: (right, middle),
        DragAction.WIDTH: (0.0, high + radius),
        DragAction.HEIGHT: (left, middle),
    }

"""A thing that is being moved, rotated or resized by hand."""

import math
from enum import Enum
from typing import NamedTuple

from ai4u_edu.locale import gettext as _
from ai4u_edu.world import (
    AreaDescription,
    BodyDescription,
    BoxShape,
    CapsuleShape,
    CircleShape,
    FloorDescription,
)
from ai4u_edu.world.shapes import Shape

Thing = BodyDescription | FloorDescription | AreaDescription

ROTATION_STEP_DEG, FREE_ROTATION_STEP_DEG = 5.0, 1.0
"""Things rotate in steps of this size, because most walls are meant to be straight."""
MAX_DRAG_M = 1e6
"""Largest distance (m) from the origin to which a thing can be dragged."""
MIN_SIZE_M = 0.1
"""Smallest length (m) that a person can pull a shape to."""
HEIGHT_STEP_M = 0.1
"""Heights are multiples of it."""
FREE_STEP_M = 0.01
"""Lengths are multiples of it if they don't snap to a grid."""


class DragAction(Enum):
    """The part of a thing that is changed."""

    MOVE = "move"
    TURN = "turn"
    RESIZE = "resize"
    LENGTH = "length"
    WIDTH = "width"
    HEIGHT = "height"


class Goal(NamedTuple):
    """Pose and shape that a drag has reached: metres, degrees."""

    x: float
    y: float
    heading_deg: float | None
    shape: Shape | None = None
    height: float | None = None
    """Height of a body (m); None if it stays."""

    @property
    def words(self) -> str:
        """The size, height or heading in words; empty for a move."""
        if self.height is not None:
            return _("{height} m high", height=f"{self.height:g}")
        if self.heading_deg is not None:
            return f"{self.heading_deg:g}°"
        match self.shape:
            case BoxShape(size=(length, width)):
                return f"{length:g} x {width:g} m"
            case CircleShape(radius=radius):
                return _("{width} m wide", width=f"{2 * radius:g}")
            case CapsuleShape(length=length, radius=radius):
                return f"{length + 2 * radius:g} x {2 * radius:g} m"
        return ""


class Drag(NamedTuple):
    """A thing that is being dragged, rotated or resized."""

    thing: Thing
    action: DragAction
    x: float
    y: float
    """Offset from the pointer to the centre; for a rotation or another size, the centre."""
    heading: float = 0.0
    """Heading of the thing, in radians."""
    grip: tuple[float, float] = (0.0, 0.0)
    """Offset from the pointer to the edge that it moves, in the thing's own frame (m)."""

    @classmethod
    def start(
        cls, thing: Thing, action: DragAction, pose: tuple[float, float, float], x: float, y: float
    ) -> "Drag":
        """Return a drag that starts with the pointer at (x, y).

        Args:
            thing: the thing.
            action: what is changed.
            pose: x, y (m) and heading (radians) of the thing.
            x: place of the pointer in the world (m).
            y: likewise.
        """
        at_x, at_y, heading = pose
        if action is DragAction.MOVE:
            return cls(thing, action, at_x - x, at_y - y, heading)
        if action is DragAction.HEIGHT:
            return cls(thing, action, at_x, at_y, heading, (0.0, y))
        along, across = _in_frame(x - at_x, y - at_y, heading)
        edge_x, edge_y = edge_of(thing.shape, action)
        return cls(thing, action, at_x, at_y, heading, (edge_x - along, edge_y - across))

    @property
    def name(self) -> str:
        """Name of the thing."""
        return self.thing.name

    @property
    def is_live(self) -> bool:
        """True if the world follows during the drag; else the page shows an outline only."""
        is_pose = self.action in {DragAction.MOVE, DragAction.TURN}
        return is_pose and isinstance(self.thing, BodyDescription)

    def goal(
        self, x: float, y: float, snap_m: float = 0.0, *, is_free: bool = False
    ) -> Goal | None:
        """Return the goal for a place of the pointer; None for an unusable place.

        Args:
            x: place of the pointer in the world (m); untrusted, it may be NaN.
            y: likewise.
            snap_m: places and sizes are multiples of it; 0 for any.
            is_free: True for any place, size and nearly any heading.
        """
        snap_m = 0.0 if is_free else snap_m
        moves = self.action is DragAction.MOVE
        dx, dy = (x + self.x, y + self.y) if moves else (x - self.x, y - self.y)
        if not math.hypot(dx, dy) <= MAX_DRAG_M:  # also true for NaN
            return None
        if moves:
            return Goal(_on_grid(dx, snap_m), _on_grid(dy, snap_m), None)
        if self.action is DragAction.TURN:
            step = FREE_ROTATION_STEP_DEG if is_free else ROTATION_STEP_DEG
            degrees = math.degrees(math.atan2(dy, dx))
            return Goal(self.x, self.y, step * round(degrees / step))
        if self.action is DragAction.HEIGHT and isinstance(self.thing, BodyDescription):
            step = FREE_STEP_M if is_free else HEIGHT_STEP_M
            height = round(round((self.thing.height + y - self.grip[1]) / step) * step, 3)
            return Goal(self.x, self.y, None, height=max(height, step, MIN_SIZE_M))
        along, across = _in_frame(dx, dy, self.heading)
        shape: Shape = self.thing.shape
        along, across = along + self.grip[0], across + self.grip[1]
        corner = edge_of(shape)
        if self.action is DragAction.LENGTH:
            across = corner[1]
        elif self.action is DragAction.WIDTH:
            along = corner[0]
        new_shape = _only(self.action, shape, _resized(shape, along, across, snap_m))
        dx, dy = _shift(self.action, shape, new_shape)
        cos, sin = math.cos(self.heading), math.sin(self.heading)
        x, y = self.x + cos * dx - sin * dy, self.y + sin * dx + cos * dy
        return Goal(round(x, 4), round(y, 4), None, new_shape)


def _in_frame(dx: float, dy: float, heading: float) -> tuple[float, float]:
    cos, sin = math.cos(heading), math.sin(heading)
    return cos * dx + sin * dy, cos * dy - sin * dx


def _only(action: DragAction, before: Shape, pulled: Shape) -> Shape:
    """Return a pulled shape with the other side as it was, if a side was pulled."""
    if action is DragAction.RESIZE:
        return pulled
    is_length = action is DragAction.LENGTH
    if isinstance(before, BoxShape) and isinstance(pulled, BoxShape):
        (length, width), (new_length, new_width) = before.size, pulled.size
        size = (new_length, width) if is_length else (length, new_width)
        return before.model_copy(update={"size": size})
    if isinstance(before, CapsuleShape) and isinstance(pulled, CapsuleShape):
        changed = {"length": pulled.length} if is_length else {"radius": pulled.radius}
        return before.model_copy(update=changed)
    return pulled


def _shift(action: DragAction, before: Shape, after: Shape) -> tuple[float, float]:
    """Return how far the centre moves (m, own frame), so that the opposite edge stays.

    Circles and other outlines grow around their centre.
    """
    if not isinstance(before, BoxShape | CapsuleShape):
        return 0.0, 0.0
    (old_x, old_y), (new_x, new_y) = edge_of(before), edge_of(after)
    dx = 0.0 if action is DragAction.WIDTH else new_x - old_x
    dy = 0.0 if action is DragAction.LENGTH else new_y - old_y
    return dx, dy


def edge_of(shape: Shape, action: DragAction = DragAction.RESIZE) -> tuple[float, float]:
    """Return the corner or the middle of a side that a knob moves, in the shape's own frame (m).

    >>> edge_of(BoxShape(size=(2, 1))), edge_of(BoxShape(size=(2, 1)), DragAction.LENGTH)
    ((1.0, 0.5), (1.0, 0.0))
    """
    if isinstance(shape, CircleShape):
        return shape.radius * math.sqrt(0.5), shape.radius * math.sqrt(0.5)
    if isinstance(shape, CapsuleShape):  # the corners of its outline are not quite its ends
        x, y = shape.length / 2 + shape.radius, shape.radius
    else:
        outline = outline_of(shape)
        x, y = max(x for x, _ in outline), max(y for _, y in outline)
    return 0.0 if action is DragAction.WIDTH else x, 0.0 if action is DragAction.LENGTH else y


def outline_of(shape: Shape) -> list[tuple[float, float]]:
    """Return a shape's outline; every kind of shape has one."""
    # each kind of shape has an outline, their base has none
    outline: list[tuple[float, float]] = shape.outline()  # type: ignore[attr-defined]
    return outline


def _resized(shape: Shape, x: float, y: float, snap_m: float = 0.0) -> Shape:
    """Return a shape whose corner lies at a place; the opposite one of a box stays where it was.

    Args:
        shape: the shape before.
        x: place of the pointer in the shape's own frame (m).
        y: likewise.
        snap_m: lengths are multiples of it; 0 for free ones.

    >>> _resized(BoxShape(size=(2, 1)), 1.6, 0.52, 0.5).size
    (2.5, 1.0)
    >>> _resized(CircleShape(radius=1), 0.3, 0.4).radius
    0.5
    """
    edge_x, edge_y = edge_of(shape)
    if isinstance(shape, BoxShape):
        size = _length(x + edge_x, snap_m), _length(y + edge_y, snap_m)
        return shape.model_copy(update={"size": size})
    if isinstance(shape, CircleShape):
        return shape.model_copy(update={"radius": _length(2 * math.hypot(x, y), snap_m) / 2})
    if isinstance(shape, CapsuleShape):
        radius = _length(y + edge_y, snap_m) / 2
        length = _length(x + edge_x - 2 * radius, snap_m)
        return shape.model_copy(update={"radius": radius, "length": length})
    reach = math.hypot(edge_x, edge_y)
    return shape.scaled(max(math.hypot(x, y), MIN_SIZE_M) / max(reach, MIN_SIZE_M))


def _length(wanted: float, snap_m: float) -> float:
    step = snap_m or FREE_STEP_M
    return max(round(round(wanted / step) * step, 6), step, MIN_SIZE_M)


def _on_grid(value: float, snap_m: float) -> float:
    return round(round(value / snap_m) * snap_m if snap_m else value, 3)

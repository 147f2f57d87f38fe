"""Marks of the things a sensor refers to: a line to a target and a ring around it, or an area."""

import math
from collections.abc import Iterable

import numpy as np
from viser import LineSegmentsHandle, SceneApi

from ai4u_edu.page.viewer.scene.arena import region_outlines
from ai4u_edu.page.viewer.scene.geometry import Array, circle, rotate, segments
from ai4u_edu.page.viewer.scene.layers import Layers
from ai4u_edu.page.viewer.scene.light import line_colours
from ai4u_edu.snapshot import BodyState, Snapshot
from ai4u_edu.snapshot.block_info import SensorInfo, Window
from ai4u_edu.snapshot.theme import SPOT_LIT, Rgb

RING_RADIUS = 1.25
"""Radius of the ring around a body, as a multiple of the body's reach."""
LINE_THICKNESS_PX = 3.0
INK: Rgb = SPOT_LIT


class Pointers:
    """Marks of sensors' targets, on one page.

    Args:
        scene: viser's scene of the page.
    """

    def __init__(self, scene: SceneApi) -> None:
        self._scene = scene
        self._lines: LineSegmentsHandle | None = None

    def draw(self, snapshot: Snapshot, body: BodyState, sensors: Iterable[SensorInfo]) -> None:
        """Draw the targets of these sensors, and remove all other marks.

        Args:
            snapshot: the shown state of the world.
            body: the body of the sensors' agent.
            sensors: the sensors.
        """
        marks = [mark for sensor in sensors for mark in pointer(snapshot, body, sensor)]
        if not marks:
            if self._lines is not None:
                self._lines.visible = False
            return
        points = np.concatenate(marks).astype(np.float32)
        if self._lines is None:
            self._lines = self._scene.add_line_segments(
                "/pointers",
                points,
                line_colours(INK),
                thickness=LINE_THICKNESS_PX,
                thickness_units="screen",
            )
        self._lines.points, self._lines.visible = points, True


def pointer(snapshot: Snapshot, body: BodyState, sensor: SensorInfo) -> list[Array]:
    """Return a sensor's marks as arrays of line segments (n, 2, 3); world frame, metres."""
    static_scene = snapshot.static_scene
    z = body.z + 2 * Layers.of(static_scene).body
    bodies = {each.name: each for each in snapshot.bodies}
    marks = []
    for described in static_scene.bodies:
        state = bodies[described.name]
        is_target = described.name in sensor.targets or set(described.tags) & set(sensor.groups)
        if is_target and not state.fallen and state.name != body.name:
            reach = described.shape.reach
            ring = segments(circle(RING_RADIUS * reach, state.x, state.y), state.z + z - body.z)
            marks += [ring, _line(body, state.x, state.y, z, short_by=RING_RADIUS * reach)]
    for area in static_scene.areas:
        # paint of a group is seen as it is; outlines of its pieces would cross at each joint
        is_member = not area.paint and set(area.tags) & set(sensor.groups)
        if area.name in sensor.targets or is_member:
            top = static_scene.floor_under(*area.position)
            level = (static_scene.lowest_floor if top is None else top) + z - body.z
            outline, hole = region_outlines(area)
            marks += [segments(edge, level) for edge in (outline, hole) if edge is not None]
            if area.name in sensor.targets:
                marks.append(_line(body, *area.position, z, short_by=0.0))
    if sensor.window is not None:
        marks.append(segments(_window_corners(sensor.window, body), z))
    return marks


def _line(body: BodyState, x: float, y: float, z: float, short_by: float) -> Array:
    """Return a line from the body towards (x, y) that ends ``short_by`` metres before it."""
    dx, dy = x - body.x, y - body.y
    share = max(1 - short_by / max(math.hypot(dx, dy), 1e-9), 0.0)
    end = (body.x + share * dx, body.y + share * dy, z)
    return np.array([[(body.x, body.y, z), end]])


def _window_corners(window: Window, body: BodyState) -> Array:
    """Return the corners of the part of the world that a picture from above shows."""
    along, across = window.size[0] / 2, window.size[1] / 2
    corners = np.array([(along, across), (-along, across), (-along, -across), (along, -across)])
    if window.centre is not None:
        centre, rotated = window.centre, corners
    else:
        centre, rotated = (body.x, body.y), rotate(corners, body.heading)
    moved: Array = rotated + np.array(centre)
    return moved

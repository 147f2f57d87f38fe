"""What a sensor is about, in the scene: a line to its target and a ring around it, or an area."""

import math
from collections.abc import Iterable

import numpy as np
from viser import LineSegmentsHandle, SceneApi

from ai4u_edu.snapshot import BodyState, Snapshot
from ai4u_edu.snapshot.block_info import SensorInfo, Window
from ai4u_edu.snapshot.theme import SPOT_LIT, Rgb
from ai4u_edu.viewer.scene.geometry import Array, circle, segments, turn
from ai4u_edu.viewer.scene.layers import Layers
from ai4u_edu.viewer.scene.light import strokes
from ai4u_edu.viewer.scene.placing import floor_under, lowest_floor, placed

RING = 1.25
"""A ring's radius, as a multiple of how far its body reaches."""
THICKNESS = 3.0
"""Pixels."""
INK: Rgb = SPOT_LIT


def has_pointer(sense: SensorInfo) -> bool:
    """Whether a sensor is about something that can be pointed at."""
    return bool(sense.targets or sense.groups or sense.window)


class Pointers:
    """Draws on one page what sensors are about.

    Args:
        scene: the page's.
    """

    def __init__(self, scene: SceneApi) -> None:
        self._scene = scene
        self._lines: LineSegmentsHandle | None = None

    def draw(self, snapshot: Snapshot, body: BodyState, senses: Iterable[SensorInfo]) -> None:
        """Draws what these sensors of the agent with that body are about, and nothing else."""
        marks = [mark for sense in senses for mark in pointer(snapshot, body, sense)]
        if not marks:
            if self._lines is not None:
                self._lines.visible = False
            return
        points = np.concatenate(marks).astype(np.float32)
        if self._lines is None:
            self._lines = self._scene.add_line_segments(
                "/pointers", points, strokes(INK), thickness=THICKNESS, thickness_units="screen"
            )
        self._lines.points, self._lines.visible = points, True


def pointer(snapshot: Snapshot, body: BodyState, sense: SensorInfo) -> list[Array]:
    """The strokes for a sensor: (n, 2, 3) each, world frame, metres."""
    static_scene = snapshot.static_scene
    z = body.z + 2 * Layers.of(static_scene).body
    bodies = {each.name: each for each in snapshot.bodies}
    marks = []
    for described in static_scene.bodies:
        state = bodies[described.name]
        is_meant = described.name in sense.targets or set(described.tags) & set(sense.groups)
        if is_meant and not state.fallen and state.name != body.name:
            reach = described.shape.reach
            ring = segments(circle(RING * reach, state.x, state.y), state.z + z - body.z)
            marks += [ring, _line(body, state.x, state.y, z, short_by=RING * reach)]
    for area in static_scene.areas:
        if area.name in sense.targets or set(area.tags) & set(sense.groups):
            top = floor_under(static_scene, *area.position)
            level = (lowest_floor(static_scene) if top is None else top) + z - body.z
            outline, hole = placed(area)
            marks += [segments(edge, level) for edge in (outline, hole) if edge is not None]
            if area.name in sense.targets:
                marks.append(_line(body, *area.position, z, short_by=0.0))
    if sense.window is not None:
        marks.append(segments(_corners(sense.window, body), z))
    return marks


def _line(body: BodyState, x: float, y: float, z: float, short_by: float) -> Array:
    """From the body towards a place, and so much short of it."""
    dx, dy = x - body.x, y - body.y
    share = max(1 - short_by / max(math.hypot(dx, dy), 1e-9), 0.0)
    end = (body.x + share * dx, body.y + share * dy, z)
    return np.array([[(body.x, body.y, z), end]])


def _corners(window: Window, body: BodyState) -> Array:
    """The corners of what a picture from above shows."""
    along, across = window.size[0] / 2, window.size[1] / 2
    corners = np.array([(along, across), (-along, across), (-along, -across), (along, -across)])
    if window.centre is not None:
        place, turned = window.centre, corners
    else:
        place, turned = (body.x, body.y), turn(corners, body.heading)
    moved: Array = turned + np.array(place)
    return moved

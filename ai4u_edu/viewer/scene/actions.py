"""Marks for agents' actions: a straight arrow to drive, a bent one to turn, a ring to jump."""

import math
from functools import lru_cache

import numpy as np
from viser import LineSegmentsHandle

from ai4u_edu.snapshot import AgentState, BodyState, Snapshot, StaticScene
from ai4u_edu.snapshot.theme import ACTION
from ai4u_edu.viewer.backend.local_server import LocalServer
from ai4u_edu.viewer.scene.geometry import Array, circle, half_width, rotate, segments
from ai4u_edu.viewer.scene.layers import Layers
from ai4u_edu.viewer.scene.light import line_colours

ACTION_NAME = "move"
"""Name of the drawn action: [forward, turn, jump, forward jump], as AI4U's actuator orders it."""
MAX_TURN_ARROW_RAD = math.radians(75)
"""Angle that the bent arrow spans for a turn of 1."""
MIN_DRAWN_VALUE = 0.02
"""Smallest component of an action that is drawn."""


class Actions:
    """Marks of the last action of every agent."""

    def __init__(self, server: LocalServer) -> None:
        self._scene = server.scene
        self.lines: LineSegmentsHandle | None = None

    def build(self, static_scene: StaticScene) -> None:
        """Read the agents' sizes from a static scene."""
        self._layers = Layers.of(static_scene)
        self._sizes = {
            body.name: (half_width(body.shape.outline()), body.height)
            for body in static_scene.bodies
            if body.name in static_scene.agent_of
        }

    def draw(self, snapshot: Snapshot) -> None:
        """Draw the agents' current actions."""
        bodies = {body.name: body for body in snapshot.bodies if body.name in self._sizes}
        marks = [self._marks(agent, bodies[agent.body]) for agent in snapshot.agents]
        below = self._layers.void - 1.0
        # an invisible segment: given no segments at all, the page would keep the previous ones
        marks.append(np.array([[(0.0, 0.0, below), (1.0, 0.0, below)]]))
        lines = np.concatenate(marks).astype(np.float32)
        if self.lines is None:
            self.lines = self._scene.add_line_segments(
                "/actions", lines, line_colours(ACTION), thickness=2.5, thickness_units="screen"
            )
        self.lines.points = lines

    def _marks(self, agent: AgentState, body: BodyState) -> Array:
        numbers = _effective(agent)
        if len(numbers) != 4 or body.fallen:
            return np.empty((0, 2, 3))
        radius, height = self._sizes[agent.body]
        flat = rotate(action_marks(numbers, radius).reshape(-1, 2), body.heading)
        z = body.z + height + self._layers.body + 3 * self._layers.unit
        points = np.column_stack([flat + np.array([body.x, body.y]), np.full(len(flat), z)])
        return points.reshape(-1, 2, 3)


def _effective(agent: AgentState) -> tuple[float, ...]:
    """Return the numbers of an agent's action, 0 for those that have no effect."""
    numbers = agent.action.get(ACTION_NAME, ())
    for info in agent.actuator_infos:
        if info.name == ACTION_NAME and len(info.components) == len(numbers) == 4:
            names = (each.name for each in info.components)
            drives, turns, jumps, leaps = (name not in info.without_effect for name in names)
            forward, turn, jump, leap = numbers
            # without upward speed, a forward jump is a drive
            ahead = forward * drives + leap * (leaps and not jumps)
            return ahead, turn * turns, jump * jumps, leap * jumps
    return numbers


@lru_cache(maxsize=1024)
def action_marks(numbers: tuple[float, ...], radius: float) -> Array:
    """Return an action's line segments (n, 2, 2), in the frame of a body of that radius (m)."""
    forward, right, jump, forward_jump = (max(-1.0, min(1.0, number)) for number in numbers)
    marks = [np.empty((0, 2, 2))]
    drive = max(-1.0, min(1.0, forward + forward_jump))
    if abs(drive) >= MIN_DRAWN_VALUE:
        start = math.copysign(1.15 * radius, drive)
        path = np.array([(start, 0.0), (start + 1.3 * radius * drive, 0.0)])
        marks.append(_arrow(path, radius))
    if abs(right) >= MIN_DRAWN_VALUE:
        angles = np.linspace(0.0, -right * MAX_TURN_ARROW_RAD, 9)
        path = 1.3 * radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
        marks.append(_arrow(path, radius))
    if max(jump, forward_jump) >= MIN_DRAWN_VALUE:
        marks.append(segments(circle(1.45 * radius, corners=24))[..., :2])
    return np.concatenate(marks)


def _arrow(path: Array, radius: float) -> Array:
    """Return a path's line segments, with an arrowhead at its end."""
    tip = path[-1]
    direction = (tip - path[-2]) / max(float(np.linalg.norm(tip - path[-2])), 1e-9)
    head = [
        np.stack([tip, tip - 0.28 * radius * rotate(direction[None], side)[0]])
        for side in (0.6, -0.6)
    ]
    return np.concatenate([np.stack([path[:-1], path[1:]], axis=1), np.stack(head)])

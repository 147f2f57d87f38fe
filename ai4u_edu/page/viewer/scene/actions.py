"""Marks for agents' actions: a straight arrow to drive, a bent one to turn, a ring to jump."""

import math
from functools import lru_cache

import numpy as np
import numpy.typing as npt
from viser import LineSegmentsHandle

from ai4u_edu.page.viewer.backend.local_server import LocalServer
from ai4u_edu.page.viewer.scene.bodies import Bodies
from ai4u_edu.page.viewer.scene.geometry import (
    Array,
    circle,
    rotate,
    segments,
)
from ai4u_edu.page.viewer.scene.layers import Layers
from ai4u_edu.page.viewer.scene.light import line_colours
from ai4u_edu.page.viewer.scene.subtree import Subtree
from ai4u_edu.snapshot import AgentState, Snapshot, StaticScene
from ai4u_edu.snapshot.marks import half_width
from ai4u_edu.snapshot.theme import ACTION

ACTION_NAME = "move"
"""Name of the drawn action: [forward, turn, jump, forward jump], as AI4U's actuator orders it."""
MAX_TURN_ARROW_RAD = math.radians(75)
"""Angle that the bent arrow spans for a turn of 1."""
MIN_DRAWN_VALUE = 0.02
"""Smallest component of an action that is drawn."""
NO_MARKS: Array = np.empty((0, 2, 2))


class Actions:
    """Marks of the last action of every agent.

    Those of a body that is a node of its own are below that node; all others are lines of one node.

    Args:
        server: viser's.
        bodies: the drawn bodies, which are built before.
    """

    def __init__(self, server: LocalServer, bodies: Bodies) -> None:
        self._scene = server.scene
        self._bodies = bodies
        self._subtree = Subtree(server.scene, "actions")
        self._nodes: dict[str, str] = {}
        self._sizes: dict[str, tuple[float, float]] = {}
        self.below_bodies: dict[str, LineSegmentsHandle] = {}
        """Marks below bodies' nodes, by the name of the body."""
        self._drawn: dict[str, Array] = {}
        self.others: LineSegmentsHandle | None = None
        """Marks of all other agents."""

    def build(self, static_scene: StaticScene) -> None:
        """Create the lines, if the agents or the nodes of their bodies have changed."""
        self._layers = Layers.of(static_scene)
        sizes = {
            body.name: (half_width(body.shape.outline()), body.height)
            for body in static_scene.bodies
            if body.name in static_scene.agent_of
        }
        nodes = {name: node for name, node in self._bodies.nodes.items() if name in sizes}
        if (sizes, nodes) == (self._sizes, self._nodes):
            return
        self._sizes, self._nodes, self._drawn = sizes, dict(nodes), {}
        self.below_bodies = {name: self._lines(f"{node}/action") for name, node in nodes.items()}
        with self._subtree.rebuild() as parent:
            rest = len(nodes) < len(sizes)
            self.others = self._lines(f"{parent}/lines") if rest else None

    def _lines(self, name: str) -> LineSegmentsHandle:
        return self._scene.add_line_segments(
            name,
            np.zeros((1, 2, 3), np.float32),
            line_colours(ACTION),
            thickness=2.5,
            thickness_units="screen",
            visible=False,
        )

    def draw(self, snapshot: Snapshot) -> None:
        """Draw the agents' current actions."""
        bodies = {body.name: body for body in snapshot.bodies if body.name in self._sizes}
        others = []
        for agent in snapshot.agents:
            body = bodies[agent.body]
            radius, height = self._sizes[body.name]
            is_over = body.fallen or agent.terminated or agent.truncated
            numbers = () if is_over else _effective(agent)
            marks = action_marks(numbers, radius) if len(numbers) == 4 else NO_MARKS
            z = height + 3 * self._layers.unit
            lines = self.below_bodies.get(body.name)
            if lines is None:
                flat = rotate(marks.reshape(-1, 2), body.heading) + np.array([body.x, body.y])
                others.append(_at(flat.reshape(-1, 2, 2), body.z + self._layers.body + z))
                continue
            lines.visible = len(marks) > 0
            if lines.visible and self._drawn.get(body.name) is not marks:  # they are cached
                self._drawn[body.name] = marks
                lines.points = _at(marks, z)
        if self.others is not None:
            points = np.concatenate(others)
            self.others.visible = len(points) > 0
            if len(points):
                self.others.points = points


def _at(marks: Array, z: float) -> npt.NDArray[np.float32]:
    """Return flat line segments (n, 2, 2) at a height (m), as (n, 2, 3)."""
    points = np.full((len(marks), 2, 3), z, np.float32)
    points[..., :2] = marks
    return points


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
    marks = [NO_MARKS]
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

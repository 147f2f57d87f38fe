"""Labels of agents and of bodies that have one, with the state of agents' remote scripts."""

import math
from typing import NamedTuple

import numpy as np
from viser import LabelHandle

from ai4u_edu.snapshot import Snapshot, StaticScene
from ai4u_edu.snapshot.agent_words import script_problem
from ai4u_edu.snapshot.theme import label_text
from ai4u_edu.viewer.backend.local_server import LocalServer
from ai4u_edu.viewer.scene.geometry import Array, rotate
from ai4u_edu.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.viewer.scene.subtree import Subtree

HIDDEN_AFTER_DRIVING_S = 1.0
"""World time (s) for which the label of an agent stays hidden after the last key is released: who
drives it looks at what is around it."""


class Labels:
    """Text labels, each below its body on the screen."""

    def __init__(self, server: LocalServer) -> None:
        self._scene = server.scene
        self._subtree = Subtree(server.scene, "labels")
        self._built_for: object = None
        self.labels: list[_Label] = []
        self._driven_at: dict[str, float] = {}

    def build(self, static_scene: StaticScene) -> None:
        """Create the labels, if they have changed."""
        wanted = (static_scene.bodies, static_scene.agent_of)
        if wanted == self._built_for:
            return
        labels = []
        with self._subtree.rebuild() as parent:
            drawer = MeshDrawer(self._scene, parent)
            for index, body in enumerate(static_scene.bodies):
                text = label_text(static_scene, body)
                if text:
                    outline = np.array(body.shape.outline())
                    centre = outline.mean(axis=0)
                    reach = float(np.linalg.norm(outline - centre, axis=1).max())
                    handle = drawer.label(str(index), text, anchor="top-center")
                    label = _Label(index, text, centre, 1.08 * reach, body.height, handle)
                    labels.append(label)
        self.labels, self._built_for = labels, wanted

    def draw(self, snapshot: Snapshot) -> None:
        """Move the labels with their bodies, and update their texts."""
        problems = {agent.body: script_problem(agent) for agent in snapshot.agents}
        for agent in snapshot.agents:
            if agent.held_keys:
                self._driven_at[agent.body] = snapshot.time
        for label in self.labels:
            body = snapshot.bodies[label.number]
            driven_at = self._driven_at.get(body.name, -math.inf)
            is_driven = 0.0 <= snapshot.time - driven_at < HIDDEN_AFTER_DRIVING_S
            problem = problems.get(body.name)
            label.handle.text = f"{label.text}  {problem}" if problem else label.text
            dx, dy = rotate(label.centre[None], body.heading)[0]
            label.handle.position = (body.x + dx, body.y + dy - label.reach, body.z + label.height)
            label.handle.visible = not body.fallen and (not is_driven or bool(problem))


class _Label(NamedTuple):
    number: int
    """Index of the body in the snapshot."""
    text: str
    centre: Array
    """Centre of the body's outline, in the body's frame."""
    reach: float
    """Distance (m) from that centre down to the label."""
    height: float
    """The body's height (m)."""
    handle: LabelHandle

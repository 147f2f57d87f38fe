"""The names of agents and of bodies that have a label, and how it stands with agents' scripts."""

from typing import NamedTuple

import numpy as np
from viser import LabelHandle

from ai4u_edu.snapshot import AgentState, Snapshot, StaticScene
from ai4u_edu.viewer.backend.local_server import LocalServer
from ai4u_edu.viewer.scene.geometry import Array, turn
from ai4u_edu.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.viewer.scene.subtree import Subtree

TROUBLES = {
    "waiting": "⌛ waits for its script",
    "late": "⚠ script is late",
    "lost": "✖ script is lost",
}
"""What is said of an agent whose script doesn't drive it, by the state of its brain."""


class Labels:
    """Writes a body's label below it, as seen on the screen."""

    def __init__(self, server: LocalServer) -> None:
        self._scene = server.scene
        self._subtree = Subtree(server.scene, "labels")
        self._seen: object = None
        self._labels: list[_Label] = []

    def build(self, static_scene: StaticScene) -> None:
        """Writes the labels, if there are other ones than before."""
        wanted = (static_scene.bodies, static_scene.agent_of)
        if wanted == self._seen:
            return
        labels = []
        with self._subtree.rebuild() as parent:
            drawer = MeshDrawer(self._scene, parent)
            for index, body in enumerate(static_scene.bodies):
                text = body.label or (body.name if body.name in static_scene.agent_of else "")
                if text:
                    outline = np.array(body.shape.outline())
                    centre = outline.mean(axis=0)
                    reach = float(np.linalg.norm(outline - centre, axis=1).max())
                    handle = drawer.label(str(index), text, anchor="top-center")
                    label = _Label(index, text, centre, 1.08 * reach, body.height, handle)
                    labels.append(label)
        self._labels, self._seen = labels, wanted

    def draw(self, snapshot: Snapshot) -> None:
        """Keeps the labels at their bodies."""
        troubles = {agent.body: trouble(agent) for agent in snapshot.agents}
        for label in self._labels:
            body = snapshot.bodies[label.number]
            more = troubles.get(body.name)
            label.handle.text = f"{label.text}  {more}" if more else label.text
            dx, dy = turn(label.centre[None], body.heading)[0]
            label.handle.position = (body.x + dx, body.y + dy - label.reach, body.z + label.height)
            label.handle.visible = not body.fallen


def trouble(agent: AgentState) -> str:
    """What is wrong with the script that should drive an agent; empty if nothing is."""
    return TROUBLES.get(agent.remote.state, "") if agent.remote is not None else ""


class _Label(NamedTuple):
    number: int
    """Of its body."""
    text: str
    centre: Array
    """Of the body's outline, in its frame."""
    reach: float
    """How far below that centre the label is written."""
    height: float
    """The body's."""
    handle: LabelHandle

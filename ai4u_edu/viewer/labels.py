"""The names of agents, and of bodies that have a label."""

from typing import NamedTuple

import numpy as np
from viser import LabelHandle

from ai4u_edu.snapshot import Snapshot, Stage
from ai4u_edu.viewer.brush import Brush
from ai4u_edu.viewer.geometry import Array, turn
from ai4u_edu.viewer.local_server import LocalServer
from ai4u_edu.viewer.root import Root


class Labels:
    """Writes a body's label below it, as seen on the screen."""

    def __init__(self, server: LocalServer) -> None:
        self._scene = server.scene
        self._root = Root(server.scene, "labels")
        self._seen: object = None
        self._labels: list[_Label] = []

    def build(self, stage: Stage) -> None:
        """Writes the labels, if there are other ones than before."""
        wanted = (stage.bodies, stage.agent_of)
        if wanted == self._seen:
            return
        labels = []
        with self._root.rebuilt() as root:
            brush = Brush(self._scene, root)
            for index, body in enumerate(stage.bodies):
                text = body.label or (body.name if body.name in stage.agent_of else "")
                if text:
                    outline = np.array(body.shape.outline())
                    centre = outline.mean(axis=0)
                    reach = float(np.linalg.norm(outline - centre, axis=1).max())
                    handle = brush.label(str(index), text, anchor="top-center")
                    labels.append(_Label(index, centre, 1.08 * reach, body.height, handle))
        self._labels, self._seen = labels, wanted

    def draw(self, snapshot: Snapshot) -> None:
        """Keeps the labels at their bodies."""
        for label in self._labels:
            body = snapshot.bodies[label.number]
            dx, dy = turn(label.centre[None], body.heading)[0]
            label.handle.position = (body.x + dx, body.y + dy - label.reach, body.z + label.height)
            label.handle.visible = not body.fallen


class _Label(NamedTuple):
    number: int
    """Of its body."""
    centre: Array
    """Of the body's outline, in its frame."""
    reach: float
    """How far below that centre the label is written."""
    height: float
    """The body's."""
    handle: LabelHandle

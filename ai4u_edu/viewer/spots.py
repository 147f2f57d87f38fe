"""Where sensors look at single places of the world: dots that light up where something is."""

from collections.abc import Callable, Collection

import numpy as np

from ai4u_edu.look import LIT, SPOT, UNLIT
from ai4u_edu.snapshot import Snapshot, Stage
from ai4u_edu.viewer.brush import Brush
from ai4u_edu.viewer.geometry import cap, circle
from ai4u_edu.viewer.layers import Layers
from ai4u_edu.viewer.light import surfaces
from ai4u_edu.viewer.local_server import LocalServer
from ai4u_edu.viewer.root import Root


class Spots:
    """Draws the places at which agents looked last.

    Args:
        server: viser's.
        watched: gives the ids of the agents whose spots are drawn.
    """

    def __init__(self, server: LocalServer, watched: Callable[[], Collection[str]]) -> None:
        self._scene = server.scene
        self._watched = watched
        self._root = Root(server.scene, "spots")
        self._colours = surfaces([UNLIT, LIT])
        self._count = 0

    def build(self, stage: Stage) -> None:
        """Learns how high the agents are: an eye below the body's edge is to be seen too."""
        layers = Layers.of(stage)
        above = layers.body + 3 * layers.unit
        self._lift = {body.name: body.height + above for body in stage.bodies}

    def draw(self, snapshot: Snapshot) -> None:
        """Draws the spots as they are."""
        watched = self._watched()
        gone = {body.name for body in snapshot.bodies if body.fallen}
        seen = [
            (spots, self._lift[agent.body])
            for agent in snapshot.agents
            if agent.id in watched and agent.body not in gone
            for spots in agent.spots.values()
        ]
        lit = np.array([each for spots, _ in seen for each in spots.lit], np.intp)
        if len(lit) != self._count:
            self._make(len(lit))
        if seen:
            self._dots.batched_positions = np.concatenate(
                [spots.places + np.array([0.0, 0.0, lift]) for spots, lift in seen],
                dtype=np.float32,
            )
            self._dots.batched_colors = self._colours[lit]

    def _make(self, count: int) -> None:
        with self._root.rebuilt() as root:
            if count:
                dot = cap(circle(SPOT, corners=16))
                self._dots = Brush(self._scene, root).batch("dots", dot, count * [UNLIT])
                self._dots.batched_scales = np.ones(count, np.float32)
        self._count = count

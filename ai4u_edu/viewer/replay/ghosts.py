"""Ghosts: the agents of a recorded run, drawn where they were at the same time of their episode."""

import math
import threading
from html import escape

from viser import FrameHandle, LabelHandle, SceneApi

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.recording import Episode, Ghost, ghost_of
from ai4u_edu.snapshot import Snapshot, StaticScene
from ai4u_edu.snapshot.theme import Rgb, body_colour, mix_colours
from ai4u_edu.viewer.backend.local_server import LocalServer
from ai4u_edu.viewer.scene.face import face
from ai4u_edu.viewer.scene.geometry import half_width, prism
from ai4u_edu.viewer.scene.layers import Layers
from ai4u_edu.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.viewer.scene.subtree import Subtree
from ai4u_edu.world import BodyDescription

PALE: Rgb = (255, 255, 255)
OPACITY = 0.4
ABOVE = 1.5
"""So many radii above a ghost stands that it is one."""

Pose = tuple[float, float, float, float]


class Ghosts:
    """Draws the ghost of one run, for all pages. It is no body: nothing senses it or touches it.

    Args:
        server: viser's.
    """

    def __init__(self, server: LocalServer) -> None:
        self._scene = server.scene
        self._subtree = Subtree(server.scene, "ghosts")
        self.name = ""
        """Whose ghost it is, in words; empty if there is none."""
        self.problem = ""
        """Why there is no ghost; empty if there is one, or none was wanted."""
        self._episode: Episode | None = None
        self.ghost: Ghost | None = None
        self._made: Ghost | None = None
        self.bodies: list[_Body] = []
        self._layers: Layers | None = None

    def race(self, episode: Episode | None, name: str = "") -> None:
        """Shows the ghost of a run as soon as it is known where it went; None: of none.

        Args:
            episode: the run.
            name: what it is called.
        """
        self._episode, self.ghost, self.problem = episode, None, ""
        self.name = name if episode is not None else ""
        if episode is not None:
            threading.Thread(target=self._play, args=(episode,), name="ghost", daemon=True).start()

    def told(self, snapshot: Snapshot) -> str:
        """What is to be said of the ghost, as HTML; empty if there is none."""
        if self.problem:
            return f"No ghost: {escape(self.problem)}"
        if self._episode is None:
            return ""
        told = f"Ghost: {escape(self.name)}"
        if self._is_elsewhere(snapshot.static_scene):
            return f"{told}. <strong>It ran in another scene.</strong>"
        if snapshot.seed != self._episode.seed:
            seed = self._episode.seed
            return f"{told}. <strong>It began otherwise: with seed {seed}. Race it anew.</strong>"
        return told

    def build(self, static_scene: StaticScene) -> None:
        """Learns how high things are drawn."""
        self._layers, self._made = Layers.of(static_scene), None

    def draw(self, snapshot: Snapshot) -> None:
        """Puts the ghost where it was at this time of its episode."""
        ghost, layers = self.ghost, self._layers
        if ghost is not self._made and layers is not None:
            self._make(ghost, snapshot.static_scene, layers)
        if ghost is None or layers is None:
            return
        now = ghost.at(snapshot.time + 1e-4)  # its times are rounded
        is_fair = self._episode is not None and snapshot.seed == self._episode.seed
        text = "ghost" if is_fair else "ghost of another start"
        for body in self.bodies:
            body.move(now.get(body.name), layers, text)

    def _make(self, ghost: Ghost | None, static_scene: StaticScene, layers: Layers) -> None:
        self._made, self.bodies = ghost, []
        episode = self._episode
        with self._subtree.rebuild() as parent:
            if ghost is None or episode is None or self._is_elsewhere(static_scene):
                return
            drivers = {str(agent.get("body", "")) for agent in episode.scene.agents}
            for number, body in enumerate(episode.scene.bodies):
                if body.name in drivers:
                    node = f"{parent}/{number}"
                    self.bodies.append(_Body(self._scene, node, body, layers))

    def _play(self, episode: Episode) -> None:
        try:
            ghost = ghost_of(episode)
        except AI4UError as error:
            if self._episode is episode:
                self.problem, self.name, self._episode = str(error), "", None
            return
        if self._episode is episode:
            self.ghost = ghost

    def _is_elsewhere(self, static_scene: StaticScene) -> bool:
        """Whether the run's things are others than those that are here; places may be chance."""
        episode = self._episode
        if episode is None:
            return False
        there = {(body.name, body.kind, body.shape) for body in episode.scene.bodies}
        here = {(body.name, body.kind, body.shape) for body in static_scene.bodies}
        return there != here or len(episode.scene.floors) != len(static_scene.floors)


class _Body:
    """An agent's body, seen through; it is made once, and the node that it hangs on is moved."""

    def __init__(self, scene: SceneApi, node: str, body: BodyDescription, layers: Layers) -> None:
        self.name = body.name
        outline = body.shape.outline()
        self._radius = radius = half_width(outline)
        colour = mix_colours(body_colour(body, is_agent=True), PALE, 0.35)
        self.frame: FrameHandle = scene.add_frame(node, show_axes=False, visible=False)
        drawer = MeshDrawer(scene, node)
        # a little below a living body, so that the two never flicker through each other
        shape = prism(outline, body.height, 0.16 * radius)
        drawer.mesh("body", shape, -layers.unit, colour, OPACITY)
        drawer.mesh("face", face(radius, body.height), 0.0, PALE, OPACITY)
        self.label: LabelHandle = MeshDrawer(scene, f"{node}-name").label("label", "")
        self.label.visible = False
        self._pose: Pose | None = None
        self._text = ""

    def move(self, pose: Pose | None, layers: Layers, text: str) -> None:
        """Puts it where it was; out of the world it is not drawn."""
        if (pose is None) != (self._pose is None):
            self.frame.visible = self.label.visible = pose is not None
        if pose is not None and pose != self._pose:
            x, y, z, heading = pose
            self.frame.position = (x, y, z + layers.body)
            self.frame.wxyz = (math.cos(heading / 2), 0.0, 0.0, math.sin(heading / 2))
            self.label.position = (x, y + ABOVE * self._radius, z + layers.body)
        if text != self._text:
            self._text = self.label.text = text
        self._pose = pose

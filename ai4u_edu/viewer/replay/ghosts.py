"""Ghosts: the agents of a recorded episode, drawn translucent at the same time of the episode."""

import threading

from viser import FrameHandle, LabelHandle, SceneApi

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.recording import Episode, Ghost, ghost_of
from ai4u_edu.snapshot import Snapshot, StaticScene
from ai4u_edu.snapshot.marks import half_width
from ai4u_edu.snapshot.theme import Rgb, body_colour, mix_colours
from ai4u_edu.viewer.backend.local_server import LocalServer
from ai4u_edu.viewer.scene.face import face
from ai4u_edu.viewer.scene.geometry import heading_wxyz, prism
from ai4u_edu.viewer.scene.layers import Layers
from ai4u_edu.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.viewer.scene.subtree import Subtree
from ai4u_edu.world import BodyDescription

PALE: Rgb = (255, 255, 255)
OPACITY = 0.4
LABEL_DISTANCE = 1.5
"""Distance of a ghost's label from its centre, in radii."""

Pose = tuple[float, float, float, float]


class Ghosts:
    """The ghosts of one episode, on all pages. They are not bodies: nothing senses or touches them.

    A background thread computes their path; the viewer's thread calls :meth:`build` and
    :meth:`draw`.

    Args:
        server: viser's server.
    """

    def __init__(self, server: LocalServer) -> None:
        self._scene = server.scene
        self._subtree = Subtree(server.scene, "ghosts")
        self.name = ""
        """Name of the episode; empty if there is no ghost."""
        self.problem = ""
        """The reason why a requested ghost can't be shown; else empty."""
        self._episode: Episode | None = None
        self.ghost: Ghost | None = None
        self._built_ghost: Ghost | None = None
        self.bodies: list[_Body] = []
        self._layers: Layers | None = None

    def race(self, episode: Episode | None, name: str = "") -> None:
        """Show an episode's ghost, as soon as its path is computed.

        Args:
            episode: the recorded episode; None removes the ghost.
            name: the episode's name.
        """
        self._episode, self.ghost, self.problem = episode, None, ""
        self.name = name if episode is not None else ""
        if episode is not None:
            threading.Thread(target=self._play, args=(episode,), name="ghost", daemon=True).start()

    def text(self, snapshot: Snapshot) -> str:
        """Return the ghost's name and any problem; empty if there is no ghost."""
        if self.problem:
            return f"No ghost: {self.problem}"
        if self._episode is None:
            return ""
        text = f"Ghost: {self.name}"
        if self._is_of_other_scene(snapshot.static_scene):
            return f"{text}. It ran in another scene."
        if snapshot.seed != self._episode.seed:
            seed = self._episode.seed
            return f"{text}. It began otherwise: with seed {seed}. Race against it again."
        return text

    def build(self, static_scene: StaticScene) -> None:
        """Rebuild the ghost at the next drawing, for a new static scene."""
        self._layers, self._built_ghost = Layers.of(static_scene), None

    def draw(self, snapshot: Snapshot) -> None:
        """Move the ghost to its pose at the snapshot's time."""
        ghost, layers = self.ghost, self._layers
        if ghost is not self._built_ghost and layers is not None:
            self._build_bodies(ghost, snapshot.static_scene, layers)
        if ghost is None or layers is None:
            return
        now = ghost.at(snapshot.time + 1e-4)  # a bit later, because its times are rounded
        is_fair = self._episode is not None and snapshot.seed == self._episode.seed
        text = "ghost" if is_fair else "ghost of another start"
        for body in self.bodies:
            body.move(now.get(body.name), layers, text)

    def _build_bodies(self, ghost: Ghost | None, static_scene: StaticScene, layers: Layers) -> None:
        self._built_ghost, self.bodies = ghost, []
        episode = self._episode
        with self._subtree.rebuild() as parent:
            if ghost is None or episode is None or self._is_of_other_scene(static_scene):
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

    def _is_of_other_scene(self, static_scene: StaticScene) -> bool:
        """Return True if the episode has other bodies or floors; positions may be random."""
        episode = self._episode
        if episode is None:
            return False
        recorded = {(body.name, body.kind, body.shape) for body in episode.scene.bodies}
        current = {(body.name, body.kind, body.shape) for body in static_scene.bodies}
        return recorded != current or len(episode.scene.floors) != len(static_scene.floors)


class _Body:
    """A ghost's translucent body; its meshes are built once, and only their parent node moves."""

    def __init__(self, scene: SceneApi, node: str, body: BodyDescription, layers: Layers) -> None:
        self.name = body.name
        outline = body.shape.outline()
        self._radius = radius = half_width(outline)
        colour = mix_colours(body_colour(body, is_agent=True), PALE, 0.35)
        self.frame: FrameHandle = scene.add_frame(node, show_axes=False, visible=False)
        drawer = MeshDrawer(scene, node)
        # a bit lower than a real body, against z-fighting between the two
        shape = prism(outline, body.height, 0.16 * radius)
        drawer.mesh("body", shape, -layers.unit, colour, OPACITY)
        drawer.mesh("face", face(radius, body.height), 0.0, PALE, OPACITY)
        self.label: LabelHandle = MeshDrawer(scene, f"{node}-name").label("label", "")
        self.label.visible = False
        self._pose: Pose | None = None
        self._text = ""

    def move(self, pose: Pose | None, layers: Layers, text: str) -> None:
        """Move the body; None, for a pose outside the world, hides it."""
        if (pose is None) != (self._pose is None):
            self.frame.visible = self.label.visible = pose is not None
        if pose is not None and pose != self._pose:
            x, y, z, heading = pose
            self.frame.position = (x, y, z + layers.body)
            self.frame.wxyz = heading_wxyz(heading)
            self.label.position = (x, y + LABEL_DISTANCE * self._radius, z + layers.body)
        if text != self._text:
            self._text = self.label.text = text
        self._pose = pose

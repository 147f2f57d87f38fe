"""One ghost: the agents of a recorded episode, translucent, at the same time of the episode."""

import threading

from viser import FrameHandle, LabelHandle, SceneApi

from ai4u_edu.base.colors import rgb
from ai4u_edu.base.errors import AI4UError
from ai4u_edu.page.viewer.scene.face import face
from ai4u_edu.page.viewer.scene.geometry import heading_wxyz, prism
from ai4u_edu.page.viewer.scene.layers import Layers
from ai4u_edu.page.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.page.viewer.scene.subtree import Subtree
from ai4u_edu.recording import Episode, Ghost, ghost_of
from ai4u_edu.recording.snapshot import Snapshot, StaticScene
from ai4u_edu.recording.snapshot.marks import half_width
from ai4u_edu.recording.snapshot.theme import Rgb, body_colour, mix_colours
from ai4u_edu.world import BodyDescription

PALE: Rgb = (255, 255, 255)
OPACITY = 0.4
LABEL_DISTANCE = 1.5
"""Distance of a ghost's label from its centre, in radii."""
LABEL_SPACING = 0.9
"""Distance between the labels of ghosts at one place, in radii."""
COLOURS = tuple(rgb(name) for name in ("orange", "purple", "green"))
"""Colours of several ghosts, none of which is that of the living robot."""

Pose = tuple[float, float, float, float]


class GhostDrive:
    """The ghost of one episode. A background thread computes its path; the viewer's thread draws.

    Args:
        scene: viser's scene.
        node: name of the ghost's node there.
        episode: the recorded episode.
        name: the episode's name.
        label: text at the ghost.
        place: index among several ghosts, which differ by it.
    """

    def __init__(
        self,
        scene: SceneApi,
        node: str,
        episode: Episode,
        name: str,
        label: str = "ghost",
        place: int | None = None,
    ) -> None:
        self._place = place
        self._scene, self._subtree = scene, Subtree(scene, node)
        self._episode, self.name, self._label = episode, name, label
        self.problem = ""
        """The reason why it can't be shown; else empty."""
        self.path: Ghost | None = None
        """The poses by time; None until they are computed."""
        self.bodies: list[_Body] = []
        self._built_for: StaticScene | None = None
        self._layers: Layers | None = None
        threading.Thread(target=self._compute, name="ghost", daemon=True).start()

    def warning(self, snapshot: Snapshot) -> str:
        """Return what makes a race against it unfair; empty if it is fair."""
        if self._is_of_other_scene(snapshot.static_scene):
            return "It ran in another scene."
        if snapshot.seed != self._episode.seed:
            seed = self._episode.seed
            return f"It began otherwise: with seed {seed}. Race against it again."
        return ""

    def draw(self, snapshot: Snapshot, layers: Layers) -> None:
        """Move the ghost to its pose at the snapshot's time."""
        if self.path is None:
            return
        if self._built_for is not snapshot.static_scene or self._layers is not layers:
            self._build(snapshot.static_scene, layers)
        now = self.path.at(snapshot.time + 1e-4)  # a bit later, because its times are rounded
        is_fair = snapshot.seed == self._episode.seed
        text = self._label if is_fair else f"{self._label} of another start"
        for body in self.bodies:
            body.move(now.get(body.name), layers, text)

    def remove(self) -> None:
        """Take it from the scene."""
        self.bodies = []
        self._subtree.remove()

    def _build(self, static_scene: StaticScene, layers: Layers) -> None:
        self._built_for, self._layers, self.bodies = static_scene, layers, []
        recorded = self._episode.scene
        with self._subtree.rebuild() as parent:
            if self._is_of_other_scene(static_scene):
                return
            drivers = {str(agent.get("body", "")) for agent in recorded.agents}
            for number, body in enumerate(recorded.bodies):
                if body.name in drivers:
                    node = f"{parent}/{number}"
                    self.bodies.append(_Body(self._scene, node, body, layers, self._place))

    def _compute(self) -> None:
        try:
            self.path = ghost_of(self._episode)
        except AI4UError as error:
            self.problem = str(error)

    def _is_of_other_scene(self, static_scene: StaticScene) -> bool:
        """Return True if the episode has other bodies or floors; positions may be random."""
        scene = self._episode.scene
        recorded = {(body.name, body.kind, body.shape) for body in scene.bodies}
        current = {(body.name, body.kind, body.shape) for body in static_scene.bodies}
        return recorded != current or len(scene.floors) != len(static_scene.floors)


class _Body:
    """A ghost's translucent body; its meshes are built once, and only their parent node moves."""

    def __init__(
        self,
        scene: SceneApi,
        node: str,
        body: BodyDescription,
        layers: Layers,
        place: int | None,
    ) -> None:
        self.name = body.name
        outline = body.shape.outline()
        radius = half_width(outline)
        own = body_colour(body, is_agent=True)
        colour = mix_colours(own if place is None else COLOURS[place % len(COLOURS)], PALE, 0.35)
        self._label_distance = (LABEL_DISTANCE + LABEL_SPACING * (place or 0)) * radius
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
            self.label.position = (x, y + self._label_distance, z + layers.body)
        if text != self._text:
            self._text = self.label.text = text
        self._pose = pose

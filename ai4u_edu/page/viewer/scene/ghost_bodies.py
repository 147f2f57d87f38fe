"""Ghosts: the agents of recorded episodes, translucent, at the same time of the episode."""

from viser import FrameHandle, LabelHandle, SceneApi

from ai4u_edu.base.colors import rgb
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import translate
from ai4u_edu.page.viewer.backend.local_server import LocalServer
from ai4u_edu.page.viewer.scene.face import face, shell
from ai4u_edu.page.viewer.scene.geometry import heading_wxyz
from ai4u_edu.page.viewer.scene.layers import Layers
from ai4u_edu.page.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.page.viewer.scene.subtree import Subtree
from ai4u_edu.recording.ghosts import GhostDrive, Ghosts
from ai4u_edu.snapshot import Snapshot, StaticScene
from ai4u_edu.snapshot.marks import half_width, robot_parts
from ai4u_edu.snapshot.theme import Rgb, body_colour, mix_colours
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


class GhostBodies:
    """The ghosts on all pages; the viewer's thread calls it.

    Args:
        server: viser's server.
        ghosts: what is drawn.
    """

    def __init__(self, server: LocalServer, ghosts: Ghosts) -> None:
        self._scene, self._ghosts = server.scene, ghosts
        self._drawn: dict[GhostDrive, _Ghost] = {}
        self._layers: Layers | None = None
        self._count = 0

    def build(self, static_scene: StaticScene) -> None:
        """Rebuild the ghosts at the next drawing, for a new static scene."""
        self._layers = Layers.of(static_scene)

    def draw(self, snapshot: Snapshot) -> None:
        """Move the ghosts to their poses at the snapshot's time."""
        drives, layers = self._ghosts.drives, self._layers
        for gone in self._drawn.keys() - set(drives):
            self._drawn.pop(gone).remove()
        if layers is not None:
            for drive in drives:
                if drive.path is not None:
                    self._picture(drive).draw(snapshot, layers)

    def bodies(self, drive: GhostDrive) -> list["_Body"]:
        """Return the bodies of a ghost that are drawn."""
        return self._drawn[drive].bodies if drive in self._drawn else []

    def _picture(self, drive: GhostDrive) -> "_Ghost":
        if drive not in self._drawn:
            self._count += 1
            self._drawn[drive] = _Ghost(self._scene, f"ghost{self._count}-", drive)
        return self._drawn[drive]


class _Ghost:
    """The bodies of one ghost, below a node of their own."""

    def __init__(self, scene: SceneApi, node: str, drive: GhostDrive) -> None:
        self._scene, self._subtree, self._drive = scene, Subtree(scene, node), drive
        self.bodies: list[_Body] = []
        self._built_for: StaticScene | None = None
        self._layers: Layers | None = None

    def draw(self, snapshot: Snapshot, layers: Layers) -> None:
        drive = self._drive
        if drive.path is None:
            return
        if self._built_for is not snapshot.static_scene or self._layers is not layers:
            self._build(snapshot.static_scene, layers)
        # a bit later, because its times are rounded
        now = drive.path.at(snapshot.time / drive.stretch + 1e-4)
        is_fair = snapshot.seed == drive.episode.seed
        text = drive.label
        if not is_fair:
            text = _("{name} of another start", name=drive.label)
        for body in self.bodies:
            body.move(now.get(body.name), layers, translate(text))

    def remove(self) -> None:
        self.bodies = []
        self._subtree.remove()

    def _build(self, static_scene: StaticScene, layers: Layers) -> None:
        self._built_for, self._layers, self.bodies = static_scene, layers, []
        recorded = self._drive.episode.scene
        with self._subtree.rebuild() as parent:
            if self._drive.is_of_other_scene(static_scene):
                return
            drivers = {str(agent.get("body", "")) for agent in recorded.agents}
            for number, body in enumerate(recorded.bodies):
                if body.name in drivers:
                    node, place = f"{parent}/{number}", self._drive.place
                    self.bodies.append(_Body(self._scene, node, body, layers, place))


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
        shape = shell(robot_parts(body), body.height)
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

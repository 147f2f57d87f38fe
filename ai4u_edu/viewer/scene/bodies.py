"""What moves: bodies as prisms with shadows, faces and marks; one batch for each kind of body."""

from collections import defaultdict
from collections.abc import Callable

import numpy as np
import numpy.typing as npt
from viser import BatchedMeshHandle, SceneNodePointerEvent

from ai4u_edu.snapshot import Snapshot, StaticScene
from ai4u_edu.snapshot.theme import VOID, Rgb, body_colour, mix_colours
from ai4u_edu.viewer.backend.local_server import LocalServer
from ai4u_edu.viewer.backend.reporting import reporting
from ai4u_edu.viewer.scene.face import face, pupils, rings
from ai4u_edu.viewer.scene.geometry import cap, half_width, joined, prism, soft
from ai4u_edu.viewer.scene.layers import Layers
from ai4u_edu.viewer.scene.light import surfaces
from ai4u_edu.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.viewer.scene.poses import Poses, poses
from ai4u_edu.viewer.scene.subtree import Subtree

BLACK: Rgb = (0, 0, 0)
LIGHT: Rgb = (240, 243, 246)
DARK: Rgb = (24, 28, 34)
BLUR = 0.16
"""How soft a shadow's edge is at most, in metres."""
RIM = 0.05
"""How wide a body's outline is drawn at most, in metres."""


class Bodies:
    """Draws all bodies; only what moved is sent.

    Args:
        server: viser's.
        on_agent: called with a page's number and a body's name when an agent is clicked on.
    """

    def __init__(self, server: LocalServer, on_agent: Callable[[int, str], None]) -> None:
        self._on_agent = on_agent
        self._scene = server.scene
        self._subtree = Subtree(server.scene, "bodies")
        self._seen: object = None
        self._kinds: list[_Kind] = []

    def build(self, static_scene: StaticScene) -> None:
        """Makes a batch for each kind of body, if there are other bodies than before."""
        self._layers = Layers.of(static_scene)
        wanted = (static_scene.bodies, static_scene.agent_of, self._layers)
        if wanted == self._seen:
            return
        members: defaultdict[object, list[int]] = defaultdict(list)
        for index, body in enumerate(static_scene.bodies):
            role = (body.name in static_scene.agent_of, "target" in body.tags)
            members[body.shape, body.height, role].append(index)
        with self._subtree.rebuild() as parent:
            self._kinds = [
                _Kind(
                    MeshDrawer(self._scene, f"{parent}/{number}"),
                    self._layers,
                    static_scene,
                    indices,
                )
                for number, indices in enumerate(members.values())
            ]
            for kind in self._kinds:
                if kind.names[0] in static_scene.agent_of:
                    kind.listen(self._on_agent)
        self._seen = wanted

    def draw(self, snapshot: Snapshot) -> None:
        """Puts all bodies where they are."""
        where = poses(snapshot, self._layers)
        for kind in self._kinds:
            kind.move(where)


class _Kind:
    """Bodies that look alike but for their colour."""

    def __init__(
        self, drawer: MeshDrawer, layers: Layers, static_scene: StaticScene, members: list[int]
    ) -> None:
        self._members = np.array(members)
        bodies = [static_scene.bodies[index] for index in members]
        self.names = [body.name for body in bodies]
        is_agent = bodies[0].name in static_scene.agent_of
        colours = [body_colour(body, is_agent) for body in bodies]
        self._own = surfaces(colours)
        self._deep = surfaces([mix_colours(colour, VOID, 0.75) for colour in colours])
        outline, height = bodies[0].shape.outline(), bodies[0].height
        radius, top, count = half_width(outline), height + layers.unit, len(members)
        pile = joined([cap(*each) for each in soft(outline, min(BLUR, radius), 5 * layers.unit, 9)])
        self._shadow = drawer.batch("shadow", pile, [BLACK] * count, opacity=0.05)
        body = prism(outline, height, min(RIM, 0.16 * radius))
        self._body = drawer.batch("body", body, colours)
        self._marks = []
        if is_agent:
            eyes = pupils(radius, top + layers.unit)
            self._marks.append(drawer.batch("face", face(radius, top), [LIGHT] * count))
            self._marks.append(drawer.batch("pupils", eyes, [DARK] * count))
        elif "target" in bodies[0].tags:
            self._marks.append(drawer.batch("rings", rings(radius, top), [LIGHT] * count))

    def listen(self, on_agent: Callable[[int, str], None]) -> None:
        """Has a click on a member told, with the page on which it was clicked."""

        async def tell(event: SceneNodePointerEvent[BatchedMeshHandle]) -> None:
            index = event.instance_index
            if index is not None and 0 <= index < len(self.names):
                on_agent(event.client_id, self.names[index])

        self._body.on_click(reporting(tell))

    def move(self, where: Poses) -> None:
        """Puts the members where they are."""
        members = self._members
        places, turns, sizes = where.places[members], where.turns[members], where.sizes[members]
        for batch in (self._body, *self._marks):
            batch.batched_positions = places
            batch.batched_wxyzs = turns
            batch.batched_scales = sizes
        self._shadow.batched_positions = where.shadows[members]
        self._shadow.batched_wxyzs = turns
        self._shadow.batched_scales = where.shadow_sizes[members]
        self._body.batched_colors = self._colours(where.depths[members])

    def _colours(self, depths: npt.NDArray[np.float64]) -> npt.NDArray[np.uint8]:
        """A body that falls fades into the void."""
        if not depths.any():
            return self._own
        share = depths[:, None]
        faded: npt.NDArray[np.float64] = (1 - share) * self._own + share * self._deep
        return faded.round().astype(np.uint8)

"""Labels of agents and of bodies that have one, with the state of agents' remote scripts.

viser draws a label's plate: neither its corners nor its opacity can be set. So labels that would
cover each other are hidden: areas' first, then those of bodies that nobody drives.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from viser import BatchedMeshHandle, LabelHandle, SceneApi

from ai4u_edu.base.colors import rgb
from ai4u_edu.locale import translate
from ai4u_edu.page.viewer.backend.local_server import LocalServer
from ai4u_edu.page.viewer.scene.arena import arena_size, camera_bounds
from ai4u_edu.page.viewer.scene.framing import frame_arena
from ai4u_edu.page.viewer.scene.geometry import Array, circle, flat_mesh, rotate
from ai4u_edu.page.viewer.scene.layers import Layers
from ai4u_edu.page.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.page.viewer.scene.subtree import Subtree
from ai4u_edu.page.viewer.scene.view import Mode, aspect_of
from ai4u_edu.page.viewer.viewer_client import ViewerClient, ViewerClients
from ai4u_edu.snapshot import BodyState, Snapshot, StaticScene
from ai4u_edu.snapshot.agent_words import script_problem
from ai4u_edu.snapshot.theme import label_text, said
from ai4u_edu.world import AreaDescription

HIDDEN_AFTER_DRIVING_S = 1.0
"""World time (s) for which the label of an agent stays hidden after the last key is released: who
drives it looks at what is around it."""
SOUTH = -math.pi / 2
CHAR_PX, LINE_PX = 7.0, 19.0
"""Width of a label's letter, and height of its plate, in pixels of the page."""
WINDOW_PX = 700.0
"""Height (pixels) that a window is taken to have while no page shows the whole arena."""
MAX_COMPARED_LABELS = 64
"""With more labels, none is hidden for another one: comparing all of them takes too long."""


class Labels:
    """Text labels, each below its body on the screen, or in the middle of an area.

    Pages share them, except those whose camera turns: a shared label would cover an agent's face
    there. They have labels of their own, with the same names, which viser shows instead.

    Args:
        server: viser's.
        viewer_clients: the pages.
    """

    def __init__(self, server: LocalServer, viewer_clients: ViewerClients) -> None:
        self._scene, self._viewer_clients = server.scene, viewer_clients
        self._subtree = Subtree(server.scene, "labels")
        self._built_for: object = None
        self.labels: list[_Label] = []
        self.areas: list[_AreaLabel] = []
        """Labels in the middle of areas."""
        self.turned: dict[int, list[_Label]] = {}
        """Labels of pages whose camera turns, by viser's client number."""
        self._driven_at: dict[str, float] = {}

    def build(self, static_scene: StaticScene) -> None:
        """Create the labels, if they have changed."""
        wanted = (static_scene.bodies, static_scene.agent_of, static_scene.areas)
        if wanted == self._built_for:
            return
        for number in tuple(self.turned):
            self._share(number)
        labels = []
        with self._subtree.rebuild() as parent:
            for index, body in enumerate(static_scene.bodies):
                text = label_text(static_scene, body)
                if text:
                    outline = np.array(body.shape.outline())
                    centre = outline.mean(axis=0)
                    reach = float(np.linalg.norm(outline - centre, axis=1).max())
                    handle = _add(self._scene, parent, index, text)
                    labels.append(_Label(index, text, centre, 1.08 * reach, handle, parent))
            areas = [
                _area_label(MeshDrawer(self._scene, parent), area, static_scene)
                for area in static_scene.areas
                if not area.is_flat and not (area.label or area.name).isspace()
            ]
        self.labels, self.areas, self._built_for = labels, areas, wanted

    def draw(self, snapshot: Snapshot) -> None:
        """Move the labels with their bodies, and update their texts."""
        for agent in snapshot.agents:
            if agent.held_keys:
                self._driven_at[agent.body] = snapshot.time
        shown = self._placed(self.labels, snapshot, SOUTH)
        if len(shown) + len(self.areas) <= MAX_COMPARED_LABELS:
            self._hide_covered(shown, snapshot)
        for placed in shown:
            placed.draw()
        for number in self.turned.keys() - self._viewer_clients.keys():
            del self.turned[number]
        for number, viewer_client in self._viewer_clients.items():
            body = _shown_body(viewer_client, snapshot)
            if body is None or viewer_client.view.mode is not Mode.TURN:
                self._share(number)
                continue
            with viewer_client.client.atomic():
                if number not in self.turned:
                    scene = viewer_client.client.scene
                    self.turned[number] = [
                        replace(
                            each,
                            handle=_add(scene, each.parent, each.number, each.text),
                            drawn=None,
                        )
                        for each in self.labels
                    ]
                turned = self._placed(self.turned[number], snapshot, body.heading + math.pi)
                for placed in turned:
                    placed.draw()

    def _share(self, number: int) -> None:
        """Show the shared labels on a page."""
        for label in self.turned.pop(number, ()):
            label.handle.remove()

    def _placed(
        self, labels: "list[_Label]", snapshot: Snapshot, down: float
    ) -> "list[_PlacedLabel]":
        """Return labels where they are to be drawn: below their bodies.

        Args:
            labels: the labels of all pages, or of one.
            snapshot: the shown state of the world.
            down: direction (rad) that is down on the screen.
        """
        problems = {agent.body: script_problem(agent) for agent in snapshot.agents}
        places = []
        for label in labels:
            body = snapshot.bodies[label.number]
            driven_at = self._driven_at.get(body.name, -math.inf)
            is_driven = 0.0 <= snapshot.time - driven_at < HIDDEN_AFTER_DRIVING_S
            problem = problems.get(body.name)
            dx, dy = rotate(label.centre[None], body.heading)[0]
            x = body.x + dx + label.reach * math.cos(down)
            y = body.y + dy + label.reach * math.sin(down)
            place = _PlacedLabel(
                label,
                f"{label.text}  {translate(problem)}" if problem else label.text,
                (x, y, body.z),  # at its foot: a tilted camera would see its face covered
                is_visible=not body.fallen and (not is_driven or bool(problem)),
                rank=0 if problem else 1 if body.name in problems else 2,
            )
            places.append(place)
        return places

    def _hide_covered(self, shown: "list[_PlacedLabel]", snapshot: Snapshot) -> None:
        """Hide labels that would cover a more important one, or a thing that has one.

        Agents are more important than other bodies, and those than areas.
        """
        metres = self._metres_per_pixel(snapshot.static_scene)
        things: list[tuple[int, _Box]] = []
        for placed in shown:
            number = placed.label.number
            body, described = snapshot.bodies[number], snapshot.static_scene.bodies[number]
            if not body.fallen and described.kind != "static":
                half = THING_SHARE * placed.label.reach
                box = body.x - half, body.y - half, body.x + half, body.y + half
                things.append((placed.rank, box))
        kept: list[_Box] = []
        for placed in sorted(shown, key=lambda each: each.rank):
            if not placed.is_visible:
                continue
            x, y, _ = placed.position
            box = _text_box(placed.text, x, y - LINE_PX / 2 * metres, metres)
            covered = [other for rank, other in things if rank < placed.rank] + kept
            if placed.rank and any(_overlap(box, other) for other in covered):
                placed.is_visible = False
            else:
                kept.append(box)
        covered = [other for _, other in things] + kept
        for area in self.areas:
            box = _text_box(area.text, *area.place, metres)
            area.show(is_visible=not any(_overlap(box, other) for other in covered))

    def _metres_per_pixel(self, static_scene: StaticScene) -> float:
        """Return the size (m) of a pixel in the smallest window that shows the whole arena."""
        sizes = [
            frame_arena(camera_bounds(static_scene), aspect_of(camera)).height / camera.image_height
            for camera in (each.client.camera for each in self._viewer_clients.values())
            if camera.image_height > 0
        ]
        return max(sizes, default=arena_size(static_scene) / WINDOW_PX)


_Box = tuple[float, float, float, float]
"""Left, low, right and high edge (m)."""
THING_SHARE = 0.7
"""Half side of the square of a thing that no label should cover, as a share of its reach."""


def _text_box(text: str, x: float, y: float, metres_per_pixel: float) -> _Box:
    """Return the box of a label around its middle."""
    half = metres_per_pixel * CHAR_PX * (len(text) + 1) / 2
    tall = metres_per_pixel * LINE_PX / 2
    return x - half, y - tall, x + half, y + tall


def _overlap(one: _Box, other: _Box) -> bool:
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]


LIGHT_RADIUS = 1.35
"""Outer radius of the light around a speaker, as a multiple of its body's."""


class SpeechBubbles:
    """Messages, shown for a moment: a speech bubble above the speaker, and a light around it."""

    def __init__(self, server: LocalServer) -> None:
        self._scene = server.scene
        self._handles: dict[str, tuple[LabelHandle, BatchedMeshHandle]] = {}

    def build(self, static_scene: StaticScene) -> None:
        """Do nothing: most agents never say anything."""

    def draw(self, snapshot: Snapshot) -> None:
        """Show the latest messages, and remove older ones."""
        texts = said(snapshot) if snapshot.state.world.messages else {}
        for name in [name for name in self._handles if name not in texts]:
            for handle in self._handles.pop(name):
                handle.remove()
        if not texts:
            return
        reaches = {body.name: body.shape.reach for body in snapshot.static_scene.bodies}
        for index, body in enumerate(snapshot.bodies):
            text = texts.get(body.name)
            if text is None or body.name not in reaches:
                continue
            position = (body.x, body.y + 1.1 * reaches[body.name], body.z + 1.0)
            handles = self._handles.get(body.name)
            if handles is None:
                drawer, reach = MeshDrawer(self._scene, "/speech"), reaches[body.name]
                ring = flat_mesh(circle(LIGHT_RADIUS * reach), circle(reach))
                handles = (
                    drawer.label(str(index), text, position, anchor="bottom-center"),
                    drawer.mesh(f"light {index}", ring, 0.0, rgb("yellow"), opacity=0.8),
                )
                self._handles[body.name] = handles
            label, light = handles
            label.text, label.position = text, position
            light.position = (body.x, body.y, body.z + Layers.of(snapshot.static_scene).body)


@dataclass
class _Label:
    number: int
    """Index of the body in the snapshot."""
    text: str
    centre: Array
    """Centre of the body's outline, in the body's frame."""
    reach: float
    """Distance (m) from that centre down to the label."""
    handle: LabelHandle
    parent: str
    """Name of the parent node."""
    drawn: object = None
    """Text, position and visibility that were drawn last."""

    def draw(self, text: str, position: tuple[float, float, float], *, is_visible: bool) -> None:
        """Set what viser draws, if it has changed: viser compares positions slowly."""
        drawn = text, position, is_visible
        if drawn != self.drawn:
            self.drawn = drawn
            self.handle.text, self.handle.position, self.handle.visible = drawn


@dataclass
class _PlacedLabel:
    label: _Label
    text: str
    position: tuple[float, float, float]
    is_visible: bool
    rank: int
    """Lower ones cover higher ones."""

    def draw(self) -> None:
        """Draw it."""
        self.label.draw(self.text, self.position, is_visible=self.is_visible)


@dataclass
class _AreaLabel:
    text: str
    place: tuple[float, float]
    """Its middle (m)."""
    handle: LabelHandle
    is_visible: bool = True

    def show(self, *, is_visible: bool) -> None:
        """Show or hide it, if that has changed."""
        if is_visible != self.is_visible:
            self.is_visible = self.handle.visible = is_visible


def _area_label(drawer: MeshDrawer, area: AreaDescription, static_scene: StaticScene) -> _AreaLabel:
    text, top = area.label or area.name, static_scene.floor_under(*area.position)
    height = static_scene.lowest_floor if top is None else top
    handle = drawer.label(f"area {area.name}/label", text, (*area.position, height))
    return _AreaLabel(text, area.position, handle)


def _add(scene: SceneApi, parent: str, index: int, text: str) -> LabelHandle:
    return MeshDrawer(scene, parent).label(str(index), text, anchor="top-center")


def _shown_body(viewer_client: ViewerClient, snapshot: Snapshot) -> BodyState | None:
    """Return the body of the agent that a page shows."""
    for agent in snapshot.agents:
        if agent.id == viewer_client.agent:
            return next(each for each in snapshot.bodies if each.name == agent.body)
    return None

"""Sensor readings drawn in the scene: on each page, those of the agent that it shows."""

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Protocol

import numpy as np
import numpy.typing as npt
from viser import LineSegmentsHandle, SceneApi

from ai4u_edu.base.colors import rgb
from ai4u_edu.blocks import RayPicture, SpotPicture
from ai4u_edu.page.viewer.backend.part import Part
from ai4u_edu.page.viewer.scene.arena import arena_size, region_outlines
from ai4u_edu.page.viewer.scene.geometry import Array, cap, circle, rotate, segments
from ai4u_edu.page.viewer.scene.layers import Layers
from ai4u_edu.page.viewer.scene.light import line_colours, surface_colours
from ai4u_edu.page.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.page.viewer.scene.subtree import Subtree
from ai4u_edu.page.viewer.viewer_client import ViewerClient, ViewerClients
from ai4u_edu.runtime.frame_budget import SENSES_PER_S, PageTurns
from ai4u_edu.snapshot import AgentState, BodyState, Snapshot, StaticScene
from ai4u_edu.snapshot.block_info import SensorInfo, Window
from ai4u_edu.snapshot.theme import (
    RAY_MISS,
    SPOT_LIT,
    SPOT_RADIUS_M,
    SPOT_UNLIT,
    UNKNOWN_GROUP,
    group_colours,
)

_Points = npt.NDArray[np.float32]
_Weights = npt.NDArray[np.float64]
_NOT_COLOURED: tuple[list[str], list[list[float]]] = ([], [])
_DOT_RADIUS = 0.0055
"""Radius of a dot, as a share of the arena's size."""


class RayStyle:
    """Colours and dot size of the rays on a static scene."""

    def __init__(self, static_scene: StaticScene) -> None:
        colours = {"?": UNKNOWN_GROUP, "": RAY_MISS} | group_colours(static_scene)
        self.index_of_group = {group: index for index, group in enumerate(colours)}
        self.line_colours = line_colours(list(colours.values()))
        self.dot_colours = surface_colours(list(colours.values()))
        self.layers = Layers.of(static_scene)
        self.dot_radius = _DOT_RADIUS * arena_size(static_scene)


class Rays:
    """The rays drawn on one page.

    Args:
        scene: viser's scene of the page.
        style: colours and sizes for the static scene.
    """

    def __init__(self, scene: SceneApi, style: RayStyle) -> None:
        self._scene = scene
        self._subtree = Subtree(scene, "rays")
        self._style, self._count = style, 0
        self._coloured = _NOT_COLOURED

    def build(self, style: RayStyle) -> None:
        """Rebuild the rays at the next drawing, in the style of another static scene."""
        self._style, self._count = style, -1

    def draw(
        self,
        pictures: Sequence[RayPicture],
        heading: float = 0.0,
        weights: Sequence[_Weights | None] = (),
    ) -> None:
        """Draw these rays, and remove all others.

        A page moves nodes at once, and shows new points some frames later. So the points are
        relative to a node at the eye, which turns with the body: late, they still fit the body.

        Args:
            pictures: the rays of each sensor.
            heading: heading (rad) of the sensors' body.
            weights: for each sensor how much each ray matters, 0..1, as its colour; by default, and
                for None, the colour is that of what the ray hits.
        """
        groups = [group for picture in pictures for group in picture.groups]
        if len(groups) != self._count:
            self._rebuild(len(groups))
        if not groups:
            return
        style = self._style
        lines = np.concatenate([ray_lines(picture) for picture in pictures])
        eye = lines[0, 0].copy()
        lines -= eye
        lines[..., :2] = rotate(lines[..., :2].reshape(-1, 2), -heading).reshape(-1, 2, 2)
        lines = lines.astype(np.float32)
        self._subtree.place(eye + np.array([0.0, 0.0, style.layers.body]), heading)
        self.lines.points = lines
        self.dots.batched_positions = ray_dots(lines, style.dot_radius)
        rounded = [[] if each is None else each.round(2).tolist() for each in weights]
        if (groups, rounded) == self._coloured:
            return
        self._coloured = groups, rounded
        indices = np.array([style.index_of_group.get(group, 0) for group in groups])
        colours = style.line_colours[indices]
        ends = np.cumsum([len(picture.groups) for picture in pictures])
        for end, each in zip(ends, weights, strict=False):
            if each is not None:
                colours[end - len(each) : end] = line_colours(weight_colours(each))
        self.lines.colors = colours[:, None].repeat(2, axis=1)
        self.dots.batched_scales = np.array([group != "" for group in groups], dtype=np.float32)
        # meshes, because the page recompiles a point cloud's shader at every change of colour
        self.dots.batched_colors = style.dot_colours[indices]

    def _rebuild(self, count: int) -> None:
        with self._subtree.rebuild() as parent:
            if count:
                drawer = MeshDrawer(self._scene, parent)
                self.lines = drawer.moving_lines("lines", count)
                dot = cap(circle(self._style.dot_radius, corners=12))
                self.dots = drawer.batch("dots", dot, count * [RAY_MISS])
        self._count, self._coloured = count, _NOT_COLOURED


def weight_colours(weights: _Weights) -> npt.NDArray[np.uint8]:
    """Return the colours of rays by how much they matter: from grey to vermillion.

    >>> weight_colours(np.array([0.0, 1.0])).tolist()
    [[201, 206, 212], [213, 94, 0]]
    """
    ends = np.array([rgb("light grey"), rgb("vermillion")], np.float64)
    shares = np.clip(weights, 0, 1)[:, None]
    colours: npt.NDArray[np.uint8] = np.rint(ends[0] + shares * (ends[1] - ends[0])).astype(
        np.uint8
    )
    return colours


def ray_lines(picture: RayPicture) -> Array:
    """Return a picture's rays as (n, 2, 3) line segments."""
    origins = np.broadcast_to(np.array(picture.origin), picture.ends.shape)
    return np.stack([origins, picture.ends], axis=1)


def ray_dots(lines: _Points, radius: float) -> _Points:
    """Return the centres of the dots, (n, 3).

    A dot touches the surface that the ray hit from outside, so that the body doesn't cover it.

    Args:
        lines: (n, 2, 3) from the eye to the hit.
        radius: radius of a dot.
    """
    back = lines[:, 0] - lines[:, 1]
    lengths = np.maximum(np.linalg.norm(back, axis=1, keepdims=True), 1e-9)
    dots: _Points = lines[:, 1] + back * np.minimum(radius / lengths, 1.0)
    return dots


class Spots:
    """The probed points, drawn as dots on one page.

    Args:
        scene: viser's scene of the page.
    """

    def __init__(self, scene: SceneApi) -> None:
        self._scene = scene
        self._subtree = Subtree(scene, "spots")
        self._colours = surface_colours([SPOT_UNLIT, SPOT_LIT])
        self._count = 0

    def draw(self, pictures: Sequence[SpotPicture], height: float) -> None:
        """Draw these spots, and remove all others.

        Args:
            pictures: the probed points of each sensor.
            height: height (m) added to the points, so that the agent's body doesn't hide them.
        """
        lit = np.array([each for spots in pictures for each in spots.lit], np.intp)
        if len(lit) != self._count:
            self._rebuild(len(lit))
        if len(lit):
            places = np.concatenate([spots.places for spots in pictures])
            places[:, 2] += height
            # a page moves a node at once, and its instances some frames later
            self.dots.position = places[0]
            self.dots.batched_positions = (places - places[0]).astype(np.float32)
            self.dots.batched_colors = self._colours[lit]

    def _rebuild(self, count: int) -> None:
        with self._subtree.rebuild() as parent:
            if count:
                dot = cap(circle(SPOT_RADIUS_M, corners=16))
                self.dots = MeshDrawer(self._scene, parent).batch("dots", dot, count * [SPOT_UNLIT])
                self.dots.batched_scales = np.ones(count, np.float32)
        self._count = count


RING_RADIUS = 1.25
"""Radius of the ring around a body, as a multiple of the body's reach."""
_LINE_THICKNESS_PX = 3.0


class _Pointers:
    """Marks of sensors' targets, on one page.

    Args:
        scene: viser's scene of the page.
    """

    def __init__(self, scene: SceneApi) -> None:
        self._scene = scene
        self._lines: LineSegmentsHandle | None = None

    def draw(self, snapshot: Snapshot, body: BodyState, sensors: Iterable[SensorInfo]) -> None:
        """Draw the targets of these sensors, and remove all other marks.

        Args:
            snapshot: the shown state of the world.
            body: the body of the sensors' agent.
            sensors: the sensors.
        """
        marks = [mark for sensor in sensors for mark in pointer(snapshot, body, sensor)]
        if not marks:
            if self._lines is not None:
                self._lines.visible = False
            return
        points = np.concatenate(marks).astype(np.float32)
        if self._lines is None:
            self._lines = self._scene.add_line_segments(
                "/pointers",
                points,
                line_colours(SPOT_LIT),
                thickness=_LINE_THICKNESS_PX,
                thickness_units="screen",
            )
        self._lines.points, self._lines.visible = points, True


def pointer(snapshot: Snapshot, body: BodyState, sensor: SensorInfo) -> list[Array]:
    """Return a sensor's marks as arrays of line segments (n, 2, 3); world frame, metres."""
    static_scene = snapshot.static_scene
    z = body.z + 2 * Layers.of(static_scene).body
    bodies = {each.name: each for each in snapshot.bodies}
    marks = []
    for described in static_scene.bodies:
        state = bodies[described.name]
        is_target = described.name in sensor.targets or set(described.tags) & set(sensor.groups)
        if is_target and not state.fallen and state.name != body.name:
            reach = described.shape.reach
            ring = segments(circle(RING_RADIUS * reach, state.x, state.y), state.z + z - body.z)
            marks += [ring, _line(body, state.x, state.y, z, short_by=RING_RADIUS * reach)]
    for area in static_scene.areas:
        # paint of a group is seen as it is; outlines of its pieces would cross at each joint
        is_member = not area.is_flat and set(area.tags) & set(sensor.groups)
        if area.name in sensor.targets or is_member:
            top = static_scene.floor_under(*area.position)
            level = (static_scene.lowest_floor if top is None else top) + z - body.z
            outline, hole = region_outlines(area)
            marks += [segments(edge, level) for edge in (outline, hole) if edge is not None]
            if area.name in sensor.targets:
                marks.append(_line(body, *area.position, z, short_by=0.0))
    if sensor.window is not None:
        marks.append(segments(_window_corners(sensor.window, body), z))
    return marks


def _line(body: BodyState, x: float, y: float, z: float, short_by: float) -> Array:
    """Return a line from the body towards (x, y) that ends ``short_by`` metres before it."""
    dx, dy = x - body.x, y - body.y
    share = max(1 - short_by / max(math.hypot(dx, dy), 1e-9), 0.0)
    end = (body.x + share * dx, body.y + share * dy, z)
    return np.array([[(body.x, body.y, z), end]])


def _window_corners(window: Window, body: BodyState) -> Array:
    """Return the corners of the part of the world that a picture from above shows."""
    along, across = window.size[0] / 2, window.size[1] / 2
    corners = np.array([(along, across), (-along, across), (-along, -across), (along, -across)])
    if window.centre is not None:
        centre, rotated = window.centre, corners
    else:
        centre, rotated = (body.x, body.y), rotate(corners, body.heading)
    moved: Array = rotated + np.array(centre)
    return moved


RayWeights = Mapping[str, npt.NDArray[np.float64]]
"""Weight of each ray of a sensor, 0..1, by perception key."""


class PictureOption(Protocol):
    """Parts that an option adds to the pictures of all pages; the viewer's thread calls it."""

    def picture_parts(self, pages: ViewerClients) -> Sequence[tuple[Part, float]]:
        """Return what is drawn, and how many times a second at most."""

    def ray_weights(self, page: ViewerClient) -> RayWeights | None:
        """Return how much each ray of a page's agent matters; None to draw rays as usual.

        As long as nothing has changed, the same object comes again.
        """


class SenseOverlay:
    """Rays, spots and targets of sensors, for the agents that pages show.

    Args:
        viewer_clients: the pages.
        rate: how many times a second each page is drawn, at most.
        options: may tell how much each ray matters.
    """

    def __init__(
        self,
        viewer_clients: ViewerClients,
        rate: float = SENSES_PER_S,
        options: Sequence[PictureOption] = (),
    ) -> None:
        self._viewer_clients, self._rate = viewer_clients, rate
        self._options = options
        self._pages: dict[int, _PageOverlay] = {}

    def build(self, static_scene: StaticScene) -> None:
        """Read the agents' sizes and the colours of groups from a static scene."""
        layers = Layers.of(static_scene)
        self._style = RayStyle(static_scene)
        margin = layers.body + 3 * layers.unit
        self._tops = {body.name: body.height + margin for body in static_scene.bodies}
        self._turns = PageTurns(self._rate)
        for page in self._pages.values():
            page.build(self._style)

    def draw(self, snapshot: Snapshot) -> None:
        """Draw the sensors of each page's agent."""
        for gone in self._pages.keys() - self._viewer_clients.keys():
            del self._pages[gone]
        agents = {agent.id: agent for agent in snapshot.agents}
        for number in self._turns.due(self._viewer_clients.keys()):
            viewer_client = self._viewer_clients[number]
            if number not in self._pages:
                self._pages[number] = _PageOverlay(viewer_client, self._style)
            agent = agents.get(viewer_client.agent)
            if agent is not None:
                weights = self._weights(viewer_client)
                self._pages[number].draw(snapshot, agent, self._tops[agent.body], weights)

    def _weights(self, viewer_client: ViewerClient) -> RayWeights | None:
        """Return the rays' weights of the first option that has some for a page."""
        found = (option.ray_weights(viewer_client) for option in self._options)
        return next((weights for weights in found if weights is not None), None)


class _PageOverlay:
    """The overlay of one page."""

    def __init__(self, viewer_client: ViewerClient, style: RayStyle) -> None:
        scene = viewer_client.client.scene
        self._viewer_client = viewer_client
        self._rays, self._spots = Rays(scene, style), Spots(scene)
        self._pointers = _Pointers(scene)
        self._drawn: tuple[object, object] = (None, None)
        self._keys: list[str] = []

    def draw(
        self, snapshot: Snapshot, agent: AgentState, top: float, weights: RayWeights | None
    ) -> None:
        (body,) = (each for each in snapshot.bodies if each.name == agent.body)
        shown = [
            sensor
            for sensor in agent.sensor_infos
            if not (body.fallen or agent.fell)  # its rays go out when it falls
            and self._viewer_client.shows_sensor(sensor.key, is_default=agent.has_marks(sensor))
        ]
        keys = [sensor.key for sensor in shown]
        with self._viewer_client.client.atomic():
            # `rays` is a new object after every reading
            drawn = self._drawn
            if agent.rays is not drawn[0] or weights is not drawn[1] or keys != self._keys:
                self._drawn, self._keys = (agent.rays, weights), keys
                seeing = [key for key in keys if key in agent.rays]
                matters = [(weights or {}).get(key) for key in seeing]
                self._rays.draw([agent.rays[key] for key in seeing], body.heading, matters)
                self._spots.draw([agent.spots[key] for key in keys if key in agent.spots], top)
            self._pointers.draw(snapshot, body, shown)

    def build(self, style: RayStyle) -> None:
        self._drawn = (None, None)
        self._rays.build(style)

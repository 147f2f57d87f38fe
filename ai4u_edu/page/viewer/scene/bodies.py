"""Bodies, drawn as prisms with shadows and marks; one batched mesh for each group of body.

A page moves a scene node in the frame in which its new pose arrives, and the instances of a batch
some frames later. Labels are nodes, so they would run ahead of batched bodies: a few bodies with
labels are nodes of their own.
"""

import math
import time
from collections import defaultdict
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
from viser import BatchedMeshHandle, SceneApi, SceneNodePointerEvent

from ai4u_edu.page.viewer.backend.local_server import LocalServer
from ai4u_edu.page.viewer.backend.reporting import report_errors
from ai4u_edu.page.viewer.scene.face import face, pupils, rings
from ai4u_edu.page.viewer.scene.geometry import Array, cap, join_meshes, prism, soft_shadow
from ai4u_edu.page.viewer.scene.layers import Layers
from ai4u_edu.page.viewer.scene.light import surface_colours
from ai4u_edu.page.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.page.viewer.scene.subtree import Subtree
from ai4u_edu.snapshot import AgentState, BodyState, Snapshot, StaticScene
from ai4u_edu.snapshot.marks import DARK, LIGHT, half_width
from ai4u_edu.snapshot.theme import VOID, Rgb, body_colour, label_text, mix_colours
from ai4u_edu.world import CircleShape

PULSE_S = 1.0
"""Duration of a pulse, wall time (s)."""
_PULSE_COUNT = 2
"""Times that a body grows and shrinks during a pulse."""
_PULSE_GROWTH = 0.22
"""Share by which a body grows."""
_MAX_GAP_M = 0.15
"""Largest gap (m) between an agent and the body that it has reached."""


def reached_target(snapshot: Snapshot, agent: AgentState) -> str:
    """Return the name of the target that an agent has reached; empty if it has reached none.

    It is the nearest body with the tag ``target`` within reach of an agent whose episode has ended
    with success.
    """
    if not (agent.succeeded and (agent.terminated or agent.truncated)):
        return ""
    shapes = {body.name: body for body in snapshot.static_scene.bodies}
    states = {body.name: body for body in snapshot.bodies}
    own, reach = states[agent.body], shapes[agent.body].shape.reach
    gaps = {
        name: math.hypot(states[name].x - own.x, states[name].y - own.y) - body.shape.reach - reach
        for name, body in shapes.items()
        if "target" in body.tags and name != agent.body and not states[name].fallen
    }
    nearest = min(gaps, key=gaps.__getitem__, default="")
    return nearest if nearest and gaps[nearest] <= _MAX_GAP_M else ""


class Pulse:
    """Scales of bodies: above 1 while one pulses.

    Args:
        clock: wall clock (s); replaced in tests.
        is_motion_reduced: returns True while nothing may pulse.
    """

    def __init__(
        self,
        clock: Callable[[], float] = time.monotonic,
        is_motion_reduced: Callable[[], bool] = lambda: False,
    ) -> None:
        self._clock, self._is_motion_reduced = clock, is_motion_reduced
        self._began: dict[tuple[str, int, int], tuple[str, float]] = {}

    def scales(self, snapshot: Snapshot) -> Array:
        """Return the scale of each body of a snapshot, shape (n,)."""
        now, began = self._clock(), {}
        for agent in snapshot.agents:
            name = reached_target(snapshot, agent)
            if name:
                episode = agent.id, snapshot.episode, agent.episode
                began[episode] = self._began.get(episode, (name, now))
        self._began = began
        pulses = () if self._is_motion_reduced() else began.values()
        sizes = {name: _pulse_scale(now - start) for name, start in pulses}
        return np.array([sizes.get(body.name, 1.0) for body in snapshot.bodies])


def _pulse_scale(seconds: float) -> float:
    """Return a body's scale a time after it was reached.

    >>> [round(_pulse_scale(seconds), 2) for seconds in (0.0, 0.25, 0.5, 0.75, 1.0, 9.0)]
    [1.0, 1.22, 1.0, 1.22, 1.0, 1.0]
    """
    if not 0.0 <= seconds < PULSE_S:
        return 1.0
    return 1.0 + _PULSE_GROWTH * math.sin(math.pi * _PULSE_COUNT * seconds / PULSE_S) ** 2


_SHADOW_DIRECTION = np.array([0.6, -0.8])
"""Unit vector along which shadows fall."""
SHADOW_OFFSET_M = 0.11
"""Distance (m) of the shadow from a body that stands on the ground."""
_SHADOW_OFFSET_PER_HEIGHT = 0.5
"""Additional distance for each metre above the ground."""
_MIN_FALLING_SCALE = 0.35
"""Scale of a body at the height at which it leaves the world."""


class DrawnPoses(NamedTuple):
    """The drawn poses of all bodies, one row for each."""

    positions: Array
    """(n, 3)"""
    wxyzs: Array
    """(n, 4) quaternions w, x, y, z."""
    scales: Array
    """(n,) 1 normally, less while a body falls, 0 for bodies that left the world."""
    depths: Array
    """(n,) 0 on or above the lowest floor, 1 at the height at which a body leaves the world."""
    shadow_positions: Array
    """(n, 3)"""
    shadow_scales: Array
    """(n,) 0 where there is no ground for the shadow."""


def compute_poses(snapshot: Snapshot, layers: Layers) -> DrawnPoses:
    """Return the drawn poses of all bodies of a snapshot.

    It runs in every frame, usually for few bodies: so it makes few calls of numpy.
    """
    bodies, static_scene = snapshot.bodies, snapshot.static_scene
    grounds = [_ground(snapshot, body) for body in bodies]
    numbers = np.array(
        [(b.x, b.y, b.z, b.heading, g or 0.0) for b, g in zip(bodies, grounds, strict=True)]
    ).reshape(-1, 5)
    heights, half_headings, ground_heights = numbers[:, 2], numbers[:, 3] / 2, numbers[:, 4]
    is_gone = np.array([body.fallen for body in bodies], dtype=bool)
    is_void = np.array([ground is None for ground in grounds], dtype=bool)
    lowest = static_scene.lowest_floor
    reach = max(lowest - static_scene.settings.fall_threshold, 0.1)
    depths = np.minimum(np.maximum((lowest - heights) / reach, 0.0), 1.0)
    scales = 1 - (1 - _MIN_FALLING_SCALE) * depths
    scales[is_gone] = 0.0
    rise = np.maximum(heights - ground_heights, 0.0)
    rise[is_void] = 0.0
    positions = numbers[:, :3] + (0.0, 0.0, layers.body)
    wxyzs = np.zeros((len(bodies), 4))
    wxyzs[:, 0], wxyzs[:, 3] = np.cos(half_headings), np.sin(half_headings)
    shadow_positions = np.empty((len(bodies), 3))
    offset = SHADOW_OFFSET_M + _SHADOW_OFFSET_PER_HEIGHT * rise
    shadow_positions[:, :2] = numbers[:, :2] + offset[:, None] * _SHADOW_DIRECTION
    shadow_positions[:, 2] = ground_heights + layers.shadow
    shadow_scales = np.ones(len(bodies))
    shadow_scales[is_void | is_gone] = 0.0
    return DrawnPoses(positions, wxyzs, scales, depths, shadow_positions, shadow_scales)


def _ground(snapshot: Snapshot, body: BodyState) -> float | None:
    """Return the height of the ground under a body; None over the void."""
    if body.on_ground:
        return body.z
    return snapshot.static_scene.floor_under(body.x, body.y, body.z)


BLACK: Rgb = (0, 0, 0)
MAX_SHADOW_BLUR_M = 0.16
"""Largest width (m) of a shadow's soft edge."""
SHADOW_LAYERS = 9
"""Number of translucent layers that make a shadow's soft edge."""
MAX_LABELLED_NODES = 6
"""Most bodies with labels that are nodes of their own; if there are more, all are batched."""
MAX_RIM_M = 0.05
"""Largest width (m) of the dark rim that outlines a body."""


class Bodies:
    """All bodies of the world; viser sends only what changed.

    Args:
        server: viser's.
        on_agent: called with viser's client id and a body's name when an agent is clicked.
        is_motion_reduced: returns True if nothing may pulse; all pages share the bodies.
    """

    def __init__(
        self,
        server: LocalServer,
        on_agent: Callable[[int, str], None],
        is_motion_reduced: Callable[[], bool],
    ) -> None:
        self._on_agent = on_agent
        self._scene = server.scene
        self._subtree = Subtree(server.scene, "bodies")
        self._built_for: object = None
        self._groups: list[_BodyGroup] = []
        self._pulse = Pulse(is_motion_reduced=is_motion_reduced)
        self.nodes: dict[str, str] = {}
        """Names of the scene nodes of bodies that have their own, by the name of the body."""

    def build(self, static_scene: StaticScene) -> None:
        """Create a batch for each kind of body, if the bodies have changed."""
        self._layers = Layers.of(static_scene)
        wanted = (static_scene.bodies, static_scene.agent_of, self._layers)
        if wanted == self._built_for:
            return
        labelled = {
            body.name
            for body in static_scene.bodies
            if body.kind != "static" and label_text(static_scene, body)
        }
        nodes = labelled if len(labelled) <= MAX_LABELLED_NODES else ()
        members: defaultdict[tuple[object, str], list[int]] = defaultdict(list)
        for index, body in enumerate(static_scene.bodies):
            role = (body.name in static_scene.agent_of, "target" in body.tags)
            node = body.name if body.name in nodes else ""
            members[(body.shape, body.height, role), node].append(index)
        with self._subtree.rebuild() as parent:
            self._groups = [
                _BodyGroup(
                    self._scene,
                    f"{parent}/{number}",
                    self._layers,
                    static_scene,
                    indices,
                    is_node=bool(node),
                )
                for number, ((_, node), indices) in enumerate(members.items())
            ]
            self.nodes = {
                node: f"{parent}/{number}" for number, (_, node) in enumerate(members) if node
            }
            for group in self._groups:
                if group.names[0] in static_scene.agent_of:
                    group.listen(self._on_agent)
        self._built_for = wanted

    def draw(self, snapshot: Snapshot) -> None:
        """Move all bodies to their current poses."""
        poses = compute_poses(snapshot, self._layers)
        poses = poses._replace(scales=poses.scales * self._pulse.scales(snapshot))
        for group in self._groups:
            group.move(poses)


class _BodyGroup:
    """Bodies that differ only in colour and pose, or one body whose meshes are moved as nodes."""

    def __init__(
        self,
        scene: SceneApi,
        name: str,
        layers: Layers,
        static_scene: StaticScene,
        members: list[int],
        *,
        is_node: bool,
    ) -> None:
        self._members = np.array(members)
        self._looks: tuple[Array, Array, Array] | None = None
        self._is_round = all(
            isinstance(static_scene.bodies[index].shape, CircleShape) for index in members
        )
        self._placed: tuple[npt.NDArray[Any], ...] = (np.empty(0),) * 3
        self._frame = scene.add_frame(name, show_axes=False) if is_node else None
        drawer = MeshDrawer(scene, name)
        bodies = [static_scene.bodies[index] for index in members]
        self.names = [body.name for body in bodies]
        is_agent = bodies[0].name in static_scene.agent_of
        colours = [body_colour(body, is_agent) for body in bodies]
        self._own = surface_colours(colours)
        self._deep = surface_colours([mix_colours(colour, VOID, 0.75) for colour in colours])
        outline, height = bodies[0].shape.outline(), bodies[0].height
        radius, top, count = half_width(outline), height + layers.unit, len(members)
        blur = min(MAX_SHADOW_BLUR_M, radius)
        shadow = soft_shadow(outline, blur, 5 * layers.unit, SHADOW_LAYERS)
        shadow_mesh = join_meshes([cap(*each) for each in shadow])
        # not below the body's node, since it moves otherwise
        self._shadow = MeshDrawer(scene, f"{name} shadow").batch(
            "shadow", shadow_mesh, [BLACK] * count, opacity=0.05
        )
        body = prism(outline, height, min(MAX_RIM_M, 0.16 * radius))
        self._body = drawer.batch("body", body, colours)
        self._marks = []
        if is_agent:
            eyes = pupils(radius, top + layers.unit)
            self._marks.append(drawer.batch("face", face(radius, top), [LIGHT] * count))
            self._marks.append(drawer.batch("pupils", eyes, [DARK] * count))
        elif "target" in bodies[0].tags:
            self._marks.append(drawer.batch("rings", rings(radius, top), [LIGHT] * count))

    def listen(self, on_agent: Callable[[int, str], None]) -> None:
        """Call ``on_agent`` with the client id and the body's name when a member is clicked."""

        async def on_click(event: SceneNodePointerEvent[BatchedMeshHandle]) -> None:
            index = event.instance_index
            if index is not None and 0 <= index < len(self.names):
                on_agent(event.client_id, self.names[index])

        self._body.on_click(report_errors(on_click))

    def move(self, poses: DrawnPoses) -> None:
        """Move the members to their current poses."""
        members = self._members
        self._place(poses.positions[members], poses.shadow_positions[members], poses.wxyzs[members])
        looks = poses.scales[members], poses.shadow_scales[members], poses.depths[members]
        if self._looks is not None and all(map(np.array_equal, looks, self._looks)):
            return
        self._looks = looks
        for batch in (self._body, *self._marks):
            batch.batched_scales = poses.scales[members]
        self._shadow.batched_scales = poses.shadow_scales[members]
        self._body.batched_colors = self._colours(poses.depths[members])

    def _place(self, *placed: npt.NDArray[Any]) -> None:
        """Set what has changed: viser's own comparison takes longer than all else in a frame.

        Args:
            placed: positions (n, 3) and positions of the shadows (n, 3) in metres, wxyzs (n, 4).
        """
        positions, shadow_positions, wxyzs = placed
        before, self._placed = self._placed, placed
        moved, shadow_moved, turned = (
            not np.array_equal(*each) for each in zip(placed, before, strict=True)
        )
        if self._frame is None:
            for batch in (self._body, *self._marks):
                if moved:
                    batch.batched_positions = positions
                if turned:
                    batch.batched_wxyzs = wxyzs
            if shadow_moved:
                self._shadow.batched_positions = shadow_positions
            if turned:
                self._shadow.batched_wxyzs = wxyzs
            return
        if moved:
            self._frame.position = positions[0]
        if shadow_moved:
            self._shadow.position = shadow_positions[0]
        if turned:
            self._frame.wxyz = wxyzs[0]
            if not self._is_round:  # a round shadow looks the same
                self._shadow.wxyz = wxyzs[0]

    def _colours(self, depths: npt.NDArray[np.float64]) -> npt.NDArray[np.uint8]:
        """Return the members' colours; a falling body fades to the colour of the void."""
        if not depths.any():
            return self._own
        share = depths[:, None]
        faded: npt.NDArray[np.float64] = (1 - share) * self._own + share * self._deep
        return faded.round().astype(np.uint8)

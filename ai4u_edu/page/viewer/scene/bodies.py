"""Bodies, drawn as prisms with shadows and marks; one batched mesh for each group of body.

A page moves a scene node in the frame in which its new pose arrives, and the instances of a batch
some frames later. Labels are nodes, so they would run ahead of batched bodies: a few bodies with
labels are nodes of their own.
"""

import math
import time
from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
from viser import BatchedMeshHandle, SceneApi, SceneNodePointerEvent

from ai4u_edu.page.viewer.backend.local_server import LocalServer
from ai4u_edu.page.viewer.backend.reporting import report_errors
from ai4u_edu.page.viewer.scene.face import (
    EYE_RISE,
    MovingParts,
    chassis,
    face,
    pupils,
    rings,
    shell,
)
from ai4u_edu.page.viewer.scene.geometry import (
    cap,
    circle,
    join_meshes,
    prism,
    soft_shadow,
)
from ai4u_edu.page.viewer.scene.layers import Layers
from ai4u_edu.page.viewer.scene.light import surface_colours
from ai4u_edu.page.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.page.viewer.scene.subtree import Subtree
from ai4u_edu.snapshot import AgentState, BodyState, Snapshot, StaticScene
from ai4u_edu.snapshot.marks import (
    CHASSIS,
    DARK,
    LIGHT,
    PUPIL_SHIFT,
    half_width,
    look_direction,
    robot_parts,
)
from ai4u_edu.snapshot.theme import RAY_MISS, VOID, Rgb, body_colour, label_text, mix_colours
from ai4u_edu.world import CircleShape

PULSE_S = 1.0
"""Duration of a pulse, wall time (s)."""
SLOW_FALL_S = 1.0
"""Duration of a fall's drawing, wall time (s): slow in its first half, catching up in the other."""
_SLOWNESS = 3.0
"""Factor by which a fall is slower at first."""
PUFF_S = 0.6
"""Duration of the puff where a body left its floor, wall time (s)."""
_PUFF_BALLS = 7
"""Discs of a puff, in a ring."""
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

    def scales(self, snapshot: Snapshot) -> dict[str, float]:
        """Return the scale of each body of a snapshot that pulses, by its name."""
        now, began = self._clock(), {}
        for agent in snapshot.agents:
            name = reached_target(snapshot, agent)
            if name:
                episode = agent.id, snapshot.episode, agent.episode
                began[episode] = self._began.get(episode, (name, now))
        self._began = began
        pulses = () if self._is_motion_reduced() else began.values()
        return {name: _pulse_scale(now - start) for name, start in pulses}


def _pulse_scale(seconds: float) -> float:
    """Return a body's scale a time after it was reached.

    >>> [round(_pulse_scale(seconds), 2) for seconds in (0.0, 0.25, 0.5, 0.75, 1.0, 9.0)]
    [1.0, 1.22, 1.0, 1.22, 1.0, 1.0]
    """
    if not 0.0 <= seconds < PULSE_S:
        return 1.0
    return 1.0 + _PULSE_GROWTH * math.sin(math.pi * _PULSE_COUNT * seconds / PULSE_S) ** 2


class SlowFall:
    """The states in which bodies are drawn: an agent's falls slowly at first, then catches up.

    Only the drawing lags; the world's clock goes on as always.

    Args:
        clock: wall clock (s); replaced in tests.
        is_motion_reduced: returns True while everything is drawn as it is.
    """

    def __init__(
        self,
        clock: Callable[[], float] = time.monotonic,
        is_motion_reduced: Callable[[], bool] = lambda: False,
    ) -> None:
        self._clock, self._is_motion_reduced = clock, is_motion_reduced
        self._falls: dict[tuple[str, int, int], _Fall] = {}

    def drawn(self, snapshot: Snapshot) -> tuple[BodyState, ...]:
        """Return the states in which the bodies of a snapshot are drawn."""
        falling = [agent for agent in snapshot.agents if agent.fell and not snapshot.past]
        if not falling:
            self._falls = {}
            return snapshot.bodies
        now, falls = self._clock(), {}
        states = {body.name: body for body in snapshot.bodies}
        for agent in falling:
            episode = agent.id, snapshot.episode, agent.episode
            fall = self._falls.get(episode) or _Fall(now, agent.body, [])
            if not fall.states and states[agent.body].fallen:
                continue  # it fell before anybody saw it
            falls[episode] = fall
            if now - fall.began <= SLOW_FALL_S:
                fall.states.append((now - fall.began, states[agent.body]))
        self._falls = falls
        if self._is_motion_reduced():
            return snapshot.bodies
        for fall in falls.values():
            if now - fall.began <= SLOW_FALL_S:
                states[fall.body] = fall.state_at(_drawn_time(now - fall.began))
        return tuple(states.values())

    def puffs(self) -> list[tuple[BodyState, float]]:
        """Return the state in which each falling body left its floor, and the time (s) since."""
        if self._is_motion_reduced():
            return []
        now = self._clock()
        return [(fall.states[0][1], now - fall.began) for fall in self._falls.values()]


class _Fall(NamedTuple):
    began: float
    """Wall time (s) of the first snapshot that showed it."""
    body: str
    states: list[tuple[float, BodyState]]
    """Times (s) since then, and the body's states."""

    def state_at(self, seconds: float) -> BodyState:
        """Return the state at a time since the beginning, between two that were seen."""
        last = len(self.states) - 1
        after = next((n for n, (when, _) in enumerate(self.states) if when >= seconds), last)
        (start, before), (end, state) = self.states[max(after - 1, 0)], self.states[after]
        share = 1.0 if end <= start else (seconds - start) / (end - start)
        x, y, z = (
            a + share * (b - a)
            for a, b in zip(
                (before.x, before.y, before.z), (state.x, state.y, state.z), strict=True
            )
        )
        return before._replace(x=x, y=y, z=z, heading=state.heading)


def _drawn_time(seconds: float) -> float:
    """Return the time (s) of a fall that is drawn a time after it began: slow, then catching up.

    >>> [round(_drawn_time(seconds), 2) for seconds in (0.0, 0.25, 0.5, 0.75, 1.0)]
    [0.0, 0.08, 0.17, 0.58, 1.0]
    """
    half = SLOW_FALL_S / 2
    slow = min(seconds, half) / _SLOWNESS
    return slow + max(seconds - half, 0.0) * (SLOW_FALL_S - half / _SLOWNESS) / half


_SHADOW_DIRECTION = (0.6, -0.8)
"""Unit vector along which shadows fall."""
SHADOW_OFFSET_M = 0.11
"""Distance (m) of the shadow from a body that stands on the ground."""
_SHADOW_OFFSET_PER_HEIGHT = 0.5
"""Additional distance for each metre above the ground."""
_MIN_FALLING_SCALE = 0.35
"""Scale of a body at the height at which it leaves the world."""


class DrawnPose(NamedTuple):
    """The drawn pose of a body."""

    position: tuple[float, float, float]
    wxyz: tuple[float, float, float, float]
    """Quaternion w, x, y, z."""
    scale: float
    """1 normally, less while the body falls, 0 if it has left the world."""
    depth: float
    """0 on or above the lowest floor, 1 at the height at which a body leaves the world."""
    shadow_position: tuple[float, float, float]
    shadow_scale: float
    """0 where there is no ground for the shadow."""


def drawn_pose(body: BodyState, static_scene: StaticScene, layers: Layers) -> DrawnPose:
    """Return the drawn pose of a body.

    It is computed without numpy, which takes longer for the few bodies that usually move.
    """
    x, y, z, half_heading = body.x, body.y, body.z, body.heading / 2
    ground = z if body.on_ground else static_scene.floor_under(x, y, z)
    lowest = static_scene.lowest_floor
    reach = max(lowest - static_scene.settings.fall_threshold, 0.1)
    depth = min(max((lowest - z) / reach, 0.0), 1.0)
    level = 0.0 if ground is None else ground
    rise = 0.0 if ground is None else max(z - level, 0.0)
    offset = SHADOW_OFFSET_M + _SHADOW_OFFSET_PER_HEIGHT * rise
    along_x, along_y = _SHADOW_DIRECTION
    return DrawnPose(
        position=(x, y, z + layers.body),
        wxyz=(math.cos(half_heading), 0.0, 0.0, math.sin(half_heading)),
        scale=0.0 if body.fallen else 1 - (1 - _MIN_FALLING_SCALE) * depth,
        depth=depth,
        shadow_position=(x + offset * along_x, y + offset * along_y, level + layers.shadow),
        shadow_scale=0.0 if body.fallen or ground is None else 1.0,
    )


def _scaled(pose: DrawnPose, pulse: float) -> DrawnPose:
    return pose._replace(scale=pulse * pose.scale)


def _by_field(poses: Sequence[DrawnPose]) -> dict[str, tuple[Any, ...]]:
    """Return the values of all poses by the name of their field; empty for no poses."""
    return dict(zip(DrawnPose._fields, zip(*poses, strict=True), strict=bool(poses)))


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
        self._slow_fall = SlowFall(is_motion_reduced=is_motion_reduced)
        self._puff: BatchedMeshHandle | None = None
        self.moving_parts: dict[str, MovingParts] = {}
        """Parts that move on robots that are nodes, by the name of the body."""
        self.nodes: dict[str, str] = {}
        """Names of the scene nodes of bodies that have their own, by the name of the body."""

    def build(self, static_scene: StaticScene) -> None:
        """Create a batch for each kind of body, if the bodies have changed."""
        for group in self._groups:
            group.forget()  # the ground may be another one
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
            self.moving_parts = {
                group.names[0]: group.moving_parts
                for group in self._groups
                if group.moving_parts is not None
            }
            for group in self._groups:
                if group.names[0] in static_scene.agent_of:
                    group.listen(self._on_agent)
        self._built_for = wanted

    def draw(self, snapshot: Snapshot) -> None:
        """Move all bodies to their current poses."""
        states, pulses = self._slow_fall.drawn(snapshot), self._pulse.scales(snapshot)
        self._draw_puff(snapshot)
        for group in self._groups:
            group.move(states, pulses, snapshot.static_scene)

    def _draw_puff(self, snapshot: Snapshot) -> None:
        """Draw discs that spread where a body has just left its floor, and vanish."""
        puffs = [(state, age) for state, age in self._slow_fall.puffs() if age < PUFF_S]
        if not puffs:
            if self._puff is not None:
                self._puff.remove()
                self._puff = None
            return
        state, age = puffs[-1]
        share = age / PUFF_S
        body = next(each for each in snapshot.static_scene.bodies if each.name == state.name)
        reach = body.shape.reach
        if self._puff is None:
            disc = cap(circle(1.0, corners=16))
            colours = [RAY_MISS] * _PUFF_BALLS
            self._puff = MeshDrawer(self._scene, "/puff").batch("discs", disc, colours, 0.6)
        angles = np.linspace(0, 2 * np.pi, _PUFF_BALLS, endpoint=False)
        distance = reach * (0.6 + 1.2 * share)
        level = snapshot.static_scene.lowest_floor + self._layers.body
        self._puff.batched_positions = np.stack(
            [
                state.x + distance * np.cos(angles),
                state.y + distance * np.sin(angles),
                np.full(_PUFF_BALLS, level),
            ],
            axis=1,
        ).astype(np.float32)
        self._puff.batched_scales = np.full(_PUFF_BALLS, 0.45 * reach * (1 - share), np.float32)


class RobotMotion:
    """Rolls the wheels of robots and turns their pupils, less often than bodies move.

    Robots that share a batch have wheels without bars, and look ahead.

    Args:
        bodies: the drawn bodies, which are built before.
    """

    def __init__(self, bodies: Bodies) -> None:
        self._bodies = bodies

    def build(self, static_scene: StaticScene) -> None:
        """Do nothing: the parts are built with their bodies."""

    def draw(self, snapshot: Snapshot) -> None:
        """Show how far robots have driven, and where their targets are."""
        moving_parts = self._bodies.moving_parts
        states = {body.name: body for body in snapshot.bodies}
        for agent in snapshot.agents:
            if agent.body in moving_parts:
                body = states[agent.body]
                direction = look_direction(snapshot.static_scene, agent, states)
                moving_parts[agent.body].move((body.x, body.y, body.heading), direction)


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
        self._members = members
        self._layers = layers
        self._is_round = all(
            isinstance(static_scene.bodies[index].shape, CircleShape) for index in members
        )
        self._shown: list[tuple[BodyState, float]] = []
        """State and scale of each member's pulse, as drawn last."""
        self._poses: list[DrawnPose] = []
        """Their poses."""
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
        parts = robot_parts(bodies[0]) if is_agent else None
        body = (
            prism(outline, height, min(MAX_RIM_M, 0.16 * radius))
            if parts is None
            else shell(parts, height)
        )
        self._body = drawer.batch("body", body, colours)
        self._marks = []
        self.moving_parts: MovingParts | None = None
        if parts is not None:
            self._marks.append(drawer.batch("base", chassis(parts, height), [CHASSIS] * count))
            eyes = drawer.batch("face", face(radius, top + EYE_RISE * radius), [LIGHT] * count)
            self._marks.append(eyes)
            if is_node:
                self.moving_parts = MovingParts(drawer, parts, radius, top)
            else:
                at_rest = pupils(radius, top).moved(PUPIL_SHIFT * radius, 0)
                self._marks.append(drawer.batch("pupils", at_rest, [DARK] * count))
        elif "target" in bodies[0].tags:
            self._marks.append(drawer.batch("rings", rings(radius, top), [LIGHT] * count))

    def listen(self, on_agent: Callable[[int, str], None]) -> None:
        """Call ``on_agent`` with the client id and the body's name when a member is clicked."""

        async def on_click(event: SceneNodePointerEvent[BatchedMeshHandle]) -> None:
            index = event.instance_index
            if index is not None and 0 <= index < len(self.names):
                on_agent(event.client_id, self.names[index])

        self._body.on_click(report_errors(on_click))

    def forget(self) -> None:
        """Compute all poses again when the members are moved next."""
        self._shown, self._poses = [], []

    def move(
        self, states: Sequence[BodyState], pulses: Mapping[str, float], static_scene: StaticScene
    ) -> None:
        """Move the members to their current poses.

        Args:
            states: of all bodies.
            pulses: scale of each body that pulses, by its name.
            static_scene: the world.
        """
        shown = [(states[index], pulses.get(states[index].name, 1.0)) for index in self._members]
        if shown == self._shown:
            return
        before, kept = self._poses, dict(zip(self._shown, self._poses, strict=True))
        self._shown = shown
        self._poses = [
            kept.get(each) or _scaled(drawn_pose(each[0], static_scene, self._layers), each[1])
            for each in shown
        ]
        # viser's own comparison takes longer than all else in a frame
        drawn, earlier = _by_field(self._poses), _by_field(before)
        changed = {name: values for name, values in drawn.items() if values != earlier.get(name)}
        self._place(changed)
        if changed.keys() & {"scale", "shadow_scale", "depth"}:
            scales = np.array(drawn["scale"])
            for batch in (self._body, *self._marks):
                batch.batched_scales = scales
            if self.moving_parts is not None:
                self.moving_parts.resize(float(scales[0]))
            self._shadow.batched_scales = np.array(drawn["shadow_scale"])
            self._body.batched_colors = self._colours(np.array(drawn["depth"]))

    def _place(self, changed: Mapping[str, tuple[Any, ...]]) -> None:
        """Set the positions and orientations that have changed.

        Args:
            changed: values of all members by the name of the field of :class:`DrawnPose`.
        """
        if self._frame is not None:
            (pose,) = self._poses
            if "position" in changed:
                self._frame.position = pose.position
            if "shadow_position" in changed:
                self._shadow.position = pose.shadow_position
            if "wxyz" in changed:
                self._frame.wxyz = pose.wxyz
                if not self._is_round:  # a round shadow looks the same
                    self._shadow.wxyz = pose.wxyz
            return
        if "position" in changed:
            positions = np.array(changed["position"])
            for batch in (self._body, *self._marks):
                batch.batched_positions = positions
        if "shadow_position" in changed:
            self._shadow.batched_positions = np.array(changed["shadow_position"])
        if "wxyz" in changed:
            wxyzs = np.array(changed["wxyz"])
            for batch in (self._body, *self._marks, self._shadow):
                batch.batched_wxyzs = wxyzs

    def _colours(self, depths: npt.NDArray[np.float64]) -> npt.NDArray[np.uint8]:
        """Return the members' colours; a falling body fades to the colour of the void."""
        if not depths.any():
            return self._own
        share = depths[:, None]
        faded: npt.NDArray[np.float64] = (1 - share) * self._own + share * self._deep
        return faded.round().astype(np.uint8)

"""Fading trails behind agents: on each page, for the agents that it shows them for."""

from collections import deque

import numpy as np
from viser import BatchedMeshHandle, SceneApi

from ai4u_edu.page.viewer.scene.geometry import Array, cap, circle
from ai4u_edu.page.viewer.scene.layers import Layers
from ai4u_edu.page.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.page.viewer.scene.subtree import Subtree
from ai4u_edu.page.viewer.viewer_client import ViewerClient, ViewerClients
from ai4u_edu.runtime.frame_budget import TRAILS_PER_S, PageTurns
from ai4u_edu.snapshot import AgentState, BodyState, Snapshot, StaticScene
from ai4u_edu.snapshot.marks import half_width
from ai4u_edu.snapshot.theme import Rgb, body_colour

TRAIL_S = 2.4
"""World time (s) that a trail goes back."""
MAX_DOTS = 24
"""Dots of a trail, evenly in time."""
MIN_STEP_M = 0.02
"""Distance between two dots below which the body stands still, and leaves none."""
DOT_RADIUS = 0.3
"""Radius of the newest dot, as a share of the body's half width."""
OPACITIES = np.linspace(0.5, 0.06, MAX_DOTS)
"""Opacity of each dot, newest first."""
SCALES = np.linspace(1.0, 0.35, MAX_DOTS)
"""Scale of each dot, newest first."""


class Trails:
    """The trails of all agents. They are recorded once, and drawn on each page.

    Args:
        viewer_clients: the pages.
    """

    def __init__(self, viewer_clients: ViewerClients) -> None:
        self._viewer_clients = viewer_clients
        self.pages: dict[int, _PageTrails] = {}
        self._trails: dict[str, Trail] = {}
        self._turns = PageTurns(TRAILS_PER_S)

    def build(self, static_scene: StaticScene) -> None:
        """Read the agents' sizes and colours from a static scene."""
        self._style = _Style(static_scene)
        for page in self.pages.values():
            page.build(self._style)

    def draw(self, snapshot: Snapshot) -> None:
        """Record where the agents are, and draw their trails on the pages whose turn it is."""
        bodies = {body.name: body for body in snapshot.bodies if body.name in self._style.radii}
        for agent in snapshot.agents:
            trail = self._trails.setdefault(agent.id, Trail())
            trail.record(snapshot, agent, bodies[agent.body])
        for gone in self.pages.keys() - self._viewer_clients.keys():
            del self.pages[gone]
        for number in self._turns.due(self._viewer_clients.keys()):
            if number not in self.pages:
                self.pages[number] = _PageTrails(self._viewer_clients[number], self._style)
            self.pages[number].draw(snapshot, self._trails)


class Trail:
    """The places where an agent's body was during the last :data:`TRAIL_S`."""

    def __init__(self) -> None:
        self._places: deque[tuple[float, Array]] = deque(maxlen=MAX_DOTS)
        self._episode: object = None
        self._now = 0.0

    def record(self, snapshot: Snapshot, agent: AgentState, body: BodyState) -> None:
        """Add the body's place, if the last one is some time ago and some distance away."""
        episode = snapshot.episode, agent.episode, snapshot.past
        if episode != self._episode or snapshot.time < self._now or body.fallen:
            self._places.clear()
        self._episode, self._now = episode, snapshot.time
        place = np.array([body.x, body.y, body.z])
        if body.fallen:
            return
        if self._places:
            last_time, last_place = self._places[0]
            is_soon = snapshot.time - last_time < 0.99 * TRAIL_S / MAX_DOTS
            if is_soon or np.linalg.norm(place - last_place) < MIN_STEP_M:
                return
        self._places.appendleft((snapshot.time, place))

    def places(self) -> Array:
        """Return the places, newest first, as (n, 3) with n from 0 to :data:`MAX_DOTS`."""
        recent = [place for time, place in self._places if self._now - time <= TRAIL_S]
        return np.array(recent).reshape(-1, 3)


class _Style:
    """Colours and sizes of the trails on a static scene."""

    def __init__(self, static_scene: StaticScene) -> None:
        agents = [body for body in static_scene.bodies if body.name in static_scene.agent_of]
        self.colours: dict[str, Rgb] = {body.name: body_colour(body, True) for body in agents}
        self.radii = {body.name: half_width(body.shape.outline()) * DOT_RADIUS for body in agents}
        self.z = Layers.of(static_scene).trail


class _PageTrails:
    """The trails on one page: one batch of dots."""

    def __init__(self, viewer_client: ViewerClient, style: _Style) -> None:
        self._viewer_client = viewer_client
        self._scene: SceneApi = viewer_client.client.scene
        self._subtree = Subtree(self._scene, "trails")
        self._style = style
        self.shown: tuple[str, ...] = ()
        """Bodies that have a trail on this page."""
        self.dots: BatchedMeshHandle | None = None
        """:data:`MAX_DOTS` dots for each of these bodies."""

    def build(self, style: _Style) -> None:
        self._style, self.shown = style, ()

    def draw(self, snapshot: Snapshot, trails: dict[str, "Trail"]) -> None:
        shows = self._viewer_client.shows_trail
        bodies = {
            agent.body: trails[agent.id].places()
            for agent in snapshot.agents
            if shows(agent.id, is_default=not agent.is_driven_by_keys)
        }
        with self._viewer_client.client.atomic():
            if tuple(bodies) != self.shown:
                self._rebuild(tuple(bodies))
            if self.dots is not None:
                self._move(self.dots, bodies)

    def _rebuild(self, bodies: tuple[str, ...]) -> None:
        self.dots, self.shown = None, bodies
        with self._subtree.rebuild() as parent:
            if bodies:
                colours = [self._style.colours[body] for body in bodies for _ in range(MAX_DOTS)]
                mesh = cap(circle(1.0, corners=16))
                self.dots = MeshDrawer(self._scene, parent).batch("dots", mesh, colours, 1.0)
                self.dots.batched_opacities = np.tile(OPACITIES, len(bodies)).astype(np.float32)

    def _move(self, dots: BatchedMeshHandle, bodies: dict[str, Array]) -> None:
        scales = np.zeros((len(bodies), MAX_DOTS), np.float32)
        positions = np.zeros((len(bodies), MAX_DOTS, 3), np.float32)
        for row, (body, places) in enumerate(bodies.items()):
            count = len(places)
            scales[row, :count] = SCALES[:count] * self._style.radii[body]
            positions[row, :count] = places
        positions[..., 2] += self._style.z
        dots.batched_scales = scales.ravel()
        dots.batched_positions = positions.reshape(-1, 3)

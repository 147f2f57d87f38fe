"""Sensor readings drawn in the scene: on each page, those of the agent that it shows."""

from ai4u_edu.explain.live import LiveExplainer, Why
from ai4u_edu.runtime.frame_budget import SENSES_PER_S, PageTurns
from ai4u_edu.snapshot import AgentState, Snapshot, StaticScene
from ai4u_edu.viewer.scene.layers import Layers
from ai4u_edu.viewer.scene.pointers import Pointers
from ai4u_edu.viewer.scene.rays import Rays, RayStyle
from ai4u_edu.viewer.scene.spots import Spots
from ai4u_edu.viewer.viewer_client import ViewerClient, ViewerClients


class SenseOverlay:
    """Rays, spots and targets of sensors, for the agents that pages show.

    Args:
        viewer_clients: the pages.
        rate: how many times a second each page is drawn, at most.
        explainer: tells how much each ray matters, for pages that show it.
    """

    def __init__(
        self,
        viewer_clients: ViewerClients,
        rate: float = SENSES_PER_S,
        explainer: LiveExplainer | None = None,
    ) -> None:
        self._viewer_clients, self._rate = viewer_clients, rate
        self._explainer = explainer
        self._pages: dict[int, _Page] = {}

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
                self._pages[number] = _Page(viewer_client, self._style)
            agent = agents.get(viewer_client.agent)
            if agent is not None:
                shows_why = viewer_client.is_why_shown and self._explainer is not None
                why = self._explainer.why(agent.id) if shows_why and self._explainer else None
                self._pages[number].draw(snapshot, agent, self._tops[agent.body], why)


class _Page:
    """The overlay of one page."""

    def __init__(self, viewer_client: ViewerClient, style: RayStyle) -> None:
        scene = viewer_client.client.scene
        self._viewer_client = viewer_client
        self._rays, self._spots = Rays(scene, style), Spots(scene)
        self._pointers = Pointers(scene)
        self._drawn: tuple[object, object] = (None, None)
        self._keys: list[str] = []

    def draw(self, snapshot: Snapshot, agent: AgentState, top: float, why: Why | None) -> None:
        (body,) = (each for each in snapshot.bodies if each.name == agent.body)
        shown = [
            sensor
            for sensor in agent.sensor_infos
            if not body.fallen
            and self._viewer_client.shows_sensor(sensor.key, is_default=agent.has_marks(sensor))
        ]
        keys = [sensor.key for sensor in shown]
        with self._viewer_client.client.atomic():
            # `rays` is a new object after every reading
            drawn = self._drawn
            if agent.rays is not drawn[0] or why is not drawn[1] or keys != self._keys:
                self._drawn, self._keys = (agent.rays, why), keys
                seeing = [key for key in keys if key in agent.rays]
                matters = {} if why is None else why.ray_weights
                weights = [matters.get(key) for key in seeing]
                self._rays.draw([agent.rays[key] for key in seeing], body.heading, weights)
                self._spots.draw([agent.spots[key] for key in keys if key in agent.spots], top)
            self._pointers.draw(snapshot, body, shown)

    def build(self, style: RayStyle) -> None:
        self._drawn = (None, None)
        self._rays.build(style)

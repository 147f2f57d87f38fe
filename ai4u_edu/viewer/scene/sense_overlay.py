"""What the agents that somebody looks at sense, in the scene: on each page its own agent's."""

from ai4u_edu.runtime.frame_budget import SENSES_PER_S, PageTurns
from ai4u_edu.snapshot import AgentState, Snapshot, StaticScene
from ai4u_edu.snapshot.block_info import SensorInfo
from ai4u_edu.viewer.scene.layers import Layers
from ai4u_edu.viewer.scene.pointers import Pointers, has_pointer
from ai4u_edu.viewer.scene.rays import Rays, StageLook
from ai4u_edu.viewer.scene.spots import Spots
from ai4u_edu.viewer.viewer_client import ViewerClient, ViewerClients


def is_seen(sense: SensorInfo, agent: AgentState) -> bool:
    """Whether a sensor has something that can be shown in the scene."""
    return shows_by_itself(sense, agent) or has_pointer(sense)


def shows_by_itself(sense: SensorInfo, agent: AgentState) -> bool:
    """Whether that is shown unless somebody switches it off: rays and spots are."""
    return sense.key in agent.rays or sense.key in agent.spots


class SenseOverlay:
    """Draws the rays, spots and targets of sensors; nothing for agents that nobody looks at.

    Args:
        viewer_clients: the pages.
    """

    def __init__(self, viewer_clients: ViewerClients) -> None:
        self._viewer_clients = viewer_clients
        self._pages: dict[int, _Page] = {}

    def build(self, static_scene: StaticScene) -> None:
        """Learns how large the agents are, and the colours of what they see."""
        layers = Layers.of(static_scene)
        self._look = StageLook(static_scene)
        lift = layers.body + 3 * layers.unit
        self._lifts = {body.name: body.height + lift for body in static_scene.bodies}
        self._turns = PageTurns(SENSES_PER_S)
        for page in self._pages.values():
            page.build(self._look)

    def draw(self, snapshot: Snapshot) -> None:
        """Draws what is looked at."""
        for gone in self._pages.keys() - self._viewer_clients.keys():
            del self._pages[gone]
        agents = {agent.id: agent for agent in snapshot.agents}
        for number in self._turns.due(self._viewer_clients.keys()):
            viewer_client = self._viewer_clients[number]
            if number not in self._pages:
                self._pages[number] = _Page(viewer_client, self._look)
            agent = agents.get(viewer_client.agent)
            if agent is not None:
                self._pages[number].draw(snapshot, agent, self._lifts[agent.body])


class _Page:
    """One page's."""

    def __init__(self, viewer_client: ViewerClient, look: StageLook) -> None:
        scene = viewer_client.client.scene
        self._viewer_client = viewer_client
        self._rays, self._spots = Rays(scene, look), Spots(scene)
        self._pointers = Pointers(scene)
        self._seen: object = None
        self._keys: list[str] = []

    def draw(self, snapshot: Snapshot, agent: AgentState, lift: float) -> None:
        (body,) = (each for each in snapshot.bodies if each.name == agent.body)
        lit = [
            sense
            for sense in agent.sensor_infos
            if not body.fallen
            and self._viewer_client.lights(sense.key, by_itself=shows_by_itself(sense, agent))
        ]
        keys = [sense.key for sense in lit]
        with self._viewer_client.client.atomic():
            if agent.rays is not self._seen or keys != self._keys:  # else nothing was sensed since
                self._seen, self._keys = agent.rays, keys
                self._rays.draw([agent.rays[key] for key in keys if key in agent.rays])
                self._spots.draw([agent.spots[key] for key in keys if key in agent.spots], lift)
            self._pointers.draw(snapshot, body, lit)

    def build(self, look: StageLook) -> None:
        self._seen = None
        self._rays.build(look)

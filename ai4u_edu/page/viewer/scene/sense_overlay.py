"""Sensor readings drawn in the scene: on each page, those of the agent that it shows."""

from collections.abc import Mapping, Sequence
from typing import Protocol

import numpy as np
import numpy.typing as npt

from ai4u_edu.page.viewer.backend.part import Part
from ai4u_edu.page.viewer.scene.layers import Layers
from ai4u_edu.page.viewer.scene.pointers import Pointers
from ai4u_edu.page.viewer.scene.rays import Rays, RayStyle
from ai4u_edu.page.viewer.scene.spots import Spots
from ai4u_edu.page.viewer.viewer_client import ViewerClient, ViewerClients
from ai4u_edu.runtime.frame_budget import SENSES_PER_S, PageTurns
from ai4u_edu.snapshot import AgentState, Snapshot, StaticScene

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
                weights = self._weights(viewer_client)
                self._pages[number].draw(snapshot, agent, self._tops[agent.body], weights)

    def _weights(self, viewer_client: ViewerClient) -> RayWeights | None:
        """Return the rays' weights of the first option that has some for a page."""
        found = (option.ray_weights(viewer_client) for option in self._options)
        return next((weights for weights in found if weights is not None), None)


class _Page:
    """The overlay of one page."""

    def __init__(self, viewer_client: ViewerClient, style: RayStyle) -> None:
        scene = viewer_client.client.scene
        self._viewer_client = viewer_client
        self._rays, self._spots = Rays(scene, style), Spots(scene)
        self._pointers = Pointers(scene)
        self._drawn: tuple[object, object] = (None, None)
        self._keys: list[str] = []

    def draw(
        self, snapshot: Snapshot, agent: AgentState, top: float, weights: RayWeights | None
    ) -> None:
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

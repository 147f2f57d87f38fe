"""Maps over the floor: arrows for what an agent would do at each place, colours for its worth."""

import time
from collections.abc import Callable

import numpy as np
from viser import BatchedMeshHandle, SceneApi

from ai4u_edu.base.colors import rgb
from ai4u_edu.explain.live_maps import LiveMaps
from ai4u_edu.explain.map_colours import value_colours
from ai4u_edu.explain.map_maker import LiveMap
from ai4u_edu.explain.page.field_arrows import FieldArrows
from ai4u_edu.explain.page.watch import Watching
from ai4u_edu.page.viewer.scene.geometry import Array, cap
from ai4u_edu.page.viewer.scene.layers import Layers
from ai4u_edu.page.viewer.scene.light import surface_colours
from ai4u_edu.page.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.page.viewer.scene.subtree import Subtree
from ai4u_edu.page.viewer.viewer_client import ViewerClient, ViewerClients
from ai4u_edu.runtime.frame_budget import TRAILS_PER_S, PageTurns
from ai4u_edu.snapshot import Snapshot, StaticScene

CELL_OPACITY = 0.85
FADE_S = 1.2
"""Time in which a map appears on a page, unless its user prefers less motion."""


class PolicyMaps:
    """The maps of each page that shows some.

    Args:
        viewer_clients: the pages.
        maps: computes them.
        watching: knows the pages that watch a network, which show its maps.
    """

    def __init__(
        self,
        viewer_clients: ViewerClients,
        maps: LiveMaps,
        watching: Watching,
    ) -> None:
        self._viewer_clients, self._maps, self._watching = viewer_clients, maps, watching
        self.pages: dict[int, PageMaps] = {}
        self._turns = PageTurns(TRAILS_PER_S)

    def build(self, static_scene: StaticScene) -> None:
        """Read the floors' heights from a static scene."""
        self._static_scene = static_scene
        for page in self.pages.values():
            page.build(static_scene)

    def draw(self, _snapshot: Snapshot) -> None:
        """Draw the maps on the pages whose turn it is."""
        for gone in self.pages.keys() - self._viewer_clients.keys():
            del self.pages[gone]
        for page in self.pages.values():
            page.fade()
        for number in self._turns.due(self._viewer_clients.keys()):
            client = self._viewer_clients[number]
            requests = self._watching.shown_maps(client).requests(client.agent)
            if number not in self.pages and not requests:
                continue
            if number not in self.pages:
                self.pages[number] = PageMaps(client, self._static_scene)
            found = {request.kind: self._maps.ask(request) for request in requests}
            self.pages[number].draw(found.get("field"), found.get("values"))


class PageMaps:
    """The maps on one page.

    Args:
        client: the page.
        static_scene: the world.
        clock: seconds.
    """

    def __init__(
        self,
        client: ViewerClient,
        static_scene: StaticScene,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._client, self._clock = client, clock
        self._began = [0.0, 0.0]
        """Times (s, of the clock) at which the arrows and the colours began to appear."""
        self._shares = [1.0, 1.0]
        """Shares of their opacities that they have now."""
        scene: SceneApi = client.client.scene
        self._arrows, self._cells = FieldArrows(scene, "field"), _Cells(scene)
        self._drawn: tuple[LiveMap | None, LiveMap | None] = (None, None)
        self.build(static_scene)

    @property
    def arrows(self) -> BatchedMeshHandle | None:
        """An arrow for each place; None if no field is shown."""
        return self._arrows.arrows

    @property
    def cells(self) -> BatchedMeshHandle | None:
        """A square for each place; None if no values are shown."""
        return self._cells.cells

    def build(self, static_scene: StaticScene) -> None:
        """Draw the maps again on another static scene."""
        self._static_scene = static_scene
        self._layers = Layers.of(static_scene)
        self._drawn = (None, None)
        self._arrows.clear()
        self._cells.clear()

    def draw(self, field: LiveMap | None, values: LiveMap | None) -> None:
        """Draw these maps, and remove all others."""
        if (field, values) == self._drawn:
            return
        drawn, self._drawn = self._drawn, (field, values)
        for index, told in enumerate((field, values)):
            if told is not None and drawn[index] is None:
                self._began[index], self._shares[index] = self._clock(), -1.0
        with self._client.client.atomic():
            if field is not drawn[0]:
                self._arrows.draw(field, self._grounds(field), self._layers)
            if values is not drawn[1]:
                self._cells.draw(values, self._grounds(values), self._layers)
            self.fade()

    def fade(self) -> None:
        """Show as much of maps that are appearing as is due now."""
        parts: tuple[FieldArrows | _Cells, ...] = (self._arrows, self._cells)
        for index, part in enumerate(parts):
            share = min(1.0, max(0.0, self._clock() - self._began[index]) / FADE_S)
            share = 1.0 if self._client.is_motion_reduced else share
            if share != self._shares[index]:
                self._shares[index] = share
                part.set_opacity(share)

    def _grounds(self, told: LiveMap | None) -> Array:
        """Return the heights of the floor at a map's places, (n,)."""
        places = () if told is None else told.poses
        lowest = self._static_scene.lowest_floor
        tops = (self._static_scene.floor_under(x, y) for x, y, _ in places)
        return np.array([lowest if top is None else top for top in tops])


class _Cells:
    """The squares of one map."""

    def __init__(self, scene: SceneApi) -> None:
        self._scene, self._subtree = scene, Subtree(scene, "values")
        self.cells: BatchedMeshHandle | None = None
        self._shape: tuple[int, tuple[float, float]] = (0, (0.0, 0.0))

    def set_opacity(self, share: float) -> None:
        if self.cells is not None:
            self.cells.opacity = share * CELL_OPACITY

    def clear(self) -> None:
        self._subtree.remove()
        self.cells = None
        self._shape = (0, (0.0, 0.0))

    def draw(self, told: LiveMap | None, grounds: Array, layers: Layers) -> None:
        if told is None or not len(told.poses):
            self.clear()
            return
        if (len(told.poses), told.cell) != self._shape:
            self._build(len(told.poses), told.cell)
        if self.cells is None:
            return
        z = grounds + layers.outline + 0.5 * layers.unit
        self.cells.batched_positions = np.column_stack([told.poses[:, :2], z]).astype(np.float32)
        self.cells.batched_colors = surface_colours(value_colours(told.values))
        self.cells.batched_scales = np.isfinite(told.values).astype(np.float32)

    def _build(self, count: int, cell: tuple[float, float]) -> None:
        self._shape = count, cell
        x, y = cell[0] / 2, cell[1] / 2
        square = cap([(x, y), (-x, y), (-x, -y), (x, -y)])
        with self._subtree.rebuild() as parent:
            drawer = MeshDrawer(self._scene, parent)
            self.cells = drawer.batch("cells", square, [rgb("white")] * count, opacity=CELL_OPACITY)

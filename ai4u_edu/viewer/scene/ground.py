"""What does not move: the void, the floors with their edges, the areas."""

from ai4u_edu.snapshot import Snapshot, StaticScene
from ai4u_edu.snapshot.theme import FLOOR, GRID, VOID, Rgb, area_colour, floor_colour, mix_colours
from ai4u_edu.viewer.backend.local_server import LocalServer
from ai4u_edu.viewer.scene.geometry import (
    Array,
    Mesh,
    grow,
    half_width,
    joined,
    segments,
    sheet,
    soft,
)
from ai4u_edu.viewer.scene.grid import grid_in
from ai4u_edu.viewer.scene.layers import Layers
from ai4u_edu.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.viewer.scene.placing import floor_under, lowest_floor, placed, size
from ai4u_edu.viewer.scene.subtree import Subtree
from ai4u_edu.world import AreaDescription, FloorDescription

RIM = 0.0025
"""How wide a floor's edge is drawn, as a share of the arena's size."""
CLIFF = 0.016
"""How much of a floor's side shows, likewise."""
SHADOW = (0.018, -0.034)
"""Where a floor's shadow falls, likewise."""
BLUR = 0.028
"""How soft that shadow's edge is, likewise."""
SHEETS = 8
"""What that shadow is made of."""
SEAM = 0.01
"""How far paint reaches beyond its outline, metres."""
BLACK: Rgb = (0, 0, 0)


class Ground:
    """Draws floors and areas; again only when they change."""

    def __init__(self, server: LocalServer) -> None:
        self._scene = server.scene
        self._subtree = Subtree(server.scene, "ground")
        self._seen: object = None

    def build(self, static_scene: StaticScene) -> None:
        """Draws the ground, if it is another one than the one that is drawn."""
        wanted = (static_scene.floors, static_scene.areas, static_scene.bounds)
        if wanted == self._seen:
            return
        with self._subtree.rebuild() as parent:
            drawer, layers = MeshDrawer(self._scene, parent), Layers.of(static_scene)
            if static_scene.floors:
                drawer.mesh("void", _around(static_scene, 200), layers.void, VOID)
            else:
                _endless_floor(drawer, layers, static_scene)
            for floor in static_scene.floors:
                _floor(drawer, layers, floor, size(static_scene))
            for area in static_scene.areas:
                top = floor_under(static_scene, *area.position)
                _area(drawer, layers, area, lowest_floor(static_scene) if top is None else top)
            drawer.finish()
        self._seen = wanted

    def draw(self, snapshot: Snapshot) -> None:
        """Nothing moves here."""


def _endless_floor(drawer: MeshDrawer, layers: Layers, static_scene: StaticScene) -> None:
    drawer.mesh("floor", _around(static_scene, 200), 0.0, FLOOR)
    drawer.line(grid_in(_around(static_scene, 2).vertices[:, :2], None, layers.grid), GRID)


def _floor(drawer: MeshDrawer, layers: Layers, floor: FloorDescription, scale: float) -> None:
    outline, hole = placed(floor)
    name, top, colour = f"floor {floor.name}", floor.top, floor_colour(floor)
    dark = mix_colours(colour, VOID, 0.55)
    edge = grow(outline, RIM * scale)
    edge_hole = grow(hole, -RIM * scale) if hole is not None else _out_of_sight(outline, scale)
    cliff = sheet(edge, edge_hole).moved(0, -CLIFF * scale)
    shadow = _shadow(outline, hole, layers, scale)
    drawer.mesh(f"{name}/shadow", shadow, top + layers.floor_shadow, BLACK, opacity=0.08)
    drawer.mesh(f"{name}/cliff", cliff, top + layers.cliff, dark)
    drawer.mesh(f"{name}/rim", sheet(edge, edge_hole), top + layers.rim, dark)
    drawer.mesh(f"{name}/top", sheet(outline, hole), top, colour)
    drawer.line(grid_in(outline, hole, top + layers.grid), mix_colours(colour, VOID, 0.12))
    if floor.label:
        drawer.label(f"{name}/label", floor.label, (*floor.position, top))


def _shadow(outline: Array, hole: Array | None, layers: Layers, scale: float) -> Mesh:
    outer = soft(outline, BLUR * scale, 8 * layers.unit, SHEETS)
    if hole is None:
        inner = len(outer) * [_out_of_sight(outline, scale)]
    else:
        inner = [each for each, _ in soft(hole, -BLUR * scale, 0.0, SHEETS)]
    pile = [sheet(each, rest, z) for (each, z), rest in zip(outer, inner, strict=True)]
    return joined(pile).moved(SHADOW[0] * scale, SHADOW[1] * scale)


def _out_of_sight(outline: Array, scale: float) -> Array | None:
    """What nobody can see of a sheet under a floor, if it is much: it needn't be drawn."""
    reach = 0.057 * scale
    return grow(outline, -reach) if half_width(outline) > 1.2 * reach else None


def _area(drawer: MeshDrawer, layers: Layers, area: AreaDescription, top: float) -> None:
    outline, hole = placed(area)
    name, colour = f"area {area.name}", area_colour(area)
    if area.paint:
        # a little larger, so that no seam shows where two pieces meet
        edge = grow(outline, SEAM)
        drawer.mesh(f"{name}/fill", sheet(edge, hole), top + layers.paint, colour)
        return
    drawer.mesh(f"{name}/fill", sheet(outline, hole), top + layers.area, colour, opacity=0.28)
    for edge in (outline,) if hole is None else (outline, hole):
        drawer.line(segments(edge, top + layers.outline), colour)
    text = area.label or area.name
    if not text.isspace():
        drawer.label(f"{name}/label", text, (*area.position, top))


def _around(static_scene: StaticScene, times: float) -> Mesh:
    """A rectangle that reaches ``times`` the arena's size beyond it."""
    (left, low), (right, high) = static_scene.bounds
    by = times * size(static_scene)
    a, b = (left - by, low - by), (right + by, high + by)
    return sheet([b, (a[0], b[1]), a, (b[0], a[1])])

"""The static ground: the void, floors with their edges and shadows, areas."""

import io
import math
from collections.abc import Collection

import numpy as np
import numpy.typing as npt
import viser
from PIL import Image
from viser import BatchedMeshHandle, ImageHandle, SceneApi

from ai4u_edu.page.viewer.backend.broadcast import VISER_VERSION
from ai4u_edu.page.viewer.backend.local_server import LocalServer
from ai4u_edu.page.viewer.scene.arena import arena_size, region_outlines
from ai4u_edu.page.viewer.scene.geometry import (
    Array,
    Mesh,
    flat_mesh,
    grow,
    join_meshes,
    segments,
    soft_shadow,
)
from ai4u_edu.page.viewer.scene.layers import Layers
from ai4u_edu.page.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.page.viewer.scene.subtree import Subtree
from ai4u_edu.snapshot import Snapshot, StaticScene
from ai4u_edu.snapshot.marks import half_width, round_floor
from ai4u_edu.snapshot.theme import (
    AREA_OPACITY,
    FLOOR,
    GRID,
    INK_RGBA,
    PASSED_OPACITY,
    VOID,
    Rgb,
    area_colour,
    floor_colour,
    ink_pixels,
    mix_colours,
)
from ai4u_edu.world import AreaDescription, BoxShape, FloorDescription
from ai4u_edu.world.ink import ENDLESS, TILE_M, Tile, TileKey
from ai4u_edu.world.pictures import decode_picture

RIM_WIDTH = 0.0025
"""Width of a floor's drawn edge, as a share of the arena's size."""
SIDE_HEIGHT = 0.016
"""Visible height of a floor's side, as a share of the arena's size."""
SHADOW_OFFSET = (0.018, -0.034)
"""Offset of a floor's shadow (x, y), as shares of the arena's size."""
SHADOW_BLUR = 0.028
"""Width of the shadow's soft edge, as a share of the arena's size."""
SHADOW_LAYERS = 8
"""Number of translucent layers that make the shadow's soft edge."""
HIDDEN_MARGIN = 0.057
"""Width of the visible border of a mesh under a floor, as a share of the arena's size."""
PAINT_OVERLAP_M = 0.01
"""Overlap (m) of painted areas, so that no gap shows between two of them."""
BLACK: Rgb = (0, 0, 0)
Place = tuple[float, ...]
PICTURE_PIXELS = 2048
"""Longer side of a picture on the ground as it is sent, if it has fewer pixels."""
INK_PIXELS = 2
"""Pixels of a cell of ink, along each side."""
INK_PICTURES_PER_S = 4.0
"""Rate at which ink is drawn: the end of a line is hidden under the robot that draws it."""


class DrawnGround:
    """Floors and areas; drawn again only when they change."""

    def __init__(self, server: LocalServer) -> None:
        self._scene = server.scene
        self._subtree = Subtree(server.scene, "ground")
        self._built_for: object = None
        self._areas: dict[str, BatchedMeshHandle] = {}
        """Fills of areas that are not paint, by name."""
        self._passed: frozenset[str] = frozenset()

    def build(self, static_scene: StaticScene) -> None:
        """Draw the ground, if it has changed."""
        wanted = (static_scene.floors, static_scene.areas, static_scene.bounds)
        if wanted == self._built_for:
            return
        self._areas, self._passed = {}, frozenset()
        with self._subtree.rebuild() as parent:
            drawer, layers = MeshDrawer(self._scene, parent), Layers.of(static_scene)
            if not static_scene.floors:
                _endless_floor(drawer, layers, static_scene)
            for floor in static_scene.floors:
                _floor(drawer, layers, floor, static_scene)
            for area in static_scene.areas:
                if area.picture is not None:
                    continue
                top = static_scene.floor_under(*area.position)
                fill = _area(
                    drawer, layers, area, static_scene.lowest_floor if top is None else top
                )
                if not area.paint:
                    self._areas[area.name] = fill
            drawer.finish()
        self._built_for = wanted

    def draw(self, snapshot: Snapshot) -> None:
        """Fill the areas that were passed; nothing else of the ground changes."""
        before, self._passed = self._passed, snapshot.passed_stages & self._areas.keys()
        for name in before ^ self._passed:
            self._areas[name].opacity = PASSED_OPACITY if name in self._passed else AREA_OPACITY


class DrawnPictures:
    """Pictures on the ground; one is sent only when another one is laid, or its size changes."""

    def __init__(self, server: LocalServer) -> None:
        self._scene = server.scene
        self._drawn: dict[str, tuple[tuple[str, BoxShape], ImageHandle]] = {}
        self._placed: dict[str, tuple[Place, Place]] = {}

    def build(self, static_scene: StaticScene) -> None:
        """Draw, move and remove pictures as areas say."""
        laid = {
            area.name: (area, area.picture, area.shape)
            for area in static_scene.areas
            if area.picture is not None and isinstance(area.shape, BoxShape)
        }
        for name in [name for name in self._drawn if name not in laid]:
            self._drawn.pop(name)[1].remove()
            self._placed.pop(name)
        layers = Layers.of(static_scene)
        for number, (name, (area, picture, shape)) in enumerate(laid.items(), start=1):
            drawn = self._drawn.get(name)
            if drawn is None or drawn[0] != (picture, shape):
                if drawn is not None:
                    drawn[1].remove()
                drawn = (picture, shape), self._send(name, picture, shape)
                self._drawn[name] = drawn
                self._placed.pop(name, None)
            top = static_scene.floor_under(*area.position)
            floor = static_scene.lowest_floor if top is None else top
            z = floor + layers.picture(number / (len(laid) + 1))
            half = math.radians(area.heading_deg) / 2
            # viser's pictures hang upside down: half a turn around x, then the heading
            pose = (*area.position, z), (0.0, math.cos(half), math.sin(half), 0.0)
            if self._placed.get(name) != pose:
                self._placed[name] = pose
                drawn[1].position, drawn[1].wxyz = pose

    def draw(self, _snapshot: Snapshot) -> None:
        """Draw nothing: pictures change only with the scene."""

    def _send(self, name: str, picture: str, shape: BoxShape) -> ImageHandle:
        pixels = decode_picture(picture)
        if (pixels[..., 3] == 255).all():
            pixels = pixels[..., :3]
        # enlarged, since a browser blurs the edges between pixels
        times = max(1, PICTURE_PIXELS // max(pixels.shape[:2]))
        return self._scene.add_image(
            f"/pictures/{name}",
            pixels.repeat(times, axis=0).repeat(times, axis=1),
            *shape.size,
            format="png",
            cast_shadow=False,
            receive_shadow=False,
        )


class DrawnInk:
    """Ink on the floors: a picture a tile, sent only when the tile has changed."""

    def __init__(self, server: LocalServer) -> None:
        self._scene = server.scene
        self._drawn: dict[TileKey, tuple[Tile, ImageHandle]] = {}
        self._heights: dict[str, float] = {}

    def build(self, static_scene: StaticScene) -> None:
        """Note the floors' heights; where one has moved, its ink is drawn again."""
        lift = Layers.of(static_scene).ink
        heights = {floor.name: floor.top + lift for floor in static_scene.floors}
        heights = heights or {ENDLESS: lift}
        if heights != self._heights:
            self._heights = heights
            self._keep(())

    def draw(self, snapshot: Snapshot) -> None:
        """Draw the tiles that have changed since the last time."""
        tiles = snapshot.state.world.ink.tiles
        if not tiles and not self._drawn:
            return
        self._keep(tiles)
        for key, tile in tiles.items():
            drawn = self._drawn.get(key)
            if key.floor not in self._heights or (drawn is not None and drawn[0] is tile):
                continue
            if drawn is None:
                centre = ((key.column + 0.5) * TILE_M, (key.row + 0.5) * TILE_M)
                image = self._scene.add_image(
                    f"/ink/{list(self._heights).index(key.floor)}/{key.column}/{key.row}",
                    _enlarged(ink_pixels(tile)),
                    TILE_M,
                    TILE_M,
                    format="png",
                    cast_shadow=False,
                    receive_shadow=False,
                    wxyz=(0.0, 1.0, 0.0, 0.0),  # viser's pictures hang upside down
                    position=(*centre, self._heights[key.floor]),
                )
            else:
                image = drawn[1]
                if viser.__version__ == VISER_VERSION:  # see ADR 7
                    image._data = _ink_png(tile)
                else:
                    image.image = _enlarged(ink_pixels(tile))
            self._drawn[key] = tile, image

    def _keep(self, keys: Collection[TileKey]) -> None:
        """Remove all other tiles from the pages."""
        for key in [key for key in self._drawn if key not in keys]:
            self._drawn.pop(key)[1].remove()


def _enlarged(pixels: npt.NDArray[np.uint8]) -> npt.NDArray[np.uint8]:
    """Return a tile with several pixels for each cell, since a browser blurs the edges between."""
    return pixels.repeat(INK_PIXELS, axis=0).repeat(INK_PIXELS, axis=1)


def _ink_png(tile: Tile) -> bytes:
    """Return a tile of ink as a PNG file with a palette."""
    picture = Image.fromarray(_enlarged(tile[::-1]))
    picture.putpalette(INK_RGBA.tobytes(), "RGBA")
    file = io.BytesIO()
    picture.save(file, "PNG", compress_level=1)
    return file.getvalue()


def add_void(scene: SceneApi, static_scene: StaticScene) -> BatchedMeshHandle | None:
    """Add the plane around the floors to a page whose camera sees a sky above it; None without.

    Seen from above, it is the background of the page (``web/styles/page/page.css``): to draw half
    of all pixels in one colour takes a third of a picture's time without a graphics card.
    """
    if not static_scene.floors:
        return None
    mesh, height = _rectangle_around(static_scene, 200), Layers.of(static_scene).void
    return MeshDrawer(scene, "/outside").mesh("void", mesh, height, VOID)


def _endless_floor(drawer: MeshDrawer, layers: Layers, static_scene: StaticScene) -> None:
    drawer.mesh("floor", _rectangle_around(static_scene, 200), 0.0, FLOOR)
    drawer.line(
        grid_in(_rectangle_around(static_scene, 2).vertices[:, :2], None, layers.grid), GRID
    )


def _floor(
    drawer: MeshDrawer, layers: Layers, floor: FloorDescription, static_scene: StaticScene
) -> None:
    scale = arena_size(static_scene)
    sharp, hole = region_outlines(floor)

    def rounded(outline: Array) -> Array:
        return round_floor(static_scene, floor, outline)

    outline = rounded(sharp)
    name, top, colour = f"floor {floor.name}", floor.top, floor_colour(floor)
    dark = mix_colours(colour, VOID, 0.55)
    edge = rounded(grow(sharp, RIM_WIDTH * scale))
    hidden = _hidden_part(sharp, scale) if hole is None else grow(hole, -RIM_WIDTH * scale)
    inner = rounded(hidden) if hole is None and hidden is not None else hidden
    side = flat_mesh(edge, inner).moved(0, -SIDE_HEIGHT * scale)
    outer = soft_shadow(sharp, SHADOW_BLUR * scale, 8 * layers.unit, SHADOW_LAYERS)
    shadow = _shadow([(rounded(each), z) for each, z in outer], hole, inner, scale)
    drawer.mesh(f"{name}/shadow", shadow, top + layers.floor_shadow, BLACK, opacity=0.08)
    drawer.mesh(f"{name}/side", side, top + layers.floor_side, dark)
    drawer.mesh(f"{name}/rim", flat_mesh(edge, inner), top + layers.rim, dark)
    drawer.mesh(f"{name}/top", flat_mesh(outline, hole), top, colour)
    drawer.line(grid_in(outline, hole, top + layers.grid), mix_colours(colour, VOID, 0.12))
    if floor.label:
        drawer.label(f"{name}/label", floor.label, (*floor.position, top))


def _shadow(
    outer: list[tuple[Array, float]], hole: Array | None, hidden: Array | None, scale: float
) -> Mesh:
    """Return a floor's shadow, without its part that is never visible.

    Args:
        outer: outline and height of each layer.
        hole: of the floor, if it has one.
        hidden: outline of the part that is never visible, if it is large.
        scale: the arena's size.
    """
    inner = len(outer) * [hidden]
    if hole is not None:
        inner = [each for each, _ in soft_shadow(hole, -SHADOW_BLUR * scale, 0.0, SHADOW_LAYERS)]
    meshes = [flat_mesh(each, rest, z) for (each, z), rest in zip(outer, inner, strict=True)]
    return join_meshes(meshes).moved(SHADOW_OFFSET[0] * scale, SHADOW_OFFSET[1] * scale)


def _hidden_part(outline: Array, scale: float) -> Array | None:
    """Return the part of a mesh under a floor that is never visible; None if it is small."""
    margin = HIDDEN_MARGIN * scale
    return grow(outline, -margin) if half_width(outline) > 1.2 * margin else None


def _area(
    drawer: MeshDrawer, layers: Layers, area: AreaDescription, top: float
) -> BatchedMeshHandle:
    """Draw an area on a floor with a top (m), and return its fill."""
    outline, hole = region_outlines(area)
    name, colour = f"area {area.name}", area_colour(area)
    if area.paint:
        edge = grow(outline, PAINT_OVERLAP_M)
        return drawer.mesh(f"{name}/fill", flat_mesh(edge, hole), top + layers.paint, colour)
    mesh = flat_mesh(outline, hole)
    fill = drawer.mesh(f"{name}/fill", mesh, top + layers.area, colour, opacity=AREA_OPACITY)
    for edge in (outline,) if hole is None else (outline, hole):
        drawer.line(segments(edge, top + layers.outline), colour)
    return fill  # its label is one of labels.py


def _rectangle_around(static_scene: StaticScene, times: float) -> Mesh:
    """Return a rectangle that reaches ``times`` the arena's size beyond it."""
    (left, low), (right, high) = static_scene.bounds
    by = times * arena_size(static_scene)
    a, b = (left - by, low - by), (right + by, high + by)
    return flat_mesh([b, (a[0], b[1]), a, (b[0], a[1])])


_MAX_LINES_PER_DIRECTION = 60
"""A floor that would need more lines gets a coarser grid."""


def grid_step(width: float) -> float:
    """Return the distance (m) between lines on a floor of a width (m): 1, 2, 5, 10, ...

    >>> [grid_step(width) for width in (10, 60, 100, 250, 1000)]
    [1.0, 1.0, 2.0, 5.0, 20.0]
    """
    step = 1.0
    while width / step > _MAX_LINES_PER_DIRECTION:
        step *= 2.5 if str(step)[0] == "2" else 2.0
    return step


def grid_in(outline: Array, hole: Array | None, z: float) -> Array:
    """Return the grid's lines (n, 2, 3) inside a convex outline and outside a convex hole."""
    step = grid_step(float(np.ptp(outline, axis=0).max()))
    vertical = _along_y(outline, hole, step)
    horizontal = _along_y(outline[:, ::-1], None if hole is None else hole[:, ::-1], step)[
        ..., ::-1
    ]
    lines = np.concatenate([vertical, horizontal])
    return np.concatenate([lines, np.full((*lines.shape[:2], 1), z)], axis=2)


def _along_y(outline: Array, hole: Array | None, step: float) -> Array:
    left, right = float(outline[:, 0].min()), float(outline[:, 0].max())
    lines = []
    for number in range(math.floor(left / step) + 1, math.ceil(right / step)):
        x = number * step
        inside = _intersect(outline, x)
        if inside is None:
            continue
        gap = None if hole is None else _intersect(hole, x)
        spans = [inside] if gap is None else [(inside[0], gap[0]), (gap[1], inside[1])]
        lines += [((x, low), (x, high)) for low, high in spans if high > low]
    return np.array(lines, np.float64).reshape(-1, 2, 2)


def _intersect(outline: Array, x: float) -> tuple[float, float] | None:
    """Return the y at which the line at x enters and leaves a convex outline; None if it misses."""
    ax, ay = outline[:, 0], outline[:, 1]
    bx, by = np.roll(ax, -1), np.roll(ay, -1)
    crossing = (ax < x) != (bx < x)
    if not crossing.any():
        return None
    y = ay[crossing] + (x - ax[crossing]) / (bx - ax)[crossing] * (by - ay)[crossing]
    return float(y.min()), float(y.max())

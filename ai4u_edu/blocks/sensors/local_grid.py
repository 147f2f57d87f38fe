"""A sensor that reads an image of the surroundings from above."""

from collections.abc import Iterable, Sequence
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np
import numpy.typing as npt
from gymnasium.spaces import Box
from pydantic import Field

from ai4u_edu.base.errors import BlockError
from ai4u_edu.base.parameters import Name, PositiveMetres
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.groups import check_groups
from ai4u_edu.blocks.sensors.footprint import Disc, Edge, footprint
from ai4u_edu.blocks.sensors.pictures import ChannelLegend
from ai4u_edu.blocks.sensors.sensor import Array, Sensor, check_memory
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import BodyDescription, BodyView, RegionDescription, WorldView

_VOID = "void"
"""Name of the channel that shows where there is no floor."""

_ENDLESS_GROUND_TAG = "floor"
"""Tag of the endless ground of a world without floors."""

_POSE_OF_FALLEN = (1e9, 1e9, 0.0, 0.0)
"""Pose that is used for bodies that fell out of the world: far outside any image."""

_Indices = npt.NDArray[np.intp]
_Floats = npt.NDArray[np.float64]
_Bits = npt.NDArray[np.uint8]
_Spans = tuple[_Floats, _Floats]
"""(shapes, rows): the first and the last u of each row; no cells if the last is the smaller."""

_EDGE_TOLERANCE_CELLS = 1e-9
"""A cell's centre this close to a shape's edge (in cells) belongs to the shape."""

_MIN_SLOPE = _EDGE_TOLERANCE_CELLS * _EDGE_TOLERANCE_CELLS
"""Smallest slope that a horizontal edge is given, so that nothing divides by zero."""


class _Raster:
    """_Rasterizes many discs and convex polygons at once.

    A cell belongs to a shape if its centre does. Coordinates are in cells: u to the right, v down,
    the centre of the first cell at (0, 0). A convex shape covers one span of cells in each row, so
    only the two ends of each span are computed; a table gives the cells in between as bits.

    Args:
        width: columns.
        height: rows.

    >>> raster = _Raster(5, 3)
    >>> pictures = raster.fill(*raster.discs(np.array([[2.0, 1.0, 1.0]])))
    >>> raster.cells(pictures).astype(int)[0]
    array([[0, 0, 1, 0, 0],
           [0, 1, 1, 1, 0],
           [0, 0, 1, 0, 0]])
    """

    def __init__(self, width: int, height: int) -> None:
        self.width, self.height = width, height
        self._rows = np.arange(height, dtype=np.float64)
        # the first n cells of a row, as bits; the xor of two such rows is the span between them
        self._first = np.packbits(np.tri(width + 1, width, -1, dtype=np.bool_), axis=1)

    def empty(self, count: int) -> _Bits:
        """Return ``count`` empty pictures."""
        return np.zeros((count, self.height, self._first.shape[1]), np.uint8)

    def discs(self, discs: _Floats) -> _Spans:
        """Return the span of each disc (u, v, radius) in each row."""
        u, v, radius = discs.T[:, :, None]
        square = radius * radius - (self._rows - v) ** 2 + _EDGE_TOLERANCE_CELLS
        half = np.sqrt(np.maximum(square, 0.0))
        half[square < 0.0] = -1.0  # the span ends before it begins: no cells
        return u - half, u + half

    def polygons(self, edges: _Floats) -> _Spans:
        """Return the span of each convex polygon in each row.

        Args:
            edges: (polygons, edges, 3): a, b and c of each edge; inside is a u + b v <= c for all.
        """
        a, b, c = edges[..., 0, None], edges[..., 1, None], edges[..., 2, None]
        right = a >= 0.0  # True for an edge that bounds its row on the right
        level = np.abs(a) < _EDGE_TOLERANCE_CELLS
        if level.any():
            a = np.where(level, np.where(right, _MIN_SLOPE, -_MIN_SLOPE), a)
        end = (c + _EDGE_TOLERANCE_CELLS - b * self._rows) / a
        high = np.minimum.reduce(np.where(right, end, np.inf), axis=1)
        low = np.maximum.reduce(np.where(right, -np.inf, end), axis=1)
        return low, high

    def fill(self, low: _Floats, high: _Floats) -> _Bits:
        """Return one picture, as bits, for each shape from its spans."""
        start = self._whole(np.ceil(low - _EDGE_TOLERANCE_CELLS))
        stop = np.maximum(start, self._whole(np.floor(high + (_EDGE_TOLERANCE_CELLS + 1.0))))
        # take is about ten times as fast as indexing here
        bits: _Bits = self._first.take(stop, axis=0) ^ self._first.take(start, axis=0)
        return bits

    def cells(self, pictures: _Bits) -> _Bits:
        """Unpack pictures to 0 or 1 for each cell."""
        return np.unpackbits(pictures, axis=-1, count=self.width)

    def _whole(self, ends: _Floats) -> npt.NDArray[np.intp]:
        return ends.clip(0.0, self.width).astype(np.intp)


class _Seen(NamedTuple):
    """Position (cells) and rotation of each shape in the image, and True if it is near."""

    u: _Floats
    v: _Floats
    cos: _Floats
    sin: _Floats
    near: npt.NDArray[np.bool_]


class _Parts(NamedTuple):
    """Discs (n, 3), or polygons with the same number of edges (n, edges, 3); lengths in cells."""

    first: int
    """Index of the first part's picture."""
    owners: _Indices
    forms: _Floats

    def draw(self, seen: _Seen, raster: _Raster) -> tuple[_Indices, _Floats, _Floats]:
        """Return the indices of all parts that are near, and their start and end in each row."""
        picks = np.flatnonzero(seen.near[self.owners])
        forms, owner = self.forms[picks], self.owners[picks]
        u, v, cos, sin = (each[owner] for each in seen[:4])
        if forms.ndim == 3:
            u, v, cos, sin = u[:, None], v[:, None], cos[:, None], sin[:, None]
        x, y = forms[..., 0], forms[..., 1]
        across, along = sin * x + cos * y, cos * x - sin * y
        if forms.ndim == 2:
            forms[:, 0], forms[:, 1] = u - across, v - along
            return picks, *raster.discs(forms)
        forms[..., 0], forms[..., 1] = -across, -along
        forms[..., 2] -= across * u + along * v
        return self.first + picks, *raster.polygons(forms)


class _TopView:
    """Draws the surroundings of a body, heading up, as one picture for each group.

    Args:
        width: columns.
        height: rows.
        cell: side length of a cell, metres.
        channels: the groups, one picture each.
        exclude_self: True leaves out the body in the middle.
    """

    def __init__(
        self, width: int, height: int, cell: float, channels: Sequence[str], exclude_self: bool
    ) -> None:
        self._raster = _Raster(width, height)
        self._cell = cell
        self._channels = tuple(channels)
        self._exclude_self = exclude_self
        self._middle = (width - 1) / 2, (height - 1) / 2
        self._corner = float(np.hypot(width, height)) / 2
        self._built_for: tuple[int, BodyView] | None = None

    def draw(self, body: BodyView, view: WorldView) -> _Bits:
        """Return the present surroundings of a body as 0 and 1: (channels, height, width)."""
        if self._built_for != (view.generation, body):
            self._build(body, view)
        seen = self._look(body)
        pictures = self._raster.empty(self._count)
        drawn = [parts.draw(seen, self._raster) for parts in self._parts]
        numbers, low, high = map(np.concatenate, zip(*drawn, strict=True))
        pictures[numbers] = self._raster.fill(low, high)
        for hole, outer in self._holes:
            pictures[outer] &= ~pictures[hole]
        planes = self._raster.empty(len(self._channels))
        for plane, channel, shown in zip(planes, self._channels, self._shown, strict=True):
            if shown.size:
                plane |= _union(pictures, shown)
            if channel == _VOID and self._ground.size:
                plane |= ~_union(pictures, self._ground)
            if channel == _ENDLESS_GROUND_TAG and not self._ground.size:
                plane[...] = 0xFF
        return self._raster.cells(planes)

    def _look(self, body: BodyView) -> _Seen:
        poses = self._poses
        for index, other in enumerate(self._bodies):
            poses[index] = _POSE_OF_FALLEN if other.fallen else other.pose
        (own_x, own_y), own = body.position, body.heading
        cos, sin = np.cos(own), np.sin(own)
        dx, dy = (poses[:, 0] - own_x) / self._cell, (poses[:, 1] - own_y) / self._cell
        left, ahead = cos * dy - sin * dx, cos * dx + sin * dy
        turned = poses[:, 3] - own
        # beyond the corners nothing can be in the picture
        near = np.hypot(left, ahead) <= self._corner + self._reaches
        return _Seen(
            self._middle[0] - left, self._middle[1] - ahead, np.cos(turned), np.sin(turned), near
        )

    def _build(self, body: BodyView, view: WorldView) -> None:
        """Decompose all shapes, once for each build of the world."""
        self._built_for = view.generation, body
        self._bodies = [
            other
            for other in (view[name] for name in view)
            if any(channel in other.tags for channel in self._channels)
            and not (other is body and self._exclude_self)
        ]
        count = len(self._bodies)
        regions: list[RegionDescription] = list(view.floors)
        regions += [area.description for area in view.areas.values()]
        owners: list[BodyDescription | RegionDescription] = [
            *(other.sampled for other in self._bodies),
            *regions,
        ]
        floors = range(count, count + len(view.floors))
        self._poses = np.zeros((len(owners), 4))
        for index, region in enumerate(regions, start=count):
            self._poses[index] = *region.position, 0.0, np.radians(region.heading_deg)
        self._reaches = np.array([owner.shape.reach for owner in owners]) / self._cell + 1.0

        discs: list[tuple[int, Disc]] = []
        polygons: dict[int, list[tuple[int, tuple[Edge, ...]]]] = {}
        self._holes = []
        for index, owner in enumerate(owners):
            found = footprint(owner.shape, self._cell if index < count else 0.0)
            if found.hole:
                self._holes.append((len(discs), len(discs) + 1))
                discs.append((index, found.hole))
            discs += [(index, disc) for disc in found.discs]
            for edges in found.polygons:
                polygons.setdefault(len(edges), []).append((index, edges))
        whose = [index for index, _ in discs]
        forms = np.array([disc for _, disc in discs]).reshape(-1, 3) / self._cell
        self._parts = [_Parts(0, _numbers(whose), forms)]
        for group in polygons.values():
            mine = [index for index, _ in group]
            forms = np.array([edges for _, edges in group])
            forms[..., 2] /= self._cell
            self._parts.append(_Parts(len(whose), _numbers(mine), forms))
            whose += mine

        self._count = len(whose)
        cut = [hole for hole, _ in self._holes]
        whole = [number for number in range(len(whose)) if number not in cut]
        self._shown = [
            _numbers(number for number in whole if channel in owners[whose[number]].tags)
            for channel in self._channels
        ]
        self._ground = _numbers(number for number in whole if whose[number] in floors)


def _union(pictures: _Bits, numbers: _Indices) -> _Bits:
    # flat, since numpy's inner loop runs along the last axis
    flat = pictures.take(numbers, axis=0).reshape(len(numbers), -1)
    union: _Bits = np.bitwise_or.reduce(flat, axis=0).reshape(pictures.shape[1:])
    return union


def _numbers(found: Iterable[int]) -> _Indices:
    return np.fromiter(found, np.intp)


Size = Annotated[int, Field(ge=1, le=512)]


class LocalGridSensor(Sensor):
    """An image of the surroundings from above that turns with the agent.

    The agent is in the middle and faces up: row 0 is farthest ahead, column 0 farthest left. Each
    cell is a square of side ``cell_size``, sampled at its centre. Each channel is a group: 255 in
    the cells that hold a body, floor or area with that tag, else 0. The channel ``void`` shows
    where there is no floor. A body thinner than a cell is drawn one cell thick, so that no wall has
    gaps. Height has no effect; a body that fell out of the world is not drawn.

    With the defaults it sees 8 m to each side::

        row 0     . . . . . . . . .        . nothing of this group: 0
                  . . . # # . . . .        # something of this group: 255
                  . . . # # . . . .
                  . . . . A . . . .        A the agent, looking up (not drawn itself)
        last row  . . . . . . . . .

    Reading: (height, width, channels), uint8, 0 or 255 (0 or 1 with ``normalized``): channels last,
    as image policies expect. When stacked, older images' channels come first: (height, width,
    stacked_observations * channels).

    Source: ours; it replaces the cameras of AI4U (Camera, Camera3DSensor, ScreenSensor) and needs
    no renderer.
    """

    width: Size = 64
    """Columns of the image."""
    height: Size = 64
    """Rows of the image."""
    cell_size: PositiveMetres = 0.25
    """Side length of a cell."""
    channels: Annotated[list[Name], Field(min_length=1, max_length=64)] = Field(
        default_factory=lambda: ["floor", "void", "wall", "target", "agent"]
    )
    """Groups (tags) that are shown, one channel each; ``void`` shows where there is no floor."""
    self_exclude: bool = True
    """True leaves out the agent's own body."""

    own_groups: ClassVar[tuple[str, ...]] = (_VOID,)

    @property
    def kind(self) -> str:  # type: ignore[override]  # depends on a parameter here
        """An image, or an array of floats if normalized."""
        return "sfloatarray" if self.normalized else "simage"

    def __post_init__(self) -> None:
        super().__post_init__()
        check_memory(self, (self.height, self.width, len(self.channels)))
        for index, channel in enumerate(self.channels):
            if channel in self.channels[:index]:
                raise BlockError(
                    _(
                        "{type} {perception_key!r}: channels: expected each group once, got "
                        "{channel} twice",
                        type=type(self).__name__,
                        perception_key=self.perception_key,
                        channel=repr(channel),
                    )
                )

    def space(self) -> Box:
        """Return the space of one image."""
        return Box(0, 255, (self.height, self.width, len(self.channels)), np.uint8)

    def observation_space(self) -> Box:
        """Return the space of the stacked images, joined along the channels."""
        count = len(self.channels) * self.stacked_observations
        shape = (self.height, self.width, count)
        return Box(0.0, 1.0, shape) if self.normalized else Box(0, 255, shape, np.uint8)

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the groups and prepare the drawing."""
        check_groups(self, "channels", view)
        self._top_view = _TopView(
            self.width, self.height, self.cell_size, self.channels, self.self_exclude
        )

    def write(self, out: Array, body: BodyView, view: WorldView) -> None:
        """Draw one image."""
        planes = self._top_view.draw(body, view)
        # the negative of 1 in 8 bits is 255
        np.negative(planes.transpose(1, 2, 0), out=out, casting="unsafe")

    def legend(self) -> ChannelLegend:
        """Return the group of each channel."""
        return ChannelLegend(tuple(self.channels))

    def _unstack(self) -> None:
        count = len(self.channels)
        self._out[..., count:] = self._out[..., :-count].copy()

    def _stack(self, reading: Any) -> None:
        out, count = self._out, len(self.channels)
        if self.stacked_observations == 1:
            out[...] = reading
        elif self._fresh:
            out[...] = np.tile(reading, self.stacked_observations)
        else:
            out[..., :-count] = out[..., count:]
            out[..., -count:] = reading

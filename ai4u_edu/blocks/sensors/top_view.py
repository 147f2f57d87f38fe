"""Images of the world around a body, seen from above."""

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ai4u_edu.blocks.sensors.footprint import Disc, Edge, footprint
from ai4u_edu.blocks.sensors.raster import Bits, Floats, Raster
from ai4u_edu.world import BodyDescription, BodyView, RegionDescription, WorldView

VOID = "void"
"""Name of the channel that shows where there is no floor."""

ENDLESS_GROUND_TAG = "floor"
"""Tag of the endless ground of a world without floors."""

POSE_OF_FALLEN = (1e9, 1e9, 0.0, 0.0)
"""Pose that is used for bodies that fell out of the world: far outside any image."""

Indices = npt.NDArray[np.intp]


class _Seen(NamedTuple):
    """Position (cells) and rotation of each shape in the image, and True if it is near."""

    u: Floats
    v: Floats
    cos: Floats
    sin: Floats
    near: npt.NDArray[np.bool_]


class _Parts(NamedTuple):
    """Discs (n, 3), or polygons with the same number of edges (n, edges, 3); lengths in cells."""

    first: int
    """Index of the first part's picture."""
    owners: Indices
    forms: Floats

    def draw(self, seen: _Seen, raster: Raster) -> tuple[Indices, Floats, Floats]:
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


class TopView:
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
        self._raster = Raster(width, height)
        self._cell = cell
        self._channels = tuple(channels)
        self._exclude_self = exclude_self
        self._middle = (width - 1) / 2, (height - 1) / 2
        self._corner = float(np.hypot(width, height)) / 2
        self._built_for: tuple[int, BodyView] | None = None

    def draw(self, body: BodyView, view: WorldView) -> Bits:
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
            if channel == VOID and self._ground.size:
                plane |= ~_union(pictures, self._ground)
            if channel == ENDLESS_GROUND_TAG and not self._ground.size:
                plane[...] = 0xFF
        return self._raster.cells(planes)

    def _look(self, body: BodyView) -> _Seen:
        poses = self._poses
        for index, other in enumerate(self._bodies):
            poses[index] = POSE_OF_FALLEN if other.fallen else other.pose
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


def _union(pictures: Bits, numbers: Indices) -> Bits:
    # flat, since numpy's inner loop runs along the last axis
    flat = pictures.take(numbers, axis=0).reshape(len(numbers), -1)
    union: Bits = np.bitwise_or.reduce(flat, axis=0).reshape(pictures.shape[1:])
    return union


def _numbers(found: Iterable[int]) -> Indices:
    return np.fromiter(found, np.intp)

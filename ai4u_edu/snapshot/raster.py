"""Rendering of a snapshot from above, without a browser."""

import math
from collections.abc import Iterable, Sequence

import numpy as np
import numpy.typing as npt
from PIL import Image, ImageDraw

from ai4u_edu.blocks import RayPicture, SpotPicture
from ai4u_edu.snapshot import BodyState, Snapshot, StaticScene, theme
from ai4u_edu.world import BodyDescription, CircleShape, RegionDescription, RingShape

Points = npt.NDArray[np.float64]

SUPERSAMPLING = 2
"""Factor by which everything is drawn larger and then reduced, for antialiasing."""
MARGIN_M = 0.75
"""Width of the void around the arena."""
SHADOW_OFFSET_M = (0.12, -0.12)
"""Offset of a body's shadow for each metre of height."""


def draw_snapshot(snapshot: Snapshot, *, longest: int = 480) -> npt.NDArray[np.uint8]:
    """Draw a snapshot from above; +x to the right, +y up.

    Args:
        snapshot: the snapshot to draw.
        longest: pixels of the longer side.

    Returns:
        (height, width, 3) uint8.
    """
    return _Canvas(snapshot.static_scene, longest).draw(snapshot)


class _Canvas:
    """An image that is being drawn; converts metres to pixels."""

    def __init__(self, static_scene: StaticScene, longest: int) -> None:
        self.static_scene = static_scene
        (left, low), (right, high) = static_scene.bounds
        wide, tall = right - left + 2 * MARGIN_M, high - low + 2 * MARGIN_M
        scale = longest / max(wide, tall)
        self.size = round(wide * scale), round(tall * scale)
        self.scale = scale * SUPERSAMPLING
        self.origin = left - MARGIN_M, high + MARGIN_M
        self.image = Image.new(
            "RGB", (self.size[0] * SUPERSAMPLING, self.size[1] * SUPERSAMPLING), theme.VOID
        )
        self.pen = ImageDraw.Draw(self.image)

    def draw(self, snapshot: Snapshot) -> npt.NDArray[np.uint8]:
        for floor in sorted(self.static_scene.floors, key=lambda floor: floor.top):
            self._region(floor, theme.floor_colour(floor), theme.FLOOR_EDGE)
        if not self.static_scene.floors:
            self.pen.rectangle((0, 0, *self.image.size), fill=theme.FLOOR)
        for area in self.static_scene.areas:
            self._region(area, theme.area_fill(area), theme.area_colour(area))
        for agent in snapshot.agents:
            self._rays(agent.rays.values())
        described = {body.name: body for body in self.static_scene.bodies}
        for state in sorted(snapshot.bodies, key=lambda state: state.z):
            if not state.fallen and state.name in described:
                self._body(described[state.name], state)
        for agent in snapshot.agents:
            self._spots(agent.spots.values())
        smooth = self.image.reduce(SUPERSAMPLING)
        return np.asarray(smooth, np.uint8)

    def _region(self, region: RegionDescription, fill: theme.Rgb, edge: theme.Rgb) -> None:
        heading = math.radians(region.heading_deg)
        outline = _placed(region.shape.outline(), *region.position, heading)
        self._polygon(outline, fill, edge)
        if isinstance(region.shape, RingShape):
            hole = _placed(region.shape.hole(), *region.position, heading)
            self._polygon(hole, theme.VOID, edge)

    def _body(self, body: BodyDescription, state: BodyState) -> None:
        colour = theme.body_colour(body, body.name in self.static_scene.agent_of)
        if state.z < 0:  # falling: the deeper, the darker
            colour = theme.mix_colours(colour, theme.VOID, min(1.0, -state.z / 2))
        outline = _placed(body.shape.outline(), state.x, state.y, state.heading)
        lift = max(0.0, state.z) + 0.4
        if state.z >= 0:
            shade = theme.mix_colours(theme.FLOOR, theme.VOID, 0.35)
            self._polygon(outline + np.multiply(SHADOW_OFFSET_M, lift), shade, None)
        self._polygon(outline, colour, theme.mix_colours(colour, (0, 0, 0), 0.45))
        if body.name in self.static_scene.agent_of:
            self._front(body, state)

    def _front(self, body: BodyDescription, state: BodyState) -> None:
        """Draw a wedge that shows an agent's heading."""
        reach = body.shape.radius if isinstance(body.shape, CircleShape) else body.shape.reach * 0.7
        wedge = [(reach * 0.95, 0.0), (reach * 0.15, reach * 0.5), (reach * 0.15, -reach * 0.5)]
        self._polygon(_placed(wedge, state.x, state.y, state.heading), (255, 255, 255), None)

    def _rays(self, pictures: Iterable[RayPicture]) -> None:
        groups = theme.group_colours(self.static_scene)
        for rays in pictures:
            start = self._pixels(np.array([rays.origin[:2]]))[0]
            ends = self._pixels(rays.ends[:, :2])
            for end, group in zip(ends, rays.groups, strict=True):
                colour = groups.get(group, theme.UNKNOWN_GROUP) if group else theme.RAY_MISS
                self.pen.line([start, end], fill=colour, width=1)

    def _spots(self, pictures: Iterable[SpotPicture]) -> None:
        radius = theme.SPOT_RADIUS_M * self.scale
        for spots in pictures:
            for (x, y), lit in zip(self._pixels(spots.places[:, :2]), spots.lit, strict=True):
                disc = (x - radius, y - radius, x + radius, y + radius)
                self.pen.ellipse(disc, fill=theme.SPOT_LIT if lit else theme.SPOT_UNLIT)

    def _polygon(self, points: Points, fill: theme.Rgb, edge: theme.Rgb | None) -> None:
        self.pen.polygon(self._pixels(points), fill=fill, outline=edge, width=SUPERSAMPLING)

    def _pixels(self, points: Points) -> list[tuple[float, float]]:
        left, top = self.origin
        x = (points[:, 0] - left) * self.scale
        y = (top - points[:, 1]) * self.scale
        return list(zip(x.tolist(), y.tolist(), strict=True))


def _placed(points: Sequence[tuple[float, float]], x: float, y: float, heading: float) -> Points:
    cos, sin = math.cos(heading), math.sin(heading)
    turned: Points = np.array(points) @ np.array([[cos, sin], [-sin, cos]]) + (x, y)
    return turned

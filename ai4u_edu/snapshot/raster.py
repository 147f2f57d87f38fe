"""Rendering of a snapshot from above, without a browser."""

import math
from collections.abc import Iterable, Sequence
from functools import lru_cache

import numpy as np
import numpy.typing as npt
from PIL import Image, ImageChops, ImageDraw, ImageFont

from ai4u_edu.blocks import RayPicture, SpotPicture
from ai4u_edu.snapshot import BodyState, Snapshot, StaticScene, theme
from ai4u_edu.snapshot.marks import (
    CHASSIS,
    DARK,
    EYES,
    LIGHT,
    NOSE,
    RING,
    RING_CENTRE,
    SHELL_TOP,
    TREAD,
    Disc,
    floor_outline,
    half_width,
    look_direction,
    pupils,
    robot_parts,
    tread_bars,
)
from ai4u_edu.world import (
    AreaDescription,
    BodyDescription,
    FloorDescription,
    RegionDescription,
    RingShape,
    WorldSettings,
)
from ai4u_edu.world.ink import TILE_M, InkImage
from ai4u_edu.world.pictures import decode_picture

Points = npt.NDArray[np.float64]
_Box = tuple[int, int, int, int]
"""Left, top, right and bottom edge (pixels)."""

SUPERSAMPLING = 2
"""Factor by which everything is drawn larger and then reduced, for antialiasing."""
MARGIN_M = 0.75
"""Width of the void around the arena."""
MIN_LABELLED_PX = 320
"""Smallest longer side of a picture with labels."""
LABEL_PX = 12
"""Size of a label's text."""
LABEL_ALPHA = 205
"""Opacity of a label's plate, of 255."""
MAX_LABEL_CHARS = 40
MIN_GRID_PX = 8
"""Least distance between two lines of the grid."""
EDGE_DARKNESS = 0.2
"""Share of black in the edge of a robot's shell, which gets less light than its top."""
SHADOW_OFFSET_M = (0.12, -0.12)
"""Offset of a body's shadow for each metre of height."""

_last_ground: tuple[object, Image.Image] | None = None
"""Picture of the ground that was drawn last, and what it shows: frames of a film share it."""


def draw_snapshot(snapshot: Snapshot, *, longest: int = 480) -> npt.NDArray[np.uint8]:
    """Draw a snapshot from above; +x to the right, +y up.

    Args:
        snapshot: the snapshot to draw.
        longest: pixels of the longer side.

    Returns:
        (height, width, 3) uint8.
    """
    return _Canvas(snapshot.static_scene, longest).draw(snapshot)


def draw_thing(
    thing: BodyDescription | FloorDescription | AreaDescription,
    reach_m: float,
    *,
    is_agent: bool,
    longest: int,
) -> npt.NDArray[np.uint8]:
    """Draw one thing from above, at the heading of its description, and nothing around it.

    Args:
        thing: its position is ignored.
        reach_m: distance (m) from the middle of the picture to its sides.
        is_agent: True for the body of an agent, which has a face.
        longest: pixels of a side.

    Returns:
        (longest, longest, 4) uint8: red, green, blue, opacity.
    """
    thing = thing.model_copy(update={"position": (0.0, 0.0)})
    side = reach_m - MARGIN_M
    static_scene = StaticScene(
        settings=WorldSettings(),
        floors=(),
        areas=(),
        bodies=(),
        agent_of={thing.name: ""} if is_agent else {},
        bounds=((-side, -side), (side, side)),
    )
    canvas = _Canvas(static_scene, longest)
    opacity = Image.new("L", canvas.image.size)
    pen = ImageDraw.Draw(opacity)
    if isinstance(thing, BodyDescription):
        heading = math.radians(thing.heading_deg)
        state = BodyState(thing.name, 0, 0, 0, heading, 0, 0, 0, 0, on_ground=True, fallen=False)
        canvas._body(thing, state, {})
        canvas._polygon(_placed(thing.shape.outline(), 0.0, 0.0, heading), 255, None, pen)
    else:
        if isinstance(thing, FloorDescription):
            canvas._region(thing, theme.floor_colour(thing), theme.FLOOR_EDGE)
        elif thing.picture is not None:
            canvas._lay(thing, thing.picture)
        else:
            canvas._region(thing, theme.area_fill(thing), theme.area_colour(thing))
        canvas._region(thing, 255, None, pen)
    canvas.image.putalpha(opacity)
    return np.asarray(canvas.image.reduce(SUPERSAMPLING), np.uint8)


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
        global _last_ground
        static_scene = self.static_scene
        key = static_scene.floors, static_scene.areas, static_scene.bounds, self.size
        ground = _last_ground
        if ground is None or ground[0] != key:
            self._ground()
            ground = _last_ground = key, self.image.copy()
        else:
            self.image.paste(ground[1])
        passed = snapshot.passed_stages
        for area in static_scene.areas:
            if area.name in passed and not area.is_flat:
                self._region(area, theme.area_fill(area, is_passed=True), theme.area_colour(area))
        self._ink(snapshot.state.world.ink)
        for agent in snapshot.agents:
            self._rays(agent.rays.values())
        described = {body.name: body for body in self.static_scene.bodies}
        states = {body.name: body for body in snapshot.bodies}
        directions = {
            agent.body: look_direction(static_scene, agent, states) for agent in snapshot.agents
        }
        for state in sorted(snapshot.bodies, key=lambda state: state.z):
            if not state.fallen and state.name in described:
                self._body(described[state.name], state, directions)
        for agent in snapshot.agents:
            self._spots(agent.spots.values())
        if max(self.size) >= MIN_LABELLED_PX:
            self._labels(snapshot)
        smooth = self.image.reduce(SUPERSAMPLING)
        return np.asarray(smooth, np.uint8)

    def _ground(self) -> None:
        floors = sorted(self.static_scene.floors, key=lambda floor: floor.top)
        if not floors:
            self.pen.rectangle((0, 0, *self.image.size), fill=theme.FLOOR)
            self._grid(Image.new("L", self.image.size, 255), theme.GRID)
        for floor in floors:
            colour = theme.floor_colour(floor)
            self._region(floor, colour, theme.FLOOR_EDGE)
            inside = Image.new("L", self.image.size)
            self._region(floor, 255, None, ImageDraw.Draw(inside))
            self._grid(inside, theme.mix_colours(colour, theme.VOID, 0.12))
        for area in self.static_scene.areas:
            if area.picture is not None:
                self._lay(area, area.picture)
        for area in self.static_scene.areas:
            if area.picture is None:
                self._region(area, theme.area_fill(area), theme.area_colour(area))

    def _lay(self, area: AreaDescription, data: str) -> None:
        """Draw an area's picture."""
        picture = Image.fromarray(decode_picture(data))
        outline = _placed(area.shape.outline(), *area.position, math.radians(area.heading_deg))
        ends = self._pixels(np.array([outline.min(axis=0), outline.max(axis=0)]))
        (left, low), (right, high) = ends
        place = math.floor(left), math.floor(high)
        size = math.ceil(right) - place[0] + 1, math.ceil(low) - place[1] + 1
        # from a pixel of the drawing to the picture's; the corners' order is a box's outline's
        (right_x, right_y), (left_x, left_y), (low_x, low_y), _ = self._pixels(outline)
        across = np.array([right_x - left_x, right_y - left_y]) / picture.width
        down = np.array([low_x - left_x, low_y - left_y]) / picture.height
        back = np.linalg.inv(np.column_stack([across, down]))
        offset = back @ (np.array(place) - (left_x, left_y))
        matrix = (back[0, 0], back[0, 1], offset[0], back[1, 0], back[1, 1], offset[1])
        shrink = max(1, math.floor(1 / max(np.hypot(*across), np.hypot(*down))))
        if shrink > 1:  # a transform looks at single pixels
            small = picture.reduce(shrink)
            sx, sy = small.width / picture.width, small.height / picture.height
            matrix = (*(sx * n for n in matrix[:3]), *(sy * n for n in matrix[3:]))
            picture = small
        turned = picture.transform(
            size, Image.Transform.AFFINE, matrix, Image.Resampling.NEAREST, fillcolor=(0, 0, 0, 0)
        )
        self.image.paste(turned, place, turned)

    def _ink(self, ink: InkImage) -> None:
        """Draw ink, each tile as a picture; on high floors last."""
        tops = {floor.name: floor.top for floor in self.static_scene.floors}
        for key in sorted(ink.tiles, key=lambda key: (tops.get(key.floor, 0.0), key)):
            corners = np.array([(key.column, key.row + 1), (key.column + 1, key.row)]) * TILE_M
            (left, top), (right, bottom) = self._pixels(corners)
            place = round(left), round(top)
            size = max(round(right) - place[0], 1), max(round(bottom) - place[1], 1)
            picture = Image.fromarray(theme.ink_pixels(ink.tiles[key])).resize(
                size, Image.Resampling.BOX
            )
            self.image.paste(picture, place, picture)

    def _grid(self, inside: Image.Image, colour: theme.Rgb) -> None:
        """Draw lines 1 m apart, more in large arenas, where the mask ``inside`` is 255."""
        lines = Image.new("L", inside.size)
        pen, (wide, tall) = ImageDraw.Draw(lines), inside.size
        step = 1.0
        while step * self.scale < MIN_GRID_PX * SUPERSAMPLING:
            step *= 2.0
        left, top = self.origin
        for number in range(math.floor(left / step), math.ceil((left + wide / self.scale) / step)):
            x = (number * step - left) * self.scale
            pen.line([(x, 0), (x, tall)], fill=255, width=SUPERSAMPLING)
        for number in range(math.floor((top - tall / self.scale) / step), math.ceil(top / step)):
            y = (top - number * step) * self.scale
            pen.line([(0, y), (wide, y)], fill=255, width=SUPERSAMPLING)
        self.image.paste(colour, mask=ImageChops.multiply(lines, inside))

    def _region(
        self,
        region: RegionDescription,
        fill: theme.Rgb | int,
        edge: theme.Rgb | None,
        pen: ImageDraw.ImageDraw | None = None,
    ) -> None:
        heading = math.radians(region.heading_deg)
        outline = (
            floor_outline(self.static_scene, region)
            if isinstance(region, FloorDescription)
            else _placed(region.shape.outline(), *region.position, heading)
        )
        self._polygon(outline, fill, edge, pen)
        if isinstance(region.shape, RingShape):
            hole = _placed(region.shape.hole(), *region.position, heading)
            self._polygon(hole, 0 if isinstance(fill, int) else theme.VOID, edge, pen)

    def _body(self, body: BodyDescription, state: BodyState, directions: dict[str, float]) -> None:
        is_agent = body.name in self.static_scene.agent_of
        colour = theme.body_colour(body, is_agent)
        if state.z < 0:  # falling: the deeper, the darker
            colour = theme.mix_colours(colour, theme.VOID, min(1.0, -state.z / 2))
        outline = _placed(body.shape.outline(), state.x, state.y, state.heading)
        lift = max(0.0, state.z) + 0.4
        if state.z >= 0:
            shade = theme.mix_colours(theme.FLOOR, theme.VOID, 0.35)
            self._polygon(outline + np.multiply(SHADOW_OFFSET_M, lift), shade, None)
        if is_agent:
            self._robot(body, state, colour, directions.get(body.name, 0.0))
            return
        self._polygon(outline, colour, theme.mix_colours(colour, (0, 0, 0), 0.45))
        if "target" in body.tags:
            radius, (outer, inner) = half_width(body.shape.outline()), RING
            self._discs(((0.0, 0.0, outer),), radius, state, LIGHT)
            self._discs(((0.0, 0.0, inner),), radius, state, colour)
            self._discs(((0.0, 0.0, RING_CENTRE),), radius, state, LIGHT)

    def _robot(
        self, body: BodyDescription, state: BodyState, colour: theme.Rgb, direction: float
    ) -> None:
        parts, radius = robot_parts(body), half_width(body.shape.outline())
        edge = theme.mix_colours(colour, (0, 0, 0), EDGE_DARKNESS)
        bars = [bar for wheel in parts.wheels for bar in tread_bars(wheel)]
        for outline, fill in (
            (parts.outline, CHASSIS),
            *((bar, TREAD) for bar in bars),
            (parts.shell, edge),
            (SHELL_TOP * parts.shell, colour),
            (radius * np.array(NOSE), LIGHT),
        ):
            self._polygon(_placed(outline, state.x, state.y, state.heading), fill, None)
        self._discs(EYES, radius, state, LIGHT)
        self._discs(pupils(direction), radius, state, DARK)

    def _discs(
        self, discs: Iterable[Disc], radius: float, state: BodyState, colour: theme.Rgb
    ) -> None:
        for x, y, size in discs:
            centre = _placed([(x * radius, y * radius)], state.x, state.y, state.heading)
            ((u, v),) = self._pixels(centre)
            r = size * radius * self.scale
            self.pen.ellipse((u - r, v - r, u + r, v + r), fill=colour)

    def _labels(self, snapshot: Snapshot) -> None:
        """Draw what is said, then labels, agents' first: none covers an earlier one."""
        states = {state.name: state for state in snapshot.bodies}
        kept: list[_Box] = []
        for name, text in theme.said(snapshot).items():
            state = states.get(name)
            if state is not None and not state.fallen:
                self._label(text, state.x, state.y + 0.9, kept)
        agents = self.static_scene.agent_of
        for body in sorted(self.static_scene.bodies, key=lambda body: body.name not in agents):
            text, state = theme.label_text(self.static_scene, body), states.get(body.name)
            if text and state is not None and not state.fallen:
                outline = _placed(body.shape.outline(), state.x, state.y, state.heading)
                x, y = outline.mean(axis=0)
                reach = np.linalg.norm(outline - (x, y), axis=1).max()
                self._label(text, x, y - 1.08 * reach, kept, is_below=True)
        for area in self.static_scene.areas:
            self._label("" if area.is_flat else area.label or area.name, *area.position, kept)
        for floor in self.static_scene.floors:
            self._label(floor.label, *floor.position, kept)

    def _label(
        self, text: str, x: float, y: float, kept: list[_Box], *, is_below: bool = False
    ) -> None:
        """Draw a label, unless it would cover one of those that are kept already."""
        if not text.strip():
            return
        plate = _plate(text.strip()[:MAX_LABEL_CHARS])
        ((u, v),) = self._pixels(np.array([(x, y)]))
        left, top = round(u - plate.width / 2), round(v - (0 if is_below else plate.height / 2))
        left = max(0, min(left, self.image.width - plate.width))  # else a picture's edge cuts it
        box = left, top, left + plate.width, top + plate.height
        if any(
            box[0] < other[2] and other[0] < box[2] and box[1] < other[3] and other[1] < box[3]
            for other in kept
        ):
            return
        kept.append(box)
        self.image.paste(plate, (left, top), plate)

    def _rays(self, pictures: Iterable[RayPicture]) -> None:
        groups = theme.group_colours(self.static_scene)
        for rays in pictures:
            start = self._pixels(np.array([rays.origin[:2]]))[0]
            ends = self._pixels(rays.ends[:, :2])
            for end, group in zip(ends, rays.groups, strict=True):
                colour = groups.get(group, theme.UNKNOWN_GROUP) if group else theme.RAY_MISS
                self.pen.line([start, end], fill=colour, width=SUPERSAMPLING)

    def _spots(self, pictures: Iterable[SpotPicture]) -> None:
        radius = theme.SPOT_RADIUS_M * self.scale
        for spots in pictures:
            for (x, y), lit in zip(self._pixels(spots.places[:, :2]), spots.lit, strict=True):
                disc = (x - radius, y - radius, x + radius, y + radius)
                self.pen.ellipse(disc, fill=theme.SPOT_LIT if lit else theme.SPOT_UNLIT)

    def _polygon(
        self,
        points: Points,
        fill: theme.Rgb | int,
        edge: theme.Rgb | None,
        pen: ImageDraw.ImageDraw | None = None,
    ) -> None:
        pen = pen or self.pen
        pen.polygon(self._pixels(points), fill=fill, outline=edge, width=SUPERSAMPLING)

    def _pixels(self, points: Points) -> list[tuple[float, float]]:
        left, top = self.origin
        x = (points[:, 0] - left) * self.scale
        y = (top - points[:, 1]) * self.scale
        return list(zip(x.tolist(), y.tolist(), strict=True))


@lru_cache(maxsize=256)
def _plate(text: str) -> Image.Image:
    """Return a label: dark text on a rounded, half transparent plate (RGBA)."""
    font = ImageFont.load_default(LABEL_PX * SUPERSAMPLING)
    left, top, right, bottom = font.getbbox(text, anchor="ls")
    ascent, pad = -min(top, font.getbbox("b", anchor="ls")[1]), 3 * SUPERSAMPLING
    size = round(right - left + 2 * pad), round(ascent + max(bottom, 0) + 1.4 * pad)
    plate = Image.new("RGBA", size, (*LIGHT, 0))
    pen = ImageDraw.Draw(plate)
    pen.rounded_rectangle((0, 0, size[0] - 1, size[1] - 1), pad, fill=(*LIGHT, LABEL_ALPHA))
    pen.text((pad - left, 0.7 * pad + ascent), text, fill=(*DARK, 255), font=font, anchor="ls")
    return plate


def _placed(
    points: Sequence[tuple[float, float]] | Points, x: float, y: float, heading: float
) -> Points:
    cos, sin = math.cos(heading), math.sin(heading)
    turned: Points = np.array(points) @ np.array([[cos, sin], [-sin, cos]]) + (x, y)
    return turned

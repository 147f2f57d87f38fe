"""What colour things have where their description names none. Okabe-Ito, and calm greys."""

from collections.abc import Iterable

from ai4u_edu.base.colors import rgb
from ai4u_edu.snapshot import StaticScene
from ai4u_edu.world import AreaDescription, BodyDescription, FloorDescription

Rgb = tuple[int, int, int]

VOID: Rgb = (50, 58, 69)
FLOOR: Rgb = (228, 232, 236)
FLOOR_EDGE: Rgb = (128, 139, 150)
GRID: Rgb = (204, 210, 216)
WALL: Rgb = (84, 93, 104)
RAY_MISS: Rgb = (152, 161, 170)
"""A ray that met nothing."""
UNKNOWN_GROUP: Rgb = rgb("purple")
"""A ray that met something without a code."""
ACTION: Rgb = (52, 60, 70)
SPOT_LIT: Rgb = rgb("yellow")
"""A spot at which a sensor sees something."""
SPOT_UNLIT: Rgb = (120, 129, 138)
"""One at which it sees nothing."""
SPOT_RADIUS_M = 0.06
"""A spot's radius, metres."""


def mix_colours(a: Rgb, b: Rgb, share: float) -> Rgb:
    """A colour between two: ``share`` 0 is all ``a``, 1 is all ``b``.

    >>> mix_colours((0, 0, 0), (100, 200, 50), 0.5)
    (50, 100, 25)
    """
    red, green, blue = (round(x + (y - x) * share) for x, y in zip(a, b, strict=True))
    return red, green, blue


def body_colour(body: BodyDescription, is_agent: bool) -> Rgb:
    """A body's colour: as described, or by its role."""
    if body.colour is not None:
        return rgb(body.colour)
    if is_agent:
        return rgb("blue")
    if "target" in body.tags:
        return rgb("orange")
    return {"static": WALL, "dynamic": rgb("sky blue"), "kinematic": rgb("green")}[body.kind]


def floor_colour(floor: FloorDescription) -> Rgb:
    """A floor's colour."""
    return FLOOR if floor.colour is None else rgb(floor.colour)


def area_colour(area: AreaDescription) -> Rgb:
    """An area's colour."""
    if area.colour is not None:
        return rgb(area.colour)
    return rgb("orange" if "target" in area.tags else "green")


def area_fill(area: AreaDescription) -> Rgb:
    """The colour inside an area where nothing shines through: pale, unless it is paint."""
    colour = area_colour(area)
    return colour if area.paint else mix_colours(colour, FLOOR, 0.65)


def group_colours(static_scene: StaticScene) -> dict[str, Rgb]:
    """The colour of each group, from the first thing that belongs to it; for rays."""
    colours: dict[str, Rgb] = {}

    def note(tags: Iterable[str], colour: Rgb) -> None:
        for tag in tags:
            colours.setdefault(tag, colour)

    for body in static_scene.bodies:
        note(body.tags, body_colour(body, body.name in static_scene.agent_of))
    for area in static_scene.areas:
        note(area.tags, area_colour(area))
    for floor in static_scene.floors:  # darker: a ray that ends on a floor lies on that floor
        note(floor.tags, mix_colours(floor_colour(floor), (0, 0, 0), 0.42))
    return colours

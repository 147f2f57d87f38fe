"""Default colours: Okabe-Ito, and greys."""

from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

from ai4u_edu.base.colors import FLOOR_RGB, rgb
from ai4u_edu.snapshot import Snapshot, StaticScene
from ai4u_edu.world import AreaDescription, BodyDescription, FloorDescription
from ai4u_edu.world.ink import INK_COLOURS, Tile
from ai4u_edu.world.messages import Message
from ai4u_edu.world.pictures import mean_colour

Rgb = tuple[int, int, int]

VOID: Rgb = (50, 58, 69)
FLOOR: Rgb = FLOOR_RGB
FLOOR_EDGE: Rgb = (128, 139, 150)
GRID: Rgb = (204, 210, 216)
WALL: Rgb = (84, 93, 104)
RAY_MISS: Rgb = (152, 161, 170)
"""Colour of a ray that hit nothing."""
UNKNOWN_GROUP: Rgb = rgb("purple")
"""Colour of a ray that hit something without a group code."""
ACTION: Rgb = (52, 60, 70)
SPOT_LIT: Rgb = rgb("yellow")
"""Colour of a point at which a sensor detects something."""
SPOT_UNLIT: Rgb = (120, 129, 138)
"""Colour of a point at which a sensor detects nothing."""
SPOT_RADIUS_M = 0.06
"""Radius of a point that a sensor reads."""


INK_RGBA = np.array([(0, 0, 0, 0)] + [(*rgb(each), 255) for each in INK_COLOURS], np.uint8)
"""Red, green, blue and opacity of ink by its code."""


def ink_pixels(tile: Tile) -> npt.NDArray[np.uint8]:
    """Return a tile of ink as a picture, its top row first.

    Returns:
        (rows, columns, 4): red, green, blue, opacity.
    """
    pixels: npt.NDArray[np.uint8] = INK_RGBA[tile[::-1]]
    return pixels


def mix_colours(a: Rgb, b: Rgb, share: float) -> Rgb:
    """Blend two colours: ``share`` 0 gives ``a``, 1 gives ``b``.

    >>> mix_colours((0, 0, 0), (100, 200, 50), 0.5)
    (50, 100, 25)
    """
    red, green, blue = (round(x + (y - x) * share) for x, y in zip(a, b, strict=True))
    return red, green, blue


def body_colour(body: BodyDescription, is_agent: bool) -> Rgb:
    """Return a body's described colour, or the default of its role."""
    if body.colour is not None:
        return rgb(body.colour)
    if is_agent:
        return rgb("blue")
    if "target" in body.tags:
        return rgb("orange")
    return {"static": WALL, "dynamic": rgb("sky blue"), "kinematic": rgb("green")}[body.kind]


def label_text(static_scene: StaticScene, body: BodyDescription) -> str:
    """Return a body's label, for agents by default their name; empty if it has none."""
    return body.label or (body.name if body.name in static_scene.agent_of else "")


SAID_S = 0.6
"""World time (s) for which a message is shown after it was said."""


def said(snapshot: Snapshot) -> dict[str, str]:
    """Return the texts of speech bubbles, by the speaker's body.

    >>> from ai4u_edu.world.messages import Message
    >>> bubble(Message(0, 10.0, (0.5, -1.0))), bubble(Message(0, 10.0, ()))
    ('“0.5  -1”', '“!”')
    """
    ticks = SAID_S * snapshot.static_scene.settings.ticks_per_second
    return {
        name: bubble(message)
        for name, message in snapshot.state.world.messages.items()
        if snapshot.tick - message.tick <= ticks
    }


def latest_said(snapshot: Snapshot) -> int:
    """Return the time of the latest message, from 1, in steps of :data:`SAID_S`; 0 for none."""
    messages = snapshot.state.world.messages
    if not messages:
        return 0
    latest = max(message.tick for message in messages.values())
    return 1 + int(latest / (SAID_S * snapshot.static_scene.settings.ticks_per_second))


def bubble(message: Message) -> str:
    """Return the text of a message; one without numbers is a call."""
    return f"“{'  '.join(f'{number:.3g}' for number in message.numbers) or '!'}”"


def floor_colour(floor: FloorDescription) -> Rgb:
    """Return a floor's described or default colour."""
    return FLOOR if floor.colour is None else rgb(floor.colour)


def area_colour(area: AreaDescription) -> Rgb:
    """Return an area's described or default colour; of one with a picture, the picture's mean."""
    if area.picture is not None:
        return mean_colour(area.picture)
    if area.colour is not None:
        return rgb(area.colour)
    return rgb("orange" if "target" in area.tags else "green")


AREA_OPACITY = 0.28
"""Opacity of an area that is not paint."""
PASSED_OPACITY = 0.7
"""Opacity of an area that an agent has passed on the way to its goal."""


def area_fill(area: AreaDescription, *, is_passed: bool = False) -> Rgb:
    """Return the opaque fill colour of an area: pale, unless it is flat or was passed."""
    colour = area_colour(area)
    return colour if area.is_flat else mix_colours(colour, FLOOR, 0.2 if is_passed else 0.65)


def group_colours(static_scene: StaticScene) -> dict[str, Rgb]:
    """Return the colour of each group for rays: that of the first thing in the group."""
    colours: dict[str, Rgb] = {}

    def add(tags: Iterable[str], colour: Rgb) -> None:
        for tag in tags:
            colours.setdefault(tag, colour)

    for body in static_scene.bodies:
        add(body.tags, body_colour(body, body.name in static_scene.agent_of))
    for area in static_scene.areas:
        add(area.tags, area_colour(area))
    for floor in static_scene.floors:  # darker: a ray that ends on a floor is drawn on that floor
        add(floor.tags, mix_colours(floor_colour(floor), (0, 0, 0), 0.42))
    return colours

"""A mouse over the picture of the world."""

import itertools
from typing import Any

from playwright.sync_api import Page, expect

from ai4u_edu.page.viewer.scene.framing import frame_arena
from tests.browser.served_viser import frames
from tests.playing import Played
from tests.waiting import until

Place = tuple[float, float]
CANVAS = "canvas[data-engine]"


def whole(page: Page) -> None:
    """Bring the camera over the whole arena, where it is from the beginning."""
    arena = page.get_by_role("button", name="Arena", exact=True)
    arena.click()
    expect(arena).to_have_attribute("aria-pressed", "true")
    frames(page)


def spot(page: Page, place: Place, half: float) -> Place:
    """Return where a place (metres) is on the screen, if the arena reaches from -half to half."""
    box = page.locator(CANVAS).bounding_box()
    assert box is not None
    seen = frame_arena(((-half, -half), (half, half)), box["width"] / box["height"])
    scale = box["height"] / seen.height
    x = box["x"] + box["width"] / 2 + scale * (place[0] - seen.x)
    return x, box["y"] + box["height"] / 2 - scale * (place[1] - seen.y)


def take(page: Page, at: Place, half: float) -> None:
    """Put the mouse on a place, and its button down as soon as there is a thing to click."""
    canvas = page.locator(CANVAS)
    x, y = spot(page, at, half)
    offsets = itertools.cycle((1, 0))  # viser looks for a thing only when the mouse has moved

    def is_on_thing() -> bool:
        offset = next(offsets)
        page.mouse.move(x + offset, y)
        frames(page)
        return not offset and canvas.evaluate("each => each.style.cursor") == "pointer"

    until(is_on_thing)
    page.mouse.down()


def carry(page: Page, at: Place, to: Place, half: float, steps: int = 8) -> None:
    """Moves the mouse as a hand does."""
    for step in range(1, steps + 1):
        share = step / steps
        place = tuple(a + share * (b - a) for a, b in zip(at, to, strict=True))
        page.mouse.move(*spot(page, (place[0], place[1]), half))
        frames(page)


def drag(page: Page, at: Place, to: Place, half: float) -> None:
    """Takes something up at one place and lets go of it at another."""
    take(page, at, half)
    carry(page, at, to, half)
    page.mouse.up()


def body(server: Played, name: str) -> list[float] | None:
    """A body's pose: x, y, z, heading; None if there is none of that name."""
    bodies: list[dict[str, Any]] = server.snapshot()["bodies"]
    return next((list(each["pose"]) for each in bodies if each["name"] == name), None)


def where(server: Played, name: str) -> Place:
    """A body's place."""
    pose = body(server, name)
    assert pose is not None
    return pose[0], pose[1]

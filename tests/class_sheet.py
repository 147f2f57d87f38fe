"""Takes the pictures of a class for the docs: ``python -m tests.class_sheet``.

With ``--all DIR``, it takes them of all sizes and color schemes instead, to look at. The messages
are made up, except those of the student's page; worlds, pages and browser are real.
"""

import argparse
import contextlib
import io
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

from PIL import Image
from playwright.sync_api import Browser

from tests.browser.wall_data import handed_in, race, tournament
from tests.browser.wall_server import wall_server
from tests.chromium import browser
from tests.classroom.served_class import CODE, served_class

PICTURES = Path(__file__).parents[1] / "docs" / "pictures"
SETTLE_MS = 1500
BAR = "class_bar"
"""Name of the picture of a student's page."""
Scheme = Literal["light", "dark"]
SCHEMES: tuple[Scheme, ...] = ("light", "dark")
COLORS = 256
"""Colors of a picture's palette; it is a third as large then, and looks the same."""


@dataclass(frozen=True)
class Shot:
    """A picture to take."""

    name: str
    page: str
    size: tuple[int, int] = (1280, 800)
    rooms: int = 30
    click: str = ""
    """Selector of what to click first."""
    state: dict[str, Any] = field(default_factory=dict)
    """Changes of the class's state."""
    is_in_docs: bool = True


def _shown(kind: str, room: str = "") -> dict[str, Any]:
    return {"shown": {"kind": kind, "room": room}}


SENTENCE = "nothing is called 'speeed'; did you mean 'speed'?"
SOURCE = """# It senses: rays, speed
def decide(percept):
    if speeed > 0.2:
        return {"move": [0.4, 0.1]}
    return {"move": [1.0, 0.0]}
"""
PROGRAMS = {
    "runs": {
        "2": {"state": "mistake", "text": SENTENCE, "line": 3},
        "5": {"state": "running", "text": "", "line": 0},
    },
    "program_mistakes": [
        {
            "kind": "unknown-name",
            "title": "A name that has no value",
            "count": 7,
            "seats": [2, 9, 14],
            "examples": [SENTENCE],
            "guide": "Search for the line in which the name gets its value.",
        }
    ],
}
ATTENTION = {"kind": "blank", "message": "Eyes to the front, please", "ends_in": 95.0}
SHOTS = [
    Shot("class_join", "join", (390, 844)),
    Shot("class_wall", "teacher"),
    Shot("class_room", "teacher", click=".ai4u-room", is_in_docs=False),
    Shot("class_progress", "teacher", click="#tab-progress"),
    Shot("class_misconceptions", "teacher", click="#tab-mistakes"),
    Shot("class_attention", "teacher", click="#attention"),
    Shot("class_held", "teacher", state={"attention": ATTENTION}, is_in_docs=False),
    Shot("class_assign", "teacher", click="#assign", is_in_docs=False),
    Shot("class_end", "teacher", click="#end", is_in_docs=False),
    Shot("class_projector", "projector", (1280, 720), state=_shown("join")),
    Shot("class_projector_room", "projector", (1280, 720), state=_shown("room", "room5")),
    Shot("class_race", "projector", (1280, 720), state={**_shown("race"), "race": race(9)}),
    Shot(
        "class_podium",
        "projector",
        (1280, 720),
        state={**_shown("race"), "race": race(9, "over")},
        is_in_docs=False,
    ),
    Shot("class_programs", "teacher", click="#tab-programs", state=PROGRAMS),
    Shot("class_assign_1400", "teacher", (1400, 900), click="#assign", is_in_docs=False),
    Shot(
        "class_tournament",
        "teacher",
        (1280, 1000),
        rooms=8,
        click="#tab-tournament",
        state={"tournament": tournament(6), "handed_in": handed_in(7)},
    ),
    Shot(
        "class_tournament_projector",
        "projector",
        (1280, 720),
        state={**_shown("tournament"), "tournament": tournament(7)},
    ),
    Shot(
        "class_tournament_many",
        "projector",
        (1280, 720),
        state={**_shown("tournament"), "tournament": tournament(30)},
        is_in_docs=False,
    ),
    Shot("class_tournament_none", "teacher", rooms=8, click="#tab-tournament", is_in_docs=False),
    Shot(
        "class_tournament_phone",
        "teacher",
        (390, 1400),
        rooms=8,
        click="#tab-tournament",
        state={"tournament": tournament(6, "over"), "handed_in": handed_in(7)},
        is_in_docs=False,
    ),
    Shot("class_check", "check", (760, 620)),
    Shot("class_privacy", "privacy", (900, 1300), is_in_docs=False),
    Shot("class_wall_0", "teacher", rooms=0, is_in_docs=False),
    Shot("class_wall_4", "teacher", rooms=4, is_in_docs=False),
    Shot("class_wall_100", "teacher", (1920, 1080), rooms=100, is_in_docs=False),
    Shot("class_wall_phone", "teacher", (390, 844), rooms=12, is_in_docs=False),
]


def main() -> None:
    """Take the pictures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--all", type=Path, help="folder for all of them, light and dark")
    parser.add_argument("--only", default="", help="part of the name of those to take")
    options = parser.parse_args()
    folder: Path = options.all or PICTURES
    folder.mkdir(parents=True, exist_ok=True)
    wanted = [
        shot for shot in SHOTS if options.only in shot.name and (options.all or shot.is_in_docs)
    ]
    with browser() as chromium:
        for shot in wanted:
            if not options.all:
                _save(take(chromium, shot, "light"), folder / f"{shot.name}.png")
                continue
            pictures = [take(chromium, shot, "light"), take(chromium, shot, "dark")]
            _save(_side_by_side(pictures), folder / f"{shot.name}.png")
        if options.only in BAR:
            pictures = [take_bar(chromium, each) for each in SCHEMES[: 2 if options.all else 1]]
            _save(_side_by_side(pictures), folder / f"{BAR}.png")


def take_bar(chromium: Browser, scheme: Scheme) -> Image.Image:
    """Return a picture of a student's page with the bar of the class, which is a real one here."""
    with (
        tempfile.TemporaryDirectory() as folder,
        served_class(Path(folder), "--rooms", "pairs") as school,
        contextlib.ExitStack() as stack,
    ):
        pages = []
        for _ in range(2):
            viewport: Any = {"width": 1100, "height": 640}
            context = chromium.new_context(viewport=viewport, color_scheme=scheme)
            pages.append(stack.enter_context(contextlib.closing(context)).new_page())
            pages[-1].goto(f"{school.url}?code={CODE}")
            pages[-1].get_by_role("button", name="Join", exact=True).click()
            pages[-1].wait_for_url("**/r/*/*")
        pages[0].wait_for_timeout(4 * SETTLE_MS)
        pages[0].keyboard.press("KeyW")
        school.command("attention", kind="", message="Five minutes left", seconds=300)
        pages[0].wait_for_timeout(2 * SETTLE_MS)
        return Image.open(io.BytesIO(pages[0].screenshot())).convert("RGB")


def take(chromium: Browser, shot: Shot, scheme: Scheme) -> Image.Image:
    """Return a picture."""
    width, height = shot.size
    viewport: Any = {"width": width, "height": height}
    context = chromium.new_context(viewport=viewport, color_scheme=scheme)
    with wall_server(shot.rooms) as school, contextlib.closing(context):
        school.state.update(shot.state)
        school.programs = [
            {"seat": seat, "name": "", "source": SOURCE, "scene": "maze", "agent": "0", "age": 70.0}
            for seat in range(1, min(shot.rooms, 9))
        ]
        page = context.new_page()
        page.goto(f"{school.url}{shot.page}")
        page.wait_for_timeout(SETTLE_MS)
        if shot.click:
            page.locator(shot.click).first.click()
            page.wait_for_timeout(SETTLE_MS / 3)
        return Image.open(io.BytesIO(page.screenshot())).convert("RGB")


def _side_by_side(pictures: list[Image.Image]) -> Image.Image:
    sheet = Image.new("RGB", (sum(each.width for each in pictures), pictures[0].height))
    x = 0
    for each in pictures:
        sheet.paste(each, (x, 0))
        x += each.width
    return sheet


def _save(picture: Image.Image, path: Path) -> None:
    picture.quantize(COLORS).save(path, optimize=True)
    print(path, path.stat().st_size // 1000, "kB")


if __name__ == "__main__":
    main()

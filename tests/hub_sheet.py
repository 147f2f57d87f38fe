"""Takes the pictures of a class at a JupyterHub for the docs: ``python -m tests.hub_sheet``.

Needs what tests/classroom/test_real_hub.py needs. With ``--all DIR``, it takes more of them, also
of a phone and in dark colors, to look at.
"""

import argparse
import tempfile
from pathlib import Path
from typing import Any

from playwright.sync_api import Browser

from tests.chromium import browser
from tests.class_sheet import PICTURES, SETTLE_MS
from tests.classroom.test_real_hub import (
    SETTINGS,
    Student,
    Teacher,
    sign_in,
    statuses,
)
from tests.lessons.hub import hub

DESKTOP, PHONE = (1280, 720), (390, 844)


def main() -> None:
    """Take the pictures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--all", type=Path, help="folder for all of them, also dark and of a phone")
    options = parser.parse_args()
    folder: Path = options.all or PICTURES
    folder.mkdir(parents=True, exist_ok=True)
    settings = SETTINGS.replace("cleanup_servers = False", "cleanup_servers = True")
    with (
        tempfile.TemporaryDirectory() as home,
        browser() as chromium,
        hub(Path(home), settings) as (url, _),
    ):
        school = url.replace("/hub/", "/services/ai4u-class/")
        students = [Student(chromium, url, each) for each in ("ada", "grace")]
        teacher = Teacher(chromium, school)
        students[0].drive("KeyA")
        students[1].drive("KeyW")
        teacher.wait_for(lambda state: len(statuses(state)) == len(students))
        _shoot(chromium, school, "ada", folder / "hub_student.png", (480, 600))
        _shoot(chromium, school, "teacher", folder / "hub_wall.png", DESKTOP)
        if options.all:
            for scheme in ("light", "dark"):
                for name, page in (("ada", "student"), ("teacher", "wall")):
                    path = folder / f"hub_{page}_phone_{scheme}.png"
                    _shoot(chromium, school, name, path, PHONE, scheme)
            _shoot(chromium, f"{school}projector", "teacher", folder / "hub_projector.png", DESKTOP)
            _shoot(chromium, school, "", folder / "hub_sign_in.png", DESKTOP)


def _shoot(
    chromium: Browser,
    url: str,
    name: str,
    path: Path,
    size: tuple[int, int],
    scheme: Any = "light",
) -> None:
    """Save a picture of a page after the sign-in; without a name, of the hub's sign-in itself."""
    viewport: Any = {"width": size[0], "height": size[1]}
    context = chromium.new_context(viewport=viewport, color_scheme=scheme)
    page = context.new_page()
    page.goto(url)
    if name:
        sign_in(page, name)
        page.wait_for_url("**/services/ai4u-class/**")
    page.wait_for_timeout(2 * SETTLE_MS)
    page.screenshot(path=path)
    context.close()
    print(path, path.stat().st_size // 1000, "kB")


if __name__ == "__main__":
    main()

"""Takes the pictures of explanations for the docs: ``python -m tests.explain_sheet``.

With ``--all DIR``, it takes the page light, dark and on a phone instead, to look at.
"""

import argparse
import io
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Literal

from PIL import Image
from playwright.sync_api import Browser, Page, expect

from ai4u_edu import Scene, trained_brain
from ai4u_edu import explain as why
from ai4u_edu.explain.plots import plot_field, plot_value_map
from tests.chromium import browser
from tests.playing import played

PICTURES = Path(__file__).parents[1] / "docs" / "pictures"
SCENES = {"box_chase": "box", "maze": None, "parking": None}
"""Scenes of the pictures, and what the poses of their maps face."""
STAND_INS = {
    "box_chase": ("2.5", "-3", "90"),
    "maze": ("-3", "4", "0"),
    "parking": ("-5.5", "0", "0"),
}
"""Other poses that are tried in the pictures: x, y (m) and heading (degrees)."""
DESK, PHONE = (1180, 900), (390, 844)
SETTLE_MS = 3000
COLORS = 256
TIME_SCALE = "0.2"
"""Slow enough for a machine that draws without a graphics card."""
Scheme = Literal["light", "dark"]


def main() -> None:
    """Take the pictures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--all", type=Path, help="folder for all of them")
    folder: Path | None = parser.parse_args().all
    with browser() as chromium:
        if folder is None:
            for scene in SCENES:
                _take(chromium, scene, PICTURES / f"explain_{scene}.png", DESK, "light")
                _take_maps(chromium, scene, PICTURES / f"explain_floor_{scene}.png", DESK, "light")
            _take_watch(chromium, PICTURES / "explain_watch.png")
            for scene, target in SCENES.items():
                _maps(scene, target)
            return
        folder.mkdir(parents=True, exist_ok=True)
        for size, name in ((DESK, "desk"), (PHONE, "phone")):
            for scheme in ("light", "dark"):
                for scene in SCENES:
                    _take(chromium, scene, folder / f"{scene}_{name}_{scheme}.png", size, scheme)
                    floor = folder / f"{scene}_floor_{name}_{scheme}.png"
                    _take_maps(chromium, scene, floor, size, scheme)


def _take(chromium: Browser, scene: str, path: Path, size: tuple[int, int], scheme: Scheme) -> None:
    """Take a picture of the page that tells because of what a network of the zoo acts."""
    with _page(chromium, scene, size, scheme) as page:
        page.get_by_role("switch", name="Show why").click()
        expect(page.locator(".ai4u-why-sentence")).to_contain_text("because", timeout=20_000)
        page.get_by_role("button", name="Pause", exact=True).click()
        page.locator(".ai4u-why-sentence").scroll_into_view_if_needed()
        page.wait_for_timeout(SETTLE_MS)
        _save(Image.open(io.BytesIO(page.screenshot())), path)


def _take_watch(chromium: Browser, path: Path) -> None:
    """Take a picture of the page while a network is watched."""
    context = chromium.new_context(viewport={"width": DESK[0], "height": DESK[1]})
    with (
        played("box_chase", "--seed", "1", waits_for_key=True) as server,
        context.new_page() as page,
    ):
        page.goto(server.url)
        page.get_by_role("button", name="Watch it think").click()
        page.get_by_role("button", name="Watch again").click(timeout=60_000)
        page.wait_for_timeout(SETTLE_MS)
        _save(Image.open(io.BytesIO(page.screenshot())), path)
    context.close()


def _take_maps(
    chromium: Browser, scene: str, path: Path, size: tuple[int, int], scheme: Scheme
) -> None:
    """Take a picture of the page with arrows, values and a stand-in over the floor."""
    with _page(chromium, scene, size, scheme) as page:
        page.get_by_role("button", name="Pause", exact=True).click()
        for name in ("Arrows: where it would go", "Colours: good and bad places"):
            page.get_by_role("switch", name=name).click()
        if SCENES[scene]:
            page.get_by_label("Facing").select_option(SCENES[scene])
        expect(page.locator(".ai4u-map-scale")).to_be_visible(timeout=60_000)
        expect(page.locator(".ai4u-map-progress:visible")).to_have_count(0, timeout=120_000)
        page.get_by_role("switch", name="Try another place").click()
        expect(page.get_by_label("x (m)")).to_be_visible(timeout=20_000)
        for label, value in zip(("x (m)", "y (m)", "Heading (°)"), STAND_INS[scene], strict=True):
            page.get_by_label(label).fill(value)
            page.get_by_label(label).blur()
        page.locator(".ai4u-maps").scroll_into_view_if_needed()
        page.wait_for_timeout(SETTLE_MS)
        _save(Image.open(io.BytesIO(page.screenshot())), path)


@contextmanager
def _page(chromium: Browser, scene: str, size: tuple[int, int], scheme: Scheme) -> Iterator[Page]:
    """Open the page of a scene in which a network of the zoo drives."""
    viewport: Any = {"width": size[0], "height": size[1]}
    context = chromium.new_context(viewport=viewport, color_scheme=scheme)
    with (
        played(scene, "--brain", "zoo", "--seed", "1", "--time-scale", TIME_SCALE) as server,
        context.new_page() as page,
    ):
        page.goto(server.url)
        page.locator("canvas[data-engine]").wait_for(timeout=60_000)
        unfold = page.get_by_role("button", name="Open the panel")
        if unfold.count():
            unfold.click()
        yield page
    context.close()


def _maps(scene: str, target: str | None) -> None:
    """Draw the action and the value all over the floor, side by side."""
    sim = Scene.load(scene).build(1)
    sim.agents[0].use_brain(trained_brain(f"zoo:{scene}"))
    sim.reset(1)
    network = f"zoo:{scene}"
    figures = (
        plot_field(why.field(network, sim, columns=20, heading=target)),
        plot_value_map(why.value_map(network, sim, columns=20, heading=target)),
    )
    images = []
    for figure in figures:
        out = io.BytesIO()
        figure.savefig(out, dpi=80)
        images.append(Image.open(out))
    sheet = Image.new("RGB", (sum(i.width for i in images), max(i.height for i in images)), "white")
    sheet.paste(images[0], (0, 0))
    sheet.paste(images[1], (images[0].width, 0))
    _save(sheet, PICTURES / f"explain_maps_{scene}.png")


def _save(image: Image.Image, path: Path) -> None:
    image.convert("RGB").quantize(COLORS).save(path, optimize=True)
    print(path)


if __name__ == "__main__":
    main()

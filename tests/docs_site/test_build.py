"""The docs site is built without a warning, is complete, and needs nothing from other hosts."""

import json
import re
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from typing import Literal

import pytest
import typer
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import expect

from ai4u_edu import Scene
from ai4u_edu.blocks.docs import built_in_blocks
from ai4u_edu.cli.main import app
from ai4u_edu.locale import LANGUAGES, SOURCE
from tests.chromium import browser, new_page
from tests.docs_site.staging import DOCS, ROOT, Staging, name_in_site
from tests.translations import TRANSLATED

pytestmark = [pytest.mark.slow, pytest.mark.nightly]

FETCHED = {
    "audio": "src",
    "iframe": "src",
    "img": "src",
    "link": "href",
    "script": "src",
    "source": "srcset",
}
"""Attributes whose addresses a browser fetches by itself."""
MAX_FILM_BYTES = 150_000


def run(*arguments: str) -> subprocess.CompletedProcess[str]:
    """Run Python in the repository."""
    command = [sys.executable, *arguments]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The pages, from one build of the command."""
    out = tmp_path_factory.mktemp("site")
    done = run("-m", "tests.docs_site", str(out))
    assert done.returncode == 0, done.stdout + done.stderr
    return out / "html"


class Fetched(HTMLParser):
    """Collects what a page fetches, and its ids."""

    def __init__(self) -> None:
        super().__init__()
        self.addresses: list[str] = []
        self.ids: set[str] = set()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Read a tag."""
        values = dict(attrs)
        self.ids.add(values.get("id") or "")
        address = values.get(FETCHED.get(tag, ""))
        if address:
            self.addresses.append(address)


def read(page: Path) -> Fetched:
    parser = Fetched()
    parser.feed(page.read_text(encoding="utf-8"))
    return parser


def test_every_page_of_the_docs_is_there(site: Path) -> None:
    for page in DOCS.rglob("*.md"):
        assert (site / name_in_site(page.relative_to(ROOT))).with_suffix(".html").is_file()
    assert (site / "changelog.html").is_file()


def test_every_block_has_a_page_with_parameters_and_an_example(site: Path) -> None:
    for kind, members in built_in_blocks().items():
        for cls in members:
            text = (site / "blocks" / f"{cls.__name__}.html").read_text(encoding="utf-8")
            for name in cls.parameters():
                assert f">{name}</span>" in text, f"{cls.__name__}: {name}"
            assert "highlight-python" in text or "doctest" in text, cls.__name__
            if kind in {"sensors"}:
                assert f"{cls.__name__}.png" in text
                assert (site / "_images" / f"{cls.__name__}.png").stat().st_size > 1000


def test_every_scene_has_a_page_with_a_small_film(site: Path) -> None:
    gallery = (site / "scenes.html").read_text(encoding="utf-8")
    for name in Scene.names():
        text = (site / "scenes" / f"{name}.html").read_text(encoding="utf-8")
        assert f"scenes/{name}.html" in gallery
        film = site / "_static" / "scenes" / f"{name}.webp"
        assert f"{name}.webp" in text
        assert 5_000 < film.stat().st_size <= MAX_FILM_BYTES


def test_every_command_has_a_section(site: Path) -> None:
    command = typer.main.get_command(app)
    ids = read(site / "cli.html").ids
    assert len(command.commands) > 15  # type: ignore[attr-defined]  # a group
    for name in command.commands:  # type: ignore[attr-defined]
        assert f"ai4u-edu-{name}" in ids


def test_the_search_finds_words(site: Path) -> None:
    text = (site / "searchindex.js").read_text(encoding="utf-8")
    index = json.loads(text[text.index("(") + 1 : text.rindex(")")])
    assert "kettl" not in index["terms"]
    found = index["terms"]["braitenberg"]
    names = [index["docnames"][each] for each in (found if isinstance(found, list) else [found])]
    assert "blocks/LightSensor" in names
    assert "RayCastingSensor" in json.dumps(index["objects"])


@pytest.mark.browser
def test_the_search_works_from_the_disk_and_asks_no_host(site: Path) -> None:
    asked: list[str] = []
    with browser() as chromium, new_page(chromium) as page:
        page.on("request", lambda request: asked.append(request.url))
        page.goto((site / "index.html").as_uri())
        page.get_by_role("textbox", name="Search").or_(
            page.get_by_placeholder("Search")
        ).first.fill("Braitenberg")
        page.keyboard.press("Enter")
        expect(page.get_by_role("link", name="LightSensor", exact=True).first).to_be_visible()
        page.get_by_role("main").get_by_role("link", name="LightSensor").first.click()
        expect(page.get_by_role("heading", name="LightSensor")).to_be_visible()
    assert [each for each in asked if not each.startswith(("file:", "data:"))] == []


@pytest.mark.browser
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_pages_are_accessible(site: Path, scheme: Literal["light", "dark"]) -> None:
    names = ["index", "scenes", "scenes/maze", "blocks/RayCastingSensor", "cli"]
    found = []
    with browser() as chromium, new_page(chromium, color_scheme=scheme) as page:
        for name in names:
            page.goto((site / f"{name}.html").as_uri())
            result = Axe().run(page)
            found += [(name, each["id"]) for each in result.response["violations"]]
    assert found == []


def test_no_page_fetches_anything_from_another_host(site: Path) -> None:
    pages = sorted(site.rglob("*.html"))
    assert len(pages) > 150
    for page in pages:
        for address in read(page).addresses:
            if address.startswith(("#", "data:")):
                continue
            assert not re.match("[a-z]+:|//", address), f"{page}: {address}"
            target = (page.parent / address.split("?")[0].split("#")[0]).resolve()
            assert target.is_file(), f"{page}: {address}"
    for style in site.rglob("*.css"):
        assert not re.search(r"url\([\"']?(https?:)?//", style.read_text(encoding="utf-8")), style


def test_external_links_are_listed(site: Path) -> None:
    listed = (site / "external_links.txt").read_text(encoding="utf-8")
    assert re.search(r"^https://gymnasium\.farama\.org  .*\btraining\b", listed, re.MULTILINE)


def test_every_page_has_a_link_to_itself_in_the_other_languages(site: Path) -> None:
    pages = [page.relative_to(site) for page in site.rglob("*.html")]
    english = {page for page in pages if page.parts[0] not in LANGUAGES}
    for language in TRANSLATED:
        translated = {page.relative_to(language) for page in pages if page.parts[0] == language}
        assert translated == english
        code = language.replace("_", "-")
        for page in english:
            here, there = site / page, site / language / page
            for one, other, wanted in ((here, there, code), (there, here, SOURCE)):
                text = one.read_text(encoding="utf-8")
                (address,) = re.findall(f'<a href="([^"]+)" hreflang="{wanted}"', text)
                assert (one.parent / address).resolve() == other
            assert f'<html class="no-js" lang="{code}"' in text


def small_site(folder: Path, text: str) -> Path:
    """Write a site of one page with the real site's settings, and return its folder."""
    staging = Staging(folder / "source")
    staging.write("conf.py", (DOCS / "conf.py").read_text(encoding="utf-8"))
    staging.write("_static/site.css", "")
    template = "_templates/sidebar/languages.html"
    staging.write(template, (DOCS / template).read_text(encoding="utf-8"))
    staging.write("index.md", text)
    return staging.folder


def test_a_link_to_nowhere_fails_the_build(tmp_path: Path) -> None:
    source = small_site(tmp_path, "# Home\n\n[gone](nowhere.md), [gone](#nothing)\n")
    done = run("-m", "sphinx", "-W", "-q", str(source), str(tmp_path / "html"))
    assert done.returncode != 0
    assert "nowhere.md" in done.stderr
    assert "nothing" in done.stderr

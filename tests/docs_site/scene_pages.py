"""The gallery of the library's scenes: a page for each, with a film of its solver."""

import html
import re

from ai4u_edu import Scene
from ai4u_edu.locale import library_text
from ai4u_edu.registration import env_id
from ai4u_edu.scenes.scene import LIBRARY
from tests.docs_site import rst
from tests.docs_site.films import Film, film_of
from tests.docs_site.staging import Staging

FOLDER, MEDIA = "scenes", "_static/scenes"
PURPOSE = re.compile(r"^\| `(\w+)` \| (.+?) \|$", re.MULTILINE)
"""A row of the table in ``docs/scenes.md``."""


def add_scenes(site: Staging) -> None:
    """Write a page for each scene of the library, and the gallery."""
    page = (site.folder / "scenes.md").read_text(encoding="utf-8")
    purposes = dict(PURPOSE.findall(page))
    cards = []
    for name in Scene.names():
        film = film_of(name)
        site.write(f"{MEDIA}/{name}.webp", film.film)
        site.write(f"{MEDIA}/{name}.png", film.still)
        site.write(f"{FOLDER}/{name}.rst", _page(site, name, purposes[name], film))
        cards.append(_card(site, name))
    entries = "\n".join(f"{FOLDER}/{name}" for name in Scene.names())
    gallery = f'<div class="ai4u-gallery">\n{"".join(cards)}</div>\n'
    site.append("scenes.md", f"{gallery}\n```{{toctree}}\n:hidden:\n\n{entries}\n```\n")


def title_of(site: Staging, name: str) -> str:
    """Return a scene's title."""
    title = Scene.load(name).description.title
    return site.translated(library_text(title)) if title else name


def _card(site: Staging, name: str) -> str:
    goal = html.escape(site.translated(library_text(Scene.load(name).description.goal)))
    return (
        f'<a href="{FOLDER}/{name}.html"><img src="{MEDIA}/{name}.png" alt="" loading="lazy">'
        f"<strong>{html.escape(title_of(site, name))}</strong><span>{goal}</span></a>\n"
    )


def _page(site: Staging, name: str, purpose: str, film: Film) -> str:
    scene = Scene.load(name).description
    agents = ", ".join(str(each.get("id", "0")) for each in scene.agents)
    level = site.words("{level}; {minutes} minutes for a person's first time")
    levels = {
        "easy": site.words("easy"),
        "medium": site.words("medium"),
        "hard": site.words("hard"),
        None: "",
    }
    facts = {
        site.words("What it is for"): rst.from_markdown(purpose),
        site.words("Goal"): rst.escaped(site.translated(library_text(scene.goal))),
        site.words("Controls"): rst.escaped(site.translated(library_text(scene.controls))),
        site.words("Rewards"): rst.escaped(site.translated(library_text(scene.rewards))),
        site.words("Level"): level.format(level=levels[scene.level], minutes=scene.minutes),
        site.words("Agents"): rst.escaped(agents),
        site.words("Environment"): rst.literal(f"ai4u_edu:{env_id(name)}"),
    }
    file = (LIBRARY / f"{name}.yaml").read_text(encoding="utf-8")
    return "\n".join(
        [
            rst.title(title_of(site, name)),
            _film(site, name, film),
            rst.table((site.words("scene"), name), facts.items(), (1, 4)),
            rst.code(f"ai4u-edu play {name}", "sh"),
            rst.title(site.words("The scene's file"), "-"),
            rst.code(file, "yaml"),
        ]
    )


def _film(site: Staging, name: str, film: Film) -> str:
    """Return the film; it can be closed, and anyone who wants no motion gets its first picture."""
    if film.speed < 1.05:
        words = site.words(
            "A program drives: {decisions} decisions in {seconds} s of the world's time"
        )
    else:
        words = site.words(
            "A program drives: {decisions} decisions in {seconds} s of the world's time, {speed} "
            "times as fast"
        )
    words = words.format(
        decisions=film.decisions, seconds=site.number(film.seconds), speed=site.number(film.speed)
    )
    alt = site.words("A film of the scene, from above")
    source = f"../{MEDIA}/{name}"
    return (
        ".. raw:: html\n\n"
        f'   <details class="ai4u-film" open><summary>{words}</summary>\n'
        f'   <picture><source srcset="{source}.png" media="(prefers-reduced-motion: reduce)">\n'
        f'   <img src="{source}.webp" alt="{alt}"></picture></details>\n'
    )

"""The gallery of the library's scenes: a page for each, with a film of its solver."""

import html
import re

from ai4u_edu import Scene
from ai4u_edu.registration import env_id
from ai4u_edu.scenes.scene import LIBRARY
from tests.docs_site import rst
from tests.docs_site.films import Film, film_of
from tests.docs_site.staging import DOCS, Staging

FOLDER, MEDIA = "scenes", "_static/scenes"
PURPOSE = re.compile(r"^\| `(\w+)` \| (.+?) \|$", re.MULTILINE)
"""A row of the table in ``docs/scenes.md``."""


def add_scenes(site: Staging) -> None:
    """Write a page for each scene of the library, and the gallery."""
    purposes = dict(PURPOSE.findall((DOCS / "scenes.md").read_text(encoding="utf-8")))
    cards = []
    for name in Scene.names():
        film = film_of(name)
        site.write(f"{MEDIA}/{name}.webp", film.film)
        site.write(f"{MEDIA}/{name}.png", film.still)
        site.write(f"{FOLDER}/{name}.rst", _page(name, purposes[name], film))
        cards.append(_card(name))
    entries = "\n".join(f"{FOLDER}/{name}" for name in Scene.names())
    gallery = f'<div class="ai4u-gallery">\n{"".join(cards)}</div>\n'
    site.append("scenes.md", f"{gallery}\n```{{toctree}}\n:hidden:\n\n{entries}\n```\n")


def title_of(name: str) -> str:
    """Return a scene's title."""
    return Scene.load(name).description.title or name


def _card(name: str) -> str:
    goal = html.escape(Scene.load(name).description.goal)
    return (
        f'<a href="{FOLDER}/{name}.html"><img src="{MEDIA}/{name}.png" alt="" loading="lazy">'
        f"<strong>{html.escape(title_of(name))}</strong><span>{goal}</span></a>\n"
    )


def _page(name: str, purpose: str, film: Film) -> str:
    scene = Scene.load(name).description
    agents = ", ".join(str(each.get("id", "0")) for each in scene.agents)
    facts = {
        "What it is for": rst.from_markdown(purpose),
        "Goal": rst.escaped(scene.goal),
        "Controls": rst.escaped(scene.controls),
        "Rewards": rst.escaped(scene.rewards),
        "Level": f"{scene.level}; {scene.minutes} minutes for a person's first time",
        "Agents": rst.escaped(agents),
        "Environment": rst.literal(f"ai4u_edu:{env_id(name)}"),
    }
    file = (LIBRARY / f"{name}.yaml").read_text(encoding="utf-8")
    return "\n".join(
        [
            rst.title(title_of(name)),
            _film(name, film),
            rst.table(("scene", name), facts.items(), (1, 4)),
            rst.code(f"ai4u-edu play {name}", "sh"),
            rst.title("The scene's file", "-"),
            rst.code(file, "yaml"),
        ]
    )


def _film(name: str, film: Film) -> str:
    """Return the film; it can be closed, and anyone who wants no motion gets its first picture."""
    faster = "" if film.speed < 1.05 else f", {film.speed:.1f} times as fast"
    words = (
        f"A program drives: {film.decisions} decisions in {film.seconds:.1f} s of the world's time"
        f"{faster}"
    )
    source = f"../{MEDIA}/{name}"
    return (
        ".. raw:: html\n\n"
        f'   <details class="ai4u-film" open><summary>{words}</summary>\n'
        f'   <picture><source srcset="{source}.png" media="(prefers-reduced-motion: reduce)">\n'
        f'   <img src="{source}.webp" alt="A film of the scene, from above"></picture></details>\n'
    )

"""Texts of a page that are cut, or spill over their button."""

import json
import re
from pathlib import Path

from playwright.sync_api import Page

from ai4u_edu.locale.catalogues import page_catalogue

CUT_TEXTS = Path(__file__).with_name("fit.js").read_text(encoding="utf-8")
SHOWN = """() => [...document.querySelectorAll(
    "button, [role=tab], label, h1, h2, h3, p, li, dt, th, summary, legend, strong, a")]
  .filter((each) => each.checkVisibility({ visibilityProperty: true }))
  .map((each) => each.innerText.trim())"""

LOADED_FONTS = """() => document.fonts.ready.then(
    (fonts) => [...fonts].filter((each) => each.status === "loaded").map((each) => each.family))"""


def loaded_fonts(page: Page) -> list[str]:
    """Return the families of fonts that a page has loaded and uses."""
    families: list[str] = page.evaluate(LOADED_FONTS)
    return families


def cut_texts(page: Page) -> list[str]:
    """Return the visible texts that don't fit into their box."""
    found: list[str] = page.evaluate(CUT_TEXTS)
    return found


def english_texts(page: Page, language: str) -> set[str]:
    """Return English texts of our scripts that a page in another language shows."""
    messages = json.loads(page_catalogue(language))["messages"]
    same = {text for text, translation in messages.items() if text == translation}
    english = {text for text in messages if re.search(r"[a-z]{2}", text)} - same
    shown: list[str] = page.evaluate(SHOWN)
    return english & set(shown)

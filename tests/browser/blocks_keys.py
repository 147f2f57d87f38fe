"""Blocks by keyboard alone, as a person with a screen reader puts a program together."""

from playwright.sync_api import Page

MAX_STEPS = 30
FOCUSED = """() => { const each = document.activeElement;
  return (each.getAttribute("aria-label") ?? each.textContent).trim().slice(0, 200); }"""


def focused(page: Page) -> str:
    """Return the accessible name of what has the focus, as far as it stands in the page."""
    name: str = page.evaluate(FOCUSED)
    return name


def go(page: Page, key: str, name: str) -> None:
    """Press a key until something whose name begins so has the focus."""
    seen = []
    for _ in range(MAX_STEPS):
        seen.append(focused(page))
        if seen[-1].startswith(name):
            return
        page.keyboard.press(key)
    raise AssertionError(f"{key} leads to {seen}, not to {name!r}")


def to_group(page: Page, name: str) -> None:
    """Open a group of blocks, and go to its first one."""
    page.keyboard.press("t")
    go(page, "ArrowDown", name)
    page.keyboard.press("ArrowRight")


def choose(page: Page, group: str, block: str) -> None:
    """Take a block of a group, and drop it where the editor proposes: at what had the focus."""
    to_group(page, group)
    go(page, "ArrowDown", block)
    page.keyboard.press("Enter")
    page.keyboard.press("Enter")


def set_number(page: Page, text: str) -> None:
    """Replace the number with the focus."""
    page.keyboard.press("Enter")
    page.keyboard.type(text)
    page.keyboard.press("Enter")

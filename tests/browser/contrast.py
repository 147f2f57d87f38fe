"""Contrast of the text of controls in the states that only a person brings about."""

from pathlib import Path

from playwright.sync_api import Page

MIN_TEXT, MIN_ICON = 4.5, 3.0
"""Lowest contrast of text and of icons (WCAG 2.2, 1.4.3 and 1.4.11)."""
CONTROLS = "button, a[href], summary, input, select, textarea, kbd, [tabindex], [role=button]"
"""Selector of everything that can be used."""
MEASURE = Path(__file__).with_name("contrast.js").read_text()
"""Page script that returns texts with too little contrast, and how many controls there are.

Colours are composed from computed styles: a screenshot would show one state of one control.
"""


def low_contrasts(page: Page, *, controls: int = 1, within: str = "body") -> list[str]:
    """Return the controls' texts that can't be read in one of their states.

    These are at rest, pointed at, focused and pressed; each of them as it is, chosen, and disabled.

    Args:
        controls: fewest controls that the page must show, so that an empty one does not pass.
        within: selector of the part of the page.
    """
    selector = f":is({within}) :is({CONTROLS})"
    limits = {"controls": selector, "minText": MIN_TEXT, "minIcon": MIN_ICON}
    low: list[str]
    low, count = page.evaluate(MEASURE, limits)
    assert count >= controls, f"expected {controls} controls or more, got {count}"
    return low

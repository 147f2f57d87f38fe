"""Changes in words, for the buttons that undo them and for sentences about them."""

import re

from ai4u_edu.blocks import Block
from ai4u_edu.page.editing.drivers import Driver
from ai4u_edu.page.panel.gallery import driver_title, words_of

_TYPE_NAME = re.compile(r"\b[A-Z][A-Za-z0-9]*\b")
_DRIVEN_BY = ": driven by "


def change_label(label: str) -> str:
    """Return an editor's label of a change with the titles of blocks.

    >>> change_label("add LinearRayCastingSensor"), change_label("move box")
    ('add Ray sensor', 'move box')
    >>> change_label("0: driven by network:zoo:box_chase")
    'change driver'
    """
    if _DRIVEN_BY in label:
        return "change driver"
    return _TYPE_NAME.sub(
        lambda found: words_of(found[0]).title if found[0] in Block.types else found[0], label
    )


def past_tense(label: str) -> str:
    """Return a label of a change as something that was done.

    >>> past_tense("move box"), past_tense("resize floor")
    ('Moved box', 'Resized floor')
    """
    verb, _, rest = change_label(label).partition(" ")
    ending = "d" if verb.endswith("e") else "ed"
    return f"{verb.capitalize()}{ending} {rest}".strip()


def driven_by(driver: Driver) -> str:
    """Return a driver as the end of a sentence.

    >>> driven_by(Driver("network:zoo:box_chase", "Network zoo:box_chase"))
    'the trained network'
    >>> driven_by(Driver("keys:ArrowController", "Keyboard: ArrowController"))
    'you (arrow keys)'
    """
    title = driver_title(driver)
    lowered = title[:1].lower() + title[1:]
    if driver.title.startswith("Keyboard:"):
        return f"you ({lowered})"
    if title == "Trained network":
        return f"the {lowered}"
    return f"“{title}”"

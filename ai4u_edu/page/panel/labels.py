"""Changes in words, for the buttons that undo them and for sentences about them."""

from collections.abc import Callable, Mapping

from ai4u_edu.locale import Text, ngettext, sentence
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.drivers import Driver
from ai4u_edu.page.panel.gallery import TRAINED_NETWORK, driver_title, words_of

_DRIVEN_BY = _("{agent}: driven by {driver}")
_DONE: Mapping[str, Callable[..., str]] = {
    "move {name}": lambda name: _("Moved {name}.", name=name),
    "move {n} thing": lambda n: ngettext("Moved {n} thing.", "Moved {n} things.", n),
    "resize {name}": lambda name: _("Resized {name}.", name=name),
}
"""Sentences on changes that were made with the mouse, by the text of the change."""


def change_label(label: str) -> str:
    """Return an editor's label of a change with the titles of blocks.

    >>> change_label(_("add {block}", block="LinearRayCastingSensor"))
    'add Ray sensor'
    >>> change_label(_("move {name}", name="box"))
    'move box'
    >>> change_label(_("{agent}: driven by {driver}", agent="0", driver="network:zoo:box_chase"))
    'change driver'
    """
    if not isinstance(label, Text):
        return label
    if label.msgid == _DRIVEN_BY:
        return _("change driver")
    if "block" not in label.values:
        return label
    title = words_of(str(label.values["block"])).title
    return Text(label.msgid, {**label.values, "block": title})


def past_tense(label: str) -> str:
    """Return a label of a change that was made with the mouse as a sentence.

    >>> past_tense(_("move {name}", name="box"))
    'Moved box.'
    >>> past_tense(ngettext("move {n} thing", "move {n} things", 2))
    'Moved 2 things.'
    """
    done = _DONE.get(label.msgid) if isinstance(label, Text) else None
    if done is None or not isinstance(label, Text):
        return sentence(change_label(label))
    return done(**label.values)


def driven_by(name: str, driver: Driver) -> str:
    """Return a sentence about who drives an agent now.

    Args:
        name: the agent's name for people.
        driver: its driver.

    >>> driven_by("robot", Driver("network:zoo:box_chase", "Network zoo:box_chase"))
    'robot is now driven by the trained network.'
    >>> driven_by("robot", Driver("keys:ArrowController", "Keyboard: ArrowController"))
    'robot is now driven by you. Keys: “Arrow keys”.'
    """
    title = driver_title(driver)
    if driver.title.startswith("Keyboard:"):
        return _("{name} is now driven by you. Keys: “{keys}”.", name=name, keys=title)
    if title == TRAINED_NETWORK:
        return _("{name} is now driven by the trained network.", name=name)
    return _("{name} is now driven by “{driver}”.", name=name, driver=title)

"""Choices of one page about explanations."""

from typing import NamedTuple, Protocol

from ai4u_edu.explain.elsewhere import Elsewhere
from ai4u_edu.explain.live_maps import MapChoice

OPTION = "explain"
"""Key of the choice among those of a page."""


class ExplainChoice(NamedTuple):
    """Choices of one page about explanations."""

    is_why_shown: bool = False
    """True if the page shows why its agent acts as it does."""
    maps: MapChoice = MapChoice()
    """The maps over the floor."""
    watched: MapChoice | None = None
    """The maps that the page shows while it watches a network; None until it does."""
    elsewhere: Elsewhere | None = None
    """Another place at which the agent is tried; None if it is at none."""


class HasChoices(Protocol):
    """A page's panel or its picture; both have the same choices."""

    choices: dict[str, object]


def choice_of(page: HasChoices) -> ExplainChoice:
    """Return what a page has chosen."""
    choice = page.choices.get(OPTION)
    return choice if isinstance(choice, ExplainChoice) else ExplainChoice()

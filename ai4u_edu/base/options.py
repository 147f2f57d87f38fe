"""The options: modules that the rest of the package works without.

This is the one list of them. Whatever uses an option loads it by its name from here, at the moment
it is needed; no import names it. So its folder may be missing, and so may packages that it needs.
"""

from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import NamedTuple, Protocol

from ai4u_edu.base.errors import SetupError, text_of
from ai4u_edu.locale import gettext as _

PAGE_OPTIONS = ("ai4u_edu.explain.page", "ai4u_edu.teach", "ai4u_edu.missions")
"""Add to the page of a world: each has a function ``page_option``; see
:class:`ai4u_edu.room.served_world.Option`."""
ENV_PAGE = "ai4u_edu.room.env_page"
"""Shows an environment's world: ``EnvPage`` makes its :class:`LivePage`."""
MISSIONS = "ai4u_edu.missions"
"""The missions of a start page: ``mission_map`` returns the function that lists them."""
DRIVERS = "ai4u_edu.learn.training.assigned"
"""Lets networks and programs drive in a world: ``with_drivers`` builds it."""

SMALL_TRAINER = "ai4u_edu.learn.small_trainer"
"""Learns from rewards and from drives with NumPy alone: ``train``, ``resume``, ``clone``; and
``kinds_of_opponents``, which says against whom."""


class MissingOptionError(SetupError):
    """An option can't be imported; the text says what needs it, and how to get it."""


class OptionTab(NamedTuple):
    """A tab of the panel that an option of a page brings."""

    name: str
    """Name in the page, in lower-case letters; the tab is given the option's part of this name."""
    title: str
    """Text on the tab."""
    script: Path
    """File of its JavaScript module, which exports a class ``Tab``, like those in ``web/panel/``.
    Pages load it below ``options/``, beside our folders, so that it may import from them."""


class LivePage(Protocol):
    """Page of a world whose ticks are run by the caller, at the pace of the wall clock."""

    url: str
    """Address of the page."""

    def advance(self) -> None:
        """Wait until the next tick is due, carry out what pages asked for, and tick.

        Raises:
            AI4UError: a block failed; the text names it.
        """

    def close(self) -> None:
        """Stop serving the page."""


def load_option(module: str, purpose: str) -> ModuleType:
    """Import an option's module.

    Args:
        module: one of those above, or one from elsewhere.
        purpose: what needs it, as the beginning of an error's sentence.

    Raises:
        MissingOptionError: it can't be imported.

    >>> load_option("no_such_option", "--brain")  # doctest: +ELLIPSIS
    Traceback (most recent call last):
        ...
    ai4u_edu.base.options.MissingOptionError: --brain needs no_such_option, which can't be ...
    """
    try:
        return import_module(module)
    except ImportError as error:
        raise MissingOptionError(
            _(
                "{purpose} needs {module}, which can't be imported here: {error}; install it "
                "with: pip install ai4u-edu",
                purpose=purpose,
                module=module,
                error=text_of(error),
            )
        ) from error

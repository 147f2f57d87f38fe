"""Options of a world's page, each of which can be left out."""

import logging
from collections.abc import Callable, Sequence
from importlib import import_module
from typing import Protocol

from ai4u_edu.page.panel.socket import PanelOption
from ai4u_edu.page.viewer.scene.sense_overlay import PictureOption
from ai4u_edu.runtime.replay_player import ReplayPlayer
from ai4u_edu.runtime.runner import Runner

OPTIONS = ("ai4u_edu.explain_page",)
"""Modules of the options that come with the package. Each has a function ``page_option``, which
takes a world's runner and its player of recorded episodes, and returns an :class:`Option`."""
logger = logging.getLogger(__name__)


class Option(PanelOption, PictureOption, Protocol):
    """An option of one world's page: it adds parts of picture and panel, and commands."""

    def stop(self) -> None:
        """End its threads, without waiting for code of a student that may not return."""


def load_options(modules: Sequence[str], runner: Runner, player: ReplayPlayer) -> list[Option]:
    """Return the options of a world's page; one that can't be imported is left out.

    Args:
        modules: their modules.
        runner: runs the world.
        player: plays its recorded episodes.
    """
    options: list[Option] = []
    for name in modules:
        try:
            make: Callable[[Runner, ReplayPlayer], Option] = import_module(name).page_option
        except ImportError as error:
            logger.info("the page does without %s: %s", name, error)
        else:
            options.append(make(runner, player))
    return options

"""Commands for the runner that any page may send, over its input socket or its panel's."""

from collections.abc import Callable, Mapping
from concurrent.futures import Future
from typing import Any, NamedTuple

from ai4u_edu.locale import gettext as _
from ai4u_edu.page.messages import PageCommand, Seed
from ai4u_edu.runtime.runner import Runner


class Pause(PageCommand, tag="pause"):
    """Pause the world."""


class Resume(PageCommand, tag="resume"):
    """Let the world run."""


class Reset(PageCommand, tag="reset"):
    """Begin an episode with the locked seed, or else with a new one."""


class TryAgain(PageCommand, tag="try_again"):
    """Begin an episode with the same start."""


class NewStart(PageCommand, tag="new_start"):
    """Begin an episode with a new start, also if the seed is locked."""


class SetSeed(PageCommand, tag="seed"):
    """Begin an episode with a seed."""

    seed: Seed


class LockSeed(PageCommand, tag="lock_seed"):
    """Begin each episode with the same seed from now on, or with new ones."""

    on: bool


def _nothing(_command: PageCommand) -> str:
    return ""


class RunCommand(NamedTuple):
    """The call that carries out a command, and the sentence about it."""

    submit: Callable[[Runner, Any], "Future[None]"]
    """Call that asks the runner to carry it out."""
    answer: Callable[[Any], str] = _nothing
    """Returns a sentence for the page's panel; empty if there is nothing to say."""


RUN_COMMANDS: Mapping[type[PageCommand], RunCommand] = {
    Pause: RunCommand(lambda runner, _command: runner.pause()),
    Resume: RunCommand(lambda runner, _command: runner.resume()),
    Reset: RunCommand(lambda runner, _command: runner.reset()),
    TryAgain: RunCommand(
        lambda runner, _command: runner.try_again(), lambda _command: _("The same start again.")
    ),
    NewStart: RunCommand(
        lambda runner, _command: runner.new_start(), lambda _command: _("A new start.")
    ),
    SetSeed: RunCommand(
        lambda runner, command: runner.reset(int(command.seed)),
        lambda command: _("Started with seed {seed}.", seed=command.seed),
    ),
    LockSeed: RunCommand(
        lambda runner, command: runner.lock_seed(command.on),
        lambda command: (
            _("Each reset repeats this start.") if command.on else _("Resets draw new starts.")
        ),
    ),
}
"""The commands of both sockets by the type of their message."""

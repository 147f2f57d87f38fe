"""Usage lines and refusals of the command line in the reader's language.

Typer's click and pydantic say theirs in English only.
"""

import re
import sys
from collections.abc import Callable
from typing import Any, TypeVar

import typer
from rich.console import Console
from rich.panel import Panel
from rich.text import Text as RichText
from typer.core import TyperCommand, TyperGroup

from ai4u_edu.locale import Text, translate
from ai4u_edu.locale import gettext as _

F = TypeVar("F", bound=Callable[..., Any])
_SENTENCES = (
    _("Invalid value for {name}: {problem}"),
    _("Invalid value: {problem}"),
    _("Value error, {problem}"),
    _("Missing argument {name}."),
    _("Missing option {name}."),
    _("No such option: {name} (Possible options: {names})"),
    _("No such option: {name}"),
    _("{text} Did you mean {names}?"),
    _("No such command {name}."),
    _("Got unexpected extra argument(s) ({words})"),
    _("Option {name} requires an argument."),
    _("Option {name} does not take a value."),
    _("{value} is not one of {names}."),
    _("File {name} does not exist."),
    _("Directory {name} does not exist."),
    _("Path {name} does not exist."),
    _("File {name} is a directory."),
    _("Directory {name} is a file."),
    _("Input should be a valid integer, unable to parse string as an integer"),
    _("Input should be a valid number, unable to parse string as a number"),
    _("Input should be a finite number"),
    _("Input should be greater than or equal to {number}"),
    _("Input should be less than or equal to {number}"),
    _("Input should be greater than {number}"),
    _("Input should be less than {number}"),
    _("Input should be a valid boolean, unable to interpret input"),
)
"""Sentences of Typer, click and pydantic; the first that fits is taken."""


class LocalizedCommand(TyperCommand):
    """A command with a usage line in the reader's language."""

    def get_usage(self, ctx: Any) -> str:
        """Return the line."""
        return _usage(super().get_usage(ctx))


class LocalizedGroup(TyperGroup):
    """A group of commands with a usage line in the reader's language."""

    def get_usage(self, ctx: Any) -> str:
        """Return the line."""
        return _usage(super().get_usage(ctx))


class App(typer.Typer):
    """A command line whose commands have a usage line in the reader's language."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(cls=LocalizedGroup, **settings)

    def command(self, name: str | None = None, **settings: Any) -> Callable[[F], F]:
        """Return a decorator that adds a command."""
        return super().command(name, cls=LocalizedCommand, **settings)


def _usage(line: str) -> str:
    words = {
        "Usage:": _("Usage:"),
        "[OPTIONS]": _("[OPTIONS]"),
        "COMMAND [ARGS]...": _("COMMAND [ARGS]..."),
    }
    for english, text in words.items():
        line = line.replace(english, translate(text), 1)
    return line


def refuse(error: Any) -> None:
    """Print why a command line is refused, with its usage, and end the program.

    Args:
        error: click's, which has no public name in Typer.
    """
    console = Console(stderr=True, highlight=False)
    context = getattr(error, "ctx", None)
    message = error.format_message()
    if not message:
        sys.exit(error.exit_code)  # no command was named: Typer has shown the help
    if context is not None:
        command = f"{context.command_path} {context.help_option_names[0]}"
        console.print(RichText(context.get_usage(), "yellow"))
        console.print(RichText(translate(_("Try '{command}' for help.", command=command)), "dim"))
    shown = RichText(translate(refusal(message, error.message)))
    console.print(Panel(shown, title=translate(_("Error")), title_align="left", border_style="red"))
    sys.exit(error.exit_code)


def refusal(message: str, own: str = "") -> str:
    """Return a refusal as a text that can be translated; others stay as they are.

    Args:
        message: click's or pydantic's.
        own: a text of ours in it, from a callback.

    >>> refusal("No such option: --sed (Possible options: --seed)").msgid
    'No such option: {name} (Possible options: {names})'
    """
    if isinstance(own, Text) and message == own:
        return own
    for pattern in _SENTENCES:
        msgid = pattern.msgid
        parts = re.split(r"\{(\w+)\}", msgid)
        regex = "".join(f"(?P<{p}>.+)" if n % 2 else re.escape(p) for n, p in enumerate(parts))
        match = re.fullmatch(regex, message, re.DOTALL)
        if match:
            values = {name: refusal(value, own) for name, value in match.groupdict().items()}
            return Text(msgid, values)
    return message

"""The reference of the command line, as Typer writes it."""

import re
import subprocess
import sys
from collections.abc import Callable

from ai4u_edu.cli.main import help_texts
from tests.docs_site.staging import ROOT, Staging

PROGRAM = "ai4u-edu"


def add_commands(site: Staging) -> None:
    """Write the reference of all commands under the page of the command line."""
    text = commands(site.translated)
    headings = {
        "Arguments": site.words("Arguments"),
        "Commands": site.words("Commands"),
        "Options": site.words("Options"),
    }
    for english, heading in headings.items():
        text = text.replace(f"**{english}**:", f"**{heading}**:")
    site.append("cli.md", text)


def commands(translate: Callable[[str], str]) -> str:
    """Return the reference of all commands, as Markdown.

    Args:
        translate: returns the translation of a help text, or the text.

    Typer makes it in a process of its own, since it reads the width of lines from the environment.
    Sphinx's extension for Click doesn't know the copy of Click that newer versions of Typer have.
    """
    module = [sys.executable, "-m", "typer", "ai4u_edu.cli.main"]
    run = subprocess.run(
        [*module, "utils", "docs", "--name", PROGRAM],
        cwd=ROOT,
        capture_output=True,
        encoding="utf-8",
        check=True,
    )
    text = re.sub(r"\A# .*\n", "", run.stdout)
    for english in sorted(help_texts(), key=len, reverse=True):
        own = translate(english).strip().replace("\\", r"\\")  # no escapes of the template
        text = re.sub(rf"(?m)(^|: ){re.escape(english.strip())}", rf"\1{own}", text)
    # the console's prompt would be copied with the command
    text = re.sub(r"^```console\n\$ ", "```text\n", text, flags=re.MULTILINE)
    text = text.replace("**Usage**:\n\n", "")
    # Typer's list of commands has only the beginning of each sentence
    first = dict(re.findall(rf"^## `{PROGRAM} (\S+)`\n\n(.+)$", text, re.MULTILINE))
    return re.sub(r"^\* `(\w+)`: .*$", lambda row: _row(row, first), text, flags=re.MULTILINE)


def _row(row: re.Match[str], first: dict[str, str]) -> str:
    """Return a line of the list of commands, with a link; other lines stay as they are."""
    name = row[1]
    return f"* [`{name}`](#{PROGRAM}-{name}): {first[name]}" if name in first else row[0]

"""The reference of the command line, as Typer writes it."""

import re
import subprocess
import sys

from tests.docs_site.staging import ROOT, Staging

PROGRAM = "ai4u-edu"


def add_commands(site: Staging) -> None:
    """Write the reference of all commands under the page of the command line."""
    site.append("cli.md", commands())


def commands() -> str:
    """Return the reference of all commands, as Markdown.

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

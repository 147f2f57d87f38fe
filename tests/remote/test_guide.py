"""Each program of the guide to remote control runs, in a process of its own, as readers run it."""

import re
import shlex
import shutil
import subprocess
import sys
import textwrap
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest

from ai4u_edu.page.panel.parts.agent import script_lines
from tests.builders import small_sim
from tests.playing import Played, played
from tests.waiting import LIMIT_MS, LIMIT_S, until

pytestmark = pytest.mark.slow

PAGE = Path(__file__).parents[2] / "docs/remote.md"
ADDRESS = "http://127.0.0.1:8080"
PATIENT = ("--receive-timeout", str(round(LIMIT_MS)))
"""A world in lockstep that waits for a script on a busy machine."""
BLOCK = re.compile(r"^( *)```(sh|python|js|text)\n(.*?)^ *```\n", re.DOTALL | re.MULTILINE)


class Block(NamedTuple):
    """Block of code, and the text before it since the block before."""

    kind: str
    code: str
    before: str


def blocks() -> list[Block]:
    text, at, found = PAGE.read_text(encoding="utf-8"), 0, []
    for match in BLOCK.finditer(text):
        found.append(Block(match[2], textwrap.dedent(match[3]), text[at : match.start()].strip()))
        at = match.end()
    return found


class Part(NamedTuple):
    """A world of the guide, and what is done in it."""

    command: list[str]
    blocks: list[Block]


def parts() -> Iterator[Part]:
    """Yield the worlds in which something runs."""
    part = Part([], [])
    for block in blocks():
        if block.kind == "sh" and block.code.startswith("ai4u-edu play"):
            if any(each.kind == "python" for each in part.blocks):
                yield part
            part = Part(shlex.split(block.code)[2:], [])
        elif block.kind in ("python", "text"):
            part.blocks.append(block)
    if any(each.kind == "python" for each in part.blocks):
        yield part


PARTS = list(parts())


@pytest.mark.parametrize("number", range(len(PARTS)))
def test_the_programs_run(number: int, tmp_path: Path) -> None:
    command, blocks = PARTS[number]
    patient = () if PATIENT[0] in command else PATIENT
    with played(*command, *patient, waits_for_key=True) as server:
        printed = ""
        for block in blocks:
            if block.kind == "python":
                printed = output_of(block.code, server, tmp_path)
            elif not block.before:  # right below a program: what it prints
                assert printed == block.code
            elif "terminal of `play`" in block.before:
                for line in block.code.splitlines():
                    until(lambda: any(line in said for said in server.told))  # noqa: B023


def output_of(code: str, server: Played, folder: Path) -> str:
    """Run a program as a file of its own, and return what it prints."""
    assert ADDRESS in code
    url = server.url.rstrip("/")
    file = folder / "drive.py"
    file.write_text(code.replace(ADDRESS, url))
    done = subprocess.run(
        [sys.executable, str(file)],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
        timeout=LIMIT_S,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_guide_has_a_world_for_each_thing_that_it_shows() -> None:
    code = "".join(block.code for part in PARTS for block in part.blocks)
    for name in (
        "AsyncRobot",
        "lockstep",
        "session=",
        "keys=",
        "patience=",
        "sense()",
        "Remote-v0",
    ):
        assert name in code


def test_the_client_in_javascript_drives(tmp_path: Path) -> None:
    node = shutil.which("node")
    if node is None:
        pytest.skip("node is missing, which runs the client in JavaScript")
    (script,) = (block.code for block in blocks() if block.kind == "js")
    file = tmp_path / "drive.mjs"
    file.write_text(script)
    with played("box_chase", *PATIENT) as server:
        url = server.url.rstrip("/").replace("http", "ws", 1)
        done = subprocess.run(
            [node, "--experimental-websocket", str(file), url],
            capture_output=True,
            text=True,
            check=False,
            timeout=LIMIT_S,
        )
        told = done.stdout.splitlines()
        assert told[0] == "I drive agent 0 of Box chase.", done.stderr
        assert re.match(r"Done after \d+ decisions: \{ touch: 100, ", told[1])
        until(lambda: any("has left: done" in line for line in server.told))


def test_the_lines_of_the_page_are_those_of_the_guide() -> None:
    lines = script_lines(ADDRESS, small_sim().agents[0])
    first = next(block.code for block in blocks() if block.kind == "python")
    for common in (
        "from ai4u_edu.remote import connect\n",
        "robot.reset()",
        "for percept in robot:",
    ):
        assert common in lines
        assert common in first

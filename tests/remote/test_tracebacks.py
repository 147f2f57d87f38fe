"""The errors of a script are short: the student's own line, and one sentence."""

import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.remote.rooms import Script, log_room
from tests.waiting import LIMIT_S

HEAD = """import sys
from ai4u_edu.remote import AsyncRobot, RemoteEnv, connect, dialogue
url = sys.argv[1]
dialogue.ATTEMPT_TIMEOUT_S = float(sys.argv[2])
"""
CONNECT = "connect(url, 'a', patience=0)"
ROBOT = "robot = connect(url, 'b', patience=float(sys.argv[2]))\n"
ENV = "RemoteEnv(url, agent='a', patience=0)"
BY_ASYNCIO = """
import asyncio
async def drive():
    async with AsyncRobot(url, 'a', patience=0) as robot:
        print(robot)
asyncio.run(drive())
"""
TAKEN = "ai4u_edu.remote.errors.RefusedError: agent 'a' is driven by another script; "
WRONG_NAME = "ai4u_edu.base.errors.ActionError: no actuator is called 'lgo'; did you mean 'log'?"
NOT_ANSWERED = "ai4u_edu.remote.errors.RemoteError: expected robot.act(...) in the loop, such as "


@pytest.mark.parametrize(
    ("lines", "sentence"),
    [
        (CONNECT, TAKEN),
        (ENV, TAKEN),
        (BY_ASYNCIO, TAKEN),
        (ROBOT + "robot.act(lgo=[1])", WRONG_NAME),
        (ROBOT + "for percept in robot:\n    pass", NOT_ANSWERED),
        (
            "connect('gopher://teacher')",
            "ai4u_edu.remote.errors.RemoteError: expected the page's address, such as ",
        ),
    ],
    ids=["connect", "env", "asyncio", "act", "loop", "argument"],
)
@pytest.mark.slow
def test_a_script_sees_its_own_lines_and_the_sentence(
    lines: str, sentence: str, tmp_path: Path
) -> None:
    file = tmp_path / "mine.py"
    file.write_text(HEAD + lines)
    with log_room(2) as room, Script(room) as other:
        other.hello(mode="realtime")
        done = subprocess.run(
            [sys.executable, str(file), room.url, str(LIMIT_S)],
            capture_output=True,
            text=True,
            check=False,
            timeout=LIMIT_S,
        )
    assert done.returncode == 1
    *frames, last = done.stderr.splitlines()
    assert last.startswith(sentence)
    assert "ai4u_edu" not in "\n".join(frames)
    assert frames[0] == "Traceback (most recent call last):"
    assert str(file) in done.stderr


@pytest.mark.needs("lessons")
def test_a_notebook_shows_its_cell_and_the_sentence(capsys: pytest.CaptureFixture[str]) -> None:
    from IPython.core.interactiveshell import InteractiveShell

    make: Any = InteractiveShell  # it has no types
    shell = make()
    shell.colors = "nocolor"
    with log_room(2) as room, Script(room) as other:
        other.hello()
        cell = f"from ai4u_edu.remote import connect\nconnect({room.url!r}, 'a', patience=0)"
        shell.run_cell(cell)
    shown = capsys.readouterr().out
    assert "RefusedError: agent 'a' is driven by another script; " in shown
    assert "connect(" in shown
    assert "site-packages" not in shown
    assert "ai4u_edu/remote" not in shown

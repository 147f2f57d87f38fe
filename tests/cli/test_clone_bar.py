"""``ai4u-edu clone`` shows how far its evaluation has come."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.waiting import LIMIT_S

pytestmark = [pytest.mark.slow, pytest.mark.needs("train")]

COMMAND = [sys.executable, "-m", "ai4u_edu"]


def test_a_terminal_sees_the_episodes_being_counted(tmp_path: Path) -> None:
    why = "a terminal is needed, which Windows can't open so"
    pty, termios = (pytest.importorskip(name, reason=why) for name in ("pty", "termios"))
    episodes, network = tmp_path / "episodes", tmp_path / "policy.onnx"
    record = ["record", "box_chase", "--brain", "zoo", "--episodes", "2", "--out", str(episodes)]
    subprocess.run([*COMMAND, *record], check=True, capture_output=True, timeout=LIMIT_S)
    terminal, end = pty.openpty()
    termios.tcsetwinsize(end, (24, 80))
    clone = ["clone", str(episodes), "--out", str(network), "--updates", "5", "--evaluate", "2"]
    with subprocess.Popen([*COMMAND, *clone], stdout=subprocess.DEVNULL, stderr=end) as process:
        os.close(end)
        shown = b""
        try:
            while part := os.read(terminal, 4096):
                shown += part
        except OSError:  # Linux's way to say that the other end was closed
            pass
        assert process.wait(LIMIT_S) == 0
    os.close(terminal)
    assert b"0/2 episodes, policy.onnx" in shown, shown

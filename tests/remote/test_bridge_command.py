"""``ai4u-edu bridge``, as a process of its own."""

import signal
import subprocess
import sys

import pytest
from typer.testing import CliRunner

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.cli.main import app
from tests.remote.bridged import TOKEN, scene_room
from tests.remote.rooms import log_room, unused_address
from tests.remote.test_ai4u_package import free_port, run_script
from tests.waiting import LIMIT_S, until

pytestmark = pytest.mark.slow

TAKE_IT = "take the whole address that its terminal shows, as in connect('http://teacher:8080/"


def bridge(*args: str) -> "subprocess.Popen[str]":
    return subprocess.Popen(
        [sys.executable, "-m", "ai4u_edu", "bridge", "--patience", str(LIMIT_S), *args],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def refused(*args: str) -> str:
    """Return why a bridge ends at once; in this process, since another one takes a second."""
    told = CliRunner().invoke(app, ["bridge", *args])
    assert isinstance(told.exception, AI4UError)
    assert "error" not in told.output
    return str(told.exception)


def test_what_is_wrong_is_said_in_a_sentence() -> None:
    with scene_room() as room:
        with bridge(room.url) as process:
            said, why = process.communicate(timeout=LIMIT_S)
        assert (process.returncode, said) == (1, "")
        assert why == f"error: expected this world's token, got none; {TAKE_IT}?token=...')\n"
        assert "got another one" in refused(room.url, "--token", "guess")
    with log_room(2) as room:
        assert refused(room.url, "--agent", "red") == (
            "no agent has the id 'red'; known are 'a', 'b'"
        )
    with unused_address() as address:
        # real time: it is to pass
        nobody = refused(f"ws://{address}", "--patience", "0.1")
    assert nobody.startswith("expected a world, got ")
    assert nobody.endswith("; is it running, and is the address right?")
    assert refused("gopher://teacher") == (
        "expected the page's address, such as 'http://127.0.0.1:8080', got 'gopher://teacher'"
    )


def test_a_script_drives_and_ctrl_c_ends_the_bridge() -> None:
    port = free_port()
    with scene_room() as room:
        own = room.sim.agents[0].brain
        url = room.url.replace("http", "ws", 1)
        with bridge(url, "--agent", "0", "--port", str(port), "--token", TOKEN) as process:
            try:
                assert process.stdout is not None
                assert process.stdout.readline() == (
                    f"no AI4U script listens at 127.0.0.1:{port} yet; start it\n"
                )
                log = run_script("steps.py", port, 20)["log"]
                assert [each["steps"] for each in log] == list(range(1, 21))
                process.send_signal(signal.SIGINT)
                _, wrong = process.communicate(timeout=LIMIT_S)
            finally:
                process.kill()
        assert (process.returncode, wrong) == (0, "")
        until(lambda: room.sim.agents[0].brain is own)

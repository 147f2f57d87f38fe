"""A script in another process: how it stands with it is seen, and a person takes its agent over."""

import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.served_viser import connected, driver_status
from tests.chromium import new_page
from tests.playing import Played, played
from tests.waiting import LIMIT_S, until

pytestmark = pytest.mark.browser

SCENE = """
name: bare
title: A bare robot
floors:
  - {name: plate, shape: {type: box, size: [12, 12]}}
bodies:
  - {name: robot, shape: {type: circle, radius: 0.5}, position: [-2, 0]}
agents:
  - id: "0"
    body: robot
    actuators:
      - {type: RBMoveActuator, move_amount: 2, turn_amount: 2}
    brains:
      - type: LocalBrain
        controller: {type: WASDRBMoveController}
"""
SCRIPT = """
import sys
from ai4u_edu.remote import connect

for percept in (robot := connect(sys.argv[1], patience=float(sys.argv[2]))):
    robot.act(move=[0, 0.25, 0, 0])
"""


@pytest.fixture
def server(tmp_path: Path) -> Iterator[Played]:
    (tmp_path / "bare.yaml").write_text(SCENE)
    scene = str(tmp_path / "bare.yaml")
    with socket.socket(type=socket.SOCK_DGRAM) as silent:  # no script answers there
        silent.bind(("127.0.0.1", 0))
        brain = f"ai4u://127.0.0.1:{silent.getsockname()[1]}"
        with played(scene, "--brain", brain, "--grace", str(LIMIT_S)) as server:
            yield server


@pytest.fixture
def page(chromium: Browser, server: Played) -> Iterator[Page]:
    page = new_page(chromium)
    page.goto(f"{server.url}")
    connected(page)
    yield page
    page.context.close()
    assert "Traceback" not in "".join(server.told)


@pytest.fixture
def script(server: Played) -> Iterator["subprocess.Popen[bytes]"]:
    command = [sys.executable, "-c", SCRIPT, server.url, str(LIMIT_S)]
    script = subprocess.Popen(command, stderr=subprocess.DEVNULL)
    yield script
    script.kill()
    script.wait()


def does(server: Played, *action: float) -> bool:
    agent: dict[str, Any] = server.snapshot()["agents"][0]
    return bool(agent["action"].get("move") == list(action))


def test_how_it_stands_with_a_script_is_seen_on_the_page(
    page: Page, server: Played, request: pytest.FixtureRequest
) -> None:
    trouble = page.locator(".ai4u-agent-state")
    expect(trouble.filter(has_text="waits for its script")).to_be_visible()
    script = request.getfixturevalue("script")
    until(lambda: does(server, 0, 0.25, 0, 0))
    expect(trouble.filter(has_text="script")).to_have_count(0)
    script.send_signal(signal.SIGSTOP)
    expect(trouble.filter(has_text="decides too late")).to_be_visible()
    script.send_signal(signal.SIGCONT)
    expect(trouble.filter(has_text="script")).to_have_count(0)
    script.kill()
    expect(trouble.filter(has_text="script is lost")).to_be_visible()


def test_a_key_takes_the_agent_over_from_a_script_elsewhere_and_lets_it_go(
    page: Page, server: Played, script: "subprocess.Popen[bytes]"
) -> None:
    expect(driver_status(page)).to_have_text(
        "A script elsewhere drives \u2013 press W to take over"
    )
    until(lambda: does(server, 0, 0.25, 0, 0))
    page.keyboard.down("KeyW")
    expect(driver_status(page)).to_have_text("You're driving")
    until(lambda: does(server, 1, 0, 0, 0))
    page.keyboard.up("KeyW")
    assert script.poll() is None
    page.locator(".ai4u-dock").get_by_role("button", name="Let go").click()
    expect(driver_status(page)).to_contain_text("A script elsewhere drives")
    until(lambda: does(server, 0, 0.25, 0, 0))
    assert script.poll() is None

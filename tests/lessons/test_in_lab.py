"""The live world inside a notebook, in a real Chromium, driven by a key."""

import json
import os
import re
import signal
import subprocess
import sys
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, FrameLocator, Page

from ai4u_edu import Recorder, Scene
from ai4u_edu.lessons.handout import hand_out
from ai4u_edu.lessons.live import Live
from ai4u_edu.runtime.runner import Runner
from tests.chromium import browser, new_page
from tests.lessons.lab import lab, wait_for
from tests.page.server.rooms import free_port
from tests.waiting import LIMIT_S, until

pytestmark = pytest.mark.browser

ROOT = Path(__file__).resolve().parent.parent.parent
BASE = "/user/ann/"
NOTEBOOK = """<!doctype html><meta charset="utf-8"><body data-base-url="{base}">{page}
<div id="{film}">the last episode</div></body>"""


@pytest.fixture(scope="module")
def chromium() -> Iterator[Browser]:
    with browser() as chromium:
        yield chromium


@pytest.fixture
def live() -> Iterator[Live]:
    scene = Scene.load("sample_scene")
    sim = scene.build()
    live = Live(sim, Recorder(sim, scene=scene.description), "Sample <scene>", seed=1)
    yield live
    live.stop()


def notebook(page: Page, url: str, live: Live, base: str = BASE) -> FrameLocator:
    """Opens a page in which the world stands as under a cell."""
    text = NOTEBOOK.format(base=base, page=live.page(480), film=live.film)
    page.route(url, lambda route: route.fulfill(body=text, content_type="text/html"))
    page.goto(url)
    return page.frame_locator("iframe")


def drives(page: Page, frame: FrameLocator, runner: Runner) -> None:
    """Clicks into the world, holds a key, and sees the robot move and nothing else scroll."""
    frame.locator(".ai4u-keycap").first.wait_for()
    frame.locator(".ai4u-driver, .ai4u-row").first.wait_for()
    before = runner.latest.bodies[0]
    page.locator("iframe").click(position={"x": 250, "y": 150})
    page.keyboard.down("KeyW")
    until(lambda: runner.latest.bodies[0].x > before.x + 1)
    page.keyboard.up("KeyW")
    until(lambda: not runner.latest.agents[0].held_keys)


def test_through_jupyter_server_proxy_behind_a_hub(
    chromium: Browser, live: Live, tmp_path: Path
) -> None:
    with lab(tmp_path, "--ServerApp.allow_remote_access=True", base=BASE) as url:
        # browsers know that such names are this machine; the room knows no such name
        url = url.replace("localhost", "hub.localhost")
        page = new_page(chromium, 1000, 700)
        asked: list[str] = []
        page.on("request", lambda request: asked.append(request.url))
        page.on("websocket", lambda socket: asked.append(socket.url))
        frame = notebook(page, url + "a-notebook", live)
        place = f"{url}proxy/{live.port}/"
        drives(page, frame, live.runner)
        link = page.get_by_role("link")
        assert link.inner_text() == "Open \u201cSample <scene>\u201d in its own tab"
        assert str(link.get_attribute("href")).startswith(place + "?token=")
        assert page.locator("img").is_hidden()
        assert page.get_by_text("the last episode").is_hidden()
        places = (place, place.replace("http", "ws", 1).rstrip("/"), url, "data:", "blob:")
        assert [each for each in asked if not each.startswith(places)] == []
        live.stop()
        page.reload()
        page.get_by_text("needs jupyter-server-proxy").wait_for()
        assert page.locator("img").is_visible()
        page.context.close()


def test_without_a_proxy_the_page_comes_from_its_own_port(chromium: Browser, live: Live) -> None:
    page = new_page(chromium, 1000, 700)
    url = f"http://localhost:{free_port()}/"
    page.route(url + "proxy/**", lambda route: route.fulfill(status=404, body="none"))
    frame = notebook(page, url, live, base="/")
    drives(page, frame, live.runner)
    assert str(page.locator("iframe").get_attribute("src")).startswith(
        f"http://localhost:{live.port}/?token="
    )
    live.close()  # as when the kernel is restarted: nothing takes the frame away
    page.get_by_text("run its cell again for a new world").wait_for()
    page.context.close()


@pytest.mark.parametrize("has_scripts", [True, False])
def test_where_there_is_no_server_a_picture_stands(
    chromium: Browser, live: Live, tmp_path: Path, has_scripts: bool
) -> None:
    exported = tmp_path / "exported.html"
    exported.write_text(
        NOTEBOOK.format(base="", page=live.page(480), film=live.film), encoding="utf-8"
    )
    page = new_page(chromium, java_script_enabled=has_scripts)
    page.goto(exported.as_uri())
    assert page.locator("img").is_visible()
    assert page.locator("img").evaluate("image => image.naturalWidth") > 200
    assert page.get_by_text("the last episode").is_visible()
    assert page.locator("iframe").count() == 0
    page.context.close()


@pytest.mark.nightly  # installs JupyterLab again
def test_from_the_wheel_lesson_02_is_driven_in_jupyterlab(
    chromium: Browser, tmp_path: Path
) -> None:
    programs = _installed(tmp_path)
    folder = tmp_path / "course"
    command = [str(programs / "ai4u-edu"), "lessons", str(folder), "--no-open"]
    command += [f"--port={free_port()}"]
    env = {name: value for name, value in os.environ.items() if not name.startswith("JUPYTER")}
    env["HOME"] = str(tmp_path)
    with (tmp_path / "log").open("w") as log:
        process = subprocess.Popen(command, stdout=log, stderr=log, env=env, cwd=tmp_path)
    try:
        address = _told_address(process, tmp_path / "log")
        wait_for(f"{address[1]}login", process, tmp_path / "log")
        page = new_page(chromium, 1280, 900, draws=True)
        asked: list[str] = []
        page.on("request", lambda request: asked.append(request.url))
        page.goto(f"{address[1]}lab/tree/02_drive.ipynb?token={address[2]}")
        src = _shown(page)
        frame = page.frame_locator("iframe[src*=token]")
        frame.locator(".ai4u-keycap").first.wait_for()
        where, _, query = src.partition("?")
        before = _pose(where, query)
        page.locator("iframe[src*=token]").click(position={"x": 250, "y": 150})
        page.keyboard.down("KeyW")
        until(lambda: _pose(where, query)[0] > before[0] + 1)
        if os.environ.get("AI4U_SHOTS"):
            page.screenshot(path=Path(os.environ["AI4U_SHOTS"]) / "lab.png")
        page.keyboard.up("KeyW")
        assert page.get_by_text("Jupyter news").count() == 0
        ours = ("http://localhost:", "data:", "blob:")
        assert [each for each in asked if not each.startswith(ours)] == []
        page.context.close()
    finally:
        process.send_signal(signal.SIGTERM)
        process.wait(LIMIT_S)


def _installed(folder: Path) -> Path:
    """The programs of an environment that holds the wheel with its lessons, and nothing else."""
    _run(sys.executable, "-m", "build", "--wheel", "--outdir", str(folder), str(ROOT))
    (wheel,) = folder.glob("*.whl")
    _run(sys.executable, "-m", "venv", str(folder / "venv"))
    programs = folder / "venv" / "bin"
    _run(
        str(programs / "python"),
        "-m",
        "pip",
        "install",
        "--quiet",
        "--no-compile",
        f"{wheel}[lessons]",
    )
    return programs


def _told_address(process: subprocess.Popen[bytes], log: Path) -> re.Match[str]:
    """Return address and token of a JupyterLab from its log: it takes another port if it has to."""

    def found() -> re.Match[str] | None:
        return re.search(r"(http://localhost:\d+/)\S*[?&]token=(\w+)\s", log.read_text())

    until(lambda: found() or process.poll() is not None)
    address = found()
    assert address is not None, log.read_text()
    return address


def _run(*command: str) -> None:
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def _shown(page: Page) -> str:
    """Runs the first two cells of code, and gives the address of the world under the second."""
    page.get_by_text("Python 3 (ipykernel) | Idle").wait_for()
    for number in range(2):
        page.locator(".jp-CodeCell").nth(number).locator(".cm-content").click()
        page.keyboard.press("Shift+Enter")
    world = page.locator("iframe[src*=token]")
    world.wait_for()
    return str(world.get_attribute("src"))


def _pose(where: str, query: str) -> list[float]:
    with urllib.request.urlopen(f"{where}api/snapshot?{query}", timeout=LIMIT_S) as answer:  # noqa: S310
        found: dict[str, Any] = json.load(answer)
    return [float(each) for each in found["agents"][0]["pose"]]


def test_a_handed_out_course_is_saved_every_ten_seconds(tmp_path: Path) -> None:
    hand_out(tmp_path)
    setting = "lab/api/settings/@jupyterlab/docmanager-extension:plugin"
    with lab(tmp_path) as url:
        answer = urllib.request.urlopen(url + setting, timeout=LIMIT_S)  # noqa: S310 - our own
        schema = json.load(answer)["schema"]["properties"]
    assert (schema["autosave"]["default"], schema["autosaveInterval"]["default"]) == (True, 10)


def test_jupyterlab_speaks_the_language_of_the_course(chromium: Browser, tmp_path: Path) -> None:
    hand_out(tmp_path, "pt_BR")
    with lab(tmp_path) as url:
        page = new_page(chromium, 1280, 900)
        page.goto(f"{url}lab/tree/02_drive.ipynb")
        page.get_by_text("Nome", exact=True).wait_for()  # a column of its files
        page.context.close()

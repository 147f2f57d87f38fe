"""Measures memory and cores of a JupyterHub: ``python -m tests.lessons.hub [--students 4]``.

Needs jupyterhub, jupyterhub-idle-culler and configurable-http-proxy on the PATH. Starts a hub with
docs/jupyterhub_config.py; each student logs in with a browser, runs the first two cells of lesson
00, and drives. The browsers run on the same machine, and draw nothing.
"""

import argparse
import contextlib
import os
import socket
import subprocess
import sys
import tempfile
import time
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

import psutil
from playwright.sync_api import Browser, Page

from tests.chromium import browser, new_page
from tests.evidence import KeptFile
from tests.lessons.lab import wait_for
from tests.waiting import LIMIT_S

CONFIG = Path(__file__).parents[2] / "docs" / "jupyterhub_config.py"
OWN = """
c.JupyterHub.bind_url = "http://127.0.0.1:{port}"
c.JupyterHub.hub_port = {hub_port}
c.ConfigurableHTTPProxy.api_url = "http://127.0.0.1:{api_port}"
c.JupyterHub.authenticator_class = "dummy"
c.DummyAuthenticator.password = "{word}"
c.Authenticator.allow_all = True
c.JupyterHub.spawner_class = "simple"
c.SimpleLocalProcessSpawner.home_dir_template = "{folder}/home/{{username}}"
c.Spawner.http_timeout = c.Spawner.start_timeout = {patience}  # the machine may be busy
ai4u_class["url"] = "http://127.0.0.1:{class_port}"
"""
WORD = "hub"
"""Password of all students."""
KINDS = {
    "configurable-http-proxy": "proxy",
    "jupyterhub-singleuser": "server",
    "ipykernel_launcher": "kernel",
    "jupyterhub_idle_culler": "culler",
    "jupyterhub": "hub",
}
"""Kind of a process by a word of its command; the first one counts."""


Ports = tuple[int, int, int, int]


def new_ports() -> Ports:
    """Return free ports, each another one."""
    with contextlib.ExitStack() as stack:
        probes = [stack.enter_context(socket.socket()) for _ in range(4)]
        for probe in probes:
            probe.bind(("127.0.0.1", 0))
        first, second, third, fourth = (int(probe.getsockname()[1]) for probe in probes)
    return first, second, third, fourth


@contextlib.contextmanager
def hub(
    folder: Path, more: str = "", ports: Ports | None = None
) -> Iterator[tuple[str, psutil.Process]]:
    """A JupyterHub; gives its address and its process.

    Args:
        folder: of its files and homes.
        more: settings at the end of its configuration.
        ports: of the proxy, the hub, the proxy's API and the class.
    """
    port, hub_port, api_port, class_port = ports or new_ports()
    config = folder / "jupyterhub_config.py"
    own = OWN.format(
        port=port,
        hub_port=hub_port,
        api_port=api_port,
        class_port=class_port,
        word=WORD,
        folder=folder,
        patience=LIMIT_S,
    )
    config.write_text(CONFIG.read_text(encoding="utf-8") + own + more, encoding="utf-8")
    url = f"http://127.0.0.1:{port}/hub/"
    kept = KeptFile(folder / "log")
    with kept.path.open("a") as log:
        process = subprocess.Popen(
            [sys.executable, "-m", "jupyterhub", "-f", str(config)],
            cwd=folder,
            stdout=log,
            stderr=log,
            env=_env(),
        )
        try:
            wait_for(url + "login", process, kept.path)
            yield url, psutil.Process(process.pid)
        finally:
            process.terminate()
            process.wait(LIMIT_S)


def _env() -> dict[str, str]:
    own = {name: value for name, value in os.environ.items() if not name.startswith("JUPYTER")}
    return {**own, "PATH": f"{Path(sys.executable).parent}{os.pathsep}{own['PATH']}"}


def report(root: psutil.Process, seconds: float, title: str) -> None:
    """Print memory and cores of each kind of process below the hub's."""
    processes = {each: _kind(each) for each in [root, *root.children(recursive=True)]}
    before = {each: _cpu(each) for each in processes}
    time.sleep(seconds)  # real time: it is measured
    memory, cores = defaultdict(list), defaultdict(list)
    for each, kind in processes.items():
        with contextlib.suppress(psutil.Error):
            memory[kind].append(round(each.memory_full_info().pss / 1e6))
            cores[kind].append(round((_cpu(each) - before[each]) / seconds, 3))
    print(f"{title}, {seconds:g} s:")
    for kind in sorted(memory):
        print(f"  {kind:<8} {len(memory[kind])} MB {memory[kind]} cores {cores[kind]}")
    print(f"  all      MB {sum(map(sum, memory.values()))}", end=" ")
    print(f"cores {sum(map(sum, cores.values())):.2f}", flush=True)


def _kind(process: psutil.Process) -> str:
    command = " ".join(process.cmdline())
    return next((kind for word, kind in KINDS.items() if word in command), "other")


def _cpu(process: psutil.Process) -> float:
    times = process.cpu_times()
    return float(times.user + times.system)


def student(chromium: Browser, url: str, name: str) -> Page:
    """Log in; gives the page with lesson 00 and a running kernel."""
    page = new_page(chromium, 1366, 768)
    page.goto(url + "login")
    page.fill("input[name=username]", name)
    page.fill("input[name=password]", WORD)
    page.click("#login_submit")
    page.get_by_text("Python 3 (ipykernel) | Idle").wait_for()
    assert page.get_by_text("Jupyter news").count() == 0
    return page


def shows(page: Page) -> None:
    """Run the first two cells of code; the second one shows a world."""
    for number in range(2):
        page.locator(".jp-CodeCell").nth(number).locator(".cm-content").click()
        page.keyboard.press("Shift+Enter")
    frame = page.frame_locator("iframe[src*=token]")
    frame.locator(".ai4u-keycap").first.wait_for()


def main() -> None:
    """Measure, and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--students", type=int, default=4)
    parser.add_argument("--seconds", type=float, default=60.0)
    options = parser.parse_args()
    with (
        tempfile.TemporaryDirectory() as folder,
        hub(Path(folder)) as (url, root),
        browser() as chromium,
    ):
        pages = [student(chromium, url, f"student{n}") for n in range(options.students)]
        report(root, options.seconds, "notebooks open")
        for page in pages:
            shows(page)
        report(root, options.seconds, "worlds wait for a key")
        for page in pages:
            page.locator("iframe[src*=token]").click(position={"x": 250, "y": 150})
            page.keyboard.down("KeyA")
        report(root, options.seconds, "all drive")


if __name__ == "__main__":
    main()

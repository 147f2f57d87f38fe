"""A real Jupyter server, with jupyter-server-proxy or without."""

import contextlib
import json
import os
import subprocess
import sys
import urllib.error
import urllib.request
from collections.abc import Iterator
from pathlib import Path

import psutil

from ai4u_edu.lessons.handout import lab_config
from tests.evidence import KeptFile
from tests.page.server.rooms import free_port
from tests.processes import command_line
from tests.waiting import LIMIT_S, until


@contextlib.contextmanager
def lab(
    folder: Path, *options: str, python: str | Path = sys.executable, base: str = "/"
) -> Iterator[str]:
    """JupyterLab in a folder; gives its address, with a slash at the end. No token is asked for.

    Args:
        folder: of the notebooks.
        options: for JupyterLab.
        python: whose JupyterLab.
        base: the path under which it is, as behind a hub.
    """
    command = [str(python), "-m", "jupyterlab", "--no-browser", "--allow-root"]
    command += [f"--port={free_port()}"]
    command += [f"--ServerApp.root_dir={folder}", "--IdentityProvider.token=", *options]
    command += [f"--ServerApp.base_url={base}", "--LabApp.news_url=None"]
    home = folder / ".jupyter-home"
    env = {
        **os.environ,
        "HOME": str(home),
        "JUPYTER_CONFIG_DIR": str(home),
        "JUPYTER_CONFIG_PATH": str(lab_config(folder)),
        "JUPYTER_DATA_DIR": str(home),
        "JUPYTER_RUNTIME_DIR": str(home),
    }
    home.mkdir()
    kept = KeptFile(home / "log")
    with kept.path.open("w") as log:
        process = subprocess.Popen(command, stdout=log, stderr=log, env=env)
        try:
            url = f"http://localhost:{port_of(process, home, kept.path)}{base}"
            wait_for(url + "api", process, kept.path)
            yield url
        finally:
            end(process)


def end(process: subprocess.Popen[bytes]) -> None:
    """End a Jupyter server, its kernels and what it has started.

    If its event loop stops while a thread of AnyIO carries out a request, it waits for that thread
    for ever (issue 10442 of JupyterLab). So it is killed as soon as its children have ended.
    """
    if process.poll() is not None:
        return
    children = psutil.Process(process.pid).children(recursive=True)
    process.terminate()
    try:
        until(lambda: process.poll() is not None or not any(map(command_line, children)))
    finally:
        process.kill()
        process.wait()


def wait_for(url: str, process: subprocess.Popen[bytes], log: Path) -> None:
    """Wait until a server answers.

    Raises:
        RuntimeError: its process has ended.
    """

    def answers() -> bool:
        try:
            with urllib.request.urlopen(url, timeout=LIMIT_S):  # noqa: S310 - our own
                return True
        except (urllib.error.URLError, ConnectionError):
            return False

    until(lambda: answers() or process.poll() is not None)
    if process.poll() is not None:
        raise RuntimeError(f"the server did not come up: {log.read_text()}")


def port_of(process: subprocess.Popen[bytes], home: Path, log: Path) -> int:
    """Return the port of a Jupyter server, which takes another one if its own is taken."""

    def known() -> dict[str, int]:
        with contextlib.suppress(OSError, ValueError):  # not there, or not written yet
            return dict(json.loads((home / f"jpserver-{process.pid}.json").read_text()))
        return {}

    until(lambda: known() or process.poll() is not None)
    if process.poll() is not None:
        raise RuntimeError(f"JupyterLab did not come up: {log.read_text()}")
    return known()["port"]

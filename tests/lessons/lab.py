"""A real Jupyter server, with jupyter-server-proxy or without."""

import contextlib
import os
import subprocess
import sys
import time
import urllib.error
import urllib.request
from collections.abc import Iterator
from pathlib import Path

from ai4u_edu.lessons.handout import lab_config
from tests.evidence import KeptFile
from tests.server.rooms import free_port
from tests.waiting import LIMIT_S, Deadline


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
    port = free_port()
    command = [str(python), "-m", "jupyterlab", "--no-browser", "--allow-root", f"--port={port}"]
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
            url = f"http://localhost:{port}{base}"
            wait_for(url + "api", process, kept.path)
            yield url
        finally:
            process.terminate()
            process.wait(LIMIT_S)


def wait_for(url: str, process: subprocess.Popen[bytes], log: Path) -> None:
    """Waits until a server answers."""
    deadline = Deadline()
    while deadline.left() and process.poll() is None:
        try:
            with urllib.request.urlopen(url, timeout=LIMIT_S):  # noqa: S310 - our own
                return
        except (urllib.error.URLError, ConnectionError):
            pass
        time.sleep(0.2)
    raise RuntimeError(f"JupyterLab did not come up: {log.read_text()}")

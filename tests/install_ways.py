"""Install the package in each way, in clean environments: ``python -m tests.install_ways WHEEL``.

The wheel is taken from its folder, its dependencies from the index; each way must serve the page.
Needs uv (``pip install uv``).
"""

import os
import shutil
import subprocess
import sys
import tempfile
import urllib.request
from pathlib import Path

from tests.waiting import LIMIT_S

UV = [sys.executable, "-m", "uv"]
PLAY = ["play", "--port", "0", "--no-open", "--no-wait-for-key"]


def main() -> None:
    """Try each way, and print how it went."""
    wheel = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as made:
        home = Path(made)
        environment = {
            **{name: value for name, value in os.environ.items() if name != "PYTHONPATH"},
            "UV_TOOL_DIR": str(home / "tools"),
            "UV_TOOL_BIN_DIR": str(home / "bin"),
        }
        local = ["--find-links", str(wheel.parent)]
        package = ["--from", str(wheel), "ai4u-edu"]
        served("uvx", [*UV, "tool", "run", "--isolated", *local, *package], environment)

        subprocess.run([*UV, "tool", "install", "--quiet", wheel], env=environment, check=True)
        served("uv tool install", [str(home / "bin" / "ai4u-edu")], environment)

        venv = home / "venv"
        subprocess.run([sys.executable, "-m", "venv", venv], check=True)
        folder = venv / ("Scripts" if os.name == "nt" else "bin")
        pip: list[str | Path] = [folder / "python", "-m", "pip", "install", "--quiet"]
        subprocess.run([*pip, wheel], env=environment, check=True)
        served("pip install", [str(folder / "ai4u-edu")], environment)

        clone = home / "clone"
        root = Path(__file__).resolve().parents[1]
        subprocess.run(["git", "clone", "--quiet", root, clone], check=True)
        served("from a clone", [sys.executable, "-m", "ai4u_edu"], environment, clone)
        shutil.rmtree(clone)


def served(
    name: str, command: list[str], environment: dict[str, str], folder: Path | None = None
) -> None:
    """Start a command, fetch the page that it serves, and end it.

    Raises:
        SystemExit: it serves no page.
    """
    with subprocess.Popen(
        [*command, *PLAY],
        env=environment,
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    ) as process:
        assert process.stdout is not None
        words = (word for line in process.stdout for word in line.split())
        url = next((word for word in words if word.startswith("http")), "")
        page = urllib.request.urlopen(url, timeout=LIMIT_S).read() if url else b""  # noqa: S310
        process.terminate()
    if b"<html" not in page.lower():
        sys.exit(f"{name}: serves no page")
    print(f"{name}: serves the page", flush=True)


if __name__ == "__main__":
    main()

"""Set up AI4U Edu from the wheels beside this file, without a network, and start it.

``python start.py`` plays the first scene; other words are a command: ``python start.py lessons``.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent


def main() -> int:
    """Return the exit status of the command."""
    bundle = json.loads((HERE / "bundle.json").read_text(encoding="utf-8"))
    this = "{} {}.{}".format(sys.platform, *sys.version_info)
    if this not in bundle["made_on"]:
        sys.stderr.write(
            f"Expected a system and Python whose packages are in the folder wheels "
            f"({', '.join(bundle['made_on'])}); this is {this}.\n"
            "Install such a Python, or run `ai4u-edu bundle` on this system with this folder.\n"
        )
        return 1
    python = set_up(Path(os.environ.get("AI4U_FOLDER", HERE)), bundle)
    if python is None:
        return 1
    words = sys.argv[1:] or ["play"]
    if words[0] == "lessons" and len(words) == 1:
        words.append(str(HERE / "course"))
    command = [str(python), "-m", "ai4u_edu", *words]
    os.chdir(HERE)
    if os.name == "posix":  # so that every signal reaches it
        os.execv(command[0], command)  # noqa: S606 - our own words and the user's, no shell
    return subprocess.call(command)  # noqa: S603 - the same


def set_up(folder: Path, bundle: dict[str, list[str]]) -> Path | None:
    """Make a Python environment in a folder, once, and return its Python; None if that fails."""
    environment = folder / f"environment-{sys.platform}-{sys.version_info[0]}.{sys.version_info[1]}"
    python = environment / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    done = environment / "complete"
    if done.exists():
        return python
    extras = ",".join(bundle["extras"])
    package = f"ai4u-edu[{extras}]" if extras else "ai4u-edu"
    wheels = ["--no-index", "--find-links", str(HERE / "wheels")]
    for command in (
        [sys.executable, "-m", "venv", str(environment)],
        # --isolated: settings of this machine would lead to a network
        [str(python), "-m", "pip", "--isolated", "install", "--quiet", *wheels, package],
    ):
        if subprocess.call(command):  # noqa: S603 - our own words and paths
            sys.stderr.write(
                f"Setting up in {environment} failed, see above. If this folder can't be written "
                "to, name another one in the variable AI4U_FOLDER.\n"
            )
            return None
    done.touch()
    return python


if __name__ == "__main__":
    sys.exit(main())

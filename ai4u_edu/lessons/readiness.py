"""``ready``: a check that everything is installed that the course needs."""

import platform
from importlib.util import find_spec

from ai4u_edu.base.version import __version__
from ai4u_edu.lessons.notebook_output import card, put
from ai4u_edu.lessons.rollouts import drives

NEEDED = {
    "lessons": ("matplotlib", "ipykernel"),
    "train": ("torch", "stable_baselines3", "onnx"),
}
FOR = {"lessons": "plots", "train": "the lessons about learning, 09 to 11"}


def ready() -> None:
    """Let a robot drive for a second, and say what is installed and what is missing."""
    (drive,) = drives("box_chase", lambda _: {"move": [0, 1, 0, 0]}, [0], limit=12)
    what = f"AI4U Edu {__version__} on Python {platform.python_version()}"
    lines = [f"{what}: a robot drove for {drive.sim.world.time:g} s of its time."]
    for extra, modules in NEEDED.items():
        missing = [each for each in modules if find_spec(each) is None]
        if missing:
            lines.append(
                f"For {FOR[extra]}, {' and '.join(missing)} must be installed too: "
                f'`pip install "ai4u-edu[{extra}]"`.'
            )
    lines += ["Everything else is there."] if lines[1:] else ["Everything is there."]
    put(card("green", "Ready.", lines), "\n".join(["Ready. " + lines[0], *lines[1:]]))

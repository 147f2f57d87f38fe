"""``ready``: a check that everything is installed that the course needs."""

import platform
from importlib.util import find_spec

from ai4u_edu.base.version import __version__
from ai4u_edu.lessons.notebook_output import tell
from ai4u_edu.lessons.rollouts import drives
from ai4u_edu.locale import gettext as _

NEEDED = {
    "lessons": ("matplotlib", "ipykernel"),
    "train": ("torch", "stable_baselines3", "onnx"),
}
FOR = {"lessons": _("plots"), "train": _("the lessons about learning, 09 to 11")}


def ready() -> None:
    """Let a robot drive for a second, and say what is installed and what is missing."""
    (drive,) = drives("box_chase", lambda _: {"move": [0, 1, 0, 0]}, [0], limit=12)
    lines = [
        _(
            "AI4U Edu {version} on Python {python}: a robot drove for {seconds:g} s of its time.",
            version=__version__,
            python=platform.python_version(),
            seconds=drive.sim.world.time,
        )
    ]
    for extra, modules in NEEDED.items():
        missing = [each for each in modules if find_spec(each) is None]
        if missing:
            lines.append(
                _(
                    'Install {modules} for {what}: `pip install "ai4u-edu[{extra}]"`.',
                    what=FOR[extra],
                    modules=", ".join(missing),
                    extra=extra,
                )
            )
    lines += [_("Everything else is there.")] if lines[1:] else [_("Everything is there.")]
    tell("green", _("Ready."), lines)

"""Checks for optional packages, with a hint how to install them.

None is needed to play, to run a trained network, or to learn with NumPy alone.
"""

import sys
from importlib.util import find_spec

from ai4u_edu.base.errors import SetupError
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import listed, ngettext

CPU_TORCH = "pip install torch --index-url https://download.pytorch.org/whl/cpu"
"""Command that installs torch without its files for graphics cards."""


def has(*modules: str) -> bool:
    """Return True if some packages are installed, without importing them."""
    return all(find_spec(module) is not None for module in modules)


def need(extra: str, *modules: str) -> None:
    """Check that an extra is installed, without importing it.

    Args:
        extra: its name in ``pip install "ai4u-edu[...]"``.
        modules: the modules of it that are needed.

    Raises:
        SetupError: a module is missing; the message says how to install it.
    """
    missing = [module for module in modules if find_spec(module) is None]
    if missing:
        install = ngettext(
            "this needs {names}, which is not installed; install with: pip install "
            '"ai4u-edu[{extra}]" (in a checkout: pip install -e ".[{extra}]")',
            "this needs {names}, which are not installed; install with: pip install "
            '"ai4u-edu[{extra}]" (in a checkout: pip install -e ".[{extra}]")',
            len(missing),
            names=listed(missing),
            extra=extra,
        )
        raise SetupError(_with_torch_advice(install, missing))


def _with_torch_advice(install: str, missing: list[str]) -> str:
    """Add how to install a small torch first, where the usual one is large."""
    if "torch" not in missing or sys.platform != "linux":
        return install
    return _(
        "{install}. Without a graphics card for it, first: {command} (0.7 GB in place of 5.9 GB)",
        install=install,
        command=CPU_TORCH,
    )

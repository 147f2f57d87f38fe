"""Checks for optional packages, with a hint how to install them.

None is needed to play, to run a trained network, or to learn with NumPy alone.
"""

import sys
from importlib.util import find_spec

from ai4u_edu.base.errors import SetupError

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
        raise SetupError(
            f"this needs {' and '.join(missing)}, which {'is' if len(missing) == 1 else 'are'} not "
            f'installed; install with: pip install "ai4u-edu[{extra}]" '
            f'(in a checkout: pip install -e ".[{extra}]"){_torch_advice(missing)}'
        )


def _torch_advice(missing: list[str]) -> str:
    """Return how to install a small torch first, where the usual one is large."""
    if "torch" not in missing or sys.platform != "linux":
        return ""
    return f". Without a graphics card for it, first: {CPU_TORCH} (0.7 GB in place of 5.9 GB)"

"""Packages that only some need: asked for when they are needed, and told of when they are missing.

``train`` learns, ``onnx`` runs a network that somebody trained; the rest of the package needs
neither.
"""

from importlib.util import find_spec

from ai4u_edu.base.errors import SetupError


def has(*modules: str) -> bool:
    """Whether some packages are installed, without loading them."""
    return all(find_spec(module) is not None for module in modules)


def need(extra: str, *modules: str) -> None:
    """Makes sure that an extra is installed, without loading it.

    Args:
        extra: its name in ``pip install "ai4u-edu[...]"``.
        modules: what of it is needed.

    Raises:
        SetupError: something is missing; says how to install it.
    """
    missing = [module for module in modules if find_spec(module) is None]
    if missing:
        raise SetupError(
            f"this needs {' and '.join(missing)}, which {'is' if len(missing) == 1 else 'are'} not "
            f'installed; install with: pip install "ai4u-edu[{extra}]" '
            f'(in a checkout: pip install -e ".[{extra}]")'
        )

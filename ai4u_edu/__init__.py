"""AI4U Edu: a top-down sandbox to learn how agents sense, decide and act.

Names are imported at first access, so that a script that only drives a remote agent loads no
physics and no viewer. ``__init__.pyi`` lists them; ``python -m tests.names --write`` updates
its list of blocks.
"""

import re
from pathlib import Path

from ai4u_edu.base.version import __version__ as __version__

# the stub is the list of names: type checkers read it, and so does the next line
_STUB = Path(__file__).with_suffix(".pyi").read_text(encoding="utf-8")
_HOME_OF = {name: home for home, name in re.findall(r"from (\S+) import \w+ as (\w+)", _STUB)}

__all__ = [*_HOME_OF]

try:
    from ai4u_edu.registration import register_envs
except ImportError:  # without Gymnasium: the first start has yet to install it
    pass
else:
    register_envs()


def __getattr__(name: str) -> object:
    from importlib import import_module

    if name not in _HOME_OF:
        raise AttributeError(f"module 'ai4u_edu' has no attribute {name!r}")
    value = getattr(import_module(_HOME_OF[name]), name)
    globals()[name] = value
    return value


def __dir__():  # type: ignore[no-untyped-def]  # an old Python must get as far as our message
    return sorted(__all__)

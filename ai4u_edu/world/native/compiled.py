"""The library of rays.c, which is optional: it is compiled when the package is built.

Without it everything gives the same bits, more slowly. Its name holds a hash of the source, so that
in a checkout a library of another version is not used; ``python .ci/compile_rays.py``
compiles it again. ``AI4U_COMPILED=0`` switches it off.
"""

import ctypes
import hashlib
import os
from functools import cache
from pathlib import Path

SOURCE = Path(__file__).with_name("rays.c")
SWITCH_VARIABLE = "AI4U_COMPILED"


def library_name(os_name: str) -> str:
    """Return the name of the library's file; `os_name` is ``os.name`` of its platform."""
    checksum = hashlib.sha256(SOURCE.read_bytes()).hexdigest()[:16]
    return f"rays-{checksum}.{'dll' if os_name == 'nt' else 'so'}"


@cache
def load_library() -> ctypes.CDLL | None:
    """Return the compiled library; None where it is missing or switched off."""
    if os.environ.get(SWITCH_VARIABLE) == "0":
        return None
    try:
        return ctypes.CDLL(str(SOURCE.with_name(library_name(os.name))))
    except OSError:  # not there, or for another processor
        return None

"""Edits of a running world: blocks, brains, bodies, whole scenes; with undo."""

import warnings
from typing import Any

from ai4u_edu.page.editing.change_result import ChangeResult
from ai4u_edu.page.editing.drivers import Driver
from ai4u_edu.page.editing.editor import SceneEditor
from ai4u_edu.page.editing.errors import ChangeError
from ai4u_edu.page.editing.state import EditState

__all__ = ["ChangeError", "ChangeResult", "Driver", "EditState", "SceneEditor"]

_RENAMED: dict[str, Any] = {"Outcome": ChangeResult, "State": EditState, "Workshop": SceneEditor}


def __getattr__(name: str) -> Any:
    if name in _RENAMED:
        now = _RENAMED[name]
        warnings.warn(f"use {__name__}.{now.__name__}", DeprecationWarning, stacklevel=2)
        return now
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")

"""Edits of a running world: blocks, brains, bodies, whole scenes; with undo."""

from ai4u_edu.page.editing.change_result import ChangeResult
from ai4u_edu.page.editing.drivers import Driver
from ai4u_edu.page.editing.editor import SceneEditor
from ai4u_edu.page.editing.errors import ChangeError
from ai4u_edu.page.editing.state import EditState

__all__ = ["ChangeError", "ChangeResult", "Driver", "EditState", "SceneEditor"]

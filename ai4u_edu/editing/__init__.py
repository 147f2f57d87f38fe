"""What a person changes in a running world: blocks, brains, bodies, whole scenes; and undo."""

from ai4u_edu.editing.drivers import Driver
from ai4u_edu.editing.editor import Workshop
from ai4u_edu.editing.errors import ChangeError
from ai4u_edu.editing.outcome import Outcome
from ai4u_edu.editing.state import State

__all__ = ["ChangeError", "Driver", "Outcome", "State", "Workshop"]

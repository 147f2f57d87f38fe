"""What a person changes in a running world: blocks, brains, bodies, whole scenes; and undo."""

from ai4u_edu.workshop.drivers import Driver
from ai4u_edu.workshop.errors import ChangeError
from ai4u_edu.workshop.outcome import Outcome
from ai4u_edu.workshop.state import State
from ai4u_edu.workshop.workshop import Workshop

__all__ = ["ChangeError", "Driver", "Outcome", "State", "Workshop"]

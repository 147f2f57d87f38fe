"""The actuators: one idea a file."""

from ai4u_edu.blocks.actuators.actuator import Actuator
from ai4u_edu.blocks.actuators.rb_move import RBMoveActuator
from ai4u_edu.blocks.actuators.respawn import RespawnActuator

__all__ = ["Actuator", "RBMoveActuator", "RespawnActuator"]

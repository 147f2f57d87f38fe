"""The actuators: one idea a file."""

from ai4u_edu.blocks.actuators.actuator import Actuator
from ai4u_edu.blocks.actuators.car import CarActuator
from ai4u_edu.blocks.actuators.cb_move import CBMoveActuator
from ai4u_edu.blocks.actuators.collect import CollectActuator
from ai4u_edu.blocks.actuators.continuous import ContinuousActuator
from ai4u_edu.blocks.actuators.differential_drive import DifferentialDriveActuator
from ai4u_edu.blocks.actuators.discrete import DiscreteActuator
from ai4u_edu.blocks.actuators.force_move import ForceMoveActuator
from ai4u_edu.blocks.actuators.grab import GrabActuator
from ai4u_edu.blocks.actuators.grid_move import GridMoveActuator
from ai4u_edu.blocks.actuators.pen import PenActuator
from ai4u_edu.blocks.actuators.rb_move import RBMoveActuator
from ai4u_edu.blocks.actuators.respawn import RespawnActuator
from ai4u_edu.blocks.actuators.speak import SpeakActuator

__all__ = [
    "Actuator",
    "CBMoveActuator",
    "CarActuator",
    "CollectActuator",
    "ContinuousActuator",
    "DifferentialDriveActuator",
    "DiscreteActuator",
    "ForceMoveActuator",
    "GrabActuator",
    "GridMoveActuator",
    "PenActuator",
    "RBMoveActuator",
    "RespawnActuator",
    "SpeakActuator",
]

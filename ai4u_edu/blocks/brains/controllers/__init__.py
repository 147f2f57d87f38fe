"""The controllers: what a LocalBrain can ask."""

from ai4u_edu.blocks.brains.controllers.arrow import ArrowController
from ai4u_edu.blocks.brains.controllers.controller import Controller
from ai4u_edu.blocks.brains.controllers.discrete_arrow import DiscreteArrowController
from ai4u_edu.blocks.brains.controllers.keyboard import Keyboard
from ai4u_edu.blocks.brains.controllers.replay import ReplayController
from ai4u_edu.blocks.brains.controllers.script import ScriptController
from ai4u_edu.blocks.brains.controllers.wasd import WASDRBMoveController

__all__ = [
    "ArrowController",
    "Controller",
    "DiscreteArrowController",
    "Keyboard",
    "ReplayController",
    "ScriptController",
    "WASDRBMoveController",
]

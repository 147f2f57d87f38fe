"""The controllers, which a LocalBrain asks for actions: one idea a file."""

from ai4u_edu.blocks.brains.controllers.a_star import AStarController, a_star
from ai4u_edu.blocks.brains.controllers.ant import AntController
from ai4u_edu.blocks.brains.controllers.arrow import ArrowController
from ai4u_edu.blocks.brains.controllers.breadth_first import BreadthFirstController, breadth_first
from ai4u_edu.blocks.brains.controllers.call import CallController
from ai4u_edu.blocks.brains.controllers.controller import Controller
from ai4u_edu.blocks.brains.controllers.discrete_arrow import DiscreteArrowController
from ai4u_edu.blocks.brains.controllers.flee import FleeController
from ai4u_edu.blocks.brains.controllers.keeper import KeeperController
from ai4u_edu.blocks.brains.controllers.neural import NeuralNetController
from ai4u_edu.blocks.brains.controllers.push_out import PushOutController
from ai4u_edu.blocks.brains.controllers.replay import ReplayController
from ai4u_edu.blocks.brains.controllers.script import ScriptController
from ai4u_edu.blocks.brains.controllers.striker import StrikerController
from ai4u_edu.blocks.brains.controllers.train import TrainController, Trainer
from ai4u_edu.blocks.brains.controllers.wasd import WASDRBMoveController
from ai4u_edu.blocks.brains.controllers.wasd_drive import WASDController

__all__ = [
    "AStarController",
    "AntController",
    "ArrowController",
    "BreadthFirstController",
    "CallController",
    "Controller",
    "DiscreteArrowController",
    "FleeController",
    "KeeperController",
    "NeuralNetController",
    "PushOutController",
    "ReplayController",
    "ScriptController",
    "StrikerController",
    "TrainController",
    "Trainer",
    "WASDController",
    "WASDRBMoveController",
    "a_star",
    "breadth_first",
]

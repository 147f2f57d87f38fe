"""The controllers: what a LocalBrain can ask."""

from ai4u_edu.blocks.brains.controllers.controller import Controller
from ai4u_edu.blocks.brains.controllers.keyboard import Keyboard
from ai4u_edu.blocks.brains.controllers.script import ScriptController
from ai4u_edu.blocks.brains.controllers.wasd import WASDRBMoveController

__all__ = ["Controller", "Keyboard", "ScriptController", "WASDRBMoveController"]

"""Brains, and their answers."""

from ai4u_edu.blocks.brains.brain import Action, Brain, Command
from ai4u_edu.blocks.brains.local import LocalBrain
from ai4u_edu.blocks.brains.remote import RemoteBrain
from ai4u_edu.blocks.brains.trained import trained_brain

__all__ = [
    "Action",
    "Brain",
    "Command",
    "LocalBrain",
    "RemoteBrain",
    "trained_brain",
]

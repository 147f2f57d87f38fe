"""The brains, and what they can answer."""

from ai4u_edu.blocks.brains.brain import Brain
from ai4u_edu.blocks.brains.command import Action, Answer, Command
from ai4u_edu.blocks.brains.local import LocalBrain

__all__ = ["Action", "Answer", "Brain", "Command", "LocalBrain"]

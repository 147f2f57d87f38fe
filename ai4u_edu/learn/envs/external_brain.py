"""A brain whose action is set from outside, by an environment's ``step``."""

from typing import Any

from ai4u_edu.blocks import Answer, Brain, Percept


class HeldBrain(Brain):
    """Brain that answers with the action that was set last."""

    abstract = True  # nothing for a scene file: somebody has to put actions in

    def __post_init__(self) -> None:
        self.action: dict[str, Any] = {}

    def decide(self, percept: Percept) -> Answer:
        """Return the action that was set last."""
        return self.action

    def title(self) -> str:
        """Name for people."""
        return "Gymnasium"


def take_over(agent: Any) -> HeldBrain:
    """Replace an agent's brain by an external one that decides as often."""
    before: Brain = agent.brain
    brain = HeldBrain(skip_frame=before.skip_frame, repeat_action=before.repeat_action)
    agent.use_brain(brain)
    return brain

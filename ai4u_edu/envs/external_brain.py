"""A brain that does what it is told: the door through which an environment's action comes in."""

from typing import Any

from ai4u_edu.blocks import Answer, Brain, Percept


class HeldBrain(Brain):
    """Hands on the action that was put into it."""

    abstract = True  # nothing for a scene file: somebody has to put actions in

    def __post_init__(self) -> None:
        self.action: dict[str, Any] = {}

    def decide(self, percept: Percept) -> Answer:
        """The action that was put in last."""
        return self.action

    def title(self) -> str:
        """What a person calls it."""
        return "Gymnasium"


def take_over(agent: Any) -> HeldBrain:
    """Gives an agent a held brain that decides as often as the one it had."""
    before: Brain = agent.brain
    brain = HeldBrain(skip_frame=before.skip_frame, repeat_action=before.repeat_action)
    agent.use_brain(brain)
    return brain

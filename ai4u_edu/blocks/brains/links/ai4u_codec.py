"""An agent in the terms of AI4U's protocol, for a script beside the world."""

from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks.brains.links.link import Offer, Situation
from ai4u_edu.wire.agent_codec import AgentCodec
from ai4u_edu.wire.ai4u_dialogue import State
from ai4u_edu.wire.validation import WireError


class AI4UCodec(AgentCodec):
    """Situations to states, replies to actions.

    Args:
        offer: the agent.

    Raises:
        SetupError: AI4U's protocol has no words for what a sensor reads.
    """

    def __init__(self, offer: Offer) -> None:
        try:
            super().__init__(offer.readings, offer.outputs)
        except WireError as error:
            raise SetupError(str(error)) from None

    def state(self, now: Situation) -> State:
        """What the script is told."""
        return State(
            sensors=self.sensors(now.percept),
            reward=now.reward,
            steps=now.steps,
            done=now.done,
            truncated=now.truncated,
            paused=now.paused,
            stopped=now.stopped,
        )

"""Conversion of an agent's observations to AI4U's protocol, for a script beside the world."""

from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks.brains.links.link import AgentSpec, Observation
from ai4u_edu.wire.agent_codec import AgentCodec
from ai4u_edu.wire.ai4u_dialogue import State
from ai4u_edu.wire.validation import WireError


class AI4UCodec(AgentCodec):
    """Converts observations to states, and replies to actions.

    Args:
        spec: of the agent.

    Raises:
        SetupError: AI4U's protocol can't express what a sensor reads.
    """

    def __init__(self, spec: AgentSpec) -> None:
        try:
            super().__init__(spec.readings, spec.outputs)
        except WireError as error:
            raise SetupError(str(error)) from None
        self._last: Observation | None = None

    def begin(self) -> None:
        """Forget what was sent: another session begins."""
        self._last = None

    def state(self, observation: Observation) -> State:
        """Return what the script is sent; its reward is that of all decisions since the last."""
        last, self._last = self._last, observation
        reward = observation.reward
        if last is not None and last.episode == observation.episode:
            if observation.steps > last.steps + 1:
                reward = observation.episode_reward - last.episode_reward
        elif observation.steps > 1:
            reward = observation.episode_reward
        return State(
            sensors=self.sensors(observation.percept),
            reward=reward,
            steps=observation.steps,
            done=observation.done,
            truncated=observation.truncated,
            paused=observation.paused,
            stopped=observation.stopped,
        )

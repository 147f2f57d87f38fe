"""The end of an agent's episode in a word."""

from collections.abc import Iterable

from ai4u_edu.snapshot.types import AgentState


def outcome(agent: AgentState, agents: Iterable[AgentState], success: str) -> str:
    """Return the end of an agent's episode in a word that pages know; empty before it.

    Args:
        agent: the agent.
        agents: all agents of the world at that time.
        success: the reward term that is paid when the goal is reached; empty if there is none.

    Returns:
        ``goal``, ``won``, ``lost``, ``fell``, ``time``, ``over``, or an empty text.
    """
    if not (agent.terminated or agent.truncated):
        return ""
    others = [other for other in agents if other.id != agent.id]
    if agent.succeeded:
        return "won" if others else "goal"
    if agent.truncated:
        return "time"
    if others:
        beaten = agent.reward < 0 or any(other.succeeded for other in others)
        return "lost" if beaten else "over"
    if agent.fell:
        return "fell"
    # a scene that names no success has one all the same
    return "goal" if agent.episode_reward > 0 and not success else "over"

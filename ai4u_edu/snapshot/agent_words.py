"""An agent's name and state in words."""

from ai4u_edu.snapshot.types import AgentState

SCRIPT_PROBLEMS = {
    "waiting": "⌛ waits for its script",
    "late": "⚠ script is late",
    "lost": "✖ script is lost",
}
"""Texts for agents whose script is not driving them, by the state of the remote brain."""


def title(agent_id: str, body: str) -> str:
    """Return an agent's name for people.

    >>> title("0", "robot"), title("runner_1", "runner 1")
    ('Agent 0: robot', 'runner 1')
    """
    alike = agent_id.replace("_", " ") == body.replace("_", " ")
    return body if alike else f"Agent {agent_id}: {body}"


def ending(agent: AgentState) -> str:
    """Return in a few words how an agent's episode ended; empty while it runs."""
    done = agent.terminated or agent.truncated
    if done and agent.succeeded:
        return "reached the goal"
    if agent.terminated:
        return "fell" if agent.fell else "episode over"
    if agent.truncated:
        return "time is up"
    return "paused" if agent.paused else ""


def script_problem(agent: AgentState) -> str:
    """Return the problem with the script that should drive an agent; empty if there is none."""
    return SCRIPT_PROBLEMS.get(agent.remote.state, "") if agent.remote is not None else ""

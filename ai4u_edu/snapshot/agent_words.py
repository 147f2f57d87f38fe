"""An agent's name and state in words."""

from ai4u_edu.blocks import Brain, NeuralNetController, ReplayController, ScriptController
from ai4u_edu.blocks.brains.remote import RemoteBrain
from ai4u_edu.locale import gettext as _
from ai4u_edu.snapshot.types import AgentState

DRIVERS = {
    NeuralNetController: _("A network"),
    ReplayController: _("A recording"),
    ScriptController: _("A script"),
}
"""Titles of drivers, by the class of their controller."""

SCRIPT_PROBLEMS = {
    "waiting": _("⌛ waits for its script"),
    "late": _("⚠ decides too late"),
    "lost": _("✖ script is lost"),
}
"""Texts for agents whose script is not driving them, by the state of the remote brain."""

WITHOUT_EFFECT = _("⚠ its script sends what has no effect")
"""Text for agents whose script makes mistakes."""


def title(agent_id: str, body: str) -> str:
    """Return an agent's name for people.

    >>> title("0", "robot"), title("runner_1", "runner 1")
    ('Agent 0: robot', 'runner 1')
    """
    alike = agent_id.replace("_", " ") == body.replace("_", " ")
    return body if alike else _("Agent {id}: {body}", id=agent_id, body=body)


def ending(agent: AgentState) -> str:
    """Return in a few words how an agent's episode ended; empty while it runs."""
    done = agent.terminated or agent.truncated
    if done and agent.succeeded:
        return _("reached the goal")
    if agent.terminated:
        return _("fell") if agent.fell else _("episode over")
    if agent.truncated:
        return _("time is up")
    return _("paused") if agent.paused else ""


def script_problem(agent: AgentState) -> str:
    """Return the problem with the script that should drive an agent; empty if there is none."""
    remote = agent.remote
    if remote is None:
        return ""
    return SCRIPT_PROBLEMS.get(remote.state, "") or (WITHOUT_EFFECT if remote.warning else "")


def driver_title(brain: Brain) -> str:
    """Return a brain's title for people, as the beginning of a sentence."""
    if isinstance(brain, RemoteBrain):
        return _("A script elsewhere")
    controller = getattr(brain, "controller", brain)
    titles = (title for kind, title in DRIVERS.items() if isinstance(controller, kind))
    return next(titles, type(controller).__name__)


def is_network(brain: Brain) -> bool:
    """Return True if a network decides."""
    return isinstance(getattr(brain, "controller", brain), NeuralNetController)

"""Answers of a script: their checks, and their conversion for the brain."""

from ai4u_edu.blocks import Answer, Command
from ai4u_edu.blocks.brains.links.link import Observation, Reset
from ai4u_edu.wire import native


def find_problem(
    message: native.Answer, asked: Observation, *, agents: int, may_seed: bool
) -> native.Problem | None:
    """Return the reason why a message can't be the answer to a percept.

    Args:
        message: the script's.
        asked: what the percept was made of.
        agents: number of agents in the world.
        may_seed: whether a reset may have a seed, which resets the whole world.
    """
    match message:
        case native.Action() if asked.done:
            text = "the episode is over; expected a reset"
            return native.Problem("episode_over", text, asked.number)
        case native.Action(episode=episode, step=step):
            if (episode, step) == (asked.episode, asked.steps):
                return None
            text = (
                f"percept {asked.number} is of episode {asked.episode}, step {asked.steps}; "
                f"got an action for episode {episode}, step {step}"
            )
            return native.Problem("bad_action", text, asked.number)
        case native.Reset(seed=int()) if not may_seed:
            text = (
                "expected a reset without a seed, which begins an episode for this agent; with "
                f"one it would begin for all {agents} agents, and whoever runs the world has to "
                "allow that (ai4u-edu play --seeded-resets)"
            )
            return native.Problem("seed_refused", text, asked.number)
    return None


def is_request_for_time(message: native.Answer) -> bool:
    """Return True for a message by which a script asks for more time."""
    return isinstance(message, native.Order) and message.word == "wait"


def to_brain_answer(message: native.Answer) -> Answer | Reset:
    """Convert a message to what a brain gets from its link."""
    match message:
        case native.Action(values=values):
            return values
        case native.Reset(seed=seed):
            return Reset(seed)
        case native.Order(word=word):
            return Command(word)

"""Warnings about blocks that run without an error and still have no effect."""

from collections.abc import Iterable

from ai4u_edu.blocks import Block, RewardFunc
from ai4u_edu.blocks.groups import missing_groups, names_groups
from ai4u_edu.blocks.rewards.eval_value import EvalValue
from ai4u_edu.check.report import Outcome, Report
from ai4u_edu.world import WorldView


def warn_of_groups(report: Report, blocks: Iterable[tuple[str, Block]], view: WorldView) -> None:
    """Add a warning for groups that no body carries; add nothing if no block names a group.

    Args:
        report: receives the finding.
        blocks: pairs of a prefix that names the block (may be empty) and the block.
        view: the blocks' world.
    """
    looking = [(words, block) for words, block in blocks if names_groups(block)]
    if not looking:
        return
    missing = [words + text for words, block in looking for text in missing_groups(block, view)]
    report.add("groups", "; ".join(missing), outcome=Outcome.WARNING if missing else None)


def warn_of_no_end(report: Report, rewards: Iterable[tuple[str, RewardFunc]]) -> None:
    """Add a warning for rewards that are meant to end the episode and cannot.

    Args:
        report: receives the finding; nothing is added if no reward is meant to end the episode.
        rewards: pairs of a prefix that names the reward (may be empty) and the reward.
    """
    ending = [(words, reward) for words, reward in rewards if reward.cause_episode_to_end]
    if not ending:
        return
    vain = [words + why for words, reward in ending if (why := _why_it_never_ends(reward))]
    report.add("ends", "; ".join(vain), outcome=Outcome.WARNING if vain else None)


def _why_it_never_ends(reward: RewardFunc) -> str:
    """Return why a reward can't end an episode, as a sentence; empty if it can."""
    if isinstance(reward, EvalValue):
        return (
            "expected a condition inside an AndRewardFunc or OrRewardFunc, with "
            "cause_episode_to_end there: alone it pays nothing, so the episode never ends by it"
        )
    if type(reward).ends is not RewardFunc.ends:  # the class overrides when it ends the episode
        return ""
    amounts = [name for name in reward.parameters() if ("_" + name).endswith("_reward")]
    if not amounts or any(getattr(reward, name) for name in amounts):
        return ""
    return (
        f"expected an amount other than 0 in {' or '.join(amounts)}, got 0: the episode ends "
        "only where something is paid, so it never ends by it"
    )

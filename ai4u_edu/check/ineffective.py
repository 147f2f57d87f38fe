"""Warnings about a block that does run, but can't do what was meant."""

from collections.abc import Iterable

from ai4u_edu.blocks import Block, RewardFunc
from ai4u_edu.blocks.groups import missing_groups, names_groups
from ai4u_edu.blocks.rewards.eval_value import EvalValue
from ai4u_edu.check.report import Outcome, Report
from ai4u_edu.world import WorldView


def warn_of_groups(report: Report, blocks: Iterable[tuple[str, Block]], view: WorldView) -> None:
    """Warn of groups that nothing in the world carries; silent where no block looks for any.

    Args:
        report: where the finding goes.
        blocks: each with the words that say which one it is; none needed for a single one.
        view: the world that they are in.
    """
    looking = [(words, block) for words, block in blocks if names_groups(block)]
    if not looking:
        return
    missing = [words + text for words, block in looking for text in missing_groups(block, view)]
    report.add("groups", "; ".join(missing), outcome=Outcome.WARNING if missing else None)


def warn_of_no_end(report: Report, rewards: Iterable[tuple[str, RewardFunc]]) -> None:
    """Warn of rewards that are to end the episode, and never can; silent where none is to.

    Args:
        report: where the finding goes.
        rewards: each with the words that say which one it is; none needed for a single one.
    """
    ending = [(words, reward) for words, reward in rewards if reward.cause_episode_to_end]
    if not ending:
        return
    vain = [words + why for words, reward in ending if (why := _why_it_never_ends(reward))]
    report.add("ends", "; ".join(vain), outcome=Outcome.WARNING if vain else None)


def _why_it_never_ends(reward: RewardFunc) -> str:
    """A sentence on why a reward can't end an episode; empty if it can."""
    if isinstance(reward, EvalValue):
        return (
            "expected a condition inside an AndRewardFunc or OrRewardFunc, with "
            "cause_episode_to_end there: alone it pays nothing, so the episode never ends by it"
        )
    if type(reward).ends is not RewardFunc.ends:  # it decides by itself
        return ""
    amounts = [name for name in reward.parameters() if ("_" + name).endswith("_reward")]
    if not amounts or any(getattr(reward, name) for name in amounts):
        return ""
    return (
        f"expected an amount other than 0 in {' or '.join(amounts)}, got 0: the episode ends "
        "only where something is paid, so it never ends by it"
    )

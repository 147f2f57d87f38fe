"""The reward terms of an episode over time, and the decisions that paid most."""

from dataclasses import dataclass

import numpy as np

from ai4u_edu.explain.policy import Floats
from ai4u_edu.recording import Episode

DEFAULT_MOMENTS = 3


@dataclass(frozen=True)
class RewardTerms:
    """The amounts of t reward terms in the n decisions of an episode."""

    seconds: Floats
    """(n,) world time (s) at which each decision was taken."""
    terms: tuple[str, ...]
    """Names of the terms."""
    amounts: Floats
    """(n, t) amount of each term in each decision."""

    @property
    def totals(self) -> Floats:
        """(t,) sum of each term."""
        return np.asarray(self.amounts.sum(axis=0))

    def moments(self, count: int = DEFAULT_MOMENTS) -> list[int]:
        """Return the decisions with the largest rewards in size, the largest first."""
        sizes = np.abs(self.amounts.sum(axis=1))
        order = np.argsort(-sizes, kind="stable")[:count]
        return [int(step) for step in order if sizes[step] > 0]


def reward_terms(episode: Episode, agent: str | None = None) -> RewardTerms:
    """Return the reward terms of a recorded episode, decision by decision.

    Args:
        episode: the recorded episode.
        agent: id of the agent; by default the one that acts first.
    """
    record = episode.agent(agent)
    decisions = list(record)
    names = tuple(dict.fromkeys(name for each in decisions for name in each.reward_terms))
    amounts = [[each.reward_terms.get(name, 0.0) for name in names] for each in decisions]
    return RewardTerms(
        record.begin / episode.scene.world.ticks_per_second,
        names,
        np.array(amounts).reshape(len(decisions), len(names)),
    )

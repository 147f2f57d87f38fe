"""Success of a network from starts that it has not learned from."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from msgspec import Struct

from ai4u_edu.blocks import Brain, Controller
from ai4u_edu.blocks.brains.controllers.key_defaults import listens_to_keys
from ai4u_edu.learn.training.episode import EpisodeStats, wilson
from ai4u_edu.learn.training.evaluating import evaluate
from ai4u_edu.learn.training.policies import entrant
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene

STARTS = 100
"""Starts from which a network is scored."""
FEW_STARTS = 50
"""Greatest number of starts of a scene that are all driven from, once each."""
STARTS_AT_ONCE = 5


class NetworkScore(Struct, frozen=True):
    """Starts from which a network reaches the goal."""

    successes: int
    starts: int
    has_all: bool
    """True if the scene has no other starts."""
    low: float
    """Lower end of the 95% confidence interval of the share; the share itself for all starts."""
    high: float

    @classmethod
    def of(cls, successes: int, starts: int, *, has_all: bool) -> "NetworkScore":
        """Return a score with its interval."""
        share = successes / starts
        low, high = (share, share) if has_all else wilson(successes, starts)
        return cls(successes, starts, has_all, low, high)

    @property
    def sentence(self) -> str:
        """The score in words."""
        if self.has_all:
            if self.successes == self.starts:
                return _("It reaches the goal from all {starts} starts.", starts=self.starts)
            return _(
                "It reaches the goal from {successes} of all {starts} starts.",
                successes=self.successes,
                starts=self.starts,
            )
        return _(
            "It reaches the goal from {successes} of {starts} new starts (95% between "
            "{low:.0%} and {high:.0%}).",
            successes=self.successes,
            starts=self.starts,
            low=self.low,
            high=self.high,
        )


def score_network(
    scene: Scene, agent: str, network: Path, max_decisions: int
) -> NetworkScore | None:
    """Let a network drive from starts that it has not learned from.

    Args:
        scene: the scene; its other agents are driven as it says.
        agent: id of the agent.
        network: the network's file.
        max_decisions: decisions after which no other start begins, since a poor network takes all
            the time that it gets.

    Returns:
        None in a scene without a goal, or if another agent would wait for keys.
    """
    sim = scene.build()
    others = [other.brain for other in sim.agents if other.id != agent]
    if scene.description.success is None or not all(map(_drives_by_itself, others)):
        return None
    seeds = _different_starts(scene)
    has_all = len(seeds) <= FEW_STARTS
    who = replace(entrant(str(network.absolute()), scene.description.name), agent=agent)
    episodes: list[EpisodeStats] = []
    for first in range(0, len(seeds), STARTS_AT_ONCE):
        if sum(episode.length for episode in episodes) > max_decisions:
            has_all = False
            break
        some = seeds[first : first + STARTS_AT_ONCE]
        episodes += evaluate(who, scene, some).episodes
    successes = sum(episode.success for episode in episodes)
    return NetworkScore.of(successes, len(episodes), has_all=has_all)


def _drives_by_itself(brain: Brain) -> bool:
    """Return False for a brain that waits for keys, or for a script."""
    controller = getattr(brain, "controller", None)
    return isinstance(controller, Controller) and not listens_to_keys(type(controller))


def _different_starts(scene: Scene) -> Sequence[int]:
    """Return seeds of which each has another start."""
    sim = scene.build()
    seeds: dict[object, int] = {}
    for seed in range(STARTS):
        sim.reset(seed)
        seeds.setdefault(tuple(body.pose for body in sim.world.bodies.values()), seed)
    return [*seeds.values()]

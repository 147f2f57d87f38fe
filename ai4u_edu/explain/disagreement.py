"""Two policies on the same episode: where they first disagree, and because of what."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks import Percept
from ai4u_edu.explain.baseline import Baseline, mean_of
from ai4u_edu.explain.groups import Group, Kind
from ai4u_edu.explain.occlusion import Occlusion, occlusion
from ai4u_edu.explain.policy import Floats, Policy, PolicyLike
from ai4u_edu.locale import gettext as _
from ai4u_edu.recording import Episode, Replay

DEFAULT_TOLERANCE = 0.2
"""Difference of one number of an action from which two policies disagree."""


@dataclass(frozen=True)
class Disagreement:
    """The actions of two policies in the n decisions of an episode."""

    components: tuple[str, ...]
    """Names of the action's numbers."""
    first: Floats
    """(n, c) actions of the first policy."""
    second: Floats
    """(n, c) actions of the second one."""
    step: int | None
    """The first decision in which they differ by more than the tolerance; None if none does."""
    percept: Percept | None
    """The percept that both got there."""
    because: tuple[Occlusion, Occlusion] | None
    """Explanations of both actions there."""

    @property
    def distance(self) -> Floats:
        """(n,) largest difference of any number, decision by decision."""
        return np.asarray(np.abs(self.first - self.second).max(axis=1, initial=0.0))


def first_disagreement(
    first: PolicyLike,
    second: PolicyLike,
    episode: Episode | Sequence[Percept],
    *,
    tolerance: float = DEFAULT_TOLERANCE,
    agent: str | None = None,
    baseline: Baseline | None = None,
    groups: Kind | Sequence[Group] = "slot",
) -> Disagreement:
    """Return where two policies first disagree on the percepts of an episode.

    Both are asked about the same percepts, whoever drove: so a difference is one of the policies,
    and does not come from other places that one of them drove to.

    Args:
        first: as for :func:`~ai4u_edu.explain.occlusion`.
        second: likewise.
        episode: a recorded episode, or its percepts.
        tolerance: difference of one number of an action from which they disagree.
        agent: id of the agent in the episode; by default the one that acts first.
        baseline: for the explanation; by default the mean of the episode's percepts.
        groups: for the explanation.

    Raises:
        NotExplainableError: the decision of one is no function of the percept.
        SetupError: the two give actions of other sizes.
    """
    one, two = (each if isinstance(each, Policy) else Policy(each) for each in (first, second))
    percepts = percepts_of(episode, agent)
    actions = np.stack([one.decide(percept) for percept in percepts])
    others = np.stack([two.decide(percept) for percept in percepts])
    if actions.shape != others.shape:
        raise SetupError(
            _(
                "expected two policies for the same actuators, got actions of {shape} and "
                "{shape2} numbers",
                shape=actions.shape[1],
                shape2=others.shape[1],
            )
        )
    apart = np.flatnonzero((np.abs(actions - others) > tolerance).any(axis=1))
    if not len(apart):
        return Disagreement(one.components, actions, others, None, None, None)
    step = int(apart[0])
    ground = mean_of(percepts) if baseline is None else baseline
    because = (
        occlusion(one, percepts[step], baseline=ground, groups=groups),
        occlusion(two, percepts[step], baseline=ground, groups=groups),
    )
    return Disagreement(one.components, actions, others, step, percepts[step], because)


def percepts_of(episode: Episode | Sequence[Percept], agent: str | None = None) -> list[Percept]:
    """Return the percepts of an agent's decisions.

    Raises:
        RecordingError: the episode can't be replayed exactly.
        SetupError: there are none.
    """
    if isinstance(episode, Episode):
        found = [moment.percept for moment in Replay(episode).moments(agent)]
    else:
        found = list(episode)
    if not found:
        raise SetupError(_("expected an episode with at least one decision, got none"))
    return found

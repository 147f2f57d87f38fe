"""Two drivers on what one agent sensed in an episode: where they first disagree, and why."""

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np

from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks import Percept
from ai4u_edu.explain.baseline import Baseline, mean_of
from ai4u_edu.explain.disagreement import DEFAULT_TOLERANCE, first_disagreement
from ai4u_edu.explain.live import MIN_MEAN_PERCEPTS, middle_of_infos, parts_of
from ai4u_edu.explain.occlusion import occlusion
from ai4u_edu.explain.policy import Policy
from ai4u_edu.explain.sentence import Axis, axes_of, sentence
from ai4u_edu.locale import gettext as _
from ai4u_edu.snapshot import AgentState


class Comparison(NamedTuple):
    """The actions of two policies in the n decisions of an episode."""

    distance: tuple[float, ...]
    """(n,) largest difference of any number of the action that has an effect, by decision."""
    step: int | None
    """The first decision in which they disagree; None if none is."""
    axes: tuple[Axis, ...] = ()
    """The numbers of the action, if they disagree; likewise the rest."""
    actions: tuple[tuple[float, ...], tuple[float, ...]] = ((), ())
    """Both actions there."""
    sentences: tuple[str, str] = ("", "")
    """The slot that each of them sees as decisive there, in words; empty for what was done."""


class _RecordedActions:
    """The actions that an agent took, as a function of the percepts that it had then."""

    __slots__ = ("_actions",)  # without attributes that Policy would compare at each decision

    def __init__(self, agents: Sequence[AgentState], keys: Iterable[str]) -> None:
        wanted = list(keys)
        self._actions = {
            id(agent.percept): {key: agent.action[key] for key in wanted if key in agent.action}
            for agent in agents
        }

    def __call__(self, percept: Percept) -> dict[str, tuple[float, ...]]:
        return self._actions[id(percept)]


def compare(
    first: Policy | None,
    second: Policy | None,
    agents: Sequence[AgentState],
    *,
    tolerance: float = DEFAULT_TOLERANCE,
) -> Comparison:
    """Return where two policies first disagree, and what each of them sees as decisive there.

    Args:
        first: a policy; None for what the agent did.
        second: another one, likewise.
        agents: states of one agent at its decisions, in order.
        tolerance: difference of one number of an action from which they disagree.

    Raises:
        NotExplainableError: the decision of one is no function of the percept.
        SetupError: there are no decisions, or the two give actions of other sizes.
    """
    percepts = [agent.percept for agent in agents]
    if not percepts:
        raise SetupError(_("expected an episode with at least one decision, got none"))
    asked = first or second
    keys = list(agents[0].action if asked is None else asked.answer(percepts[0]))
    did = Policy(_RecordedActions(agents, keys))
    told = first_disagreement(first or did, second or did, percepts, tolerance=tolerance, groups=())
    axes = axes_of(agents[0].actuator_infos, keys)
    if len(axes) != len(told.components):
        axes = [Axis(name, -1.0, 1.0) for name in told.components]
    # numbers without effect are not trained, and differ at random
    has_effect = np.array([axis.has_effect for axis in axes], bool)
    apart = np.abs(told.first - told.second)[:, has_effect].max(axis=1, initial=0.0)
    distance, beyond = tuple(apart.tolist()), np.flatnonzero(apart > tolerance)
    if not len(beyond):
        return Comparison(distance, None)
    step = int(beyond[0])
    agent, percept = agents[step], percepts[step]
    # the mean of a few percepts is hardly another one
    is_long = len(percepts) >= MIN_MEAN_PERCEPTS
    baseline: Baseline = mean_of(percepts) if is_long else middle_of_infos(agent.sensor_infos)
    sentences = []
    for policy in (first, second):
        if policy is None:
            sentences.append("")
            continue
        inputs = set(policy.inputs(percept))
        groups = parts_of([info for info in agent.sensor_infos if info.key in inputs], agent)
        because = occlusion(policy, percept, baseline=baseline, groups=groups)
        sentences.append(sentence(because, axes))
    actions = tuple(told.first[step].tolist()), tuple(told.second[step].tolist())
    return Comparison(distance, step, tuple(axes), actions, (sentences[0], sentences[1]))

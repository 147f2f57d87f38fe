"""Values of places: the reward that a policy expects from there on."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ai4u_edu.base.errors import SetupError
from ai4u_edu.explain.field import poses_for
from ai4u_edu.explain.policy import Floats, Policy, PolicyLike, has_critic, values_of
from ai4u_edu.explain.world_copy import DEFAULT_COLUMNS, Poses, WorldCopy, WorldLike
from ai4u_edu.locale import gettext as _

DEFAULT_DECISIONS = 200
"""Decisions of a rollout from one pose."""
DISCOUNT = 0.99
"""Value of a reward that comes one decision later."""


@dataclass(frozen=True)
class ValueMap:
    """The values of n poses."""

    poses: Poses
    """(n, 3) x, y (m), heading (rad)."""
    values: Floats
    """(n,) expected sum of discounted rewards; NaN where the agent can't stand."""
    source: str
    """``critic`` or ``rollouts``."""


def value_map(
    policy: PolicyLike,
    world: WorldLike,
    poses: Poses | None = None,
    *,
    columns: int = DEFAULT_COLUMNS,
    heading: float | str | None = None,
    agent: str | None = None,
    seed: int = 0,
    source: str = "",
    decisions: int = DEFAULT_DECISIONS,
    discount: float = DISCOUNT,
    on_pose: Callable[[int, int], object] = lambda _done, _all: None,
) -> ValueMap:
    """Return what many poses are worth to a policy.

    The critic of a network tells what it learned to expect, which may be wrong; a rollout tells
    what one episode from there pays.

    Args:
        policy: as for :func:`~ai4u_edu.explain.occlusion`.
        world: a scene, its name, or a world that stands as it stands now; it does not change.
        poses: as for :func:`~ai4u_edu.explain.field`, with ``columns`` and ``heading``.
        columns: of the grid.
        heading: of the grid's poses.
        agent: id of the agent; by default the one that acts first.
        seed: the episode's seed, if the world is a scene.
        source: ``critic`` or ``rollouts``; by default the critic where the network has one.
        decisions: longest rollout.
        discount: of a rollout.
        on_pose: called after each pose with its number, from 1, and the number of poses; an
            exception that it raises ends the computation.

    Raises:
        SetupError: the network has no critic, or there is no such source.
    """
    asked = policy if isinstance(policy, Policy) else Policy(policy)
    source = source_of(asked, source)
    copy = WorldCopy(world, asked, agent=agent, seed=seed)
    poses = poses_for(copy, poses, columns, heading)
    values = np.full(len(poses), np.nan)
    for index, pose in enumerate(poses):
        values[index] = value_at(copy, pose, source, decisions=decisions, discount=discount)
        on_pose(index + 1, len(poses))
    return ValueMap(poses, values, source)


def source_of(policy: Policy, wanted: str = "") -> str:
    """Return the source of a policy's values: ``critic`` or ``rollouts``.

    Raises:
        SetupError: there is no such source, or a function is to have a critic.
    """
    network = policy.network
    source = wanted or ("critic" if network is not None and has_critic(network) else "rollouts")
    if source not in ("critic", "rollouts"):
        raise SetupError(
            _("source: expected 'critic' or 'rollouts', got {source}", source=repr(source))
        )
    if source == "critic" and network is None:
        raise SetupError(_("source: expected a network with a critic; a function has none"))
    return source


def value_at(
    copy: WorldCopy,
    pose: Floats,
    source: str,
    *,
    decisions: int = DEFAULT_DECISIONS,
    discount: float = DISCOUNT,
    on_decision: Callable[[], object] = lambda: None,
) -> float:
    """Return what a pose is worth; NaN if the agent can't stand there.

    Args:
        copy: of the world.
        pose: x, y (m), heading (rad).
        source: as :func:`source_of` returns it.
        decisions: longest rollout.
        discount: of a rollout.
        on_decision: called after each decision of a rollout; an exception that it raises ends it.
    """
    percept = copy.percept_at(pose)
    if percept is None:
        return float("nan")
    if source == "critic" and copy.policy.network is not None:
        return values_of(copy.policy.network, percept)
    total, weight, agent = 0.0, 1.0, copy.agent
    for _decision in range(decisions):
        if agent.done:
            break
        copy.step()
        total += weight * agent.reward
        weight *= discount
        on_decision()
    return total

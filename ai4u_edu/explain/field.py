"""The action at many places: what a policy would do if the agent stood there."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ai4u_edu.explain.policy import Floats, Policy, PolicyLike
from ai4u_edu.explain.world_copy import DEFAULT_COLUMNS, Poses, WorldCopy, WorldLike


@dataclass(frozen=True)
class ActionField:
    """The actions of a policy at n poses, for an action of c numbers."""

    poses: Poses
    """(n, 3) x, y (m), heading (rad)."""
    components: tuple[str, ...]
    """Names of the action's numbers."""
    actions: Floats
    """(n, c) the actions; NaN where the agent can't stand."""
    moves: Floats
    """(n, 3) how the pose changes in one decision: x, y (m), heading (rad); NaN likewise."""

    @property
    def can_stand(self) -> Floats:
        """(n,) True where the agent can stand."""
        return np.asarray(~np.isnan(self.moves).any(axis=1))


def field(
    policy: PolicyLike,
    world: WorldLike,
    poses: Poses | None = None,
    *,
    columns: int = DEFAULT_COLUMNS,
    heading: float | str | None = None,
    agent: str | None = None,
    seed: int = 0,
    on_pose: Callable[[int, int], object] = lambda _done, _all: None,
) -> ActionField:
    """Return what a policy would do at many poses, in a copy of a world.

    The agent is put at each pose as if its episode began there: at rest, and with stacked readings
    that all show the same. All other bodies stay where they are.

    Args:
        policy: as for :func:`~ai4u_edu.explain.occlusion`.
        world: a scene, its name, or a world that stands as it stands now; it does not change.
        poses: (n, 3) x, y (m), heading (rad); by default a grid over the floor.
        columns: of that grid.
        heading: of the grid's poses: an angle (rad), or the name of a body or an area to face; by
            default the agent's present one.
        agent: id of the agent; by default the one that acts first.
        seed: the episode's seed, if the world is a scene.
        on_pose: called after each pose with its number, from 1, and the number of poses; an
            exception that it raises ends the computation.

    >>> still = field(lambda percept: {"move": [1, 0, 0, 0]}, "box_chase", columns=3, heading=0.0)
    >>> still.poses.shape, still.actions.shape, bool(np.nanmax(still.moves[:, 0]) > 0.1)
    ((9, 3), (9, 4), True)
    """
    copy = WorldCopy(
        world, policy if isinstance(policy, Policy) else Policy(policy), agent=agent, seed=seed
    )
    poses = poses_for(copy, poses, columns, heading)
    actions: list[Floats | None] = []
    moves = np.full((len(poses), 3), np.nan)
    for index, pose in enumerate(poses):
        found = action_at(copy, pose)
        actions.append(None if found is None else found[0])
        if found is not None:
            moves[index] = found[1]
        on_pose(index + 1, len(poses))
    return ActionField(poses, copy.policy.components, _table(actions), moves)


def action_at(copy: WorldCopy, pose: Floats) -> tuple[Floats, Floats] | None:
    """Return the action at a pose, (c,), and how the pose changes then, (3,).

    Returns:
        None if the agent can't stand there.
    """
    percept = copy.percept_at(pose)
    if percept is None:
        return None
    action = copy.policy.decide(percept)
    copy.step()
    (x, y), angle = copy.agent.body.position, copy.agent.body.heading
    turned = np.remainder(angle - pose[2] + np.pi, 2 * np.pi) - np.pi
    return action, np.array([x - pose[0], y - pose[1], turned])


def poses_for(
    copy: WorldCopy, poses: Poses | None, columns: int, heading: float | str | None
) -> Poses:
    """Return poses that were given, or a grid with the heading that is wanted."""
    if poses is not None:
        return np.asarray(poses, np.float64).reshape(-1, 3)
    if isinstance(heading, str):
        return copy.towards(copy.grid(columns), heading)
    return copy.grid(columns, heading)


def _table(rows: list[Floats | None]) -> Floats:
    width = next((len(row) for row in rows if row is not None), 0)
    empty = np.full(width, np.nan)
    return np.array([empty if row is None else row for row in rows]).reshape(len(rows), width)

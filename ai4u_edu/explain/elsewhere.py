"""The action of a running world's agent if it stood somewhere else, asked pose by pose."""

import math
import threading
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from ai4u_edu.blocks import Brain
from ai4u_edu.explain.errors import NotExplainableError
from ai4u_edu.explain.field import action_at
from ai4u_edu.explain.live import GONE, LiveExplainer
from ai4u_edu.explain.map_maker import SceneOf
from ai4u_edu.explain.moment import Moment
from ai4u_edu.explain.sentence import Axis, axes_of
from ai4u_edu.explain.world_copy import WorldCopy
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.snapshot import Snapshot


class Pose(NamedTuple):
    """A place on the floor and a heading: metres, radians."""

    x: float
    y: float
    heading: float


class Elsewhere(NamedTuple):
    """The action at a pose, beside the present one."""

    agent: str
    """Id of the agent."""
    pose: Pose
    axes: tuple[Axis, ...]
    """The numbers of the action."""
    now: tuple[float, ...]
    """The action on the agent's percept."""
    then: tuple[float, ...] | None
    """The action at the pose; None if the agent can't stand there."""
    move: tuple[float, ...]
    """Change of the pose in one decision from there: x, y (m), heading (rad)."""


class PoseTrial:
    """Tries poses in a copy of a running world. Any thread may call it; the calls take turns.

    Args:
        latest: returns the latest snapshot.
        explainer: knows the agents' policies.
        scene_of: returns the scene in which a snapshot was taken; may wait for the world's thread.
    """

    def __init__(
        self, latest: Callable[[], Snapshot], explainer: LiveExplainer, scene_of: SceneOf
    ) -> None:
        self._latest, self._explainer, self._scene_of = latest, explainer, scene_of
        self._lock = threading.Lock()
        self._copy: WorldCopy | None = None
        self._copied: tuple[SceneDescription, Brain, str] | None = None

    def at(self, agent_id: str, pose: Pose | None = None) -> Elsewhere:
        """Return what an agent would do at a pose; by default where it stands now.

        Raises:
            NotExplainableError: its decision is no function of the percept.
            AI4UError: the world does not answer, or can't be copied.
        """
        with self._lock:
            snapshot = self._latest()
            agent = next((each for each in snapshot.agents if each.id == agent_id), None)
            brain = self._explainer.brain(agent_id)
            if agent is None or brain is None:
                raise NotExplainableError(GONE)
            if pose is None:
                body = next(each for each in snapshot.bodies if each.name == agent.body)
                pose = Pose(body.x, body.y, body.heading)
            copy = self._copy_of(snapshot, agent_id, brain)
            now = copy.policy.decide(agent.percept)
            axes = axes_of(agent.actuator_infos, list(copy.policy.answer(agent.percept)))
            if len(axes) != len(now):
                axes = [Axis(name, -1.0, 1.0) for name in copy.policy.components]
            found = action_at(copy, np.array(pose))
            return Elsewhere(
                agent_id,
                pose,
                tuple(axes),
                tuple(now.tolist()),
                None if found is None else tuple(found[0].tolist()),
                (math.nan,) * 3 if found is None else tuple(found[1].tolist()),
            )

    def _copy_of(self, snapshot: Snapshot, agent_id: str, brain: Brain) -> WorldCopy:
        scene = self._scene_of(snapshot)
        moment = Moment.of_snapshot(snapshot, scene, agent_id, brain)
        copied = scene, brain, agent_id
        if self._copy is None or self._copied is None or copied != self._copied:
            self._copied = None
            self._copy = WorldCopy(moment, self._explainer.policy(agent_id))
            self._copied = copied
        else:
            self._copy.take_over(moment)
        return self._copy

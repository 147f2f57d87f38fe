"""A map over the floor of a running world: what its agent would do at each place, or its worth."""

import math
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from time import monotonic
from typing import Literal, NamedTuple

import numpy as np

from ai4u_edu.base.errors import AI4UError, text_of
from ai4u_edu.blocks import Brain
from ai4u_edu.explain.field import action_at
from ai4u_edu.explain.live import GONE, LiveExplainer
from ai4u_edu.explain.moment import Moment
from ai4u_edu.explain.pacing import StoppedError
from ai4u_edu.explain.policy import Floats
from ai4u_edu.explain.value_map import source_of, value_at
from ai4u_edu.explain.world_copy import Poses, WorldCopy
from ai4u_edu.locale import join
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.snapshot import AgentState, Snapshot
from ai4u_edu.world import AreaDescription, BodyDescription

CELLS, ROLLOUT_CELLS = 200, 100
"""Places of a map, about; of one whose values are rollouts, each of which takes long."""
MAX_COLUMNS = 40
MAX_FACED = 12
"""Most things in the list of what an agent can look at."""
RETRY_S = 1.0
"""Time after which a map that has failed is tried again, if the world has changed."""
PUBLISH_S = 0.25
"""Time after which a map that is not complete yet is shown with more places."""
MIN_TURN_RAD = 0.1
"""Turn of an agent from which a map for its present heading is computed again."""
MIN_MOVE_M = 0.02
"""Movement of another body from which a map is computed again."""

Kind = Literal["field", "values"]
SceneOf = Callable[[Snapshot], SceneDescription]


class MapRequest(NamedTuple):
    """A map that somebody wants to see."""

    agent: str
    """Id of the agent."""
    kind: Kind
    """``field`` for what it would do, ``values`` for what each place is worth."""
    facing: str = ""
    """Name of a body or an area that the agent looks at from each place; empty for the heading
    that it has."""


@dataclass(frozen=True, eq=False)
class LiveMap:
    """The n places of a map that are known so far."""

    request: MapRequest
    problem: str = ""
    """Reason why there is no map; empty if there is one."""
    poses: Poses = field(default_factory=lambda: np.zeros((0, 3)))
    """(n, 3) x, y (m), heading (rad), on a grid."""
    cell: tuple[float, float] = (1.0, 1.0)
    """Distance (m) of the places along x and y."""
    moves: Floats = field(default_factory=lambda: np.zeros((0, 3)))
    """(n, 3) how the pose changes in one decision; NaN where nothing is known, for a field."""
    values: Floats = field(default_factory=lambda: np.zeros(0))
    """(n,) values; NaN where nothing is known."""
    source: str = ""
    """``critic`` or ``rollouts``."""
    time: float = 0.0
    """World time (s) at which the other bodies stood as they do in the map."""
    done: int = 0
    """Number of places that are known, or where the agent can't stand."""


class _Situation(NamedTuple):
    """All that a map depends on."""

    brain: Brain
    scene: SceneDescription
    others: tuple[object, ...]
    """Episode, rounded poses of the other bodies, and the agent's heading where it counts."""


class MapMaker:
    """Computes one map, place by place, and again when the world has changed.

    One thread calls :meth:`advance`; any thread may read :attr:`latest`.

    Args:
        request: the map.
        explainer: knows the agents' policies.
        scene_of: returns the scene in which a snapshot was taken.
        rest: called between decisions; may wait, and raises StoppedError to end.
    """

    def __init__(
        self,
        request: MapRequest,
        explainer: LiveExplainer,
        scene_of: SceneOf,
        rest: Callable[[], None],
    ) -> None:
        self.request = request
        self.latest: LiveMap | None = None
        """The map so far; None before the first place."""
        self._explainer, self._scene_of, self._rest = explainer, scene_of, rest
        self._seen: Snapshot | None = None
        self._made: _Situation | None = None
        self._copy: WorldCopy | None = None
        self._places: Iterator[None] | None = None
        self._failed_at = -math.inf

    def advance(self, snapshot: Snapshot) -> bool:
        """Compute one more place; return False if nothing is left to do."""
        try:
            self._look(snapshot)
            if self._places is None:
                return False
            if next(self._places, True):
                self._places = None
        except StoppedError:
            raise
        except AI4UError as error:
            self._fail(text_of(error))
        except Exception as error:  # a student's function may raise anything
            self._fail(join([type(error).__name__, text_of(error)], ": "))
        return True

    def _fail(self, problem: str) -> None:
        self._places = self._copy = None
        self._failed_at = monotonic()
        self.latest = LiveMap(self.request, problem)

    def _look(self, snapshot: Snapshot) -> None:
        """Begin again if that is due after the world has changed."""
        if snapshot is self._seen or monotonic() - self._failed_at < RETRY_S:
            return
        is_idle, before = self._places is None, self._made
        brain = self._explainer.brain(self.request.agent)
        if brain is None:
            self._made = None
            raise AI4UError(GONE)
        # while a world runs, a pass is finished first: bodies move all the time
        is_same_driver = before is not None and before.brain is brain
        if not is_idle and is_same_driver and not snapshot.paused:
            return
        self._seen = snapshot
        now = _Situation(brain, self._scene_of(snapshot), self._others(snapshot))
        if now == before or (self._keeps_values(snapshot) and now[:2] == (before or now)[:2]):
            return
        self._made = now
        self._begin(snapshot, now, None if before is None or now[:2] != before[:2] else self._copy)

    def _keeps_values(self, snapshot: Snapshot) -> bool:
        """Return True for values that took long, while a world runs: they stay for its pauses."""
        made = self.latest
        return made is not None and made.source == "rollouts" and not snapshot.paused

    def _others(self, snapshot: Snapshot) -> tuple[object, ...]:
        agent = next((each for each in snapshot.agents if each.id == self.request.agent), None)
        if agent is None:
            raise AI4UError(GONE)
        found: list[object] = [snapshot.seed, bool(snapshot.past)]
        for body in snapshot.bodies:
            if body.name != agent.body:
                x, y = round(body.x / MIN_MOVE_M), round(body.y / MIN_MOVE_M)
                found.append((body.name, x, y, round(body.heading / MIN_TURN_RAD), body.fallen))
            elif not self.request.facing:
                found.append(round(body.heading / MIN_TURN_RAD))
        return tuple(found)

    def _begin(self, snapshot: Snapshot, now: _Situation, copy: WorldCopy | None) -> None:
        self._places = None
        moment = Moment.of_snapshot(snapshot, now.scene, self.request.agent, now.brain)
        if copy is None:
            self.latest = None
            copy = WorldCopy(moment, self._explainer.policy(self.request.agent))
        else:
            copy.take_over(moment)
        self._copy = copy
        source = source_of(copy.policy) if self.request.kind == "values" else ""
        poses, cell = _grid(copy, ROLLOUT_CELLS if source == "rollouts" else CELLS)
        if self.request.facing:
            poses = copy.towards(poses, self.request.facing)
        empty = LiveMap(
            self.request,
            poses=poses,
            cell=cell,
            moves=np.full((len(poses), 3), np.nan),
            values=np.full(len(poses), np.nan),
            source=source,
            time=snapshot.time,
        )
        self._places = self._pass(copy, empty)

    def _pass(self, copy: WorldCopy, made: LiveMap) -> Iterator[None]:
        """Compute all places, each after a yield of None; the first pass shows them as they come.

        Later ones show them at the end: else a map would mix two moments.
        """
        is_first = self.latest is None
        moves, values = made.moves.copy(), made.values.copy()
        shown_at = -math.inf
        for done, index in enumerate(_spread(len(made.poses)), 1):
            if self.request.kind == "field":
                found = action_at(copy, made.poses[index])
                if found is not None:
                    moves[index] = found[1]
            else:
                values[index] = value_at(
                    copy, made.poses[index], made.source, on_decision=self._rest
                )
            self._rest()
            is_last = done == len(made.poses)
            if is_last or (is_first and monotonic() - shown_at >= PUBLISH_S):
                shown_at = monotonic()
                self.latest = replace(made, moves=moves.copy(), values=values.copy(), done=done)
            yield None


def faced_things(snapshot: Snapshot, agent: AgentState) -> list[str]:
    """Return the things that the agent could look at from each place.

    These are the targets of its sensors, and things that alone have one of their tags, as a goal
    has and walls have not.
    """
    scene = snapshot.static_scene
    all_things: tuple[BodyDescription | AreaDescription, ...] = (*scene.bodies, *scene.areas)
    things = [each for each in all_things if each.name != agent.body]
    counts = Counter(tag for each in things for tag in each.tags)
    targets = {name for info in agent.sensor_infos for name in info.targets}
    return [
        each.name
        for each in things
        if each.name in targets or any(counts[tag] == 1 for tag in each.tags)
    ][:MAX_FACED]


def _grid(copy: WorldCopy, cells: int) -> tuple[Poses, tuple[float, float]]:
    """Return about `cells` poses on a grid of squares, and the spacing of its columns and rows."""
    (left, low), (right, high) = copy.sim.world.bounds()
    width, height = max(right - left, 1e-6), max(high - low, 1e-6)
    columns = min(max(2, round(math.sqrt(cells * width / height))), MAX_COLUMNS)
    poses = copy.grid(columns)
    return poses, (width / columns, height / (len(poses) // columns))


def _spread(count: int) -> Iterator[int]:
    """Yield the numbers below ``count``, neighbours far apart in time.

    >>> list(_spread(8))
    [0, 5, 2, 7, 4, 1, 6, 3]
    """
    stride = max(1, round(count * 0.618))
    while math.gcd(stride, count) > 1:
        stride += 1
    return (index * stride % count for index in range(count))

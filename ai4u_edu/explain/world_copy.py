"""Copies of a world in which an agent is put somewhere else, while the world itself stays."""

from collections.abc import Iterable
from functools import partial

import numpy as np
import numpy.typing as npt

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.agent.state import SimState
from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks import Brain, HomeostaticVariable, LocalBrain, Percept, Sensor
from ai4u_edu.blocks.block import walk_blocks
from ai4u_edu.explain.moment import Moment
from ai4u_edu.explain.policy import Policy
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene

DEFAULT_COLUMNS = 12
"""Columns of a grid of poses; rows follow from the shape of the world."""
MAX_POSES = 10_000

Poses = npt.NDArray[np.float64]
WorldLike = Scene | ControlRequestor | Moment | str
"""A scene, its name, or a world that has been built, which is copied as it stands now."""


class WorldCopy:
    """A copy of a world, in which one agent is put at any pose while all else stays.

    All else is everything that has changed since the world was built: poses and speeds, what
    others hold, their blocks and decisions, the random generators. The agent's own episode begins
    at the pose, and its internal variables (energy) have their present levels.

    Other agents stand still if a script elsewhere drives them, or what no file can hold, such as a
    Python function.

    Args:
        world: as :data:`WorldLike`; a scene is taken as it begins with a seed.
        policy: drives the agent in the copy.
        agent: id of the agent; by default the one that acts first.
        seed: the episode's seed, for a scene.
    """

    def __init__(
        self, world: WorldLike, policy: Policy, *, agent: str | None = None, seed: int = 0
    ) -> None:
        if isinstance(world, str):
            world = Scene.load(world)
        state: SimState | None = None
        if isinstance(world, ControlRequestor):
            world = Moment.of_sim(world, agent)
        if isinstance(world, Moment):
            state, seed = _in_scene(world.state), world.state.world.seed
            self.sim = Scene(world.scene).build(brains=partial(_brain_in_copy, world.agent))
            self.agent = self.sim.agent(world.agent)
            rhythm = world.brain
        else:
            self.sim = world.build(seed)
            self.agent = self.sim.agents[0] if agent is None else self.sim.agent(agent)
            rhythm = self.agent.brain
        self.policy = policy
        self.agent.use_brain(_brain_of(policy, rhythm))
        self.sim.reset(seed)
        beginning = self.sim.get_state()
        self._first = beginning.agents[self.agent.id]
        self._state = beginning if state is None else state

    def take_over(self, moment: Moment) -> None:
        """Stand as the same scene stood at another moment."""
        self._state = _in_scene(moment.state)

    def grid(self, columns: int = DEFAULT_COLUMNS, heading: float | None = None) -> Poses:
        """Return poses on a grid over the floor, row by row from below, (n, 3): x, y, heading.

        Args:
            columns: of the grid.
            heading: of all poses (rad); by default the agent's present one.

        Raises:
            SetupError: that would be no poses, or more than 10 000.
        """
        (left, low), (right, high) = self.sim.world.bounds()
        # walls around a floor are wider than where anybody can stand
        side = max(right - left, 1e-6) / max(columns, 1)
        rows = max(1, round((high - low) / side))
        if not 0 < columns * rows <= MAX_POSES:
            raise SetupError(
                _(
                    "expected 1 to {max_poses} poses, got {columns} columns and {rows} rows",
                    max_poses=MAX_POSES,
                    columns=columns,
                    rows=rows,
                )
            )
        xs = left + side * (np.arange(columns) + 0.5)
        ys = low + (high - low) / rows * (np.arange(rows) + 0.5)
        angle = self.home[2] if heading is None else heading
        return np.array([(x, y, angle) for y in ys for x in xs])

    @property
    def home(self) -> tuple[float, float, float]:
        """The agent's pose in the world that was copied: x, y, heading."""
        place = self._state.world.motions[self.agent.body_name]
        return place.x, place.y, place.heading

    def towards(self, poses: Poses, target: str) -> Poses:
        """Return the poses turned to a body or an area.

        Raises:
            NameNotFoundError: there is nothing of that name.
        """
        areas = self.sim.world.areas
        x, y = (
            (areas[target].x, areas[target].y)
            if target in areas
            else self.sim.world[target].position
        )
        turned = poses.copy()
        turned[:, 2] = np.arctan2(y - poses[:, 1], x - poses[:, 0])
        return turned

    def percept_at(self, pose: Iterable[float]) -> Percept | None:
        """Return what the agent would sense at a pose, as if its episode began there.

        Returns:
            None if it can't stand there: there is no floor, or something else.
        """
        self.sim.set_state(self._with_episode_of_its_own(self._state))
        x, y, heading = map(float, pose)
        if self.sim.world.ground(x, y) is None:
            return None
        self.agent.body.move_to(x, y, heading=heading)
        self.sim.world.contacts.forget(self.agent.body)
        if self.sim.world.find_overlap(self.agent.body) is not None:
            return None
        self._begin_here()
        return self.agent.sense()

    def _with_episode_of_its_own(self, state: SimState) -> SimState:
        """Return a state in which the agent has not decided yet; its blocks are as they are."""
        now = state.agents.get(self.agent.id)
        if now is None:
            return state
        first = self._first._replace(blocks=now.blocks)
        return state._replace(agents={**state.agents, self.agent.id: first})

    def _begin_here(self) -> None:
        """Let rewards, stacks and delays begin again; an actuator's reset could move the body."""
        bound, view = self.agent.bound_blocks, self.agent.view
        inner = [
            each for each in walk_blocks(bound.rewards) if isinstance(each, HomeostaticVariable)
        ]
        levels = [variable.get_state() for variable in inner]
        for reward in bound.rewards:
            reward.on_reset(self.agent, view)
        for variable, level in zip(inner, levels, strict=True):
            variable.set_state(level)
        for sensor in walk_blocks(bound.sensors):
            if isinstance(sensor, Sensor):
                sensor.restart()

    def step(self) -> Percept:
        """Run one decision of the agent from where it was put."""
        return self.sim.step(self.agent)


def _in_scene(state: SimState) -> SimState:
    """Return a state without the options of its reset, which the moment's scene has already."""
    return state._replace(options={})


def _brain_in_copy(moved: str, agent: BasicAgent) -> Brain | None:
    """Return the brain of an agent that has none that a file can hold, or that will be moved."""
    is_local = all(isinstance(brain, LocalBrain) for brain in agent.brains if brain.enabled)
    if agent.brains and is_local and agent.id != moved:
        return None
    return LocalBrain(controller=_stand_still)


def _stand_still(_percept: Percept) -> dict[str, float]:
    """Do nothing, as a function from percept to action."""
    return {}


def _brain_of(policy: Policy, like: Brain) -> LocalBrain:
    """Return a brain that decides as often as a network was trained to, or as another brain."""
    rhythm = {} if policy.network is None else policy.network.rhythm
    return LocalBrain(
        controller=policy.answer,
        skip_frame=rhythm.get("skip_frame", like.skip_frame),
        repeat_action=rhythm.get("repeat_action", like.repeat_action),
    )

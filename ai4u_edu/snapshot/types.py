"""Types of snapshots: the state of a world at one tick, for the page, the API and the recorder."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, NamedTuple

from ai4u_edu.agent import LedgerEntry
from ai4u_edu.agent.state import Phase, SimState
from ai4u_edu.blocks import (
    Legend,
    Percept,
    RayPicture,
    RemoteStatus,
    SpotPicture,
    Stages,
)
from ai4u_edu.snapshot.block_info import ActuatorInfo, SensorInfo
from ai4u_edu.world import AreaDescription, BodyDescription, FloorDescription, Region, WorldSettings

NOWHERE = Phase()
"""Phase before the first decision."""
EMPTY: Mapping[str, Any] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class StaticScene:
    """The parts of a world that do not change during an episode; shared between snapshots.

    Randomized values are those of the present episode.
    """

    settings: WorldSettings
    floors: tuple[FloorDescription, ...]
    areas: tuple[AreaDescription, ...]
    bodies: tuple[BodyDescription, ...]
    agent_of: dict[str, str]
    """Ids of agents by the names of their bodies."""
    bounds: tuple[tuple[float, float], tuple[float, float]]
    """A rectangle around everything in all episodes: ((left, low), (right, high)), metres."""
    goal: str = ""
    """The goal in words."""
    success: str = ""
    """The reward term that is paid when the goal is reached; empty if there is none."""

    @property
    def lowest_floor(self) -> float:
        """Height of the lowest floor; bodies below it are falling."""
        return min((floor.top for floor in self.floors), default=0.0)

    def floor_under(self, x: float, y: float, below: float = math.inf) -> float | None:
        """Return the height of the highest floor at (x, y), at most ``below``; None over the void.

        The ground of a world without floors is endless, at height 0.
        """
        if not self.floors:
            return 0.0
        tops = [
            floor.top
            for floor in self.floors
            if floor.top <= below + 1e-6 and Region(floor).contains(x, y)
        ]
        return max(tops, default=None)


class Need(NamedTuple):
    """The present level of a homeostatic variable."""

    name: str
    level: float
    range: tuple[float, float]
    comfort: tuple[float, float]
    """Bounds of the comfort zone."""


class BodyState(NamedTuple):
    """Pose and velocity of a body: metres, radians, m/s, rad/s, in the world's frame.

    Like :class:`AgentState` a named tuple, since a frozen dataclass takes several times as long to
    make and many bodies need thousands a second.
    """

    name: str
    x: float
    y: float
    z: float
    heading: float
    vx: float
    vy: float
    vz: float
    angular_velocity: float
    on_ground: bool
    fallen: bool


class AgentState(NamedTuple):
    """Percept, action and reward of an agent's last decision."""

    id: str
    body: str
    brain: str
    percept: Percept
    action: dict[str, tuple[float, ...]]
    clipped: int
    """Numbers of actions so far that were out of range and clipped."""
    reward: float
    """Reward of the last finished decision."""
    reward_terms: dict[str, float]
    """Its terms by name."""
    episode_reward: float
    episode_terms: dict[str, float]
    steps: int
    terminated: bool
    truncated: bool
    paused: bool
    held_keys: frozenset[str]
    is_driven_by_keys: bool
    """True if a person drives it, False for a script or network."""
    rays: Mapping[str, RayPicture]
    """Rays of the last reading, by perception key."""
    remote: RemoteStatus | None = None
    """Status of the remote script, if one drives."""
    episode: int = 1
    """Episodes that the agent has begun, alone or with the world."""
    succeeded: bool = False
    """True if it was paid in this episode for reaching the scene's goal."""
    fell: bool = False
    """True if its episode ended because it fell."""
    bumps: int = 0
    """Contacts of its body with others that have begun since the world's reset."""
    collects: int = 0
    """Things that it has collected, and stages that it has passed, in this episode."""
    needs: tuple[Need, ...] = ()
    stages: tuple[Stages, ...] = ()
    """Stages on the way to the goal, such as marks that it passed; one for each set of targets."""
    seconds_left: float | None = None
    """World time (s) from its last decision to the end by the step limit; None without a limit."""
    spots: Mapping[str, SpotPicture] = EMPTY
    """Points that sensors read in their last reading, by perception key."""
    legends: Mapping[str, Legend] = EMPTY
    """Colours for showing readings as pictures, by perception key."""
    phase: Phase = NOWHERE
    """Progress in its present decision."""
    history: tuple[LedgerEntry, ...] = ()
    """Rewards of its latest decisions, if the ledger keeps them."""
    sensor_infos: tuple[SensorInfo, ...] = ()
    """Descriptions of its sensors; the same object until its blocks are rebound."""
    actuator_infos: tuple[ActuatorInfo, ...] = ()
    """Descriptions of its actuators, likewise."""

    def outcome(self, agents: Iterable["AgentState"], success: str) -> str:
        """Return the end of its episode in a word that pages know; empty before it.

        Args:
            agents: all agents of the world at that time.
            success: the reward term that is paid when the goal is reached; empty if there is none.

        Returns:
            ``goal``, ``won``, ``lost``, ``fell``, ``time``, ``over``, or an empty text.
        """
        if not (self.terminated or self.truncated):
            return ""
        others = [other for other in agents if other.id != self.id]
        if self.succeeded:
            return "won" if others else "goal"
        if self.truncated:
            return "time"
        if others:
            beaten = self.reward < 0 or any(other.succeeded for other in others)
            return "lost" if beaten else "over"
        if self.fell:
            return "fell"
        # a scene that names no success has one all the same
        return "goal" if self.episode_reward > 0 and not success else "over"

    def has_marks(self, sensor: SensorInfo) -> bool:
        """Return True if a sensor's last reading has rays or spots to draw in the world."""
        return sensor.key in self.rays or sensor.key in self.spots

    def is_drawable(self, sensor: SensorInfo) -> bool:
        """Return True if a sensor has marks, or refers to things or a part of the world."""
        return self.has_marks(sensor) or bool(sensor.targets or sensor.groups or sensor.window)


@dataclass(frozen=True, slots=True)
class SlowTick:
    """A tick that took too long."""

    seconds: float
    contacts: int
    """Approximate number of touching pairs of bodies."""


@dataclass(frozen=True, slots=True)
class Snapshot:
    """State of a world and its agents at one tick."""

    static_scene: StaticScene
    tick: int
    time: float
    """World time (s) since the reset."""
    seed: int
    episode: int
    paused: bool
    time_scale: float
    """Wanted speed; 1 is real time."""
    real_time_factor: float
    """Measured speed."""
    error: str
    """Sentence about the error that stopped the world; empty if none did."""
    bodies: tuple[BodyState, ...]
    agents: tuple[AgentState, ...]
    state: SimState
    """All else that a copy of the world needs to go on from here; :attr:`bodies` has the poses."""
    slow_tick: SlowTick | None = None
    """Slowest tick of the last seconds, if it took too long."""
    episode_time: float = 0.0
    """Time (s) of the episode; it stops at the episode's end, while the world goes on."""
    waiting: str = ""
    """``key`` while the world waits for a person to press a key, ``teacher`` while a teacher holds
    it; empty otherwise."""
    is_seed_locked: bool = False
    """True if a reset without a seed repeats the present seed."""
    past: str = ""
    """Label of a moment of the past; empty for the present."""

    @property
    def passed_stages(self) -> frozenset[str]:
        """Names of the bodies and areas that some agent has passed on the way to its goal."""
        stages = [stages for agent in self.agents for stages in agent.stages if stages.passed]
        return frozenset(name for each in stages for name in each.targets if name not in each.ahead)

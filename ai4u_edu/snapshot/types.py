"""Snapshot types: the frozen state of a world that the page, the API and the recorder read."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, NamedTuple

from ai4u_edu.agent import Entry
from ai4u_edu.agent.decision_cycle import Phase
from ai4u_edu.blocks import (
    Legend,
    Percept,
    RayPicture,
    RemoteStatus,
    SpotPicture,
)
from ai4u_edu.snapshot.block_info import ActuatorInfo, SensorInfo
from ai4u_edu.world import AreaDescription, BodyDescription, FloorDescription, WorldSettings

NOWHERE = Phase()
"""Before the first decision."""
EMPTY: Mapping[str, Any] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class StaticScene:
    """What does not move in an episode; the same object until something is built anew.

    What a scene leaves to chance stands here as it was drawn.
    """

    settings: WorldSettings
    floors: tuple[FloorDescription, ...]
    areas: tuple[AreaDescription, ...]
    bodies: tuple[BodyDescription, ...]
    agent_of: dict[str, str]
    """The agent's id, by the name of its body."""
    bounds: tuple[tuple[float, float], tuple[float, float]]
    """A rectangle around everything in all episodes: ((left, low), (right, high)), metres."""
    goal: str = ""
    """What is to be done, in words."""
    success: str = ""
    """The reward term that is paid when it is done; empty if there is none."""


class Need(NamedTuple):
    """Something that an agent has to keep in balance, as it is now."""

    name: str
    level: float
    range: tuple[float, float]
    comfort: tuple[float, float]
    """The ends of the zone in which the agent feels well."""


class BodyState(NamedTuple):
    """Where a body is: metres, radians, m/s, rad/s, in the world's frame.

    A named tuple, as :class:`AgentState`: for a crowd there are thousands a second, and a frozen
    dataclass takes several times as long to make.
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
    """What an agent sensed, did and got in its last decision."""

    id: str
    body: str
    brain: str
    percept: Percept
    action: dict[str, tuple[float, ...]]
    clipped: int
    """How many numbers of actions were out of range, and cut, so far."""
    reward: float
    """Of the last decision that is over; while the next one is under way, still of that one."""
    reward_terms: dict[str, float]
    """The same by name."""
    episode_reward: float
    episode_terms: dict[str, float]
    steps: int
    terminated: bool
    truncated: bool
    paused: bool
    held_keys: frozenset[str]
    rays: Mapping[str, RayPicture]
    """The rays of the last reading, by perception key."""
    remote: RemoteStatus | None = None
    """How it stands with the script that drives, if it is one's turn."""
    episode: int = 1
    """How many episodes the agent has begun, those that it began alone too."""
    succeeded: bool = False
    """Whether it was paid in this episode for reaching the scene's goal."""
    fell: bool = False
    """Whether its episode ended because it fell."""
    needs: tuple[Need, ...] = ()
    spots: Mapping[str, SpotPicture] = EMPTY
    """The places that sensors looked at in their last reading, by perception key."""
    legends: Mapping[str, Legend] = EMPTY
    """How readings are seen as pictures, by perception key."""
    phase: Phase = NOWHERE
    """How far it is in its decision."""
    history: tuple[Entry, ...] = ()
    """What its latest decisions were paid, if somebody wants to know."""
    sensor_infos: tuple[SensorInfo, ...] = ()
    """What is known of its readings: the same object as long as it has these blocks."""
    actuator_infos: tuple[ActuatorInfo, ...] = ()
    """What is known of its actions, likewise."""


@dataclass(frozen=True, slots=True)
class SlowTick:
    """A tick that took too long."""

    seconds: float
    contacts: int
    """How many pairs of bodies touched, about."""


@dataclass(frozen=True, slots=True)
class Snapshot:
    """Everything at one tick."""

    static_scene: StaticScene
    tick: int
    time: float
    """Seconds of the world's time since the reset."""
    seed: int
    episode: int
    paused: bool
    time_scale: float
    """How fast the time should run; 1 is real time."""
    real_time_factor: float
    """How fast it ran lately."""
    error: str
    """What stopped the world, in a sentence; empty while all is well."""
    bodies: tuple[BodyState, ...]
    agents: tuple[AgentState, ...]
    slow_tick: SlowTick | None = None
    """The slowest tick of the last seconds, if one took too long."""
    past: str = ""
    """Which moment of the past it is, in words; empty for now."""

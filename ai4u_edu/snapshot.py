"""One frozen picture of everything, for the page, the API and the recorder."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, NamedTuple

from ai4u_edu.agent import BasicAgent, Entry
from ai4u_edu.blocks import (
    FallReward,
    HomeostaticReward,
    Legend,
    Percept,
    RayPicture,
    RemoteBrain,
    RemoteStatus,
    RewardFunc,
    SpotPicture,
)
from ai4u_edu.cycle import ControlRequestor, Phase
from ai4u_edu.facts import Control, Sense, facts_of, pictures_of
from ai4u_edu.world import AreaDescription, BodyDescription, FloorDescription, WorldSettings

NOWHERE = Phase()
"""Before the first decision."""
EMPTY: Mapping[str, Any] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class Stage:
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
    senses: tuple[Sense, ...] = ()
    """What is known of its readings: the same object as long as it has these blocks."""
    controls: tuple[Control, ...] = ()
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

    stage: Stage
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


def picture_of(
    sim: ControlRequestor,
    stage: Stage | None = None,
    *,
    paused: bool = False,
    time_scale: float = 1.0,
    real_time_factor: float = 1.0,
    error: str = "",
    slow_tick: SlowTick | None = None,
) -> Snapshot:
    """Everything as it is now.

    Args:
        sim: the world and its agents.
        stage: what :func:`set_stage` gave, if nothing was built since.
        paused: whether the time stands still.
        time_scale: how fast it should run.
        real_time_factor: how fast it ran lately.
        error: what stopped the world.
        slow_tick: one that took too long, lately.
    """
    world = sim.world
    return Snapshot(
        stage=stage or set_stage(sim),
        tick=world.ticks,
        time=world.time,
        seed=world.seeds.seed,
        episode=sim.episode,
        paused=paused,
        time_scale=time_scale,
        real_time_factor=real_time_factor,
        error=error,
        bodies=body_states(sim),
        agents=tuple(agent_state(agent, sim.success, sim.phase(agent)) for agent in sim.agents),
        slow_tick=slow_tick,
    )


def set_stage(sim: ControlRequestor) -> Stage:
    """What does not move in a world."""
    world = sim.world
    return Stage(
        settings=world.settings,
        floors=world.floors,
        areas=tuple(
            region.description
            for region in world.areas.values()
            if isinstance(region.description, AreaDescription)
        ),
        bodies=tuple(body.drawn for body in world.bodies.values()),
        agent_of={agent.body_name: agent.id for agent in sim.agents},
        bounds=world.bounds(),
        goal=sim.goal,
        success=sim.success,
    )


def body_states(sim: ControlRequestor) -> tuple[BodyState, ...]:
    """Where all bodies are now."""
    states = []
    for body in sim.world.bodies.values():
        x, y = body.position
        vx, vy = body.velocity
        states.append(
            BodyState(
                name=body.name,
                x=x,
                y=y,
                z=body.z,
                heading=body.heading,
                vx=vx,
                vy=vy,
                vz=body.vz,
                angular_velocity=body.angular_velocity,
                on_ground=body.on_ground,
                fallen=body.fallen,
            )
        )
    return tuple(states)


def agent_state(agent: BasicAgent, success: str = "", phase: Phase = NOWHERE) -> AgentState:
    """What an agent sensed, did and got in its last decision.

    Args:
        agent: which.
        success: the reward term that is paid when the goal is reached.
        phase: how far it is in its decision.
    """
    ledger, facts, pictures = agent.ledger, facts_of(agent), pictures_of(agent)
    reward, terms = ledger.finished
    return AgentState(
        id=agent.id,
        body=agent.body_name,
        brain=agent.brain.title(),
        percept=agent.percept,
        action=dict(agent.last_action),
        clipped=sum(actuator.clipped for actuator in agent.fitting.actuators.values()),
        reward=reward,
        reward_terms=dict(terms),
        episode_reward=ledger.episode_total,
        episode_terms=dict(ledger.episode_terms),
        steps=agent.steps,
        terminated=agent.terminated,
        truncated=agent.truncated,
        paused=agent.paused,
        held_keys=agent.keyboard.held(),
        rays=pictures.rays,
        remote=agent.brain.status() if isinstance(agent.brain, RemoteBrain) else None,
        episode=agent.episode,
        succeeded=ledger.episode_terms.get(success, 0.0) > 0,
        fell=_fell(agent),
        needs=tuple(_needs(agent)),
        spots=pictures.spots,
        legends=facts.legends,
        phase=phase,
        history=ledger.latest(),
        senses=facts.senses,
        controls=facts.controls,
    )


def _fell(agent: BasicAgent) -> bool:
    if not agent.terminated:
        return False
    low = agent.body.fallen and not agent.body.on_ground  # who was only taken away stood there
    ends = [
        reward
        for reward in agent.fitting.rewards
        if reward.cause_episode_to_end and agent.ledger.terms.get(reward.name)
    ]
    # after another end a body may yet roll over the edge
    return any(_is_for_falling(reward, low=low) for reward in ends) if ends else low


def _is_for_falling(reward: RewardFunc, *, low: bool) -> bool:
    children: Sequence[RewardFunc] = getattr(reward, "children", ())
    return isinstance(reward, FallReward) or (
        low and any(_is_for_falling(child, low=low) for child in children)
    )


def _needs(agent: BasicAgent) -> Iterator[Need]:
    for reward in agent.fitting.rewards:
        if isinstance(reward, HomeostaticReward):
            for each in reward.variables:
                bounds = each.range_min, each.range_max
                comfort = each.comfort_min, each.comfort_max
                yield Need(each.name, each.level, bounds, comfort)

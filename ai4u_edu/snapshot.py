"""One frozen picture of everything, for the page, the API and the recorder."""

from dataclasses import dataclass

from ai4u_edu.agent import BasicAgent
from ai4u_edu.blocks import Percept, RayPicture, RaySensor
from ai4u_edu.cycle import ControlRequestor
from ai4u_edu.world import AreaDescription, BodyDescription, FloorDescription, WorldSettings


@dataclass(frozen=True, slots=True)
class Stage:
    """What does not move; the same object until something is built anew."""

    settings: WorldSettings
    floors: tuple[FloorDescription, ...]
    areas: tuple[AreaDescription, ...]
    bodies: tuple[BodyDescription, ...]
    agent_of: dict[str, str]
    """The agent's id, by the name of its body."""
    bounds: tuple[tuple[float, float], tuple[float, float]]
    """A rectangle around everything, as described: ((left, low), (right, high)), metres."""


@dataclass(frozen=True, slots=True)
class BodyState:
    """Where a body is: metres, radians, m/s, rad/s, in the world's frame."""

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


@dataclass(frozen=True, slots=True)
class AgentState:
    """What an agent sensed, did and got in its last decision."""

    id: str
    body: str
    brain: str
    percept: Percept
    action: dict[str, tuple[float, ...]]
    clipped: int
    """How many numbers of actions were out of range, and cut, so far."""
    reward: float
    reward_terms: dict[str, float]
    episode_reward: float
    episode_terms: dict[str, float]
    steps: int
    terminated: bool
    truncated: bool
    paused: bool
    held_keys: frozenset[str]
    rays: dict[str, RayPicture]
    """The rays of the last reading, by perception key."""


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


def picture_of(
    sim: ControlRequestor,
    stage: Stage | None = None,
    *,
    paused: bool = False,
    time_scale: float = 1.0,
    real_time_factor: float = 1.0,
    error: str = "",
) -> Snapshot:
    """Everything as it is now.

    Args:
        sim: the world and its agents.
        stage: what :func:`set_stage` gave, if nothing was built since.
        paused: whether the time stands still.
        time_scale: how fast it should run.
        real_time_factor: how fast it ran lately.
        error: what stopped the world.
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
        agents=tuple(agent_state(agent) for agent in sim.agents),
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
        bodies=tuple(body.description for body in world.bodies.values()),
        agent_of={agent.body_name: agent.id for agent in sim.agents},
        bounds=world.bounds(),
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


def agent_state(agent: BasicAgent) -> AgentState:
    """What an agent sensed, did and got in its last decision."""
    ledger = agent.ledger
    return AgentState(
        id=agent.id,
        body=agent.body_name,
        brain=agent.brain.title(),
        percept=agent.percept,
        action=dict(agent.last_action),
        clipped=sum(actuator.clipped for actuator in agent.fitting.actuators.values()),
        reward=ledger.total,
        reward_terms=dict(ledger.terms),
        episode_reward=ledger.episode_total,
        episode_terms=dict(ledger.episode_terms),
        steps=agent.steps,
        terminated=agent.terminated,
        truncated=agent.truncated,
        paused=agent.paused,
        held_keys=agent.keyboard.held(),
        rays={
            sensor.perception_key: sensor.picture()
            for sensor in agent.fitting.sensors
            if isinstance(sensor, RaySensor) and sensor.is_active
        },
    )

"""Capture of a running world as an immutable snapshot."""

from collections.abc import Iterator, Sequence

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.agent.state import Phase
from ai4u_edu.blocks import (
    ArrowController,
    DiscreteArrowController,
    FallReward,
    HomeostaticReward,
    RemoteBrain,
    RewardFunc,
    Stages,
    WASDRBMoveController,
)
from ai4u_edu.blocks.actuators.collect import CollectActuator
from ai4u_edu.snapshot.block_info import block_info_of, sensor_pictures_of
from ai4u_edu.snapshot.types import (
    NOWHERE,
    AgentState,
    BodyState,
    Need,
    SlowTick,
    Snapshot,
    StaticScene,
)
from ai4u_edu.world import AreaDescription

KEY_CONTROLLERS = ArrowController, DiscreteArrowController, WASDRBMoveController


def capture_snapshot(
    sim: ControlRequestor,
    static_scene: StaticScene | None = None,
    *,
    paused: bool = False,
    time_scale: float = 1.0,
    real_time_factor: float = 1.0,
    error: str = "",
    slow_tick: SlowTick | None = None,
    episode_time: float | None = None,
    waiting: str = "",
) -> Snapshot:
    """Capture the present state of a world and its agents.

    Args:
        sim: the world and its agents.
        static_scene: an earlier result of :func:`capture_static_scene`, to share it if nothing was
            built since.
        paused: True if the world is paused.
        time_scale: wanted speed; 1 is real time.
        real_time_factor: measured speed.
        error: the error that stopped the world.
        slow_tick: a recent tick that took too long.
        episode_time: time (s) of the episode; default: the world's time.
        waiting: see :attr:`Snapshot.waiting`.
    """
    world = sim.world
    return Snapshot(
        static_scene=static_scene or capture_static_scene(sim),
        tick=world.ticks,
        time=world.time,
        seed=world.seeds.seed,
        episode=sim.episode,
        paused=paused,
        time_scale=time_scale,
        real_time_factor=real_time_factor,
        error=error,
        bodies=capture_bodies(sim),
        agents=tuple(
            capture_agent(
                agent, sim.success, sim.phase(agent), world.contacts.begun(agent.body_name)
            )
            for agent in sim.agents
        ),
        state=sim.get_state(with_motions=False),
        slow_tick=slow_tick,
        episode_time=world.time if episode_time is None else episode_time,
        waiting=waiting,
        is_seed_locked=sim.is_seed_locked,
    )


def capture_static_scene(sim: ControlRequestor) -> StaticScene:
    """Capture the parts of a world that do not change during an episode."""
    world = sim.world
    return StaticScene(
        settings=world.settings,
        floors=world.floors,
        areas=tuple(
            region.description
            for region in world.areas.values()
            if isinstance(region.description, AreaDescription)
        ),
        bodies=tuple(body.sampled for body in world.bodies.values()),
        agent_of={agent.body_name: agent.id for agent in sim.agents},
        bounds=world.bounds(),
        goal=sim.goal,
        success=sim.success,
    )


def capture_bodies(sim: ControlRequestor) -> tuple[BodyState, ...]:
    """Capture the poses and velocities of all bodies."""
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


def capture_agent(
    agent: BasicAgent, success: str = "", phase: Phase = NOWHERE, bumps: int = 0
) -> AgentState:
    """Capture the percept, action and reward of an agent's last decision.

    Args:
        agent: the agent.
        success: the reward term that is paid when the goal is reached.
        phase: the agent's progress in its present decision.
        bumps: contacts of its body that have begun.
    """
    stages = _stages(agent)
    ledger, info, pictures = agent.ledger, block_info_of(agent), sensor_pictures_of(agent)
    reward, terms = ledger.finished
    return AgentState(
        id=agent.id,
        body=agent.body_name,
        brain=agent.brain.title(),
        percept=agent.percept,
        action=dict(agent.last_action),
        clipped=sum(actuator.clipped for actuator in agent.bound_blocks.actuators.values()),
        reward=reward,
        reward_terms=dict(terms),
        episode_reward=ledger.episode_total,
        episode_terms=dict(ledger.episode_terms),
        steps=agent.steps,
        terminated=agent.terminated,
        truncated=agent.truncated,
        paused=agent.paused,
        held_keys=agent.keyboard.held(),
        is_driven_by_keys=_is_driven_by_keys(agent),
        rays=pictures.rays,
        remote=agent.brain.status() if isinstance(agent.brain, RemoteBrain) else None,
        episode=agent.episode,
        succeeded=ledger.episode_terms.get(success, 0.0) > 0,
        fell=has_fallen(agent),
        needs=tuple(_needs(agent)),
        bumps=bumps,
        collects=sum(each.passed for each in stages)
        + sum(
            actuator.count
            for actuator in agent.bound_blocks.actuators.values()
            if isinstance(actuator, CollectActuator)
        ),
        stages=stages,
        seconds_left=_seconds_left(agent),
        spots=pictures.spots,
        legends=info.legends,
        phase=phase,
        history=ledger.latest(),
        sensor_infos=info.sensor_infos,
        actuator_infos=info.actuator_infos,
    )


def _is_driven_by_keys(agent: BasicAgent) -> bool:
    brain = agent.brain
    if isinstance(brain, RemoteBrain) and brain.override is not None:
        brain = brain.override
    return isinstance(getattr(brain, "controller", None), KEY_CONTROLLERS)


def has_fallen(agent: BasicAgent) -> bool:
    """Return True if an agent's episode has ended because it fell."""
    if not agent.terminated:
        return False
    low = agent.body.fallen and not agent.body.on_ground  # taken out without a fall: on ground
    ends = [
        reward
        for reward in agent.bound_blocks.rewards
        if reward.cause_episode_to_end and agent.ledger.terms.get(reward.name)
    ]
    # if the episode ended for another reason, a fall afterwards does not count
    return any(_is_for_falling(reward, low=low) for reward in ends) if ends else low


def _is_for_falling(reward: RewardFunc, *, low: bool) -> bool:
    children: Sequence[RewardFunc] = getattr(reward, "children", ())
    return isinstance(reward, FallReward) or (
        low and any(_is_for_falling(child, low=low) for child in children)
    )


def _stages(agent: BasicAgent) -> tuple[Stages, ...]:
    """Return the stages of each set of targets once, though several rewards may count them."""
    found: dict[tuple[str, ...], Stages] = {}
    for reward in agent.bound_blocks.rewards:
        stages = reward.stages()
        if stages is not None:
            found.setdefault(stages.targets, stages)
    return tuple(found.values())


def _seconds_left(agent: BasicAgent) -> float | None:
    limit = agent.max_steps_per_episode
    if not limit:
        return None
    return max(0, limit - agent.steps) * (agent.brain.skip_frame + 1) * agent.view.dt


def _needs(agent: BasicAgent) -> Iterator[Need]:
    for reward in agent.bound_blocks.rewards:
        if isinstance(reward, HomeostaticReward):
            for each in reward.variables:
                bounds = each.range_min, each.range_max
                comfort = each.comfort_min, each.comfort_max
                yield Need(each.name, each.level, bounds, comfort)

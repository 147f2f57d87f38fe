"""Recorded drives, and what happened in them, noted independently of the recorder."""

from dataclasses import dataclass, field
from typing import Any

from ai4u_edu import (
    BasicAgent,
    CircleShape,
    Command,
    ControlRequestor,
    LocalBrain,
    PositionSensor,
    RBMoveActuator,
    Scene,
    StepSensor,
    TouchRewardFunc,
    World,
)
from ai4u_edu.check.rollout import RandomDrive
from ai4u_edu.recording import Episode, Recorder
from ai4u_edu.snapshot import capture_bodies


@dataclass
class Note:
    """One decision: what was sensed before it, what was done, what was paid, where all was."""

    percept: bytes
    texts: tuple[str | tuple[str, ...], ...]
    poses: Any
    action: dict[str, tuple[float, ...]]
    terms: dict[str, float] = field(default_factory=dict)
    tick: int = 0


class Notes:
    """Writes down all decisions of all agents."""

    def __init__(self, sim: ControlRequestor) -> None:
        self.sim = sim
        self.of: dict[str, list[Note]] = {agent.id: [] for agent in sim.agents}
        for agent in sim.agents:
            agent.begin_of_step.connect(self._begin)
            agent.end_of_episode.connect(self._paid)
            agent.end_of_step.connect(self._paid)

    def _begin(self, agent: BasicAgent) -> None:
        percept = agent.percept
        note = Note(percept.data, percept.texts, capture_bodies(self.sim), dict(agent.last_action))
        note.tick = self.sim.world.ticks
        self.of[agent.id].append(note)

    def _paid(self, agent: BasicAgent) -> None:
        self.of[agent.id][-1].terms = agent.reward_terms


@dataclass
class Take:
    episode: Episode
    notes: dict[str, list[Note]]


def take(name: str, seed: int = 11, decisions: int = 120) -> Take:
    """Record a random drive in which every agent has its own decision interval."""
    scene = Scene.load(name)
    sim = scene.build()
    recorder = Recorder(sim, scene=scene.description)
    notes = Notes(sim)
    for number, agent in enumerate(sim.agents):
        drive = RandomDrive(agent)
        drive.restart(seed + number)
        agent.use_brain(
            LocalBrain(
                controller=drive,
                skip_frame=agent.brain.skip_frame + number,
                repeat_action=number % 2 == 0,
            )
        )
    sim.reset(seed)
    for _ in range(decisions):
        if all(agent.done for agent in sim.agents):
            break
        sim.step()
    recorder.finish()
    return Take(recorder.episodes[-1], notes.of)


def driver(agent: str, answers: Any, skip_frame: int = 2, **fields: Any) -> BasicAgent:
    """An agent on the body of its name that gives some answers, and then goes ahead."""
    rest = iter(answers)
    return BasicAgent(
        id=agent,
        body=agent,
        sensors=[PositionSensor(), StepSensor()],
        actuators=[RBMoveActuator(move_amount=2)],
        rewards=[TouchRewardFunc(target="ball")],
        brains=[
            LocalBrain(
                controller=lambda percept: next(rest, {"move": [1, 0.2, 0, 0]}),
                skip_frame=skip_frame,
            )
        ],
        **fields,
    )


def field_of(*agents: BasicAgent) -> ControlRequestor:
    """A ball, and agents around it."""
    world = World()
    world.add_body("ball", CircleShape(radius=0.4), position=(1.5, 0.2), tags=("target",))
    for number, agent in enumerate(agents):
        world.add_body(agent.body_name, CircleShape(radius=0.5), position=(0, 2 * number))
    return ControlRequestor(world, list(agents))


GO = {"move": [1, 0, 0, 0]}
LEFT = {"move": [0.5, -1, 0, 0]}
RESPAWN, WAIT, HOLD = Command.RESPAWN, Command.WAIT, Command.HOLD

"""A run of a scene with the block that is checked, under random actions."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple
from zlib import crc32

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.blocks import (
    Actuator,
    Answer,
    Block,
    Keyboard,
    LocalBrain,
    Percept,
    RewardFunc,
    Sensor,
)
from ai4u_edu.scenes import Scene

Script = Callable[[BasicAgent, int], None]
"""Called before each decision with the agent and the decision's number."""

Pose = tuple[float, float, float, float]

_KEY_NAMES = np.array(
    [
        *("ArrowUp", "ArrowDown", "ArrowLeft", "ArrowRight", "Space", "Enter"),
        *("KeyW", "KeyA", "KeyS", "KeyD", "KeyU", "KeyJ", "KeyG", "KeyR"),
    ]
)
_KEY_HELD_PROBABILITY = 0.1
"""Probability that a key is held during a decision."""

_MEAN_DECISIONS_HELD = 6
"""Mean number of decisions for which an action is kept: new ones each time would cancel out."""

_ZERO_PROBABILITY = 0.4
"""Probability that a component of an action is 0."""

NAMES = {Sensor: "perception_key", Actuator: "action_name", RewardFunc: "name"}

SCRIPTED = ("handler", "trainer")
"""Attributes that a script sets on a block; a copy needs them too."""


class RolloutStep(NamedTuple):
    """The state after one decision."""

    percepts: dict[str, Percept]
    """Percepts by agent id."""
    terms: dict[str, dict[str, float]]
    """Rewards by agent id and term name."""
    poses: dict[str, Pose]
    """Poses by body name."""
    traces: object
    """Traces in the world besides poses: a checksum of the ink, and messages."""
    answer: Answer | None
    """The answer of the first agent's brain in this decision."""
    done: bool
    """True if the first agent's episode is over."""


class Rollout:
    """A scene whose agents act at random, with the block under test on the first agent.

    Args:
        scene: the scene to build.
        block: is added to the first agent and replaces a block of the same name; a brain replaces
            the random one.
        actuators: are added to the first agent as well.
        without: the first agent's block of the same name is removed.
        script: called before every decision.
    """

    def __init__(
        self,
        scene: Scene,
        block: Block | None = None,
        *,
        actuators: Sequence[Actuator] = (),
        without: Block | None = None,
        script: Script | None = None,
    ) -> None:
        self.sim = scene.build()
        self.agent = self.sim.agents[0]
        self._script = script
        self._answer: Answer | None = None
        if without is not None:
            _take_off(self.agent, without)
        for each in actuators:
            _put_on(self.agent, each)
        self._drives = [RandomDrive(agent) for agent in self.sim.agents]
        for agent, drive in zip(self.sim.agents, self._drives, strict=True):
            # a clock that stands still: no key times out because the check is slow
            agent.keyboard = Keyboard(clock=lambda: 0.0)
            agent.brains[:] = [LocalBrain(controller=drive)]
        if block is not None:
            _put_on(self.agent, block)
        for agent in self.sim.agents:
            agent.setup(self.sim.world)
        self._record_answers(self.agent.brain)

    def run(self, seed: int, decisions: int) -> list[RolloutStep]:
        """Reset with a seed and run; return a record of each decision and each reset."""
        agent, sim = self.agent, self.sim
        sim.reset(seed)
        for number, drive in enumerate(self._drives):
            drive.restart(seed + number)
        keys = np.random.default_rng([seed, 1])
        self._answer = None
        records = [self._record()]
        for number in range(decisions):
            if self._script is not None:
                self._script(agent, number)
            agent.keyboard.hold(
                _KEY_NAMES[keys.random(len(_KEY_NAMES)) < _KEY_HELD_PROBABILITY].tolist()
            )
            sim.step()
            records.append(self._record())
            if agent.done or agent.stopped:
                sim.reset()
                records.append(self._record())
        return records

    def _record(self) -> RolloutStep:
        agents = self.sim.agents
        return RolloutStep(
            percepts={agent.id: agent.percept for agent in agents},
            terms={agent.id: agent.reward_terms for agent in agents},
            poses={name: body.pose for name, body in self.sim.world.bodies.items()},
            traces=(self.sim.world.ink.digest, self.sim.world.messages.get_state()),
            answer=self._answer,
            done=self.agent.done,
        )

    def _record_answers(self, brain: Any) -> None:
        decide = brain.decide

        def recorded(percept: Percept) -> Answer:
            answer: Answer = decide(percept)
            self._answer = answer
            return answer

        brain.decide = recorded


class RandomDrive:
    """A random controller; one actuator's actions don't depend on which others there are.

    Args:
        agent: the agent whose actuators it drives.
    """

    def __init__(self, agent: BasicAgent) -> None:
        self._agent = agent
        self.restart(0)

    def restart(self, seed: int) -> None:
        """Start again from a seed."""
        self._seed = seed
        self._rngs: dict[str, np.random.Generator] = {}
        self._held: dict[str, Any] = {}

    def __call__(self, _percept: Percept) -> dict[str, Any]:
        """Return an action for every actuator that takes one."""
        for name, actuator in self._agent.bound_blocks.actuators.items():
            if actuator.is_output:
                rng = self._rngs.setdefault(
                    name, np.random.default_rng([self._seed, crc32(name.encode())])
                )
                if name not in self._held or rng.random() < 1 / _MEAN_DECISIONS_HELD:
                    self._held[name] = _drawn(actuator, rng)
        return dict(self._held)


def _drawn(actuator: Actuator, rng: np.random.Generator) -> Any:
    low, high = actuator.limits()
    if not actuator.is_continuous:
        return int(rng.integers(int(low[0]), int(high[0]) + 1))
    rests = rng.random(len(low)) < _ZERO_PROBABILITY
    # an unbounded component is drawn from -10..10
    numbers = rng.uniform(np.maximum(low, -10.0), np.minimum(high, 10.0))
    return np.where(rests, np.clip(0.0, low, high), numbers).tolist()


def standard_scene() -> Scene:
    """Load the small world in which blocks are checked."""
    return Scene.load(Path(__file__).with_name("standard_world.yaml"))


def fresh(value: Any) -> Any:
    """Return a deep copy of blocks, made again from their parameters; other values are shared."""
    if isinstance(value, Block):
        new = type(value)(**{name: fresh(each) for name, each in value.values().items()})
        for name in SCRIPTED:
            if name in vars(value):
                setattr(new, name, vars(value)[name])
        return new
    if isinstance(value, Mapping):
        return {name: fresh(each) for name, each in value.items()}
    if isinstance(value, list | tuple):
        return type(value)(fresh(each) for each in value)
    return value


def _put_on(agent: BasicAgent, block: Block) -> None:
    """Give an agent a block, replacing one of the same name."""
    _take_off(agent, block)
    _row_for(agent, block).append(block)


def _take_off(agent: BasicAgent, block: Block) -> None:
    """Remove an agent's blocks of the same kind and name; for a brain, all brains."""
    row = _row_for(agent, block)
    row[:] = [each for each in row if name_of(each) != name_of(block)]


def name_of(block: Block) -> str:
    """Return a block's name; empty if its kind has none."""
    for kind, field in NAMES.items():
        if isinstance(block, kind):
            return str(getattr(block, field))
    return ""


def title_of(block: Block) -> str:
    """Return a block's class and name."""
    name = name_of(block)
    return f"{type(block).__name__} {name!r}" if name else type(block).__name__


def _row_for(agent: BasicAgent, block: Block) -> list[Any]:
    if isinstance(block, Sensor):
        return agent.sensors
    if isinstance(block, Actuator):
        return agent.actuators
    return agent.rewards if isinstance(block, RewardFunc) else agent.brains

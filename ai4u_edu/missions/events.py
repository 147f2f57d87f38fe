"""Events of a world and its page, as the checks of missions see them."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.agent.driving_keys import active_brain, has_driving_keys
from ai4u_edu.blocks import LinearRayCastingSensor, NeuralNetController, RemoteBrain
from ai4u_edu.blocks.sensors.ray_sensor import spread
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.snapshot import has_fallen

Driver = Literal["keys", "program", "network", "controller"]
"""Kinds of drivers; blocks are a program, and a controller is one that comes with the package."""
AHEAD_DEG = 20.0
"""Angle (degrees) up to which a ray looks ahead, as in the blocks of programs."""


@dataclass(frozen=True)
class Decision:
    """One decision of an agent, when its percept and reward are final."""

    driver: Driver
    episode: int
    """Number of the agent's episode."""
    step: int
    """Number of the decision in it, from 1; 0 for the moment before the first one."""
    seed: int
    seconds: float
    """Time (s) in the world since its reset."""
    x: float
    """Place of the body (m)."""
    y: float
    heading: float
    """Heading (rad), counter-clockwise."""
    speed: float
    """Speed (m/s), above 0 forward."""
    turning: float
    """Turning speed (degrees/s), above 0 to the left."""
    terms: Mapping[str, float]
    """Reward of the decision, by term."""
    reward_types: Mapping[str, str] = field(repr=False)
    """Class of each reward function, by its name."""
    outcome: Literal["", "goal", "fell", "time", "over"]
    """End of the episode; empty before it."""
    percept: Mapping[str, Any] = field(repr=False)
    distances: Mapping[str, float] = field(repr=False)
    """Distance (m) to what is nearest, by the side: around, ahead, left, right; empty without a
    flat fan of rays that read distances."""
    network: str = ""
    """File of the network that drives; empty for another driver."""
    acts: bool = True
    """False if the action was all zeros: whatever moved the robot, its driver did not."""

    def value_of(self, what: str) -> float:
        """Return a quantity, such as ``speed``, ``distance ahead`` or a number of a sensor."""
        if what in ("speed", "turning"):
            return self.speed if what == "speed" else self.turning
        if what.startswith("distance "):
            return self.distances[what.removeprefix("distance ")]
        key, _, part = what.rstrip("]").partition("[")
        return float(np.asarray(self.percept[key]).reshape(-1)[int(part or 0)])


@dataclass(frozen=True)
class SeenPage:
    """The tab that a person has open in the page."""

    tab: str
    way: str = ""
    """``python`` or ``blocks``, as the program in the tab "Code" is written; empty before that was
    open."""


@dataclass(frozen=True)
class PersonAnswer:
    """An answer that a person has typed or chosen, and the decision before it."""

    text: str
    decision: Decision | None


@dataclass(frozen=True)
class Verdict:
    """The opinion of an exercise's judge on a person's work."""

    passed: bool
    text: str


Event = Decision | SeenPage | PersonAnswer | Verdict | SceneDescription


def decision_of(sim: ControlRequestor, agent: BasicAgent) -> Decision:
    """Return an agent's latest decision, for checks; call it in its event ``percept_ready``."""
    body, percept = agent.body, agent.percept
    (x, y), (vx, vy) = body.position, body.velocity
    outcome: Literal["", "goal", "fell", "time", "over"] = ""
    if agent.done:
        has_succeeded = agent.ledger.episode_terms.get(sim.success, 0.0) > 0
        outcome = "fell" if has_fallen(agent) else "time" if agent.truncated else "over"
        outcome = "goal" if has_succeeded else outcome
    return Decision(
        driver=driver_of(agent),
        episode=agent.episode,
        step=agent.steps,
        seed=sim.world.seeds.seed,
        seconds=sim.world.time,
        x=x,
        y=y,
        heading=body.heading,
        speed=vx * math.cos(body.heading) + vy * math.sin(body.heading),
        turning=math.degrees(body.angular_velocity),
        terms=dict(agent.ledger.terms) if agent.steps else {},
        reward_types={reward.name: type(reward).__name__ for reward in agent.rewards},
        outcome=outcome,
        percept=percept,
        distances=distances_of(agent),
        network=getattr(getattr(active_brain(agent.brain), "controller", None), "model_path", ""),
        acts=any(any(numbers) for numbers in agent.last_action.values()),
    )


def driver_of(agent: BasicAgent) -> Driver:
    """Return the kind of driver that decides for an agent now."""
    if has_driving_keys(agent):
        return "keys"
    brain = active_brain(agent.brain)
    if isinstance(brain, RemoteBrain):
        return "program"
    controller = getattr(brain, "controller", None)
    return "network" if isinstance(controller, NeuralNetController) else "controller"


def distances_of(agent: BasicAgent) -> dict[str, float]:
    """Return the nearest distance (m) of each side, by the agent's first flat fan of rays."""
    sensor = ray_sensor_of(agent)
    if sensor is None:
        return {}
    width = 1 + sensor.return_code
    numbers = np.asarray(agent.percept[sensor.perception_key]).reshape(-1, width)[:, -1]
    metres = np.where(numbers == 0, 1.0, numbers / sensor.farthest) * sensor.vision_max_distance
    angles = np.degrees(spread(sensor.number_of_rays, sensor.field_of_view))
    angles = angles - sensor.horizontal_shift
    sides = {
        "around": np.full(len(angles), fill_value=True),
        "ahead": np.abs(angles) <= AHEAD_DEG,
        "left": angles > AHEAD_DEG,
        "right": angles < -AHEAD_DEG,
    }
    return {side: float(metres[rays].min()) for side, rays in sides.items() if rays.any()}


def ray_sensor_of(agent: BasicAgent) -> LinearRayCastingSensor | None:
    """Return the sensor by which a check knows distances; None if the agent has none."""
    for sensor in agent.sensors:
        if isinstance(sensor, LinearRayCastingSensor) and sensor.stacked_observations == 1:
            return sensor if sensor.return_distance else None
    return None

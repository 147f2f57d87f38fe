"""A scripted beginner at the keyboard, who does what a scene's page says.

It sees the world as it was a reaction time ago, knows four directions of driving, and keeps each
choice of keys for a moment. It goes through the agent's keyboard, as a page does.
"""

import math
from collections import deque
from collections.abc import Callable
from typing import NamedTuple

from ai4u_edu import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.snapshot import capture_agent

REACTION_S = 0.2
HOLD_S = 0.15
"""Shortest time for which keys are held."""
STRAIGHT_RAD, SHARP_RAD = math.radians(12), math.radians(50)
"""Errors of the direction below which it does not steer, and above which it stops to turn."""

Point = tuple[float, float]
Keys = frozenset[str]


class Sight(NamedTuple):
    """The part of the world's state that a person sees at one moment."""

    at: dict[str, Point]
    """Positions of all bodies that are there."""
    heading: float
    """The own body's heading, radians."""
    me: str
    """Name of the own body."""

    @property
    def own(self) -> Point:
        """The own position."""
        return self.at[self.me]


Plan = Callable[[Sight], Keys]
"""Chooses the keys to hold for what it sees."""
Planner = Callable[[ControlRequestor], Plan]
"""Makes a plan for an episode that has just begun."""


class Try(NamedTuple):
    """The end of one try."""

    won: bool
    fell: bool
    seconds: float


def play(sim: ControlRequestor, planner: Planner, seed: int) -> Try:
    """Play one episode with the first agent's keyboard."""
    sim.reset(seed)
    agent, plan = sim.agents[0], planner(sim)
    decision_s = (agent.brain.skip_frame + 1) / sim.world.settings.ticks_per_second
    seen = deque([look(sim, agent)], maxlen=math.ceil(REACTION_S / decision_s) + 1)
    held: Keys = frozenset()
    held_for = HOLD_S
    while not agent.done:
        wanted = plan(seen[0])
        if wanted != held and held_for >= HOLD_S:
            held, held_for = wanted, 0.0
        agent.keyboard.hold(held)
        sim.step(agent)
        held_for += decision_s
        seen.append(look(sim, agent))
    agent.keyboard.release()
    won = agent.ledger.episode_terms.get(sim.success, 0.0) > 0
    return Try(won, not won and capture_agent(agent).fell, agent.steps * decision_s)


def look(sim: ControlRequestor, agent: BasicAgent) -> Sight:
    """Return what a person sees now."""
    at = {body.name: body.position for body in sim.world.bodies.values() if not body.fallen}
    at[agent.body_name] = agent.body.position
    return Sight(at, agent.body.heading, agent.body_name)


def direction(start: Point, end: Point) -> float:
    """Return the direction from one point to another, radians."""
    return math.atan2(end[1] - start[1], end[0] - start[0])


def towards(sight: Sight, goal: Point) -> Keys:
    """Return the keys that turn towards a point and drive there."""
    error = math.remainder(direction(sight.own, goal) - sight.heading, 2 * math.pi)
    turn = "KeyA" if error > 0 else "KeyD"
    if abs(error) < STRAIGHT_RAD:
        return frozenset({"KeyW"})
    return frozenset({turn}) if abs(error) > SHARP_RAD else frozenset({"KeyW", turn})

"""Small worlds for tests."""

from collections.abc import Sequence
from typing import Any

from ai4u_edu import (
    Actuator,
    BasicAgent,
    BoxShape,
    Brain,
    CircleShape,
    ControlRequestor,
    LocalBrain,
    RBMoveActuator,
    RewardFunc,
    Sensor,
    World,
)


def still(_percept: Any) -> dict[str, Any]:
    """A controller that does nothing."""
    return {}


def small_world(*, plate: float = 0.0) -> World:
    """A robot at the origin that looks along +x, and a box four metres ahead of it."""
    world = World()
    if plate:
        world.add_floor("plate", BoxShape(size=(plate, plate)))
    world.add_body("robot", CircleShape(radius=0.5))
    world.add_body("box", BoxShape(size=(1, 1)), position=(4, 0), tags=("target",))
    return world


def small_sim(
    sensors: Sequence[Sensor] = (),
    *,
    actuators: Sequence[Actuator] | None = None,
    rewards: Sequence[RewardFunc] = (),
    brains: Sequence[Brain] | None = None,
    world: World | None = None,
    controller: Any = still,
    **fields: Any,
) -> ControlRequestor:
    """One agent in a small world, reset and ready."""
    brain = LocalBrain(controller=controller, skip_frame=fields.pop("skip_frame", 0))
    agent = BasicAgent(
        body="robot",
        sensors=list(sensors),
        actuators=[RBMoveActuator(move_amount=2)] if actuators is None else list(actuators),
        rewards=list(rewards),
        brains=[brain] if brains is None else list(brains),
        **fields,
    )
    sim = ControlRequestor(world or small_world(), [agent])
    sim.reset(seed=0)
    return sim

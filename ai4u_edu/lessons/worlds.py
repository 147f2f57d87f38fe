"""Worlds in which exercises are checked; what is in them lies elsewhere in each episode."""

from typing import Any

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import Brain, LocalBrain
from ai4u_edu.lessons.exercise import NotYet
from ai4u_edu.world import BoxShape, CircleShape, Variation, World

ANYWHERE = Variation(x=(-3.5, 3.5), y=(-3.5, 3.5), heading_deg=(-180, 180), clearance=1.0)


def plate(
    robot: Variation | None = ANYWHERE, box: Variation | None = ANYWHERE, *, size: float = 10
) -> World:
    """A square plate over the void with a robot and a box.

    Args:
        robot: where the robot may be; None for the middle, looking along +x.
        box: where the box may be; None for 3 m in front of the middle.
        size: the plate's side, metres.
    """
    world = World()
    world.add_floor("plate", BoxShape(size=(size, size)))
    world.add_body("robot", CircleShape(radius=0.5), tags=("agent",), random=robot)
    world.add_body("box", BoxShape(size=(1, 1)), position=(3, 0), tags=("target",), random=box)
    return world


def put_in(agent: Any, world: World, brain: Brain | None = None) -> ControlRequestor:
    """A student's agent in a world.

    Args:
        agent: what they made.
        world: where it is put.
        brain: drives in place of their own; left out, theirs does.

    Raises:
        NotYet: it is no agent, or has nobody to drive it.
    """
    if not isinstance(agent, BasicAgent):
        raise NotYet(f"Expected an agent, made with `BasicAgent(...)`, got `{agent!r}`.")
    if brain is not None:
        agent = agent.changed(brains=[brain])
    return ControlRequestor(world, [agent])


def forward(amount: float = 1.0, turn: float = 0.0) -> LocalBrain:
    """A brain that always does the same."""
    return LocalBrain(controller=lambda _: {"move": [amount, turn, 0, 0]})

"""Worlds in which exercises are checked, random in each episode."""

from typing import Any

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import Brain, LocalBrain
from ai4u_edu.lessons.exercise import NotYet
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import BoxShape, CircleShape, Variation, World

ANYWHERE = Variation(x=(-3.5, 3.5), y=(-3.5, 3.5), heading_deg=(-180, 180), clearance=1.0)


def plate(
    robot: Variation | None = ANYWHERE, box: Variation | None = ANYWHERE, *, size: float = 10
) -> World:
    """Return a square plate over the void with a robot and a box.

    Args:
        robot: range of the robot's place; None for the middle, looking along +x.
        box: range of the box's place; None for 3 m in front of the middle.
        size: the plate's side, metres.
    """
    world = World()
    world.add_floor("plate", BoxShape(size=(size, size)))
    world.add_body("robot", CircleShape(radius=0.5), tags=("agent",), random=robot)
    world.add_body("box", BoxShape(size=(1, 1)), position=(3, 0), tags=("target",), random=box)
    return world


def put_in(agent: Any, world: World, brain: Brain | None = None) -> ControlRequestor:
    """Put a student's agent into a world.

    Args:
        agent: the student's agent.
        world: the world.
        brain: a driver in place of the agent's own.

    Raises:
        NotYet: it is no agent, or has nobody to drive it.
    """
    if not isinstance(agent, BasicAgent):
        raise NotYet(
            _("Expected an agent, made with `BasicAgent(...)`, got `{got}`.", got=repr(agent))
        )
    if brain is not None:
        agent = agent.changed(brains=[brain])
    return ControlRequestor(world, [agent])


def forward(amount: float = 1.0, turn: float = 0.0) -> LocalBrain:
    """Return a brain that always does the same."""
    return LocalBrain(controller=lambda _: {"move": [amount, turn, 0, 0]})

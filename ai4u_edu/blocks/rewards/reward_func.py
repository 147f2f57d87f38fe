"""What every reward function has: a name, and the amount that it pays for each decision."""

from typing import Any

from ai4u_edu.base.errors import BlockError
from ai4u_edu.blocks.block import Block, default_name, levels_up
from ai4u_edu.world import BodyView, WorldView


class RewardFunc(Block):
    """The base of all reward functions: fill :meth:`on_update`.

    >>> from ai4u_edu import BasicAgent, CircleShape, ControlRequestor, LocalBrain, World
    >>> class StayNear(RewardFunc):
    ...     '''Costs a point for each metre to a body.'''
    ...     target: str
    ...     def on_update(self, body, view): return -body.distance(view[self.target])
    >>> world = World()
    >>> robot = world.add_body("robot", CircleShape(radius=0.5))
    >>> box = world.add_body("box", CircleShape(radius=0.5), position=(3, 4))
    >>> agent = BasicAgent(
    ...     body="robot",
    ...     rewards=[StayNear(target="box")],
    ...     brains=[LocalBrain(controller=lambda percept: {})],
    ... )
    >>> sim = ControlRequestor(world, [agent])
    >>> sim.reset()
    >>> percept = sim.step()
    >>> agent.reward_terms
    {'stay_near': -5.0}
    """

    name: str = ""
    """The term's name in the breakdown of rewards; left out: from the class's name."""
    cause_episode_to_end: bool = False
    """True ends the episode when this pays something; And and Or end it when they hold."""
    is_active: bool = True
    """False switches the reward function off: it pays nothing."""

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        if levels_up(cls, "on_update") < levels_up(cls, "holds"):
            cls.holds = RewardFunc.holds  # type: ignore[method-assign]  # the other was for another

    def __post_init__(self) -> None:
        self.name = self.name or default_name(type(self), "RewardFunc", "Reward", "Func")

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """What the decision that just ended is worth.

        Args:
            body: the agent's body.
            view: the world, to be asked.
        """
        raise BlockError(
            f"{type(self).__name__} has no on_update(self, body, view): it must return a number"
        )

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        """Tell whether the thing it watches for is the case: And and Or ask, after on_update.

        It should not depend on the amounts: a touch is a touch, even if it pays nothing. A class
        of your own that leaves this out holds where it pays something.

        Args:
            paid: what on_update returned just now; by default it holds where that is not 0.
            body: the agent's body.
            view: the world, to be asked.
        """
        return paid != 0.0

    def ends(self, paid: float) -> bool:
        """Tell whether the decision that just ended ends the episode, if this may end it at all.

        Args:
            paid: what on_update returned just now; by default it ends where that is not 0.
        """
        return paid != 0.0

    @property
    def has_ticks(self) -> bool:
        """Whether on_tick is filled; where none is, all ticks of a decision may pass at one go."""
        return type(self).on_tick is not RewardFunc.on_tick

    def on_tick(self, body: BodyView, view: WorldView) -> None:
        """Called after every tick of a decision; only where a subclass fills it."""

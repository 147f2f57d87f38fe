"""The base of reward functions: a name, and an amount for each decision."""

from typing import Any, NamedTuple

from ai4u_edu.base.errors import BlockError
from ai4u_edu.blocks.block import Block, default_name, levels_up
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import BodyView, WorldView


class Stages(NamedTuple):
    """Stages on the way to a goal, such as marks to pass or bodies to collect."""

    passed: int
    """Number of stages passed in this episode; 0 to ``total``."""
    total: int
    targets: tuple[str, ...]
    """Names of the bodies and areas that they stand for, in order if the order counts."""
    ahead: tuple[str, ...] = ()
    """Names of those that are not passed."""
    next: tuple[str, ...] = ()
    """Names of those that count now: one if the order counts, else all that are ahead."""


class RewardFunc(Block):
    """The base of all reward functions: override :meth:`on_update`.

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
    """Name of the term in the breakdown of rewards; left out: derived from the class's name."""
    cause_episode_to_end: bool = False
    """True ends the episode when this pays something; And and Or end it when they hold."""
    is_active: bool = True
    """False switches the reward function off: it pays nothing."""

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        if levels_up(cls, "on_update") < levels_up(cls, "holds"):
            cls.holds = RewardFunc.holds  # type: ignore[method-assign]  # the inherited one fits the inherited on_update

    def __post_init__(self) -> None:
        self.name = self.name or default_name(type(self), "RewardFunc", "Reward", "Func")

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """Return the reward of the decision that just ended.

        Args:
            body: the agent's body.
            view: a read-only view of the world.
        """
        raise BlockError(
            _(
                "{type} has no on_update(self, body, view): it must return a number",
                type=type(self).__name__,
            )
        )

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        """Return True if its condition is met; AndRewardFunc and OrRewardFunc use it.

        It is called after on_update, and should not depend on the amounts: a touch that pays
        nothing still is a touch. A class that doesn't override this holds when it pays something.

        Args:
            paid: the last result of on_update; by default it holds if that is not 0.
            body: the agent's body.
            view: a read-only view of the world.
        """
        return paid != 0.0

    def ends(self, paid: float) -> bool:
        """Return True to end the episode; used only with ``cause_episode_to_end``.

        Args:
            paid: the last result of on_update; by default the episode ends if that is not 0.
        """
        return paid != 0.0

    def stages(self) -> Stages | None:
        """Return the stages that it pays for, to be shown to a person; None if it has none."""
        return None

    @property
    def has_ticks(self) -> bool:
        """True if on_tick is overridden; only then is it called."""
        return type(self).on_tick is not RewardFunc.on_tick

    def on_tick(self, body: BodyView, view: WorldView) -> None:
        """React to a tick; called after every tick of a decision if a subclass overrides it."""

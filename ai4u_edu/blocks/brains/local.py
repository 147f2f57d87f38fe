"""A brain in this process."""

from collections.abc import Callable, Sequence
from typing import Any, cast

from pydantic import field_validator

from ai4u_edu.base.errors import SetupError, shown
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.block import Block
from ai4u_edu.blocks.brains.brain import Answer, Brain
from ai4u_edu.blocks.brains.controllers.controller import Controller
from ai4u_edu.blocks.brains.controllers.script import ScriptController
from ai4u_edu.blocks.parameterized import Parameterized
from ai4u_edu.blocks.percept import Percept
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import WorldView


class LocalBrain(Brain):
    """Decides by its controller: a keyboard, a Python function, a network.

    A plain function from percept to action may be given as the controller.

    >>> LocalBrain(controller=lambda percept: {"move": [1, 0, 0, 0]}).skip_frame
    4
    """

    controller: Controller | Callable[[Percept], Answer]
    """The controller that is asked, or a function from percept to action."""

    @field_validator("controller", mode="before")
    @classmethod
    def _wrapped(cls, controller: Any) -> Controller:
        if isinstance(controller, Controller):
            return controller
        if callable(controller) and not isinstance(controller, type):
            return ScriptController(function=controller)
        got = shown(controller)
        if isinstance(controller, type):
            name = controller.__name__
            got = _("the class {name}; make one, as in {name}()", name=name)
        raise ValueError(
            _("expected a controller, or a function from percept to action, got {got}", got=got)
        )

    def inner_blocks(self) -> Sequence[Block]:
        """Return the controller."""
        return (self._controller,)

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Set the controller up."""
        self._controller.on_setup(agent, view)

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Reset the controller."""
        self._controller.on_reset(agent, view)

    def decide(self, percept: Percept) -> Answer:
        """Return the controller's answer."""
        controller = self._controller
        controller.new_state_event(percept)
        return controller.get_action(percept)

    def title(self) -> str:
        """Return the name of the brain and its controller."""
        return f"{type(self).__name__}({type(self.controller).__name__})"

    @property
    def _controller(self) -> Controller:
        return cast(Controller, self.controller)  # the validator wraps functions


def as_brain(given: object) -> Brain:
    """Return a brain unchanged, or a LocalBrain for a controller or a function.

    Raises:
        SetupError: the value is none of these.
    """
    if isinstance(given, Brain):
        return given
    if can_drive(given):
        return LocalBrain(controller=given)  # type: ignore[arg-type]  # can_drive checked it
    got = repr(given)
    if isinstance(given, type):
        got = _("the class {name}", name=given.__name__)
    raise SetupError(
        _(
            "expected a brain, a controller or a function from percept to action, got {got}; "
            "a brain is made as in LocalBrain(controller=WASDRBMoveController())",
            got=got,
        )
    )


def can_drive(given: object) -> bool:
    """Return True for a controller or a function, which a LocalBrain can hold."""
    if isinstance(given, Controller):
        return True
    return callable(given) and not isinstance(given, type | Parameterized)

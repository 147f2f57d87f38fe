"""A controller that does what a script requests, one action at a time."""

from collections.abc import Sequence
from typing import Any, ClassVar

import numpy as np

from ai4u_edu.base.errors import ActionError, suggest
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.brains.command import Answer, Command
from ai4u_edu.blocks.brains.controllers.controller import Controller
from ai4u_edu.blocks.percept import Percept
from ai4u_edu.world import WorldView

__all__ = ["TrainController", "Trainer"]


class Trainer:
    """A script that drives an agent by the requests that it makes to its TrainController.

    Fill :meth:`state_updated`, and give it to the controller: ``controller.trainer = MyTrainer()``.
    """

    controller: "TrainController"
    """The controller that takes the requests; known once the agent is set up."""
    agent: AgentView
    """The agent that is driven; known once it is set up."""

    def on_setup(self) -> None:
        """Called when the agent is set up; controller and agent are known by then."""

    def on_reset(self) -> None:
        """Called at each reset, before the first percept of the episode."""

    def state_updated(self, percept: Percept) -> None:
        """Called before each decision; what it requests is done in this very decision.

        Args:
            percept: the agent's readings now.
        """


class TrainController(Controller):
    """Does what a script requests, once for each request, and nothing where there is none.

    A script calls :meth:`request_continuous_action` or :meth:`request_action` with an actuator's
    name and numbers: the next decision takes them. Requests to several actuators are taken
    together; of two to the same actuator, the later one counts. Without a request the decision is
    an empty action: no actuator acts, and the body rolls on as the physics has it. A reset forgets
    what was requested before.

    A :class:`Trainer` in ``trainer`` is told of each new percept, and requests from there. A script
    that steps the world itself requests between two steps. Both in the world's own thread: requests
    are not thread-safe.

    Source: AI4U's TrainController.

    Differs from AI4U: a request names its actuator, so several can be under way. The trainer gets
    the percept, in place of GetStateAsFloat and its like, and asks for a new episode by
    ``request_restart()``.

    >>> from ai4u_edu import LocalBrain, Scene, TrainController, Trainer
    >>> class Chase(Trainer):
    ...     '''Turns until the box is ahead, then drives at it.'''
    ...     def state_updated(self, percept):
    ...         is_ahead = percept["orientation"][0] > 0.95
    ...         action = [1, 0, 0, 0] if is_ahead else [0, 0.3, 0, 0]
    ...         self.controller.request_continuous_action("move", action)
    >>> controller = TrainController()
    >>> controller.trainer = Chase()
    >>> sim = Scene.load("box_chase").build()
    >>> robot = sim.agents[0]
    >>> robot.use_brain(LocalBrain(controller=controller))
    >>> sim.reset(seed=3)
    >>> while not robot.done:
    ...     percept = sim.step()
    >>> robot.reward_terms["touch"]
    100.0
    """

    needs_script: ClassVar[bool] = True
    """The page offers no driver that does nothing by itself."""

    def __post_init__(self) -> None:
        self.trainer: Trainer | None = None
        """The script that is told of each new percept; None: requests come from somewhere else."""
        self._agent: AgentView | None = None
        self._requested: dict[str, Any] = {}
        self._wants_restart = False

    def request_continuous_action(self, name: str, values: Sequence[float]) -> None:
        """Request an action of numbers for the next decision.

        Args:
            name: the actuator's action name.
            values: as many numbers as the actuator takes.

        Raises:
            ActionError: there is no such actuator, or these are no finite numbers.
        """
        self._request(name, values, "finite numbers")

    def request_action(self, name: str, values: Sequence[int]) -> None:
        """Request an action of whole numbers for the next decision: one choice, as a list.

        Args:
            name: the actuator's action name.
            values: whole numbers, such as ``[2]`` for choice 2 of a DiscreteActuator.

        Raises:
            ActionError: there is no such actuator, or these are no whole numbers.
        """
        self._request(name, values, "whole numbers", are_whole=True)

    def request_restart(self) -> None:
        """Request a new episode in place of the next decision."""
        self._wants_restart = True

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Introduces the trainer to the agent."""
        self._agent = agent
        self._forget()
        if self.trainer is not None:
            self._introduce(self.trainer).on_setup()

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Forgets what was requested."""
        self._forget()
        if self.trainer is not None:
            self._introduce(self.trainer).on_reset()

    def new_state_event(self, percept: Percept) -> None:
        """Tells the trainer."""
        if self.trainer is not None:
            self._introduce(self.trainer).state_updated(percept)

    def get_action(self, percept: Percept) -> Answer:
        """All that was requested since the last decision."""
        requested, restart = self._requested, self._wants_restart
        self._forget()
        return Command.RESTART if restart else requested

    def _introduce(self, trainer: Trainer) -> Trainer:
        # each time: one trainer may drive copies of this controller in turns
        trainer.controller = self
        if self._agent is not None:
            trainer.agent = self._agent
        return trainer

    def _forget(self) -> None:
        self._requested, self._wants_restart = {}, False

    def _request(self, name: str, values: Any, expected: str, *, are_whole: bool = False) -> None:
        if self._agent is not None:
            known = {each.action_name for each in self._agent.actuators if each.is_active}
            if name not in known:
                raise ActionError(f"no actuator is called {name!r}; {suggest(name, known)}")
        try:
            numbers = np.asarray(values)
            if not are_whole:
                numbers = numbers.astype(np.float64)
            kinds = "iu" if are_whole else "f"
            fits = numbers.dtype.kind in kinds and bool(np.isfinite(numbers).all())
        except (TypeError, ValueError):
            fits = False
        if not fits or numbers.ndim != 1:
            raise ActionError(f"action {name!r}: expected {expected} in a list, got {values!r}")
        self._requested[name] = tuple(numbers.tolist())

"""A controller that executes a script's requests."""

from collections.abc import Sequence
from typing import Any, ClassVar

import numpy as np

from ai4u_edu.base.errors import ActionError, suggest
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.brains.brain import Answer, Command
from ai4u_edu.blocks.brains.controllers.controller import Controller
from ai4u_edu.blocks.percept import Percept
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import WorldView

__all__ = ["TrainController", "Trainer"]


class Trainer:
    """A script that drives an agent by requests to its TrainController.

    Override :meth:`state_updated`, and set ``controller.trainer = MyTrainer()``.
    """

    controller: "TrainController"
    """The controller that takes the requests; available once the agent is set up."""
    agent: AgentView
    """The agent that it drives; available once the agent is set up."""

    def on_setup(self) -> None:
        """Prepare; called when the agent is set up, with controller and agent available."""

    def on_reset(self) -> None:
        """Prepare for an episode; called at each reset, before its first percept."""

    def state_updated(self, percept: Percept) -> None:
        """Request actions; called before each decision, which executes them.

        Args:
            percept: the agent's present readings.
        """


class TrainController(Controller):
    """Executes a script's requests, each one once; without a request no actuator acts.

    A script calls :meth:`request_continuous_action` or :meth:`request_action` with an actuator's
    name and numbers; the next decision executes them. Requests to several actuators are combined;
    of two to the same actuator, the later one counts. Without a request the body only moves by its
    momentum. A reset discards pending requests.

    A :class:`Trainer` in ``trainer`` is called with each new percept, and makes requests then. A
    script that steps the world itself makes requests between two steps. Both run in the world's
    thread: requests are not thread-safe.

    Source: AI4U's TrainController.

    Differs from AI4U: a request names its actuator, so a decision can have several. The trainer
    gets the percept instead of calling GetStateAsFloat and the like, and starts a new episode with
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
    """Marks a controller that does nothing without a script; the page doesn't offer it."""

    def __post_init__(self) -> None:
        self.trainer: Trainer | None = None
        """The script that is called with each new percept; None if requests come from elsewhere."""
        self._agent: AgentView | None = None
        self._requested: dict[str, Any] = {}
        self._wants_restart = False

    def request_continuous_action(self, name: str, values: Sequence[float]) -> None:
        """Request an action of numbers for the next decision.

        Args:
            name: the actuator's action name.
            values: as many numbers as the actuator takes.

        Raises:
            ActionError: there is no such actuator, or these are not finite numbers.
        """
        self._request(name, values, _("finite numbers"))

    def request_action(self, name: str, values: Sequence[int]) -> None:
        """Request an action of whole numbers for the next decision: one choice, as a list.

        Args:
            name: the actuator's action name.
            values: whole numbers, such as ``[2]`` for choice 2 of a DiscreteActuator.

        Raises:
            ActionError: there is no such actuator, or these are not whole numbers.
        """
        self._request(name, values, _("whole numbers"), are_whole=True)

    def request_restart(self) -> None:
        """Request a new episode in place of the next decision."""
        self._wants_restart = True

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Connect the trainer to the agent."""
        self._agent = agent
        self._forget()
        if self.trainer is not None:
            self._introduce(self.trainer).on_setup()

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Discard pending requests."""
        self._forget()
        if self.trainer is not None:
            self._introduce(self.trainer).on_reset()

    def new_state_event(self, percept: Percept) -> None:
        """Call the trainer."""
        if self.trainer is not None:
            self._introduce(self.trainer).state_updated(percept)

    def get_action(self, percept: Percept) -> Answer:
        """Return all requests since the last decision."""
        requested, restart = self._requested, self._wants_restart
        self._forget()
        return Command.RESTART if restart else requested

    def _introduce(self, trainer: Trainer) -> Trainer:
        # at each call, since one trainer may drive several copies of this controller
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
                raise ActionError(
                    _(
                        "no actuator is called {name!r}; {hint}",
                        name=name,
                        hint=suggest(name, known),
                    )
                )
        try:
            numbers = np.asarray(values)
            if not are_whole:
                numbers = numbers.astype(np.float64)
            kinds = "iu" if are_whole else "f"
            fits = numbers.dtype.kind in kinds and bool(np.isfinite(numbers).all())
        except (TypeError, ValueError):
            fits = False
        if not fits or numbers.ndim != 1:
            raise ActionError(
                _(
                    "action {name!r}: expected {expected} in a list, got {values}",
                    name=name,
                    expected=expected,
                    values=repr(values),
                )
            )
        self._requested[name] = tuple(numbers.tolist())

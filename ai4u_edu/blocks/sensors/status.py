"""Sensors of the agent's own episode: done, truncated, id, steps, reward, last action."""

from typing import Annotated

import numpy as np
from gymnasium.spaces import Box, Discrete, Text
from pydantic import Field

from ai4u_edu.base.errors import BlockError, suggest
from ai4u_edu.base.parameters import MAX_COUNT, quantity
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.sensors.sensor import Array, Sensor
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import BodyView, WorldView

LARGEST = 2**31 - 1


class StatusSensor(Sensor):
    """A sensor that reads its agent's state; it doesn't stack and is no policy input."""

    abstract = True

    is_input: bool = False
    stackable = False

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Store the agent."""
        self._agent = agent


class DoneSensor(StatusSensor):
    """The end of the episode: 1 once it is over, for any reason, else 0.

    Every agent has one, even if its description names none. It is no policy input (``is_input`` is
    off), and it doesn't stack.

    Reading: true or false; one number, 0 or 1. Source: AI4U.
    """

    perception_key: str = "done"
    kind = "sbool"
    reads_status = True

    def space(self) -> Discrete:
        """Return the space of 0 and 1."""
        return Discrete(2)

    def write(self, out: Array, body: BodyView, view: WorldView) -> None:
        """Write the reading into ``out``."""
        out[...] = self._agent.done


class TruncatedSensor(StatusSensor):
    """The end by the step limit: 1 once the episode was truncated by it, else 0.

    ``done`` is true at every end; this sensor tells truncation from a terminal state (a goal, a
    fall). It is no policy input (``is_input`` is off), and it doesn't stack.

    Reading: true or false; one number, 0 or 1. Source: AI4U.
    """

    perception_key: str = "truncated"
    kind = "sbool"
    reads_status = True

    def space(self) -> Discrete:
        """Return the space of 0 and 1."""
        return Discrete(2)

    def write(self, out: Array, body: BodyView, view: WorldView) -> None:
        """Write the reading into ``out``."""
        out[...] = self._agent.truncated


class IDSensor(StatusSensor):
    """The agent's id, as text.

    Every agent has one, even if its description names none. It is no policy input (``is_input`` is
    off), and it doesn't stack.

    Reading: text of up to 80 characters. Source: AI4U.
    """

    perception_key: str = "id"

    def space(self) -> Text:
        """Return the space of texts of up to 80 characters."""
        return Text(80)

    def read(self, body: BodyView, view: WorldView) -> str:
        """Return the id."""
        return self._agent.id


class StepSensor(StatusSensor):
    """The number of decisions that the agent has taken in this episode.

    It is no policy input (``is_input`` is off), and it doesn't stack.

    Reading: a whole number from 0 on; with ``normalized`` divided by ``max_size``. Source: AI4U.

    Differs from AI4U: ``normalized`` is off; it does what realNumber does there.
    """

    perception_key: str = "steps"
    max_size: Annotated[int, Field(ge=1, le=MAX_COUNT)] = 300
    """Number of decisions that reads as 1 when normalised."""

    @property
    def kind(self) -> str:  # type: ignore[override]  # depends on a parameter here
        """An integer, or a float (share of max_size) if normalized."""
        return "sfloat" if self.normalized else "sint"

    def space(self) -> Box:
        """Return the range of integers from 0 on."""
        return Box(0, LARGEST, (), np.int32)

    def scale(self) -> float:
        """Return the number of steps that reads as 1."""
        return float(self.max_size)

    def write(self, out: Array, body: BodyView, view: WorldView) -> None:
        """Write the reading into ``out``."""
        out[...] = self._agent.steps


class RewardSensor(StatusSensor):
    """The reward of the last decision, times ``reward_scale``.

    It is the sum of all terms, already multiplied by the agent's own ``reward_scale``. It is no
    policy input (``is_input`` is off), and it doesn't stack.

    Reading: one number, of any size. Source: AI4U.
    """

    perception_key: str = "reward"
    reward_scale: Annotated[float, quantity("1")] = 1.0
    """Factor by which the reward is multiplied."""
    kind = "sfloat"
    reads_status = True

    def space(self) -> Box:
        """Return the range of all numbers."""
        return Box(-np.inf, np.inf, ())

    def write(self, out: Array, body: BodyView, view: WorldView) -> None:
        """Write the reading into ``out``."""
        out[...] = self._agent.reward * self.reward_scale


class ActionSensor(Sensor):
    """The last action of one actuator; zeros before the first action, or if it got none.

    Stack it to show a policy several of its latest actions.

    Reading: (action_size,), within the actuator's ranges. Source: AI4U.

    Differs from AI4U: ``action_size`` follows from the actuator unless it is given. The number of
    actions, which AI4U's guide calls action_size, is ``stacked_observations``.
    """

    action_name: str = "move"
    """Name of the action that is read."""
    action_size: Annotated[int, Field(ge=1, le=1024)] | None = None
    """Number of values of one action; by default as many as the actuator takes. For several actions
    set ``stacked_observations``."""

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the actuator."""
        actuators = {actuator.action_name: actuator for actuator in agent.actuators}
        if self.action_name not in actuators:
            raise BlockError(
                _(
                    "no actuator is called {action_name!r}; {hint}",
                    action_name=self.action_name,
                    hint=suggest(self.action_name, actuators),
                )
            )
        self._agent, self._slots = agent, actuators[self.action_name].slots()
        low, high = actuators[self.action_name].limits()
        if self.action_size not in (None, len(low)):
            raise BlockError(
                _(
                    "action_size: expected {count}, since an action of {action_name!r} has "
                    "{count} numbers, got {action_size}; leave it out, and for the last "
                    "{action_size} actions set stacked_observations={action_size}",
                    count=len(low),
                    action_name=self.action_name,
                    action_size=self.action_size,
                )
            )
        self._low, self._high = np.array(low, np.float32), np.array(high, np.float32)

    def space(self) -> Box:
        """Return the actuator's ranges, extended to include 0."""
        return Box(np.minimum(self._low, 0), np.maximum(self._high, 0))

    def slots(self) -> tuple[str, ...]:
        """Return the actuator's names of its numbers."""
        return self._slots

    def write(self, out: Array, body: BodyView, view: WorldView) -> None:
        """Write the reading into ``out``."""
        out[...] = self._agent.last_action.get(self.action_name, 0.0)

"""An actor and a critic: a network that turns readings into an action, and one that judges.

Before: :mod:`~ai4u_edu.learn.small.neural_network`. New here is only what stands around a network:

- readings become numbers of about the same size before they go in;
- what comes out becomes an action within its range;
- a second network, the *critic*, says how much reward is to be expected from here on.

>>> from gymnasium import spaces
>>> network = ActorCritic(spaces.Box(-5, 5, (3,)), spaces.Box(-1, 1, (2,)))
>>> network.draw(np.random.default_rng(0))
>>> readings = np.array([[1, -5, 0], [0, 2, 3]], np.float32)
>>> network.act(readings).shape, network.values(readings).shape
((2, 2), (2,))
"""

from collections.abc import Sequence
from typing import Any, TypeGuard

import numpy as np
import numpy.typing as npt
from gymnasium import spaces

from ai4u_edu.base.errors import SetupError
from ai4u_edu.learn.small.neural_network import Floats, Mlp, parameter_count
from ai4u_edu.locale import gettext as _

LAYERS = (64, 64)
"""Neurons of the hidden layers."""
MAX_RANGE = 1e6
"""Largest bound that says something of a reading's size; beyond it, a reading counts as boundless.
"""


class ActorCritic:
    """Actor and critic, two networks of the same size with the same inputs.

    Actions of real numbers: the actor gives each of them in units of its range (1 is the end that
    is farther from 0), and what is beyond the range is cut off. Choices: the actor gives one number
    for each, and the largest one wins. So it is, too, with an action of real numbers of which only
    a few are done, those of a person's keys: halfway between "left" and "right" lies "rest", which
    is what nobody wanted where one turns either way.

    Args:
        observation_space: (r,) of a flat observation.
        action_space: a Box (n,) whose numbers have bounds, or a Discrete.
        layers: neurons of the hidden layers.
        key_actions: (k, n) the only actions of a Box to choose from; left out, all in its range.

    Attributes:
        parameters: all numbers that can be learned, in one array: actor, critic, ``log_spread``.
        gradient: of the same shape; both networks write theirs into it.
        actor, critic: the networks.
        log_spread: (n,) logarithm of how far an action that is tried out lies from the actor's, in
            units of its range; (0,) if it chooses. Only PPO uses and changes it.
        middle, size: (r,) a reading goes in as (reading - middle) / size.
        low, high, unit: (n,) ends of an action's range, and the larger of their absolute values;
            (0,) for a Discrete.
        chooses: True for a Discrete action space, and with key actions.
        first_choice: number of the first choice of a Discrete.
        key_actions: (k, n) as given, or None.

    Raises:
        SetupError: such observations or actions can't be learned, or the key actions are no
            actions of the space.
    """

    def __init__(
        self,
        observation_space: spaces.Space[Any],
        action_space: spaces.Space[Any],
        layers: Sequence[int] = LAYERS,
        key_actions: npt.NDArray[Any] | None = None,
    ) -> None:
        outputs = _output_count(action_space)
        if key_actions is not None:
            outputs = len(_checked_key_actions(key_actions, action_space))
        self.observation_space, self.action_space = observation_space, action_space
        self.layers = tuple(layers)
        self.key_actions = None if key_actions is None else key_actions.astype(np.float32)
        self.chooses = isinstance(action_space, spaces.Discrete) or key_actions is not None
        self.first_choice = int(action_space.start) if _is_choice(action_space) else 0
        self.low, self.high = _bounds(action_space)
        # 0 stays 0, since it usually means rest: an action of 0 to 1 begins at 0, not at 0.5
        self.unit = np.maximum(np.abs(self.low), np.abs(self.high))
        self.middle, self.size = _usual_sizes(observation_space)

        inputs = len(self.middle)
        actor_sizes, critic_sizes = (inputs, *layers, outputs), (inputs, *layers, 1)
        actor_end = parameter_count(actor_sizes)
        critic_end = actor_end + parameter_count(critic_sizes)
        spreads = 0 if self.chooses else len(self.low)
        self.parameters = np.zeros(critic_end + spreads, np.float32)
        self.gradient = np.zeros_like(self.parameters)
        numbers, slopes = self.parameters, self.gradient
        self.actor = Mlp(actor_sizes, numbers[:actor_end], slopes[:actor_end])
        self.critic = Mlp(critic_sizes, numbers[actor_end:critic_end], slopes[actor_end:critic_end])
        self.log_spread, self.log_spread_gradient = numbers[critic_end:], slopes[critic_end:]

    def draw(self, generator: np.random.Generator) -> None:
        """Draw random weights; the first actions are close to rest."""
        self.actor.draw(generator, last_gain=0.01)
        self.critic.draw(generator)

    def scaled(self, readings: npt.NDArray[Any]) -> Floats:
        """Return what goes into both networks, (n, r), for readings (n, r)."""
        inputs: Floats = ((readings - self.middle) / self.size).astype(np.float32)
        return inputs

    def act(self, readings: npt.NDArray[Any]) -> npt.NDArray[Any]:
        """Return the best known action for each row of readings, as :meth:`to_actions` does."""
        outputs = self.actor.forward(self.scaled(readings))
        return self.to_actions(outputs.argmax(axis=1) if self.chooses else outputs)

    def to_actions(self, taken: npt.NDArray[Any]) -> npt.NDArray[Any]:
        """Return actions as an environment takes them.

        Args:
            taken: (n, numbers) in units of their range, or the index of each choice, (n,).

        Returns:
            (n, numbers) float32 within the bounds, or (n,) int64.
        """
        if self.key_actions is not None:
            return self.key_actions[taken.astype(np.int64)]
        if self.chooses:
            return taken.astype(np.int64) + self.first_choice
        actions: npt.NDArray[Any] = np.clip(taken * self.unit, self.low, self.high)
        return actions.astype(np.float32)

    def values(self, readings: npt.NDArray[Any]) -> Floats:
        """Return the discounted reward that the critic expects from each row on, (n,)."""
        values: Floats = self.critic.forward(self.scaled(readings))[:, 0]
        return values

    def copy(self) -> "ActorCritic":
        """Return a copy that shares no array with this one."""
        other = ActorCritic(
            self.observation_space, self.action_space, self.layers, self.key_actions
        )
        other.parameters[:] = self.parameters
        other.middle, other.size = self.middle.copy(), self.size.copy()
        return other


def _is_choice(space: spaces.Space[Any]) -> "TypeGuard[spaces.Discrete[Any]]":
    return isinstance(space, spaces.Discrete)


def _output_count(space: spaces.Space[Any]) -> int:
    """Return how many numbers the actor gives for an action."""
    if _is_choice(space):
        return int(space.n)
    if isinstance(space, spaces.Dict):
        raise SetupError(
            _(
                "expected an agent with one actuator to learn, got {space}; set is_output "
                "to False on the others",
                space=str(sorted(space)),
            )
        )
    if not isinstance(space, spaces.Box) or not space.is_bounded():
        raise SetupError(
            _(
                "expected an agent with one actuator whose numbers have a range, got {space}",
                space=str(space),
            )
        )
    return int(np.prod(space.shape))


def _checked_key_actions(
    key_actions: npt.NDArray[Any], space: spaces.Space[Any]
) -> npt.NDArray[Any]:
    """Return key actions, if all of them are actions of the space."""
    low, high = _bounds(space)
    if (
        _is_choice(space)
        or key_actions.ndim != 2
        or key_actions.shape[1:] != low.shape
        or not len(key_actions)
        or not ((low <= key_actions) & (key_actions <= high)).all()
    ):
        raise SetupError(
            _(
                "expected key actions of the space {space}, got {got}",
                space=str(space),
                got=str(key_actions.tolist()),
            )
        )
    return key_actions


def _bounds(space: spaces.Space[Any]) -> tuple[Floats, Floats]:
    """Return the ends of the range of each number of an action; choices have none."""
    if not isinstance(space, spaces.Box):
        return np.zeros(0, np.float32), np.zeros(0, np.float32)
    return space.low.ravel().astype(np.float32), space.high.ravel().astype(np.float32)


def _usual_sizes(space: spaces.Space[Any]) -> tuple[Floats, Floats]:
    """Return what to subtract from each reading, and by what to divide it.

    A neuron adds its inputs up, so that a distance of 25 m would drown a sine of 0.5. Divided by
    the largest value that the sensor can give, both are at most 1. Nothing is subtracted, as 0
    usually means that there is nothing to see.
    """
    if not isinstance(space, spaces.Box) or len(space.shape) != 1:
        raise SetupError(
            _("expected a flat observation (observation='flat'), got {space}", space=str(space))
        )
    largest = np.maximum(np.abs(space.low), np.abs(space.high)).astype(np.float32)
    has_size = (largest > 0.0) & (largest < MAX_RANGE)
    return np.zeros_like(largest), np.where(has_size, largest, 1.0).astype(np.float32)

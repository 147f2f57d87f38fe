"""Policies as plain functions from a percept to the numbers of an action."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ai4u_edu.base.errors import AI4UError, SetupError
from ai4u_edu.blocks import Command, Controller, LocalBrain, NeuralNetController, ScriptController
from ai4u_edu.blocks.brains.network import VALUE_OUTPUT, Network, find_network
from ai4u_edu.explain.errors import NotExplainableError
from ai4u_edu.explain.statefulness import dependence_on_more, memory_of
from ai4u_edu.locale import gettext as _

Floats = npt.NDArray[np.float64]
Percepts = Mapping[str, Any]
PolicyLike = Any
"""A function from percept to action, a Controller or LocalBrain, a Network or its file, or the
result of a training that has a ``path``."""

NOT_READINGS = ("done",)
"""Readings that no policy weighs: they end or begin an episode."""


class Policy:
    """A decision that is a function of the percept.

    Args:
        source: as :data:`PolicyLike`.

    Raises:
        NotExplainableError: it keeps a state, or reads the world besides the percept.
        SetupError: it is nothing that decides.

    >>> policy = Policy(lambda percept: {"move": [percept["eyes"][0], 0.0]})
    >>> policy.decide({"eyes": np.array([0.5, 1.0])}).tolist(), policy.components
    ([0.5, 0.0], ('move 0', 'move 1'))
    """

    def __init__(self, source: PolicyLike) -> None:
        self.network: Network | None = None
        self._ask, self._owner = self._asker_of(source)
        self.components: tuple[str, ...] = ()
        """Names of the action's numbers; known after the first decision."""

    def inputs(self, percept: Percepts) -> tuple[str, ...]:
        """Return the keys of the numeric readings that the policy may use."""
        if self.network is not None:
            return tuple(port.name for port in self.network.inputs)
        return tuple(
            key
            for key, value in percept.items()
            if key not in NOT_READINGS and np.asarray(value).dtype.kind in "fiub"
        )

    def decide(self, percept: Percepts) -> Floats:
        """Return the action's numbers, (components,).

        Raises:
            NotExplainableError: the answer is a command, or changes the policy's own state.
        """
        parts = {name: each.ravel() for name, each in self.answer(percept).items()}
        self.components = tuple(
            key if len(numbers) == 1 else f"{key} {index}"
            for key, numbers in parts.items()
            for index in range(len(numbers))
        )
        return np.concatenate([*parts.values(), np.zeros(0)])

    def answer(self, percept: Percepts) -> dict[str, Floats]:
        """Return the action, an array for each actuator; otherwise like :meth:`decide`."""
        before = memory_of(self._owner)
        answer = self._ask(percept)
        after = memory_of(self._owner)
        if after != before:
            changed = [name for name, value in after.items() if before.get(name) != value]
            raise NotExplainableError(
                _(
                    "the policy keeps something from one decision to the next (it changes "
                    "{names}), so its action may not follow from the percept alone; expected a "
                    "policy without a state",
                    names=", ".join(changed),
                )
            )
        if isinstance(answer, Command):
            raise NotExplainableError(
                _(
                    "expected an action, got the command {name}; choose a percept in the middle "
                    "of an episode",
                    name=answer.name,
                )
            )
        return {key: np.asarray(value, np.float64) for key, value in _named(answer)}

    def _asker_of(self, source: PolicyLike) -> tuple[Callable[[Percepts], Any], Any]:
        """Return the function to ask, and the object whose state it may change."""
        if isinstance(source, LocalBrain):
            source = source.controller
        if isinstance(source, ScriptController):
            source = source.function
        if isinstance(source, NeuralNetController):
            source = source.network
        for place in ("path", "folder"):  # of a clone, of a training
            if not isinstance(source, Network | Path | str) and hasattr(source, place):
                source = getattr(source, place)
        if isinstance(source, str | Path):
            source = Network(find_network(str(source)))
        if isinstance(source, Network):
            self.network = source
            return lambda percept: _actions(source, percept), None
        if isinstance(source, Controller):
            reason = dependence_on_more(source)
            if reason:
                raise NotExplainableError(reason)
            controller: Any = source
            return controller.get_action, controller
        if callable(source):
            return source, source
        raise SetupError(
            _(
                "expected a function from percept to action, a Controller, a network's file "
                "(policy.onnx or zoo:SCENE) or the result of a training, got {source}",
                source=repr(source),
            )
        )


def values_of(network: Network, percept: Percepts) -> float:
    """Return the value that a network's critic gives a percept.

    Raises:
        SetupError: the network has no critic.
    """
    if not has_critic(network):
        raise SetupError(
            _(
                "{name}: this network has no critic; export it with: ai4u-edu export MODEL "
                "--with-critic, or estimate values by rollouts",
                name=network.path.name,
            )
        )
    return float(network.decide(percept)[VALUE_OUTPUT].ravel()[0])


def has_critic(network: Network) -> bool:
    """Return True if the network also gives the value of a percept."""
    return any(port.name == VALUE_OUTPUT for port in network.outputs)


def _actions(network: Network, percept: Percepts) -> dict[str, Any]:
    outputs = network.decide(percept)
    return {name: each for name, each in outputs.items() if name != VALUE_OUTPUT}


def _named(answer: Any) -> list[tuple[str, Any]]:
    if isinstance(answer, Mapping):
        return list(answer.items())
    try:
        return [("action", np.asarray(answer, np.float64))]
    except (TypeError, ValueError):
        raise AI4UError(
            _(
                "expected an action as a mapping from actuator to numbers, got {answer}",
                answer=repr(answer),
            )
        ) from None

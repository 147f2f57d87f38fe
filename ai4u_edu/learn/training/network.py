"""A Stable-Baselines3 model as one torch module from readings to an action. Loads torch."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
import torch
from gymnasium import spaces
from stable_baselines3.common.base_class import BaseAlgorithm
from stable_baselines3.common.preprocessing import is_image_space
from torch import Tensor, nn

from ai4u_edu.base.errors import SetupError
from ai4u_edu.learn.training.algorithms import CLASSES


class PolicyModule(nn.Module):  # type: ignore[misc]  # seen without its types
    """Torch module of a model's deterministic policy: readings in, an action out.

    Scaling of the readings, the choice and the scaling to the actuator's range all happen inside.

    Args:
        model: a Stable-Baselines3 model: SAC, PPO or DQN.
        keys: the perception keys, in the order in which the readings come.
        table: (choices, numbers) the actions, where the model chooses them by number.
        with_critic: True also gives the value that the model's critic expects from there on.
    """

    def __init__(
        self,
        model: BaseAlgorithm,
        keys: Sequence[str],
        table: npt.NDArray[np.float32] | None = None,
        *,
        with_critic: bool = False,
    ) -> None:
        super().__init__()
        self._with_critic = with_critic
        self.policy: Any = model.policy
        self._kind = _kind_of(model)
        self._keys = tuple(keys)
        self._spaces = _spaces_of(model.observation_space)
        seen = model.observation_space
        self._picture = _seen_of(seen) if is_image_space(seen) else None
        action_space: Any = model.action_space
        self._continuous = isinstance(action_space, spaces.Box)
        if self._continuous:
            self.low: Tensor
            self.high: Tensor
            self.register_buffer("low", torch.as_tensor(action_space.low))
            self.register_buffer("high", torch.as_tensor(action_space.high))
        self.table: Tensor | None
        self.register_buffer("table", None if table is None else torch.as_tensor(table))

    def forward(self, *readings: Tensor) -> Tensor | tuple[Tensor, Tensor]:
        """Return an action for each row of the readings; with a critic, also its value, (n, 1)."""
        seen = self._observation(readings)
        action = self._act(seen)
        return (action, self._value(seen)) if self._with_critic else action

    def _value(self, seen: Any) -> Tensor:
        """Return the discounted reward that the critic expects: of SAC and DQN, of the action."""
        policy = self.policy
        if self._kind == "dqn":
            net = policy.q_net
            values: Tensor = net.q_net(self._features(seen, net.features_extractor))
            return values.max(dim=1, keepdim=True).values
        if self._kind == "sac":
            actor, critic = policy.actor, policy.critic
            latent = actor.latent_pi(self._features(seen, actor.features_extractor))
            squashed = torch.tanh(actor.mu(latent))
            inputs = torch.cat([self._features(seen, critic.features_extractor), squashed], dim=1)
            each = torch.cat([net(inputs) for net in critic.q_networks], dim=1)
            return each.min(dim=1, keepdim=True).values
        extractor = (
            policy.features_extractor
            if policy.share_features_extractor
            else policy.vf_features_extractor
        )
        latent = policy.mlp_extractor.forward_critic(self._features(seen, extractor))
        expected: Tensor = policy.value_net(latent)
        return expected

    def _act(self, seen: Any) -> Tensor:
        if self._kind == "sac":
            actor = self.policy.actor
            latent = actor.latent_pi(self._features(seen, actor.features_extractor))
            return self._scaled(torch.tanh(actor.mu(latent)))
        if self._kind == "dqn":
            net = self.policy.q_net
            return self._looked_up(net.q_net(self._features(seen, net.features_extractor)))
        policy = self.policy
        extractor = (
            policy.features_extractor
            if policy.share_features_extractor
            else policy.pi_features_extractor
        )
        latent = policy.mlp_extractor.forward_actor(self._features(seen, extractor))
        numbers = policy.action_net(latent)
        if not self._continuous:
            return self._looked_up(numbers)
        if policy.squash_output:
            return self._scaled(torch.tanh(numbers))
        return torch.minimum(torch.maximum(numbers, self.low), self.high)

    def _observation(self, readings: Sequence[Tensor]) -> Any:
        if self._picture:
            return _as_seen(readings[0], self._picture)
        if not self._spaces:
            return torch.cat([each.to(torch.float32).flatten(1) for each in readings], dim=1)
        named = zip(self._keys, readings, strict=True)
        return {key: _as_seen(each, self._spaces[key]) for key, each in named}

    def _features(self, seen: Any, extractor: nn.Module) -> Tensor:
        features: Tensor = extractor(seen)
        return features

    def _scaled(self, squashed: Tensor) -> Tensor:
        return self.low + 0.5 * (squashed + 1.0) * (self.high - self.low)

    def _looked_up(self, values: Tensor) -> Tensor:
        best = values.argmax(dim=1)
        return best if self.table is None else self.table[best]


class _ReadingForm(NamedTuple):
    """Form of one reading as a network's input."""

    choices: int
    """Count of values of a whole number, which is one-hot encoded; 0 for anything else."""
    is_picture: bool
    shape: tuple[int, ...]


def _spaces_of(space: spaces.Space[Any]) -> dict[str, _ReadingForm]:
    """Return the space of each reading; empty where they all come in one array."""
    if not isinstance(space, spaces.Dict):
        return {}
    return {key: _seen_of(each) for key, each in space.spaces.items()}


def _seen_of(space: spaces.Space[Any]) -> _ReadingForm:
    choices = int(space.n) if isinstance(space, spaces.Discrete) else 0
    return _ReadingForm(choices, is_image_space(space), space.shape or ())


def _as_seen(reading: Tensor, seen: _ReadingForm) -> Tensor:
    """Preprocess a reading as Stable-Baselines3 does."""
    if seen.choices:
        return nn.functional.one_hot(reading.to(torch.int64), seen.choices).to(torch.float32)
    if not seen.is_picture:
        return reading.to(torch.float32)
    if tuple(reading.shape[1:]) != seen.shape:
        reading = reading.permute(0, 3, 1, 2)  # it takes the channels first
    return reading.to(torch.float32) / 255.0


def _kind_of(model: BaseAlgorithm) -> str:
    for kind, cls in CLASSES.items():
        if isinstance(model, cls):
            return kind
    raise SetupError(f"expected a model of SAC, PPO or DQN, got {type(model).__name__}")

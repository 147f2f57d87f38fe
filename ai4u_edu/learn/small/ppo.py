"""Proximal policy optimization (PPO): an agent learns from rewards, in many worlds at once.

Before: :mod:`~ai4u_edu.learn.small.actor_critic`. New here is that nobody shows what to do. One
round of learning (:meth:`Ppo.improve`) has four steps:

1. **Drive.** In each of 16 worlds, take 32 decisions. The actor's action is varied at random: who
   never tries anything else finds nothing better. Keep what was sensed, done and paid.
2. **Judge.** How much better than usual went what was tried? The critic says what is usual; the
   *advantage* (:func:`advantages`) is what came, less that.
3. **Improve the actor.** Make what had a positive advantage more probable, and the rest less.
4. **Improve the critic.** Have it expect what came.

Steps 3 and 4 go ten times through all decisions, in small batches. The data are of the actor as it
was while driving, so it may not get too far away from that: where an action has become 20% more (or
less) probable than it was, it is not pushed any further. That limit is the *proximal* in the name.

>>> from ai4u_edu import Scene
>>> ppo = Ppo(Scene.load("yardstick"), PpoSettings(worlds=2, steps=8, batch=8))
>>> ppo.improve()
>>> ppo.decisions
16

Source: J. Schulman et al., Proximal Policy Optimization Algorithms, arXiv:1707.06347, 2017; the
advantage: J. Schulman et al., High-Dimensional Continuous Control Using Generalized Advantage
Estimation, ICLR 2016.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt
from gymnasium import spaces

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.ledger import HANDLERS
from ai4u_edu.base.errors import AI4UError, SetupError, suggest
from ai4u_edu.base.seeding import MAX_TRAINING_SEED, checked_seed
from ai4u_edu.learn.envs.worlds import Worlds
from ai4u_edu.learn.small.actor_critic import LAYERS, ActorCritic
from ai4u_edu.learn.small.easy_starts import EasyStarts
from ai4u_edu.learn.small.neural_network import Adam, Floats, clip_norm, parameter_count
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene

Array = npt.NDArray[Any]
Flags = npt.NDArray[np.bool_]

STRONGER_KEYS_LATER = 3.0
"""Distance by which the outputs for keys at full strength begin below those of the keys: about
one decision of twenty tries one."""
FIRST_SEED = 2**40
"""Smallest seed of an episode to learn in; small ones are left for evaluations."""


@dataclass(frozen=True)
class PpoSettings:
    """Settings of a training; ``ai4u-edu train`` has the same ones for Stable-Baselines3."""

    worlds: int = 16
    """Copies of the scene in which the agent learns at once."""
    steps: int = 32
    """Decisions in each world between two improvements."""
    batch: int = 128
    """Decisions in a gradient step."""
    epochs: int = 10
    """Times that an improvement goes through all decisions."""
    rate: float = 3e-3
    """Learning rate: the usual change of a parameter in a gradient step."""
    discount: float = 0.98
    """Worth of a reward a decision later, compared with now: it makes 50 decisions matter."""
    trust: float = 0.95
    """Share of the rewards that really came in an advantage, as against the critic's guesses: 0
    trusts the guess after one decision, 1 only what came. (The lambda of the literature.)"""
    clip: float = 0.2
    """Change of an action's probability beyond which it is not pushed any further."""
    critic_weight: float = 0.5
    """Weight of the critic's loss beside the actor's."""
    max_gradient: float = 0.5
    """Length to which a longer gradient is shortened."""
    first_spread: float = 0.6
    """Standard deviation of what is tried out at first, in units of an action's range."""
    first_spread_after_clone: float = 0.2
    """The same for a training that begins with a network: with 0.6, it forgets what it can."""
    layers: tuple[int, ...] = LAYERS
    """Neurons of the hidden layers."""
    check_every: int = 4096
    """Decisions between two checks."""
    check_episodes: int = 30
    """Episodes of a check, each from another start."""
    check_decisions: int = 1000
    """Decisions after which an episode of a check is cut off, if the scene has no lower limit."""
    enough: int = 2
    """Checks in a row with success in every episode after which a training ends; 0 for never."""


@dataclass(frozen=True)
class Experience:
    """Decisions of one round: ``steps`` in each of ``worlds`` worlds."""

    inputs: Floats
    """(steps, worlds, r) scaled readings before each decision."""
    taken: Array
    """(steps, worlds, numbers) what was tried out, in units of the action's range; or the index of
    a choice, (steps, worlds)."""
    log_chances: Floats
    """(steps, worlds) logarithm of the probability with which it was tried out."""
    advantages: Floats
    """(steps, worlds)"""
    returns: Floats
    """(steps, worlds) what the critic should have expected."""


class Ppo:
    """A learner that improves a network round by round.

    The same seed gives the same network on the same machine, if numeric libraries use one thread.

    Args:
        scene: with the rhythm and the limit of steps to learn with.
        settings: of the training.
        seed: of the network, of what is tried out, and of the worlds.
        agent: id of the agent that learns; left out, the one that acts first.
        begin_with: network to improve, such as a clone; its layers hold. Left out, a random one.
            Less is tried out then (``first_spread_after_clone``). A clone of drives by keys goes on
            choosing among their actions, and among these at full strength.
        reward_weights: factor of each reward term by its name; 1 for one that is left out. They
            change what is learned from, and nothing in the world.
        worlds: in which it learns, with as many agents that learn as the settings have worlds; left
            out, those of the scene.

    Attributes:
        worlds: in which it learns.
        agent: that learns, in the first world.
        network: as it is now; it can also get worse again.
        decisions: count of decisions that were learned from.
        optimizer, generator: with which it goes on.
        easy_starts: in a scene with a curriculum; else None.

    Raises:
        SetupError: the agent can't learn, or there is no reward term of a name.
    """

    def __init__(
        self,
        scene: Scene,
        settings: PpoSettings | None = None,
        *,
        seed: int = 0,
        agent: str | None = None,
        begin_with: ActorCritic | None = None,
        reward_weights: Mapping[str, float] | None = None,
        worlds: Worlds | None = None,
    ) -> None:
        self.settings = settings or PpoSettings()
        self.seed = _small_enough(seed)
        self.worlds = worlds or Worlds(self.settings.worlds, scene, observation="flat", agent=agent)
        env = self.worlds.envs[0]
        self.agent = env.agent
        self.reward_weights = _checked_weights(reward_weights or {}, self.agent)
        self.generator = np.random.default_rng(self.seed)
        spread = self.settings.first_spread
        if begin_with is None:
            self.network = ActorCritic(
                env.observation_space, env.action_space, self.settings.layers
            )
            self.network.draw(self.generator)
        else:
            self.network = _with_stronger_keys(
                _checked_network(begin_with, env.observation_space, env.action_space)
            )
            self.settings = replace(self.settings, layers=begin_with.layers)
            spread = self.settings.first_spread_after_clone
        self.network.log_spread[:] = math.log(spread)
        self.optimizer = Adam(self.network.parameters, self.settings.rate, epsilon=1e-5)
        self.decisions = 0
        self.easy_starts = EasyStarts.of(scene)
        self.begin_episodes()

    def improve(self) -> None:
        """Drive, judge, and improve actor and critic: one round.

        Raises:
            AI4UError: the parameters have become infinite or no numbers.
        """
        experience = self.drive()
        self.update(experience)
        self.decisions += experience.advantages.size
        if not np.isfinite(self.network.parameters).all():
            raise AI4UError(
                _(
                    "after {decisions} decisions the network's numbers are not finite any more; "
                    "try smaller rewards, or a smaller learning rate",
                    decisions=self.decisions,
                )
            )

    def drive(self) -> Experience:
        """Take ``steps`` decisions in each world, and judge them: steps 1 and 2 of a round."""
        settings, network, worlds = self.settings, self.network, self.worlds
        shape = settings.steps, settings.worlds
        inputs = np.zeros((*shape, len(network.middle)), np.float32)
        outputs = np.zeros((*shape, network.actor.sizes[-1]), np.float32)
        taken: Array = np.zeros(shape if network.chooses else outputs.shape, np.float32)
        rewards = np.zeros(shape, np.float32)
        is_over = np.zeros(shape, np.bool_)
        cut_off: list[tuple[int, int]] = []
        last_inputs: list[Floats] = []
        for step in range(settings.steps):
            inputs[step] = network.scaled(worlds.observations)
            outputs[step] = network.actor.forward(inputs[step])
            taken[step] = _try_out(network, outputs[step], self.generator)
            worlds.step(network.to_actions(taken[step]))
            rewards[step] = [self.reward_of(agent) for agent in worlds.agents]
            is_over[step] = worlds.terminated | worlds.truncated
            for index in np.flatnonzero(is_over[step] & ~worlds.terminated).tolist():
                cut_off.append((step, index))
                last_inputs.append(network.scaled(worlds.observations[index]))
            for index in np.flatnonzero(is_over[step]).tolist():
                # The next decision of this world is the first of another episode: no decision is
                # spent on beginning one, so there is none without an action to learn from.
                self._begin_episode(index)
        # The critic doesn't drive, so it is asked once, for all decisions and for what came after
        # the last ones. That is faster than once a decision.
        after = network.scaled(worlds.observations)[None]
        values = _values(network, np.concatenate([inputs, after]))
        next_values = values[1:].copy()
        # Where an episode ended, the next row is of another one. After a real end nothing comes,
        # which is worth 0. An episode that was only cut off would have gone on from where it was.
        next_values[is_over] = 0.0
        if cut_off:
            steps, indices = zip(*cut_off, strict=True)
            next_values[steps, indices] = _values(network, np.stack(last_inputs))
        gained = advantages(
            rewards, values[:-1], next_values, ~is_over, settings.discount, settings.trust
        )
        log_chances, _, _ = _log_chances(network, outputs, taken)
        return Experience(inputs, taken, log_chances, gained, gained + values[:-1])

    def choose_among(self, key_actions: Array) -> None:
        """Begin with a network that chooses among these actions, (k, n); its weights are zeros."""
        spaces_of = self.network.observation_space, self.network.action_space
        self.network = ActorCritic(*spaces_of, self.network.layers, key_actions)
        self.optimizer = Adam(self.network.parameters, self.settings.rate, epsilon=1e-5)

    def update(self, experience: Experience) -> None:
        """Improve actor and critic by what was driven: steps 3 and 4 of a round."""
        settings, network = self.settings, self.network
        count = experience.advantages.size
        inputs = experience.inputs.reshape(count, -1)
        taken = experience.taken.reshape(count, *experience.taken.shape[2:])
        before, gained, returns = (
            numbers.ravel()
            for numbers in (experience.log_chances, experience.advantages, experience.returns)
        )
        for _number in range(settings.epochs):
            order = self.generator.permutation(count)
            for start in range(0, count, settings.batch):
                batch = order[start : start + settings.batch]
                self._improve_actor(inputs[batch], taken[batch], before[batch], gained[batch])
                error = network.critic.forward(inputs[batch])[:, 0] - returns[batch]
                slope = 2.0 * settings.critic_weight * error / len(batch)
                network.critic.backward(slope[:, None].astype(np.float32))
                clip_norm(network.gradient, settings.max_gradient)
                self.optimizer.step(network.gradient)

    def begin_episodes(self) -> None:
        """Begin an episode in every world: other ones after a break than before."""
        first = FIRST_SEED + 1000 * self.seed + 7919 * self.decisions
        for index in range(self.settings.worlds):
            self._begin_episode(index, first + index)

    def _begin_episode(self, index: int, seed: int | None = None) -> None:
        starts, envs = self.easy_starts, self.worlds.envs
        if starts is None:
            self.worlds.reset(index, seed)
            return
        if seed is None and index < len(envs):  # an episode has ended
            starts.note(envs[index].success)
        self.worlds.reset(index, seed, starts.options)

    def _improve_actor(self, inputs: Floats, taken: Array, before: Floats, gained: Floats) -> None:
        """Write the actor's part of the gradient.

        Args:
            inputs: (n, r) scaled readings.
            taken: what was tried out.
            before: (n,) logarithm of its probability then.
            gained: (n,) its advantage.
        """
        network, clip = self.network, self.settings.clip
        # only what is better than the others counts, however large rewards are
        gained = (gained - gained.mean()) / (gained.std() + 1e-8)
        now, slope, spread_slope = _log_chances(network, network.actor.forward(inputs), taken)
        # 1.2: it has become 20% more probable; beyond e ** 20, it might become infinite
        ratio = np.exp(np.minimum(now - before, 20.0))
        # To be made larger is the mean of min(ratio * gained, clipped ratio * gained). Where the
        # second one is smaller, the ratio is far enough away already: there its slope is 0.
        goes_on = np.where(gained > 0.0, ratio < 1.0 + clip, ratio > 1.0 - clip)
        # the slope of a ratio is the ratio times the slope of its logarithm; and less, not more, as
        # an optimizer makes a loss smaller
        weight = -(gained * ratio * goes_on / len(gained)).astype(np.float32)[:, None]
        network.actor.backward(weight * slope)
        network.log_spread_gradient[:] = (weight * spread_slope).sum(axis=0)

    def reward_of(self, agent: BasicAgent) -> float:
        """Return the reward of an agent's latest decision, by the weights of this training."""
        ledger = agent.ledger
        if not self.reward_weights:
            return ledger.total
        weights = self.reward_weights
        return sum(weights.get(name, 1.0) * amount for name, amount in ledger.terms.items())


def advantages(
    rewards: Floats,
    values: Floats,
    next_values: Floats,
    goes_on: Flags,
    discount: float,
    trust: float,
) -> Floats:
    """Return how much better than expected each decision went: generalized advantage estimation.

    After one decision there is a first answer: its reward, and what the critic expects from there
    on, less what it expected before. That is the *surprise*. But a good decision may show only
    later, so the surprises after it count too, each one less than the one before.

    Args:
        rewards: (steps, worlds).
        values: (steps, worlds) reward that the critic expected before each decision.
        next_values: (steps, worlds) and after it; 0 after an episode's real end.
        goes_on: (steps, worlds) False where an episode ended: surprises of the next one say
            nothing of this one.
        discount: worth of a reward a decision later.
        trust: weight of a surprise one decision later, on top of that.

    >>> one = np.ones((3, 1), np.float32)
    >>> advantages(one, 0 * one, 0 * one, one > 0, 0.5, 1.0).ravel().tolist()
    [1.75, 1.5, 1.0]
    """
    found = np.zeros_like(rewards)
    later: Floats = np.zeros(rewards.shape[1], np.float32)
    for step in reversed(range(len(rewards))):
        surprise = rewards[step] + discount * next_values[step] - values[step]
        later = surprise + discount * trust * goes_on[step] * later
        found[step] = later
    return found


def _try_out(network: ActorCritic, outputs: Floats, generator: np.random.Generator) -> Array:
    """Draw an action for each row of the actor's outputs."""
    if not network.chooses:
        noise = generator.standard_normal(outputs.shape, np.float32)
        tried: Array = outputs + np.exp(network.log_spread) * noise
        return tried
    # the largest of these sums is each choice with its softmax probability (Gumbel's trick)
    index: Array = (outputs + generator.gumbel(size=outputs.shape)).argmax(axis=1)
    return index


def _log_chances(
    network: ActorCritic, outputs: Floats, taken: Array
) -> tuple[Floats, Floats, Floats]:
    """Return how probable actions are for an actor.

    Args:
        network: for the spread.
        outputs: (..., numbers) of the actor.
        taken: (..., numbers), or (...) indices of choices.

    Returns:
        The logarithm of the probability (or of its density), (...); its slope for each output,
        (..., numbers); and its slope for each logarithm of a spread, (..., numbers or 0).
    """
    if network.chooses:
        shifted = outputs - outputs.max(axis=-1, keepdims=True)
        log_chances = shifted - np.log(np.exp(shifted).sum(axis=-1, keepdims=True))
        index = taken.astype(np.int64)[..., None]
        is_taken = np.arange(outputs.shape[-1]) == index
        slope = is_taken - np.exp(log_chances)
        none = np.zeros((*slope.shape[:-1], 0), np.float32)
        return np.take_along_axis(log_chances, index, -1)[..., 0], slope, none
    # a bell curve around the output: the logarithm of its height is a parabola
    distance = (taken - outputs) / np.exp(network.log_spread)
    height = -0.5 * distance**2 - network.log_spread - 0.5 * math.log(2.0 * math.pi)
    return height.sum(axis=-1), distance / np.exp(network.log_spread), distance**2 - 1.0


def _values(network: ActorCritic, inputs: Floats) -> Floats:
    """Return what the critic expects, (...), for scaled readings (..., r)."""
    flat = inputs.reshape(-1, inputs.shape[-1])
    values: Floats = network.critic.forward(flat)[:, 0]
    return values.reshape(inputs.shape[:-1])


def _small_enough(seed: int) -> int:
    if checked_seed(seed) > MAX_TRAINING_SEED:
        raise SetupError(
            _(
                "seed: expected a whole number from 0 to {most} for a training, got {seed}",
                most=MAX_TRAINING_SEED,
                seed=seed,
            )
        )
    return checked_seed(seed)


def _checked_network(
    network: ActorCritic, observation_space: spaces.Space[Any], action_space: spaces.Space[Any]
) -> ActorCritic:
    """Return a copy of a network.

    Raises:
        SetupError: it is one of another agent.
    """
    own, needed = (
        (network.observation_space, network.action_space),
        (observation_space, action_space),
    )
    if own != needed:
        raise SetupError(
            _(
                "begin_with: expected a network of this agent, for {observation_space} and "
                "{action_space}, got one for {own} and {own2}",
                observation_space=str(observation_space),
                action_space=str(action_space),
                own=str(own[0]),
                own2=str(own[1]),
            )
        )
    return network.copy()


def _with_stronger_keys(network: ActorCritic) -> ActorCritic:
    """Return the network, which can also choose the actions of its keys at full strength.

    Keys often move a robot with less than its full strength, and who learns for rewards should be
    able to get faster than the person. At first these actions are improbable.
    """
    keys = network.key_actions
    if keys is None:
        return network
    strength = np.abs(keys / np.where(network.unit > 0.0, network.unit, 1.0)).max(axis=1)
    strong = np.clip(keys / np.maximum(strength, 1e-6)[:, None], network.low, network.high)
    known = {tuple(key) for key in keys.tolist()}
    new = [row for row, key in enumerate(strong.tolist()) if tuple(key) not in known]
    other = ActorCritic(
        network.observation_space,
        network.action_space,
        network.layers,
        np.concatenate([keys, strong[new]]),
    )
    other.middle, other.size = network.middle, network.size
    other.critic.parameters[:] = network.critic.parameters
    hidden = parameter_count(network.actor.sizes[:-1])
    other.actor.parameters[:hidden] = network.actor.parameters[:hidden]
    rows = [*range(len(keys)), *new]
    other.actor.weights[-1][:] = network.actor.weights[-1][rows]
    other.actor.biases[-1][:] = network.actor.biases[-1][rows]
    other.actor.biases[-1][len(keys) :] -= STRONGER_KEYS_LATER
    return other


def _checked_weights(weights: Mapping[str, float], agent: BasicAgent) -> dict[str, float]:
    """Return the weights as they are.

    Raises:
        SetupError: there is no term of a name, or a weight is no finite number.
    """
    names = [HANDLERS, *(reward.name for reward in agent.rewards)]
    for name, weight in weights.items():
        if name not in names:
            raise SetupError(
                _(
                    "reward_weights: no reward term is called {name!r}; {hint}",
                    name=name,
                    hint=suggest(name, names),
                )
            )
        if not math.isfinite(weight):
            raise SetupError(
                _(
                    "reward_weights: expected a finite weight of {name!r}, got {weight}",
                    name=name,
                    weight=weight,
                )
            )
    return dict(weights)

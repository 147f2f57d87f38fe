"""Worlds of the lesson on learning from inside: a corridor, and a game of several agents."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from operator import mul
from typing import Any

import numpy as np
import numpy.typing as npt

from ai4u_edu.lessons.exercise import NotYet
from ai4u_edu.lessons.numeric import finite_number
from ai4u_edu.locale import gettext as _

Array = npt.NDArray[np.float64]
Episode = list[tuple[int, int, float]]
"""Cell, action (0 left, 1 right) and reward of each step."""

CELLS, START = 8, 2
"""Number of cells of the corridor, and the first one of a walk."""
FAR = 1.0
"""Reward at the right end."""
RATE, DISCOUNT, WALKS, MAX_STEPS = 0.5, 0.9, 200, 100
BEST = FAR * DISCOUNT ** (CELLS - START - 2)
"""Discounted return of a walk straight to the right end."""
HARD_NEAR = 0.5
"""Near reward that is hard to give up."""
EPISODES, MAX_EPISODE_STEPS = 300, 60
"""Episodes of a training of policy gradient, and the longest of them."""


@dataclass
class Walks:
    """A walker's life in the corridor."""

    returns: list[float]
    """Discounted return of each walk."""
    visits: list[int]
    """Times that it stood in each cell."""
    values: Array
    """Value of a step to the left and to the right in each cell, (cells, 2)."""


def explore(epsilon: Callable[[int, int], float], seed: int = 0, near: float = 0.2) -> Walks:
    """Let a walker learn by Q-learning in the corridor with two rewards.

    Args:
        epsilon: probability of a random step, from the number of the walk and of all walks.
        seed: seed of its random choices.
        near: reward at the left end, which is nearer.
    """
    chance = np.random.default_rng(seed)
    values = np.zeros((CELLS, 2))
    returns, visits = [], [0] * CELLS
    for walk in range(WALKS):
        probability = finite_number(epsilon(walk, WALKS))
        cell, steps, total = START, 0, 0.0
        while 0 < cell < CELLS - 1 and steps < MAX_STEPS:
            visits[cell] += 1
            tries = chance.random() < probability or values[cell, 0] == values[cell, 1]
            action = int(chance.integers(2)) if tries else int(values[cell].argmax())
            now, reward = _step(cell, action, near)
            target = reward + DISCOUNT * (values[now].max() if 0 < now < CELLS - 1 else 0.0)
            values[cell, action] += RATE * (target - values[cell, action])
            total += reward * DISCOUNT**steps
            cell, steps = now, steps + 1
        visits[cell] += 1
        returns.append(total)
    return Walks(returns, visits, values)


def _step(cell: int, action: int, near: float) -> tuple[int, float]:
    now = cell + (1 if action else -1)
    return now, {0: near, CELLS - 1: FAR}.get(now, 0.0)


def softmax(preferences: Any) -> Array:
    """Return the probabilities of actions from their preferences."""
    powers = np.exp(np.asarray(preferences, float) - np.max(preferences))
    return np.asarray(powers / powers.sum())


Reinforce = Callable[[Array, Episode, float, float], Array]


def learn(
    reinforce: Reinforce, rate: float = 0.3, seed: int = 0, near: float = 0.2
) -> tuple[list[float], Array]:
    """Train a policy in the corridor by policy gradient.

    Args:
        reinforce: the new preferences, from (preferences, episode, rate, discount).
        rate: learning rate.
        seed: seed of the walker's choices.
        near: reward at the left end, which is nearer.

    Returns:
        Discounted return of each episode, in percent of the best; the preferences (cells, 2).
    """
    chance = np.random.default_rng(seed)
    preferences: Array = np.zeros((CELLS, 2))
    returns = []
    for _number in range(EPISODES):
        episode = walked(preferences, chance, near)
        total = sum(reward * DISCOUNT**n for n, (_, _, reward) in enumerate(episode))
        returns.append(100 * total / BEST)
        found = reinforce(preferences.copy(), episode, rate, DISCOUNT)
        preferences = as_preferences(found, preferences.shape)
    return returns, preferences


def walked(preferences: Array, chance: np.random.Generator, near: float) -> Episode:
    """Return an episode of a walker with these preferences."""
    cell = START
    episode: Episode = []
    while 0 < cell < CELLS - 1 and len(episode) < MAX_EPISODE_STEPS:
        action = int(chance.random() < softmax(preferences[cell])[1])
        now, reward = _step(cell, action, near)
        episode.append((cell, action, reward))
        cell = now
    return episode


def score(rate: float, seed: int) -> float:
    """Return how good a training ends: the mean return of its last 50 episodes, % of the best."""
    return float(np.mean(learn(_reinforce, rate, seed, HARD_NEAR)[0][-50:]))


def five_seeds(rate: float = 0.3) -> list[list[float]]:
    """Return the returns of five trainings that differ in the seed only."""
    return [learn(_reinforce, rate, seed, HARD_NEAR)[0] for seed in range(5)]


def _reinforce(preferences: Array, episode: Episode, rate: float, discount: float) -> Array:
    after, worth = preferences.copy(), 0.0
    for cell, action, reward in reversed(episode):
        worth = reward + discount * worth
        step = -softmax(preferences[cell])
        step[action] += 1
        after[cell] += rate * worth * step
    return after


def as_preferences(given: Any, shape: tuple[int, ...]) -> Array:
    """Return a student's table of preferences.

    Raises:
        NotYet: it is something else, or holds numbers that are not finite.
    """
    if given is None:
        raise NotYet(
            _("Your function returned nothing (None). Is `return` missing?"), hint="no-return"
        )
    try:
        found = np.array(given, float)
    except (TypeError, ValueError, OverflowError):
        found = np.zeros(0)
    if found.shape != shape or isinstance(given, bool | str):
        raise NotYet(
            _(
                "Expected the table of preferences, {shape} rows with {shape2} numbers.",
                shape=shape[0],
                shape2=shape[1],
            )
        )
    if not np.isfinite(found).all():
        raise NotYet(_("There are numbers in the table that are not finite."), hint="not-finite")
    return found


class Game:
    """Environment with PettingZoo's interface, whose agents end at different times.

    Args:
        names: of the agents.
    """

    def __init__(self, *names: str) -> None:
        self.possible_agents = list(names)
        self.agents: list[str] = []
        self.seed: int | None = None
        self.totals: dict[str, float] = {}
        """Rewards so far, by agent."""
        self.steps: dict[str, int] = {}
        """Steps so far, by agent; each is worth 1 if its action was right."""

    def reset(self, seed: int | None = None, options: Any = None) -> tuple[Any, Any]:
        """Begin a game."""
        del options
        self.seed = seed
        self._chance = np.random.default_rng(seed)
        self.agents = list(self.possible_agents)
        self._left = {name: int(self._chance.integers(3, 12)) for name in self.agents}
        # so that some end before others, and one of them by time
        self._left[self.agents[0]] = 14
        self.totals = dict.fromkeys(self.agents, 0.0)
        self.steps = dict.fromkeys(self.agents, 0)
        self._observed = self._observations(self.agents)
        return dict(self._observed), {name: {} for name in self.agents}

    def step(self, actions: Mapping[str, Any]) -> tuple[Any, Any, Any, Any, Any]:
        """Run one step; an action is right if it is the agent's observation, times two."""
        if not self.agents:
            raise NotYet(
                _(
                    "You called `step` although no agent takes part any more (`env.agents` "
                    "is empty)."
                ),
                hint="over",
            )
        acting = list(self.agents)
        missing = [name for name in acting if name not in actions]
        if missing:
            raise NotYet(
                _("`step` got no action for {missing!r}.", missing=missing[0]), hint="actions"
            )
        rewards = {name: self._reward(name, actions[name]) for name in acting}
        for name in acting:
            self._left[name] -= 1
            self.steps[name] += 1
            self.totals[name] += rewards[name]
        over = {name: self._left[name] <= 0 for name in acting}
        by_time = {name: over[name] and name == self.possible_agents[0] for name in acting}
        ended = {name: over[name] and not by_time[name] for name in acting}
        self.agents = [name for name in acting if not over[name]]
        self._observed = self._observations(acting)
        return dict(self._observed), rewards, ended, by_time, {name: {} for name in acting}

    def policies(self) -> dict[str, Callable[[Any], float]]:
        """Return a policy for each agent: right for its own observations only."""
        return {name: partial(mul, factor) for factor, name in enumerate(self.possible_agents, 2)}

    def _observations(self, names: list[str]) -> dict[str, float]:
        return {name: float(self._chance.integers(1, 100)) for name in names}

    def _reward(self, name: str, action: Any) -> float:
        wanted = (self.possible_agents.index(name) + 2) * self._observed[name]
        return 1.0 if finite_number(action) == wanted else -5.0

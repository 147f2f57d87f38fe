"""One step of policy gradient: the right ones, and the mistakes that explain a wrong one."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from ai4u_edu.lessons.exercises.lesson_14_worlds import Array, Episode, softmax
from ai4u_edu.lessons.numeric import is_close


def updated(
    preferences: Array,
    episode: Episode,
    rate: float,
    discount: float,
    *,
    order: str = "once",
    weighted: bool = False,
    worth_of: Callable[[Episode, int, float], float] | None = None,
    gradient: Callable[[Array, int], Array] | None = None,
) -> Array:
    """Return the preferences after one episode.

    Args:
        preferences: before it, (cells, actions).
        episode: cell, action and reward of each step.
        rate: learning rate.
        discount: of later rewards.
        order: ``once``: all steps from the preferences before; else one after another.
        weighted: whether later steps of an episode count less, as in Sutton and Barto's book.
        worth_of: what a step is multiplied by; left out, its discounted return.
        gradient: of the logarithm of an action's probability, from probabilities and action.
    """
    after = preferences.copy()
    steps = list(range(len(episode)))
    for number in reversed(steps) if order == "backward" else steps:
        cell, action, _ = episode[number]
        worth = (worth_of or _worth)(episode, number, discount)
        chances = softmax((preferences if order == "once" else after)[cell])
        step = (gradient or _gradient)(chances, action)
        after[cell] += rate * worth * (discount**number if weighted else 1) * step
    return after


def _worth(episode: Episode, number: int, discount: float) -> float:
    return float(sum(r * discount**n for n, (_, _, r) in enumerate(episode[number:])))


def _gradient(chances: Array, action: int) -> Array:
    return np.asarray(np.eye(len(chances))[action] - chances)


def rounded(row: Array) -> list[float]:
    """Return a row of preferences as it is shown."""
    return [float(each) for each in row.round(3)]


def gradient_mistake(
    before: Array, episode: Episode, rate: float, discount: float, got: Array
) -> str:
    """Return the diagnosis of wrong preferences; empty for an unknown mistake."""

    def sums_forward(steps: Episode, number: int, discount: float) -> float:
        worth = 0.0
        for _, _, reward in steps[: number + 1]:
            worth = reward + discount * worth
        return worth

    def undiscounted(steps: Episode, number: int, _: float) -> float:
        return sum(reward for _, _, reward in steps[number:])

    def whole(steps: Episode, _: int, discount: float) -> float:
        return _worth(steps, 0, discount)

    slips: Mapping[str, dict[str, Any]] = {
        "sign": {"gradient": lambda chances, action: -_gradient(chances, action)},
        "onehot": {"gradient": lambda chances, action: np.eye(len(chances))[action]},
        "probability": {
            "gradient": lambda chances, action: chances[action] * _gradient(chances, action)
        },
        "reward": {"worth_of": lambda steps, number, _: steps[number][2]},
        "undiscounted": {"worth_of": undiscounted},
        "past": {"worth_of": whole},
        "forward": {"worth_of": sums_forward},
    }
    if is_close(got, before, 1e-6):
        return "begin"
    for order in ("once", "forward", "backward"):
        if is_close(got, updated(before, episode, 1.0, discount, order=order), 1e-6):
            return "rate"
        for name, slip in slips.items():
            if is_close(got, updated(before, episode, rate, discount, order=order, **slip), 1e-6):
                return name
    return ""

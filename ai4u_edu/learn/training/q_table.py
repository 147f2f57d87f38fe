"""Q-learning with a table: the oldest and smallest way to learn from reward alone.

The table estimates for each action in each state the discounted reward that will follow. It begins
with zeros, and each step corrects one number a little.
"""

from collections.abc import Callable, Hashable
from typing import Any

import gymnasium
import numpy as np
import numpy.typing as npt
from gymnasium.spaces import Discrete

from ai4u_edu.base.errors import SetupError, suggest
from ai4u_edu.learn.training.progress_bar import counted
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene

DIRTY_CODE = 200
"""Code of a dirty place in the grid world's map."""


def grid_state(seen: Any) -> Hashable:
    """Return the state of the grid world: the robot's cell, and which places are still dirty.

    The cell alone is not enough: where to go next depends on what has been cleaned already.

    Args:
        seen: an observation or a percept with a ``grid`` and a ``cell``.
    """
    row, column = seen["cell"]
    return int(row), int(column), *np.flatnonzero(seen["grid"] == DIRTY_CODE).tolist()


def still(scene: Scene, *but: str) -> Scene:
    """Return a scene in which everything is in the same place in each episode.

    The places of enemies and persons are not in :func:`grid_state`, so a table learns one world.

    Args:
        scene: stays as it is.
        but: names of bodies that stay random, such as the robot.

    >>> scene = still(Scene.load("grid_world"), "robot")
    >>> [thing.name for thing in scene.description.things if thing.random]
    ['robot']
    """
    names = [thing.name for thing in scene.description.things]
    for name in but:
        if name not in names:
            raise SetupError(
                _(
                    "the scene has nothing called {name!r}; {hint}",
                    name=name,
                    hint=suggest(name, names),
                )
            )
    fixed = {"random": None, "curriculum": None}
    kinds = {
        kind: tuple(
            thing if thing.name in but else thing.model_copy(update=fixed)
            for thing in getattr(scene.description, kind)
        )
        for kind in ("floors", "areas", "bodies")
    }
    return Scene(scene.description.model_copy(update=kinds), scene.folder)


class QTable:
    """Estimated value of each action in each state.

    Args:
        actions: number of actions to choose from.
        state: makes a state from an observation.
        output: the actuator's name.
    """

    def __init__(
        self, actions: int, state: Callable[[Any], Hashable] = grid_state, output: str = "move"
    ) -> None:
        self.actions, self.state, self.output = actions, state, output
        self.values: dict[Hashable, npt.NDArray[np.float64]] = {}
        self.returns: list[float] = []
        """The reward of each episode that it learned from."""

    def of(self, state: Hashable) -> npt.NDArray[np.float64]:
        """Return the values of all actions in a state, (actions,)."""
        return self.values.setdefault(state, np.zeros(self.actions))

    def best(self, state: Hashable) -> int:
        """Return the action with the largest value; the first of several."""
        known = self.values.get(state)  # to ask must not fill the table
        return 0 if known is None else int(known.argmax())

    def drive(self, percept: Any) -> dict[str, int]:
        """Act greedily, as a controller: ``LocalBrain(controller=table.drive)``."""
        return {self.output: self.best(self.state(percept))}


def q_learning(
    env: gymnasium.Env[Any, Any],
    *,
    state: Callable[[Any], Hashable] = grid_state,
    episodes: int = 500,
    rate: float = 0.5,
    discount: float = 0.99,
    curiosity: float = 0.1,
    seed: int = 0,
    quiet: bool = False,
) -> QTable:
    """Learn a table by trial and error. Source: C. Watkins, 1989.

    The grid world, with its things in one place: 500 episodes (about 15 seconds) are enough; and
    then ``evaluate(table.drive, scene)``.

    Args:
        env: with a few actions (Discrete).
        state: makes a state from an observation: all that the best action depends on.
        episodes: number of episodes.
        rate: learning rate; 1 keeps only the last experience.
        discount: value of a reward that comes one step later.
        curiosity: probability of a random action instead of the best one (epsilon).
        seed: seed of the worlds and of all random choices.
        quiet: True shows nothing.

    >>> import gymnasium, ai4u_edu
    >>> scene = still(Scene.load("grid_world"), "robot")
    >>> env = gymnasium.make("ai4u_edu/GridWorld-v0", scene=scene)
    >>> table = q_learning(env, episodes=2, quiet=True)
    >>> table.drive(env.reset(seed=0)[0])["move"] in range(5)
    True
    """
    if not isinstance(env.action_space, Discrete):
        raise SetupError(
            _(
                "expected actions to choose from (Discrete), got {action_space}",
                action_space=str(env.action_space),
            )
        )
    actions = int(env.action_space.n)
    table, chance = QTable(actions, state), np.random.default_rng(seed)
    for episode in counted(range(episodes), "Q-learning", quiet=quiet):
        seen, _info = env.reset(seed=2**40 + 1000 * seed + episode)
        here, over, total = state(seen), False, 0.0
        while not over:
            curious = chance.random() < curiosity
            action = int(chance.integers(actions)) if curious else table.best(here)
            seen, paid, terminated, truncated, _info = env.step(action)
            reward = float(paid)
            there = state(seen)
            to_come = 0.0 if terminated else table.of(there).max()
            values = table.of(here)
            values[action] += rate * (reward + discount * to_come - values[action])
            here, over, total = there, terminated or truncated, total + reward
        table.returns.append(total)
    return table

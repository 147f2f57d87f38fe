"""Reinforcement learning: it tries things out, and does more of what paid."""

import os
import shutil
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ai4u_edu.explain import Group, Occlusion
from ai4u_edu.lessons.exercise import Done, NotYet, a_function, exercise, named
from ai4u_edu.lessons.exit_ticket import Question, exit_ticket
from ai4u_edu.lessons.numeric import Slip, chance_for, difference, finite_number, is_close
from ai4u_edu.lessons.rollouts import drive, driven_by, seeds_of
from ai4u_edu.lessons.student_errors import NOTHING_RETURNED
from ai4u_edu.lessons.wrong_reward import OUTCOMES, Hacker, outcomes
from ai4u_edu.locale import gettext as _

if TYPE_CHECKING:
    import gymnasium

    from ai4u_edu.learn.training import QTable
    from ai4u_edu.learn.training.run import Check, Trained

    Update = Callable[[float, float, float, float, float], float]

CELLS, START, SLIP = 8, 2, 0.1
"""Corridor: number of cells, first cell, probability of a slip; from a pit to the goal."""
RATE, DISCOUNT, TRIES = 0.5, 0.9, 0.3
SHORT, ENOUGH = 100, 2000
"""With AI4U_FAST: decisions to learn from, and the requested number that counts as enough."""
EPISODES, NEEDED, LIMIT = 100, 95, 200


@dataclass(frozen=True)
class Shortened:
    """Result of :func:`learn` in tests: a finished network, as there is no time to train one."""

    checks: "list[Check]"
    path: Path


def learn(steps: int, seed: int = 0, *, quiet: bool = False) -> "Trained | Shortened":
    """Train SAC in the box chase, in the folder ``runs/sac-STEPS-SEED``.

    With ``AI4U_FAST=1`` it trains for an instant, and returns the package's network if enough steps
    were requested.

    Args:
        steps: decisions to learn from, at the most.
        seed: seed of the network, the worlds and all random choices.
        quiet: True shows nothing.
    """
    from ai4u_edu.blocks.brains.network import find_network
    from ai4u_edu.learn.training import train

    fast = bool(os.environ.get("AI4U_FAST"))
    settings: dict[str, Any] = {"sac": {"check_every": 500}, "enough": 3}
    trained = train(
        "box_chase",
        "sac",
        steps=min(steps, SHORT) if fast else steps,
        seed=seed,
        out=Path("runs") / f"sac-{steps}-{seed}",
        settings=settings | ({"check_episodes": 2} if fast else {}),
        overwrite=True,
        quiet=quiet or fast,
    )
    if fast and steps >= ENOUGH:
        return Shortened(trained.checks, find_network("zoo:box_chase", None))
    return trained


def keep(trained: "Trained | Shortened", path: str | Path = "sac.onnx") -> Path:
    """Write a training's network into a file.

    Args:
        trained: the result of :func:`learn`.
        path: the file's path.
    """
    from ai4u_edu.learn.training import export

    if isinstance(trained, Shortened):
        return Path(shutil.copyfile(trained.path, path))
    return export(trained, path)


def learn_house(grid_world: "gymnasium.Env[Any, Any]", episodes: int = 500) -> "QTable":
    """Learn a table by Q-learning; with ``AI4U_FAST=1`` from a few episodes only.

    Args:
        grid_world: the environment, with everything in the same place in each episode.
        episodes: number of episodes.
    """
    from ai4u_edu.learn.training import q_learning

    fast = bool(os.environ.get("AI4U_FAST"))
    return q_learning(grid_world, episodes=3 if fast else episodes, quiet=fast)


def corridor(update: "Update", episodes: int = 40, seed: int = 0) -> list[list[float]]:
    """Let a walker learn a corridor: a pit (-1) at its left end, the goal (+1) at its right end.

    One step in ten slips into the other direction.

    Args:
        update: the new value of a step, from (value, reward, best_next, rate, discount).
        episodes: number of walks.
        seed: seed of its random choices.

    Returns:
        The value of the better step in each cell, after each walk.
    """
    chance = np.random.default_rng(seed)
    values = np.zeros((CELLS, 2))
    history = []
    for _number in range(episodes):
        cell = START
        while 0 < cell < CELLS - 1:
            tries = chance.random() < TRIES or values[cell, 0] == values[cell, 1]
            step = int(chance.integers(2)) if tries else int(values[cell].argmax())
            slips = chance.random() < SLIP
            now = cell + (1 if (step == 1) != slips else -1)
            reward = {0: -1.0, CELLS - 1: 1.0}.get(now, 0.0)
            said = update(values[cell, step], reward, values[now].max(), RATE, DISCOUNT)
            values[cell, step] = finite_number(said)
            cell = now
        history.append([float(each) for each in values.max(axis=1)])
    return history


@exercise(
    "10.1",
    _("What later is worth now"),
    hints={
        "undiscounted": _(
            "Every reward counts in full. Later ones have to count less: multiply the reward "
            "number n by `discount ** n`."
        ),
        "later": _(
            "Rewards that come later have to count less. `enumerate(rewards)` gives each "
            "reward with its number n: 0, 1, 2 ... Multiply each by `discount ** n`."
        ),
        "linear": _(
            "The discount is applied once per reward, not once per step: it is a power, "
            "`discount ** n`, and not a product."
        ),
        "once": _(
            "The whole sum is discounted once. Each reward has its own power of the discount."
        ),
        "backward": _(
            "The order is turned round: the first reward comes now, the last one latest."
        ),
        "first": _(
            "The first reward comes now: it counts in full. Its number is 0, and `discount "
            "** 0` is 1."
        ),
    },
)
def discounts(worth: Any) -> str:
    """Check the discounted return of rewards."""
    chance = chance_for("10.1", worth)
    for length in (3, 1, 0, 6, 20):
        rewards = [float(each) for each in chance.integers(-5, 10, length)]
        discount = round(float(chance.uniform(0.3, 0.9)), 2)
        right = sum(reward * discount**n for n, reward in enumerate(rewards))
        got = finite_number(a_function(worth)(list(rewards), discount))
        if not is_close(got, right, 1e-6):
            slips = {
                "first": (_("the right sum, discounted once more"), discount * right),
                "undiscounted": (_("the sum without the discount"), sum(rewards)),
                "linear": (
                    _("right for `discount * n` in place of `discount ** n`"),
                    sum(reward * discount * n for n, reward in enumerate(rewards)),
                ),
                "once": (_("the whole sum, discounted once"), discount * sum(rewards)),
                "backward": (
                    _("right for the list turned round"),
                    sum(reward * discount**n for n, reward in enumerate(reversed(rewards))),
                ),
            }
            slip = difference(got, slips, 1e-6) if length > 1 else Slip("", "")
            raise NotYet(
                _(
                    "With the rewards {rewards} and a discount of {discount} expected "
                    "{right:.3f}, got {got:.3f}{words}.",
                    rewards=str(rewards[:6]),
                    discount=discount,
                    right=right,
                    got=got,
                    words=slip.words,
                ),
                hint=slip.name or ("later" if is_close(got, 0, 0) else ""),
            )
    return _("Five lists of rewards, all of them worth what they should be.")


@exercise(
    "10.2",
    _("One step of learning"),
    hints={
        "stays": _(
            "`value` comes back as it was: nothing is learned. What has the step brought? "
            "The reward, and what can still be had from there: `reward + discount * "
            "best_next`. Move the value a part of the way to that."
        ),
        "jump": _(
            "The value jumps all the way to what happened last. Once is no proof: go only "
            "the part `rate` of the way, `value + rate * (target - value)`."
        ),
        "undiscounted": _(
            "What comes later counts less than what is paid now: multiply `best_next` by "
            "`discount`."
        ),
        "minus-value": _(
            "The value grows and grows. Move it by a part of the *difference* between target "
            "and value: `rate * (target - value)`."
        ),
        "bracket": _(
            "Without brackets the rate multiplies only the target: `value + rate * (target - "
            "value)`."
        ),
        "other-side": _(
            "A rate of 0 should change nothing, a rate of 1 everything. With yours it is the "
            "other way round."
        ),
        "all-discounted": _("The reward of this step is paid now: only `best_next` is discounted."),
        "future": _(
            "Only the reward of this very step counts with you. The goal pays at the last "
            "step alone, so no cell before it would ever be worth anything: add `discount * "
            "best_next`."
        ),
    },
)
def learns_a_step(update: Any) -> str:
    """Check the update of a value, and a walker that learns by it."""
    chance = chance_for("10.2", update)
    for _number in range(20):
        value, reward, best, rate, discount = (
            round(float(each), 2) for each in chance.uniform(0.1, 0.9, 5)
        )
        target = reward + discount * best
        right = value + rate * (target - value)
        got = finite_number(a_function(update)(value, reward, best, rate, discount))
        if not is_close(got, right, 1e-6):
            slips = {
                "stays": (_("the value as it was: nothing is learned"), value),
                "jump": (_("the target itself, as if the rate were 1"), target),
                "future": (
                    _("right without the rewards from there on"),
                    value + rate * (reward - value),
                ),
                "undiscounted": (
                    _("right without the discount"),
                    value + rate * (reward + best - value),
                ),
                "minus-value": (_("right without `- value`"), value + rate * target),
                "bracket": (
                    _("right but for a bracket: the rate has to multiply the whole difference"),
                    value + rate * target - value,
                ),
                "other-side": (
                    _("right with the rate on the wrong side"),
                    rate * value + (1 - rate) * target,
                ),
                "all-discounted": (
                    _("right if the reward were discounted too"),
                    value + rate * (discount * (reward + best) - value),
                ),
            }
            slip = difference(got, slips, 1e-6)
            raise NotYet(
                _(
                    "A value of {value:.2f}, a reward of {reward:.2f}, {best:.2f} to be had "
                    "from there, a rate of {rate:.2f} and a discount of {discount:.2f}: "
                    "expected {right:.3f}, got {got:.3f}{words}.",
                    value=value,
                    reward=reward,
                    best=best,
                    rate=rate,
                    discount=discount,
                    right=right,
                    got=got,
                    words=slip.words,
                ),
                hint=slip.name,
            )
    learned = [corridor(update, seed=seed)[-1][START] for seed in seeds_of("10.2", 10)]
    return _(
        "A walker who learns by it knew its way after 40 walks: in the cell where it "
        "begins, the better step was worth {mean:.2f}.",
        mean=float(np.mean(learned)),
    )


@exercise(
    "10.3",
    _("Long enough"),
    hints={
        "longer": _(
            "A decision takes the robot 1/6 s here, so 400 decisions are about a minute of "
            "life, and in the first 500 it only tries things out. Let it learn from 5,000 or "
            "10,000; it stops by itself when it is good."
        ),
        "again": _(
            "It is nearly there. Chance plays a part in learning: look at the curve, let it "
            "learn from more decisions, or take another `seed`."
        ),
    },
)
def has_learned(trained: Any) -> Done:
    """Check for success in 95 of 100 unseen worlds."""
    from ai4u_edu.scenes import Scene

    if not isinstance(trained, Shortened):
        _expect_trained(trained)
    sim = driven_by(trained, Scene.load("box_chase"))
    agent = sim.agents[0]
    fast = bool(os.environ.get("AI4U_FAST"))
    episodes = EPISODES // 10 if fast else EPISODES
    won = lost = 0
    for done in (drive(sim, agent, seed, LIMIT) for seed in seeds_of("10.3", episodes)):
        won, lost = won + done.won, lost + (not done.won)
        if lost > (1 - NEEDED / EPISODES) * episodes:
            how = _("it fell") if done.fell else _("it did not get there in time")
            raise done.not_yet(
                _(
                    "In {lost} of {won} worlds it failed; in the last of them {how} ({where}).",
                    lost=lost,
                    won=won + lost,
                    how=how,
                    where=done.where,
                ),
                "again" if won > 4 * lost else "longer",
            )
    return Done(
        _(
            "It reached the box in {won} of {episodes} worlds that it never saw.",
            won=won,
            episodes=episodes,
        )
    )


def _expect_trained(trained: Any) -> None:
    from ai4u_edu.learn.training.run import Trained

    if not isinstance(trained, Trained):
        raise NotYet(_("Expected what `learn(...)` returned, got {got}.", got=named(trained)))


@exercise(
    "10.4",
    _("The wrong reward, learned"),
    hints={
        "name": _('Write your guess into `prediction`: "touches", "lingers" or "falls".'),
        "touches": _(
            "A touch pays 10, once, and ends the episode. Being near pays up to 3 at each of "
            "60 decisions. Which sum is larger?"
        ),
        "falls": _("A fall costs 1 and ends the payments. What is there to be had on the plate?"),
        "untrained": _("`hacked` has to be what `learn_wrong_reward()` returns."),
    },
)
def predicts_the_learner(prediction: Any, hacked: Any) -> Done:
    """Check the predicted behaviour of a robot that learned with a well-meant reward."""
    if not isinstance(hacked, Hacker):
        raise NotYet(
            _("Expected what `learn_wrong_reward()` returned, got {got}.", got=named(hacked)),
            hint="untrained",
        )
    if not isinstance(prediction, str) or prediction not in OUTCOMES:
        raise NotYet(
            _(
                "Expected one of {listed} as your guess, got {got}.",
                listed=", ".join(OUTCOMES),
                got=named(prediction),
            ),
            hint="name",
        )
    worlds = 20
    counts, last = outcomes(hacked, seeds_of("10.4", worlds))
    touches, lingers, falls = (counts[each] for each in OUTCOMES)
    told = _(
        "In {worlds} worlds it touched the box in {touches}, fell in {falls}, and was "
        "still on the plate when time was up in {lingers}.",
        worlds=worlds,
        touches=touches,
        falls=falls,
        lingers=lingers,
    )
    if counts[prediction] < max(counts.values()):
        raise NotYet(told, hint=prediction, picture=last.picture())
    return Done(_("You saw it coming. {told}", told=told), last.picture())


@exercise(
    "10.5",
    _("What does it look at most?"),
    hints={
        "first": _(
            "That is the first slot. Compare them all: `told.shift[n]` is a list, and its "
            "largest number, without its sign, says how far slot n moves the action."
        ),
        "sign": _(
            "To the left or to the right: both are movements. Compare the sizes, as "
            "`abs(...)` gives them."
        ),
        "sum": _(
            "Movements to both sides do not cancel, and small ones do not add up: for each "
            "slot only the largest one counts."
        ),
        "name": _("Return one of the names in `told.names`."),
    },
)
def finds_what_matters(looks_most_at: Any) -> str:
    """Check on made-up explanations that the slot with the largest movement is found."""
    a_function(looks_most_at)
    rng = chance_for("10.5", looks_most_at)
    names = ("ray 1", "ray 2", "speed", "box")
    mistakes = ("first", "", "sum", "sign")
    moved = np.array([[0.5, 0.0, 0.4], [0.0, -0.8, 0.1], [0.6, 0.6, 0.6], [-0.7, 0.1, 0.7]])
    for shift, winner in enumerate(rng.permutation(names)):
        others = iter(rng.permutation([name for name in names if name != winner]))
        named_by = [str(next(others) if mistake else winner) for mistake in mistakes]
        order = [(number + shift) % len(names) for number in range(len(names))]
        groups = tuple(
            Group(named_by[row], "all", np.arange(4) == number) for number, row in enumerate(order)
        )
        action = rng.uniform(-1, 1, size=3)
        told = Occlusion(groups, ("left", "right", "jump"), action, action - moved[order])
        got = looks_most_at(told)
        if got is None:
            raise NotYet(NOTHING_RETURNED, hint="no-return")
        if not isinstance(got, str) or got not in names:
            raise NotYet(
                _("Expected one of {names}, got {got}.", names=repr(told.names), got=named(got)),
                hint="name",
            )
        if got != winner:
            hint = "first" if got == told.names[0] else mistakes[named_by.index(got)]
            raise NotYet(
                _(
                    "Expected '{winner}', which moves a number by -0.8, got {got!r}.",
                    winner=winner,
                    got=got,
                ),
                hint=hint,
            )
    return _("You found the slot that matters most in four explanations.")


exit_ticket(
    "10.exit",
    Question(
        "b",
        {
            "a": _(
                "Only the touch pays much here, and each decision before it makes it count less."
            ),
            "c": _(
                "Without a discount that would be so. With one, 100 counts less for each "
                "decision that it comes later."
            ),
        },
    ),
    Question(
        "c",
        {
            "a": _(
                "An update looks one step ahead. On the earlier steps the best value ahead "
                "was still 0."
            ),
            "b": _(
                "The last step brought a reward, so its value moved at once, by the learning rate."
            ),
        },
    ),
    Question(
        "a",
        {
            "b": _(
                "It may have learned these worlds by heart. Only a test on other seeds can tell."
            ),
            "c": _(
                "It may have learned them by heart, or it may have understood. Only a test "
                "can tell."
            ),
        },
    ),
)

"""Inside learning: exploration, policy gradient, seeds, and the interfaces of environments."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from ai4u_edu.base.optional_deps import need
from ai4u_edu.lessons.exercise import Done, NotYet, a_function, exercise, named
from ai4u_edu.lessons.exercises.lesson_14_worlds import (
    BEST,
    WALKS,
    Array,
    Episode,
    Game,
    as_preferences,
    explore,
    learn,
    softmax,
)
from ai4u_edu.lessons.exit_ticket import Question, exit_ticket
from ai4u_edu.lessons.numeric import chance_for, finite_number, is_close
from ai4u_edu.lessons.rollouts import seeds_of
from ai4u_edu.lessons.student_errors import NOTHING_RETURNED
from ai4u_edu.locale import gettext as _

WALKERS, GOOD_WALKERS = 20, 10
LAST, GOOD = 20, 0.9
"""Walks at the end that are looked at, and their share of the best possible return."""
LATE = 0.05
"""Mean probability of random steps in the last walks that is too much."""


@exercise(
    "14.1",
    _("Explore, then use it"),
    call_limit_s=30,
    hints={
        "none": _(
            "It never tries anything new, so it stays with the reward that it found first. "
            "Begin with a large probability."
        ),
        "always": _(
            "It still tries things when it knows the way. Let the probability fall to 0, or "
            "nearly, before the last walks."
        ),
        "short": _(
            "It stops trying before it has found the far reward, in too many of the worlds. "
            "Begin with more, or let it fall more slowly."
        ),
        "reversed": _(
            "It tries more and more. It should be the other way round: try while nothing is known."
        ),
        "percent": _("A probability lies between 0 and 1."),
    },
)
def explores(epsilon: Any) -> Done | str:
    """Check twenty walkers that explore by a schedule."""
    schedule = a_function(epsilon)
    chances = [finite_number(schedule(walk, WALKS)) for walk in range(WALKS)]
    outside = [each for each in chances if not 0 <= each <= 1]
    if outside:
        raise NotYet(_("Your function gave {outside:g}.", outside=outside[0]), hint="percent")
    good = found = 0
    for seed in seeds_of("14.1", WALKERS):
        walks = explore(schedule, seed)
        good += float(np.mean(walks.returns[-LAST:])) >= GOOD * BEST
        found += bool(walks.values[2, 1] > walks.values[2, 0])
    told = _(
        "{found} of {walkers} walkers learned that the far reward is better; {good} went "
        "straight to it in their last {last} walks.",
        found=found,
        walkers=WALKERS,
        good=good,
        last=LAST,
    )
    if good >= GOOD_WALKERS:
        return told
    early, late = float(np.mean(chances[:LAST])), float(np.mean(chances[-LAST:]))
    if late > LATE:
        hint = "reversed" if late > 1.5 * early and late > early + 0.1 else "always"
    else:
        hint = "short" if any(chances) else "none"
    raise NotYet(
        _("{told} {good_walkers} are needed.", told=told, good_walkers=GOOD_WALKERS), hint=hint
    )


@exercise(
    "14.2",
    _("Policy gradient"),
    hints={
        "begin": _(
            "The preferences come back as they were. Go through the episode from its end: "
            "`for cell, action, reward in reversed(episode)`."
        ),
        "sign": _("It goes the wrong way: what paid becomes less probable. Add the step."),
        "onehot": _(
            "Only the action that was taken is changed. All preferences of the cell go down "
            "by `rate * worth * probability`, and the one of the taken action goes up by "
            "`rate * worth` besides."
        ),
        "reward": _(
            "Only the reward of the step itself counts with you. In this corridor all steps "
            "but the last one have none: count what came after, too, discounted."
        ),
        "undiscounted": _(
            "Later rewards count as much as early ones: `worth = reward + discount * worth`, "
            "from the end of the episode to its beginning."
        ),
        "past": _(
            "You multiply each step by the whole episode's return. That learns as well, only "
            "with more noise: a step can't change what was paid before it. Count from this "
            "step on."
        ),
        "forward": _("The returns are summed up from the wrong end. Begin with the last step."),
        "probability": _(
            "You multiply by the probability of the action. The gradient of its *logarithm* "
            "is wanted: 1 minus the probability, for the action that was taken."
        ),
        "rate": _("The learning rate is missing."),
    },
)
def follows_the_gradient(reinforce: Any) -> str:
    """Check one step of policy gradient, and a training with it."""
    update = a_function(reinforce)
    chance = chance_for("14.2", update)
    for length in (1, 3, 6, 4):
        cells, actions = int(chance.integers(3, 6)), int(chance.integers(2, 4))
        before: Array = chance.normal(size=(cells, actions)).round(2)
        episode: Episode = [
            (
                int(chance.integers(cells)),
                int(chance.integers(actions)),
                round(float(chance.uniform(0.2, 2)), 1),
            )
            for _ in range(length)
        ]
        rate, discount = (round(float(chance.uniform(0.3, 0.9)), 2) for _ in range(2))
        given = before.copy()
        got = as_preferences(update(given, list(episode), rate, discount), before.shape)
        right = [
            _updated(before, episode, rate, discount, order=order, weighted=weighted)
            for order in ("once", "forward", "backward")
            for weighted in (False, True)
        ]
        if not any(is_close(got, each, 1e-6) for each in right):
            cell = int(np.abs(got - right[0]).sum(axis=1).argmax())
            raise NotYet(
                _(
                    "An episode of {length} steps, rate {rate}, discount {discount}: the "
                    "preferences of cell {cell} should become {expected}, and become "
                    "{found}.",
                    length=length,
                    rate=rate,
                    discount=discount,
                    cell=cell,
                    expected=str(_rounded(right[0][cell])),
                    found=str(_rounded(got[cell])),
                ),
                hint=_gradient_mistake(before, episode, rate, discount, got),
            )
    returns = [np.mean(learn(update, seed=seed)[0][-50:]) for seed in seeds_of("14.2", 5)]
    told = ", ".join(f"{each:.0f}" for each in returns)
    return _(
        "Four episodes, all right. Five trainings ended at {told} percent of the best return.",
        told=told,
    )


CALMS, MAX_FALSE = 200, 24
"""Comparisons of two equally good methods, and how many of them may end with a claim."""
CLEAR, MIN_FOUND = 50, 45
"""Comparisons in which one is clearly better, and how many of them have to be found."""
CLAIMS = ("first", "second", "unclear")


def _updated(
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
        worth_of: what a step is multiplied by; default: its discounted return.
        gradient: of the logarithm of an action's probability, from probabilities and action.
    """
    after = preferences.copy()
    steps = list(range(len(episode)))
    for number in reversed(steps) if order == "backward" else steps:
        cell, action, _reward = episode[number]
        worth = (worth_of or _worth)(episode, number, discount)
        chances = softmax((preferences if order == "once" else after)[cell])
        step = (gradient or _gradient)(chances, action)
        after[cell] += rate * worth * (discount**number if weighted else 1) * step
    return after


def _worth(episode: Episode, number: int, discount: float) -> float:
    return float(sum(r * discount**n for n, (_, _, r) in enumerate(episode[number:])))


def _gradient(chances: Array, action: int) -> Array:
    return np.asarray(np.eye(len(chances))[action] - chances)


def _rounded(row: Array) -> list[float]:
    """Return a row of preferences as it is shown."""
    return [float(each) for each in row.round(3)]


def _gradient_mistake(
    before: Array, episode: Episode, rate: float, discount: float, got: Array
) -> str:
    """Return the diagnosis of wrong preferences; empty for an unknown mistake."""

    def sums_forward(steps: Episode, number: int, discount: float) -> float:
        worth = 0.0
        for *_steps, reward in steps[: number + 1]:
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
        if is_close(got, _updated(before, episode, 1.0, discount, order=order), 1e-6):
            return "rate"
        for name, slip in slips.items():
            if is_close(got, _updated(before, episode, rate, discount, order=order, **slip), 1e-6):
                return name
    return ""


@exercise(
    "14.3",
    _("May you claim it?"),
    hints={
        "mean": _(
            "The larger mean is not enough: two equally good methods never have the same "
            "mean. How large is the difference, compared with its noise?"
        ),
        "timid": _(
            "It misses a difference that many runs show. The mean of n runs varies less than "
            "a single run: by the standard deviation divided by the square root of n."
        ),
        "reversed": _("It claims the one with the lower results."),
        "one-sided": _("Sometimes the second one is better. Say `second` then."),
        "few": _(
            "With few runs your function claims too much. Count how often it claims "
            "something about two equally good methods: at most about one time in ten."
        ),
        "name": _('Return "first", "second" or "unclear".'),
        "idle": _('"unclear" alone is never wrong, and never of any use.'),
    },
)
def claims(claim: Any) -> str:
    """Check a claim about two methods, with methods that are known."""
    judge = a_function(claim)
    chance = np.random.default_rng(seeds_of("14.3", 1)[0])
    false = _counts(judge, chance, CALMS, [5, 10, 20], 0.0)
    found: dict[str, dict[str, int]] = {}
    for name, runs, distance in (("large", 5, 5.0), ("small", 50, 1.0)):
        found[name] = _counts(judge, chance, CLEAR, [runs], distance)
    claimed = false["right"] + false["wrong"]
    large, small = found["large"]["right"], found["small"]["right"]
    told = _(
        "Two equally good methods: {claimed} claims in {calms} comparisons. A difference "
        "of 5 standard deviations, 5 runs each: found in {large} of {clear}. Of 1, with "
        "50 runs each: found in {small} of {clear}.",
        claimed=claimed,
        calms=CALMS,
        large=large,
        clear=CLEAR,
        small=small,
    )
    if claimed > MAX_FALSE:
        raise NotYet(told, hint="mean" if claimed > CALMS / 2 else "few")
    for each in found.values():
        if each["wrong"] > CLEAR / 4:
            raise NotYet(told, hint="reversed")
        if each["right"] < MIN_FOUND:
            raise NotYet(told, hint=_shyness(found))
    return told


def _shyness(found: Mapping[str, Mapping[str, int]]) -> str:
    if not any(each["right"] for each in found.values()):
        return "idle"
    half = all(each["second"] == 0 for each in found.values())
    return "one-sided" if half else "timid"


def _counts(
    judge: Callable[..., Any],
    chance: np.random.Generator,
    comparisons: int,
    runs: list[int],
    distance: float,
) -> dict[str, int]:
    """Return how many comparisons ended with a right claim, a wrong one, and `second`.

    Args:
        judge: the student's function.
        chance: generator of the results.
        comparisons: number of comparisons.
        runs: numbers of runs of each method, one of which is taken in each comparison.
        distance: between the methods' means, in standard deviations.
    """
    counts = {"right": 0, "wrong": 0, "second": 0}
    for _number in range(comparisons):
        count, deviation, middle = (
            chance.choice(runs),
            chance.uniform(3, 12),
            chance.uniform(30, 70),
        )
        ahead = chance.choice([-1, 1]) * distance * deviation / 2
        lists = [chance.normal(middle + each, deviation, count) for each in (ahead, -ahead)]
        first, second = ([round(float(each), 1) for each in one] for one in lists)
        said = judge(first, second)
        if said is None:
            raise NotYet(NOTHING_RETURNED, hint="no-return")
        if not isinstance(said, str) or said not in CLAIMS:
            raise NotYet(
                _(
                    "Expected one of {listed}, got {got}.",
                    listed=", ".join(CLAIMS),
                    got=named(said),
                ),
                hint="name",
            )
        better = "first" if ahead > 0 else "second"
        counts["second"] += said == "second"
        if said != "unclear":
            counts["right" if said == better else "wrong"] += 1
    return counts


@exercise(
    "14.4",
    _("A game of several agents"),
    hints={
        "begin": _(
            "Begin with `env.reset(seed=seed)`. Then, as long as `env.agents` is not empty, "
            "give `env.step` an action for each of them, and add up the rewards."
        ),
        "first": _(
            "You stop when the first agent is out. The others go on: play until `env.agents` "
            "is empty."
        ),
        "over": _(
            "You look at the terminations only. An agent can also be cut off by time: that "
            "is a truncation. `env.agents` has those that are left, whatever the reason."
        ),
        "actions": _("`step` needs an action for each agent in `env.agents`."),
        "stale": _("The actions answer old observations. `step` returns new ones: keep them."),
        "policy": _("Each agent has its own policy: `policies[name](observations[name])`."),
        "seed": _(
            "The game has to begin with the seed that you are given: `env.reset(seed=seed)`."
        ),
        "lost": _(
            "The last reward of an agent that is out is missing. After `step`, `env.agents` "
            "has only those that are left: go through `rewards` in place of it."
        ),
        "last": _("That is the reward of the last step. Add up the rewards of all steps."),
        "all": _("One number for all is not enough: a dictionary with the total of each agent."),
    },
)
def plays(play: Any) -> str:
    """Check the totals of games, with a game whose agents end at different times."""
    need("multi", "pettingzoo")
    from ai4u_edu.learn.envs import parallel_env

    run = a_function(play)
    for seed in seeds_of("14.4", 6):
        game = Watched("ann", "ben", "eve")
        got = run(game, game.policies(), seed)
        _expect_totals(got, game, seed)
    env = parallel_env("tag", max_cycles=60)
    policies: dict[str, Callable[[Any], Any]] = dict.fromkeys(env.possible_agents, _still)
    seed = seeds_of("14.4", 7)[-1]
    got = _totals(run(env, policies, seed), list(env.possible_agents))
    wanted = _reference(parallel_env("tag", max_cycles=60), policies, seed)
    if not all(is_close(got[name], wanted[name], 1e-4) for name in wanted):
        raise NotYet(
            _("A game of tag: expected {wanted}, got {got}.", wanted=str(wanted), got=str(got))
        )
    return _("Six games with three agents, and a game of tag: all totals are right.")


def _still(_: Any) -> Any:
    return np.zeros(4, np.float32)


def _reference(env: Any, policies: Mapping[str, Callable[[Any], Any]], seed: int) -> dict[str, Any]:
    totals = dict.fromkeys(env.possible_agents, 0.0)
    observations, _info = env.reset(seed=seed)
    while env.agents:
        actions = {name: policies[name](observations[name]) for name in env.agents}
        observations, rewards, *_more = env.step(actions)
        for name, reward in rewards.items():
            totals[name] += float(reward)
    return totals


class Watched(Game):
    """Game that keeps what may be taken for an agent's total."""

    def step(self, actions: Mapping[str, Any]) -> tuple[Any, Any, Any, Any, Any]:
        """Run one step."""
        found = super().step(actions)
        self.last = {**getattr(self, "last", {}), **found[1]}
        return found

    def kept(self) -> dict[str, float]:
        """Return the totals without the reward of the step in which an agent went out."""
        return {name: self.totals[name] - self.last[name] for name in self.totals}


def _totals(given: Any, names: list[str]) -> dict[str, float]:
    if given is None:
        raise NotYet(NOTHING_RETURNED, hint="no-return")
    if not isinstance(given, Mapping) or set(given) != set(names):
        raise NotYet(
            _(
                "Expected a dictionary with a total for each of {listed}, got {got}.",
                listed=", ".join(names),
                got=named(given),
            ),
            hint="all",
        )
    return {name: finite_number(given[name]) for name in names}


def _expect_totals(given: Any, game: Watched, seed: int) -> None:
    """Raise NotYet if the totals of a game are not right, or the game was not played to its end."""
    if not game.totals:
        raise NotYet(_("The game has not begun: `reset` was not called."), hint="begin")
    if game.seed != seed:
        raise NotYet(
            _("The game began with the seed {seed}, not {seed2}.", seed=str(game.seed), seed2=seed),
            hint="seed",
        )
    if game.agents:
        out = len(game.possible_agents) - len(game.agents)
        raise NotYet(
            _("The game was not over: {listed} still took part.", listed=", ".join(game.agents)),
            hint="first" if out else "begin",
        )
    got = _totals(given, game.possible_agents)
    wanted = {name: float(game.steps[name]) for name in game.possible_agents}
    if all(is_close(got[name], wanted[name], 1e-6) for name in wanted):
        return
    hint = ""
    if all(is_close(got[name], game.kept()[name], 1e-6) for name in wanted):
        hint = "lost"
    elif all(is_close(got[name], game.last[name], 1e-6) for name in wanted):
        hint = "last"
    elif all(is_close(got[name], game.totals[name], 1e-6) for name in wanted):
        hint = "policy" if game.totals[game.possible_agents[0]] > 0 else "stale"
    raise NotYet(
        _(
            "Seed {seed}: with your actions right at each step the totals are {wanted}; you "
            "got {got}.",
            seed=seed,
            wanted=str(wanted),
            got=str(got),
        ),
        hint=hint,
    )


exit_ticket(
    "14.exit",
    Question(
        "c",
        {
            "a": _(
                "What looks best is the small reward, from the first time on. Why should it "
                "ever go elsewhere?"
            ),
            "b": _(
                "It does learn from what it does. It finds the small reward, and stays with it."
            ),
        },
    ),
    Question(
        "b",
        {
            "a": _("The step is the return times the gradient. What is the return here?"),
            "c": _("That would need a return above 0."),
        },
    ),
    Question(
        "a",
        {
            "b": _("The means differ by less than 4, the runs of one method by more than 20."),
            "c": _(
                "Three runs can't show that either: a real difference may be hidden in the noise."
            ),
        },
    ),
)

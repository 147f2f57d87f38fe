"""Rewards: say what you want, get what you said."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import (
    BearingSensor,
    DistanceToTargetRewardFunc,
    FallReward,
    LocalBrain,
    OrientationSensor,
    Percept,
    RBMoveActuator,
    RestlessnessRewardFunc,
    RewardFunc,
    TouchRewardFunc,
)
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.explain import RewardTerms
from ai4u_edu.lessons.exercise import Done, NotYet, a_function, a_list_of, exercise, named
from ai4u_edu.lessons.exit_ticket import Question, exit_ticket
from ai4u_edu.lessons.numeric import chance_for, finite_number
from ai4u_edu.lessons.rollouts import drive, seeds_of
from ai4u_edu.lessons.student_errors import NOTHING_RETURNED
from ai4u_edu.lessons.worlds import plate
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import BodyView, WorldView

Action = dict[str, list[float]]
SEEDS = (1, 2, 3, 4, 5)
TEN_SECONDS = 120
NEAR, FAR = 1.6, 3.0
"""Metres from the box between which the dancer dances."""


def _steer(percept: Percept, speed: float = 1.0) -> Action:
    left, ahead = (float(each) for each in percept["bearing"])
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [speed, -left, 0, 0]}


def _linger(percept: Percept) -> Action:
    return _steer(percept, 0.0 if percept["orientation"][1] < NEAR else 1.0)


def _dancer() -> Callable[[Percept], Action]:
    """Drive to and fro in front of the box."""
    comes = True

    def dance(percept: Percept) -> Action:
        nonlocal comes
        away = percept["orientation"][1]
        comes = away > FAR or (comes and away >= NEAR)
        return _steer(percept, 1.0 if comes else -1.0)

    return dance


CHARACTERS: dict[str, Callable[[], Any]] = {
    "runner": lambda: _steer,
    "stroller": lambda: lambda percept: _steer(percept, 0.4),
    "lingerer": lambda: _linger,
    "dancer": _dancer,
    "sleeper": lambda: lambda _: {"move": [0, 0, 0, 0]},
    "jumper": lambda: lambda _: {"move": [1, 0, 0, 0]},
}
"""Factories of each character's controller."""


def character(name: str, rewards: Sequence[RewardFunc] = ()) -> ControlRequestor:
    """Return a world with a robot of that character.

    Args:
        name: one of ``CHARACTERS``.
        rewards: its reward functions.
    """
    if name not in CHARACTERS:
        raise NotYet(
            _("Expected one of {listed}; got `{name!r}`.", listed=", ".join(CHARACTERS), name=name)
        )
    agent = BasicAgent(
        body="robot",
        sensors=[BearingSensor(target="box"), OrientationSensor(target="box", normalized=False)],
        actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
        rewards=list(rewards),
        brains=[LocalBrain(controller=CHARACTERS[name]())],
    )
    return ControlRequestor(plate(), [agent])


tempers = character
"""Its name in notebooks that were handed out before."""


def contest(rewards: Sequence[RewardFunc], seeds: Sequence[int] = SEEDS) -> dict[str, float]:
    """Return the mean return of each character, over the same worlds.

    Args:
        rewards: the reward functions of all of them.
        seeds: seeds of the worlds.
    """
    rewards = a_list_of(RewardFunc, rewards)
    found = {}
    for name in CHARACTERS:
        sim = character(name, rewards)
        agent = sim.agents[0]
        total = 0.0
        for seed in seeds:
            drive(sim, agent, seed, TEN_SECONDS)
            total += agent.ledger.episode_total
        found[name] = finite_number(total / len(seeds))
    return found


def _best(found: Mapping[str, float]) -> str:
    return max(found, key=lambda name: found[name])


def _shown(found: Mapping[str, float]) -> str:
    return ", ".join(f"{name} {paid:.1f}" for name, paid in found.items())


class Approach(RewardFunc):
    """Pays 1 for each decision that brought the agent closer to the box; the notebook's."""

    def on_reset(self, _agent: AgentView, view: WorldView) -> None:
        """Forget the last distance."""
        self._before = view["box"].distance(view["robot"])

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """Return 1 if it came closer."""
        now = view["box"].distance(body)
        paid = 1.0 if now < self._before - 0.01 else 0.0
        self._before = now
        return paid


WELL_MEANT: dict[str, Callable[[], list[RewardFunc]]] = {
    "near": lambda: [
        DistanceToTargetRewardFunc(target="box", max_reward=1),
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
    ],
    "quick": lambda: [
        TouchRewardFunc(target="box", reward=10),
        FallReward(success_reward=-1, cause_episode_to_end=True),
        RestlessnessRewardFunc(reward=-1, min_dist=5),
    ],
    "closer": lambda: [Approach()],
}
"""The notebook's rewards; the check does not trust those that it is given."""


@exercise(
    "09.1",
    _("Who wins?"),
    hints={
        "near": _(
            "With `near` the touch pays 10, once, and ends the episode. Being near pays a "
            "little at each of 120 decisions. Which sum is larger?"
        ),
        "quick": _(
            "With `quick` everybody pays 1 at each decision until the episode is over. What "
            "ends the episode here? Read the first line of `quick` once more."
        ),
        "name": _("Write one of the six names in quotes, for each of the three rewards."),
        "closer": _(
            "With `closer` a step towards the box pays, and a step away costs nothing. Which "
            "of them takes most steps towards it?"
        ),
    },
)
def predicts(winners: Any, well_meant: Any) -> Done:
    """Check the predicted winner with each of three rewards."""
    if not isinstance(winners, Mapping):
        raise NotYet(_("Expected a name for each reward, got `{winners!r}`.", winners=winners))
    if not isinstance(well_meant, Mapping) or set(well_meant) != set(WELL_MEANT):
        raise NotYet(_("Run the cell with the three well-meant rewards once more."))
    for name, rewards in WELL_MEANT.items():
        said = winners.get(name)
        found = contest(rewards(), seeds_of("09.1", 5))
        if not isinstance(said, str) or said not in found:
            raise NotYet(
                _(
                    "For `{name}` expected one of {listed}; got {got}.",
                    name=name,
                    listed=", ".join(found),
                    got=named(said),
                ),
                hint="name",
            )
        if said != _best(found):
            raise NotYet(
                _(
                    "With `{name}` the {said} gets {found:.1f}, and somebody else gets more.",
                    name=name,
                    said=said,
                    found=found[said],
                ),
                hint=name,
            )
    return Done(_("You saw all three winners coming."))


def _made(make: Any) -> list[RewardFunc]:
    return a_list_of(RewardFunc, a_function(make)())


@exercise(
    "09.2",
    _("A trail that can't be tricked"),
    hints={
        "linger": _(
            "Somebody gets more than the runner by staying near, or by dancing. A trail must "
            "pay for *getting* nearer, and take it back when the robot goes away again: "
            "`ProgressReward`."
        ),
        "patience": _(
            "In ten seconds the runner wins. In a minute another one wins, which is paid for "
            "staying near: every reward for *being* somewhere can be collected without end."
        ),
        "nothing": _("Nobody is paid anything yet."),
        "lost": _("The runner does not win. What does it get for the touch?"),
        "trail": _(
            "The runner wins, but until the touch it gets nothing: a beginner would not know "
            "where to go. Add a reward for progress."
        ),
    },
)
def has_a_trail(make: Any) -> Done:
    """Check that the runner wins, and is rewarded on the way."""
    seeds = seeds_of("09.2", 5)
    found = contest(_made(make), seeds)
    if not any(found.values()):
        raise NotYet(_("Nobody gets anything: {shown}.", shown=_shown(found)), hint="nothing")
    others = max(paid for name, paid in found.items() if name not in ("runner", "stroller"))
    if found["runner"] < others + 1 or found["runner"] < found["stroller"] - 1:
        stays = max(found["lingerer"], found["dancer"]) >= found["runner"] - 1
        raise NotYet(
            _("The runner does not win clearly: {shown}.", shown=_shown(found)),
            hint="linger" if stays else "lost",
        )
    for name in ("lingerer", "dancer"):
        paid_in_a_minute = _in_a_minute(name, _made(make), seeds[:2])
        if paid_in_a_minute > found["runner"] - 1:
            raise NotYet(
                _(
                    "In ten seconds the runner wins. In a minute the {name} gets "
                    "{paid_in_a_minute:.1f}, more than the runner's {found:.1f}.",
                    name=name,
                    paid_in_a_minute=paid_in_a_minute,
                    found=found["runner"],
                ),
                hint="patience",
            )
    sim = character("runner", _made(make))
    agent = sim.agents[0]
    for seed in seeds:
        paid: list[float] = []
        done = drive(sim, agent, seed, TEN_SECONDS, lambda _: paid.append(agent.reward))  # noqa: B023
        good = sum(each > 0 for each in paid[1:])
        if good < 0.5 * (len(paid) - 1):
            raise done.not_yet(
                _(
                    "The runner was paid above 0 for {good} of {count} decisions ({where}).",
                    good=good,
                    count=len(paid) - 1,
                    where=done.where,
                ),
                "trail",
            )
    return Done(
        _("Who drives to the box wins, and the way is paid: {shown}.", shown=_shown(found)),
        done.picture(),
    )


def _in_a_minute(name: str, rewards: list[RewardFunc], seeds: Sequence[int]) -> float:
    """Return the mean return in episodes of a minute."""
    sim = character(name, rewards)
    agent = sim.agents[0]
    total = 0.0
    for seed in seeds:
        drive(sim, agent, seed, 6 * TEN_SECONDS)
        total += agent.ledger.episode_total
    return finite_number(total / len(seeds))


@exercise(
    "09.3",
    _("Quick, but not at any price"),
    hints={
        "time": _(
            "Runner and stroller get the same. Let each decision cost a little: the `reward` "
            "for restlessness below 0."
        ),
        "jump": _(
            "The jumper is not the last: a fall ends the episode, and after that nothing "
            "costs any more. The fall has to cost more than all the time that it saves."
        ),
        "pays": _(
            "Time pays, but it should cost: the `reward` for restlessness has to be below 0."
        ),
        "dear": _(
            "Time costs so much that the runner, too, gets less than nothing: make it cheaper."
        ),
        "runner": _("The runner has to get the most of all."),
    },
)
def is_quick(make: Any) -> Done:
    """Check that the runner beats the stroller, and the jumper is last."""
    found = contest(_made(make), seeds_of("09.3", 5))
    if found["sleeper"] > 0.1:
        raise NotYet(
            _("The sleeper is paid for sleeping: {shown}.", shown=_shown(found)), hint="pays"
        )
    if found["runner"] < 0:
        raise NotYet(
            _("The runner gets less than nothing: {shown}.", shown=_shown(found)), hint="dear"
        )
    if found["runner"] <= found["stroller"] + 0.1:
        raise NotYet(_("Time costs nothing yet: {shown}.", shown=_shown(found)), hint="time")
    if _best(found) != "runner":
        raise NotYet(_("The runner does not win: {shown}.", shown=_shown(found)), hint="runner")
    if min(found, key=lambda name: found[name]) != "jumper":
        raise NotYet(_("The jumper is not the last: {shown}.", shown=_shown(found)), hint="jump")
    return Done(_("Quick, and jumping does not pay: {shown}.", shown=_shown(found)))


@exercise(
    "09.4",
    _("What paid most?"),
    hints={
        "first": _(
            "That is the first name. Add up what each term paid over all decisions, and "
            "compare the sums."
        ),
        "rows": _(
            "`told.amounts[n]` is what all terms paid in decision n. Term n is the n-th "
            "number of each row: `row[n] for row in told.amounts`."
        ),
        "once": _(
            "That term paid the largest single amount. Another one paid less at a time, but "
            "more in all: add the amounts up."
        ),
        "size": _("A term can cost a lot: then its sum is far below 0, and it did not pay."),
        "name": _("Return one of the names in `told.terms`."),
    },
)
def finds_what_paid(paid_most: Any) -> str:
    """Check on made-up episodes that the term with the largest sum is found."""
    a_function(paid_most)
    rng = chance_for("09.4", paid_most)
    names = ("near", "time", "touch", "fall")
    mistakes = {"often": "", "cost": "size", "once": "once", "fall": "size"}
    winners = rng.permutation(names)
    for shift, winner in enumerate(winners):
        others = iter(rng.permutation([name for name in names if name != winner]))
        named_by = {part: winner if part == "often" else next(others) for part in mistakes}
        parts = [*mistakes][shift:] + [*mistakes][:shift]
        terms = tuple(str(named_by[part]) for part in parts)
        small = rng.integers(2, 5, size=(20, 1)) * [[1.0, -9.0, 0.0, 0.0]]
        small[-1] += [0.0, 0.0, 30.0, -40.0]
        order = [[*mistakes].index(part) for part in parts]
        told = RewardTerms(np.arange(20) / 4, terms, small[:, order])
        got = paid_most(told)
        if got is None:
            raise NotYet(NOTHING_RETURNED, hint="no-return")
        if not isinstance(got, str) or got not in terms:
            raise NotYet(
                _("Expected one of {terms}, got {got}.", terms=repr(terms), got=named(got)),
                hint="name",
            )
        if got != winner:
            rows = [float(row.sum()) for row in told.amounts[: len(terms)]]
            if got == terms[rows.index(max(rows))]:
                hint = "rows"
            elif got == terms[0]:
                hint = "first"
            else:
                hint = mistakes[parts[terms.index(got)]]
            sums = dict(zip(terms, told.totals.round(1).tolist(), strict=True))
            raise NotYet(
                _(
                    "Expected '{winner}', got {got!r}. The sums are {sums}.",
                    winner=winner,
                    got=got,
                    sums=str(sums),
                ),
                hint=hint,
            )
    return _("You found the term that paid most in four episodes.")


exit_ticket(
    "09.exit",
    Question(
        "b",
        {
            "a": _("That pays 10, once. How much do a hundred decisions near the box pay?"),
            "c": _("The touch ends the episode. There is no time after it."),
        },
    ),
    Question(
        "a",
        {
            "b": _(
                "It pays for every metre. But a metre back costs as much as a metre forward brings."
            ),
            "c": _(
                "A reward function knows nothing about intentions. It computes a number from "
                "what happened."
            ),
        },
    ),
    Question(
        "c",
        {
            "a": _(
                "Searching costs 1 at each decision, up to 120 in all. Is there something cheaper?"
            ),
            "b": _("Standing still costs 1 at each decision as well."),
        },
    ),
)

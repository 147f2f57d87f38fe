"""Needs: a creature that gets hungry."""

import math
from typing import Any

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import (
    AndRewardFunc,
    BearingSensor,
    CollectActuator,
    EvalFloatValue,
    HomeostaticReward,
    HomeostaticSensor,
    HomeostaticVariable,
    OrRewardFunc,
    RBMoveActuator,
)
from ai4u_edu.lessons.calls import Calls, function_exercise
from ai4u_edu.lessons.exercise import Done, NotYet, exercise
from ai4u_edu.lessons.exit_ticket import Question, exit_ticket
from ai4u_edu.lessons.numeric import difference, finite_number, is_close
from ai4u_edu.lessons.rollouts import Drive, as_brain, drive, seeds_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import BoxShape, CircleShape, Variation, World

DECISIONS_PER_MINUTE = 720
"""Number of decisions in a minute."""
LOW, HIGH = 0.4, 0.8
"""Ends of the comfort zone, as shares of the range."""
MINUTES = 6
"""Worlds in which it has to live for a minute; in the others it begins with little of one."""
LOW_LIMIT = 120
"""Decisions in a world that begins with little of one: 10 s."""
DETOUR_M, SLACK_S = 5.0, 1.2
"""Length of a way over the wrong place beyond the direct one, and time to spare on that."""
DRY, DRY_WELL = (4.0, 6.0), 0.83
"""Losses of energy and water in a dry summer, and the share of decisions for gold."""
WELL = 0.6
"""Share of the decisions in which both levels have to be in the zone."""
HUNDRED = _(
    "In the percept the levels go from 0 to 1: what the panel shows as 40 is 0.4 here. "
    "Compare with 0.4, not with 40."
)
ROOM = Variation(x=(-4, 4), y=(-4, 4), heading_deg=(-180, 180), clearance=0.3)


def creature(
    controller: Any,
    energy: float = 60,
    water: float = 60,
    losses: tuple[float, float] = (3.0, 4.0),
) -> ControlRequestor:
    """Return a creature on a plate with food and water.

    Args:
        controller: a function, a controller or a brain; drives it.
        energy: level at the beginning, from 0 to 100.
        water: level at the beginning, from 0 to 100.
        losses: of energy and water, in each second.
    """
    needs = _needs((energy, water), losses)
    agent = BasicAgent(
        body="creature",
        max_steps_per_episode=DECISIONS_PER_MINUTE,
        sensors=[
            HomeostaticSensor(perception_key="inside"),
            BearingSensor(target="food", perception_key="to food"),
            BearingSensor(target="water", perception_key="to water"),
        ],
        actuators=[
            RBMoveActuator(move_amount=3, turn_amount=3),
            CollectActuator(
                action_name="eat", group="food", adds={"energy": 40}, comes_back_after=3
            ),
            CollectActuator(
                action_name="drink", group="water", adds={"water": 40}, comes_back_after=3
            ),
        ],
        rewards=[
            HomeostaticReward(reward=10, variables=needs),
            OrRewardFunc(
                name="ran out",
                children=[
                    EvalFloatValue(property=f"inside[{index}]", min_value=0, max_value=0)
                    for index in (0, 1)
                ],
                reward=-10,
                cause_episode_to_end=True,
            ),
            AndRewardFunc(
                name="well",
                children=[
                    EvalFloatValue(property=f"inside[{index}]", min_value=LOW, max_value=HIGH)
                    for index in (0, 1)
                ],
                reward=0.01,
            ),
        ],
        brains=[as_brain(controller)],
    )
    return ControlRequestor(_meadow(), [agent])


def _meadow() -> World:
    """Return a plate with the creature's body, food and water at random places."""
    world = World()
    world.add_floor("meadow", BoxShape(size=(12, 12)))
    world.add_body("creature", CircleShape(radius=0.5), tags=("agent",), random=ROOM)
    world.add_body(
        "food",
        CircleShape(radius=0.45),
        kind="static",
        tags=("food",),
        random=ROOM,
        colour="green",
        label="food",
    )
    world.add_body(
        "water",
        BoxShape(size=(0.8, 0.8)),
        kind="static",
        tags=("water",),
        random=ROOM,
        colour="sky blue",
        label="water",
    )
    return world


def _needs(levels: tuple[float, float], losses: tuple[float, float]) -> list[HomeostaticVariable]:
    return [
        HomeostaticVariable(
            name=name,
            range_max=100,
            comfort_min=100 * LOW,
            comfort_max=100 * HIGH,
            value=level,
            drift_per_second=-loss,
        )
        for name, level, loss in zip(("energy", "water"), levels, losses, strict=True)
    ]


@function_exercise(
    "18.1",
    _("How long?"),
    hints={
        "begin": _("How much is there to lose until 40? And how much of it goes in a second?"),
        "empty": _("That is how long it takes until nothing is left. Comfort ends at 40."),
        "whole": _("A time need not be a whole number of seconds: divide with `/`."),
        "up": _("A time need not be a whole number of seconds: do not count, divide."),
        "product": _("The larger the loss, the shorter the time: divide by it."),
        "below": _("Below 40 there is no comfort left: the answer is 0, not less."),
    },
)
def computes_comfort(chance: np.random.Generator) -> Calls:
    """Check the seconds until a level reaches 40."""
    cases = [(60.0, 4.0), (50.0, 3.0), (30.0, 2.0)]
    for low, high in ((45, 100), (45, 100), (5, 39), (60, 100), (41, 60)):
        level = round(float(chance.uniform(low, high)), 1)
        cases.append((level, round(float(chance.uniform(0.5, 6)), 1)))
    for level, loss in cases:
        found = finite_number((yield level, loss))
        wanted = max(0.0, (level - 40) / loss)
        if not is_close(found, wanted, 0.01):
            slips = {
                "empty": (_("the time until nothing is left"), level / loss),
                "below": (_("below 0"), (level - 40) / loss),
                "whole": (_("right, but cut off to a whole number"), float(int(wanted))),
                "up": (_("right, but rounded up"), float(math.ceil(wanted))),
                "product": (_("the loss times what there is to lose"), (level - 40) * loss),
                "begin": (_("the level itself"), level),
            }
            slip = difference(found, slips, 0.01)
            raise NotYet(
                _(
                    "With a level of {level:g} and a loss of {loss:g} a second it takes "
                    "{wanted:.2f} s, your function says {found:.2f}{words}.",
                    level=level,
                    loss=loss,
                    wanted=wanted,
                    found=found,
                    words=slip.words,
                ),
                hint=slip.name,
            )
    return Done(_("Eight levels, eight times right."))


def _life(
    controller: Any, seed: int, limit: int = DECISIONS_PER_MINUTE, **levels: Any
) -> tuple[Drive, float, int]:
    """Return an episode, the share with both levels in the zone, and the empty level (or -1)."""
    sim = creature(controller, **levels)
    inside: list[tuple[float, ...]] = []
    done = drive(
        sim,
        sim.agents[0],
        seed,
        limit,
        lambda done: inside.append(_levels(done.agent)),
    )
    well = sum(all(LOW <= level <= HIGH for level in levels) for levels in inside) / len(inside)
    last = inside[-1]
    return done, well, last.index(min(last)) if done.agent.terminated else -1


def _levels(agent: BasicAgent) -> tuple[float, ...]:
    return tuple(float(level) for level in agent.percept["inside"])


@exercise(
    "18.2",
    _("Stay alive"),
    hints={
        "thirst": _(
            "It dies although there is enough of both. It has to go for what it has less of: "
            "compare `energy` and `water`."
        ),
        "hundred": HUNDRED,
        "reversed": _(
            "It goes for what it has more of. Where energy is the smaller one, food is needed."
        ),
    },
)
def stays_alive(live: Any) -> Done:
    """Check that it lives for a minute, and begins with what it needs most."""
    worlds: list[tuple[int, dict[str, Any]]] = [(seed, {}) for seed in seeds_of("18.2", MINUTES)]
    worlds += _short_worlds("18.2", 8)
    for seed, begins in worlds:
        done, _needs, ran_out = _life(live, seed, **begins)
        if ran_out >= 0:
            name, other = (_("energy"), _("water"))[:: -1 if ran_out else 1]
            level = _levels(done.agent)[1 - ran_out]
            hint = "reversed" if _goes_for_more(live, done) else "thirst"
            hint = "hundred" if _hundred(live, done) else hint
            told = _("It began with little of one. ") if begins else ""
            raise done.not_yet(
                _(
                    "{told}After {steps:.0f} seconds its {name} had run out, with {other} at "
                    "{level:.0f} ({where}).",
                    told=told,
                    steps=done.steps / 12,
                    name=name,
                    other=other,
                    level=100 * level,
                    where=done.where,
                ),
                hint,
            )
    return Done(_("It lived, in {count} worlds.", count=len(worlds)), done.picture())


def _short_worlds(exercise_id: str, count: int) -> list[tuple[int, dict[str, Any]]]:
    """Return seeds and levels of worlds in which only one of two ways is short enough.

    The creature has just enough of one need for the direct way to what it lacks, and the way over
    the other place takes it too long.

    Args:
        exercise_id: whose seeds they are.
        count: number of worlds in which energy is short, and of those in which water is.
    """
    found: dict[str, list[tuple[int, dict[str, Any]]]] = {"energy": [], "water": []}
    for seed in seeds_of(exercise_id, 400)[MINUTES:]:
        sim = creature(lambda _: {})
        sim.reset(seed)
        body, food, water = (sim.world[name] for name in ("creature", "food", "water"))
        between = math.dist(food.position, water.position)
        for low, near, far in (("energy", food, water), ("water", water, food)):
            way, other = (math.dist(body.position, each.position) for each in (near, far))
            if other + between - way < DETOUR_M or len(found[low]) == count:
                continue
            direct_s = way / 3 + abs(body.bearing(near)) / 3
            levels = {"energy": 85, "water": 85, low: 2 * (direct_s + SLACK_S)}
            found[low].append((seed, {**levels, "losses": (2, 2), "limit": LOW_LIMIT}))
        if all(len(worlds) == count for worlds in found.values()):
            break
    return [world for pair in zip(*found.values(), strict=True) for world in pair]


def _goes_for_more(live: Any, done: Drive) -> bool:
    """Return True if its actions depend on which level is the lower one: then they are mixed up."""
    if not callable(live):
        return False
    percept = dict(done.agent.percept)
    answers = [live({**percept, "inside": levels}) for levels in ([0.3, 0.6], [0.6, 0.3])]
    return repr(answers[0]) != repr(answers[1])


def _hundred(live: Any, done: Drive) -> bool:
    """Return True if it takes the levels for numbers from 0 to 100."""
    if not callable(live):
        return False
    percept = dict(done.agent.percept)
    small, large = (
        {repr(live({**percept, "inside": [one * unit, two * unit]})) for one, two in _LEVELS}
        for unit in (1, 100)
    )
    return len(small) == 1 < len(large)


_LEVELS = ((0.1, 0.9), (0.9, 0.1), (0.6, 0.6), (0.1, 0.1), (0.9, 0.9))


@exercise(
    "18.3",
    _("Live well"),
    hints={
        "begin": _(
            "Three cases: all is well, then rest; energy is lower, then food; water is "
            "lower, then water."
        ),
        "hundred": HUNDRED,
        "greedy": _(
            "It has too much most of the time. Eat when a level has sunk towards 40, not before."
        ),
        "late": _(
            "It waits too long. On the way to the food the levels go on sinking: start a bit "
            "above 40."
        ),
    },
)
def lives_well(live: Any) -> Done:
    """Check for both levels in the zone in 60 of 100 decisions."""
    shares = []
    for seed in seeds_of("18.3", 6):
        done, well, ran_out = _life(live, seed)
        shares.append(well)
        mean = sum(_levels(done.agent)) / 2
        if ran_out >= 0:
            why = "begin" if done.moved < 0.1 else "late"
            raise done.not_yet(
                _(
                    "It died after {steps:.0f} seconds ({where}).",
                    steps=done.steps / 12,
                    where=done.where,
                ),
                "hundred" if _hundred(live, done) else why,
            )
        if well < WELL:
            why = "greedy" if mean > 0.6 else "late"
            raise done.not_yet(
                _(
                    "It felt well in {well:.0f} of 100 decisions, not {well2:.0f}; at the "
                    "end its mean level was {mean:.0f} ({where}).",
                    well=100 * well,
                    well2=100 * WELL,
                    mean=100 * mean,
                    where=done.where,
                ),
                "hundred" if _hundred(live, done) else why,
            )
    share = 100 * sum(shares) / len(shares)
    return Done(_("It felt well in {share:.0f} of 100 decisions.", share=share), done.picture())


@exercise(
    "18.4",
    _("Gold: a dry summer"),
    hints={
        "begin": _("First it has to live. Begin with your `live_well` of 18.3."),
        "rest": _(
            "While it rests it looks anywhere. It could already turn towards what it will "
            "need next: then the way is shorter when it is time."
        ),
        "early": _("It has too much most of the time: wait until a level is lower."),
        "late": _(
            "Levels fall on the way, and here they fall faster. Go a bit earlier; and which "
            "of the two will reach 40 first?"
        ),
        "hundred": HUNDRED,
    },
)
def lives_in_a_dry_summer(live: Any) -> Done:
    """Check for both levels in the zone, on average over twenty lives with larger losses."""
    shares, levels = [], []
    for seed in seeds_of("18.4", 20):
        done, well, ran_out = _life(live, seed, losses=DRY)
        if ran_out >= 0:
            raise done.not_yet(
                _(
                    "It died after {steps:.0f} seconds ({where}).",
                    steps=done.steps / 12,
                    where=done.where,
                ),
                "hundred" if _hundred(live, done) else "begin",
            )
        shares.append(well)
        levels.append(sum(_levels(done.agent)) / 2)
    share = sum(shares) / len(shares)
    told = _("It felt well in {share:.1f} of 100 decisions", share=100 * share)
    if share < DRY_WELL:
        hint = "early" if sum(levels) / len(levels) > 0.65 else "late"
        hint = "rest" if _rests(live, done) else hint
        raise NotYet(
            _("{told}; gold is {dry_well:.0f}.", told=told, dry_well=100 * DRY_WELL),
            hint=hint,
            picture=done.picture(),
        )
    return Done(_("Gold: {told}.", told=told), done.picture())


def _rests(live: Any, done: Drive) -> bool:
    """Return True if it does nothing while all is well."""
    if not callable(live):
        return False
    beside = {"inside": [0.7, 0.7], "to food": [1.0, 0.0], "to water": [1.0, 0.0]}
    answer = live({**done.agent.percept, **beside})
    return isinstance(answer, dict) and not any(answer.get("move", (0,)))


exit_ticket(
    "18.exit",
    Question(
        "c",
        {
            "a": _("Too much is outside the comfort zone as well."),
            "b": _("Its energy leaves the comfort zone, at the upper end."),
        },
    ),
    Question(
        "a",
        {
            "b": _("In the percept the levels go from 0 to 1."),
            "c": _("Then its energy would be above the zone, not below."),
        },
    ),
    Question(
        "b",
        {
            "a": _(
                "A creature that is full is not paid for food. What is it about food that counts?"
            ),
            "c": _("A creature can stay alive, and feel worse and worse."),
        },
    ),
)

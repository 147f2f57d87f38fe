"""Build an agent from blocks."""

from itertools import pairwise
from typing import Any

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import BearingSensor, LocalBrain, RBMoveActuator, TouchRewardFunc
from ai4u_edu.lessons.exercise import Done, NotYet, exercise
from ai4u_edu.lessons.exit_ticket import Question, exit_ticket
from ai4u_edu.lessons.numeric import is_close
from ai4u_edu.lessons.rollouts import Drive, as_brain, drive, seeds_of
from ai4u_edu.lessons.worlds import forward, plate, put_in
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import Variation

ASIDE = Variation(x=(-4, 4), y=(3, 4))
"""Places of a box that is out of the way."""
BEHIND = Variation(places=((-3.0, 0.0),))
GOLD_DECISIONS = 20
"""Mean number of decisions that is enough in 03.5; without driving backward it takes 20.6."""
Turn = tuple[float, float, float, float]
IDLE = LocalBrain(controller=lambda _: {})
STATUS = ("done", "id")
"""Perception keys that every agent has."""


@exercise(
    "03.1",
    _("Legs"),
    hints={
        "actuator": _(
            "An actuator is missing: put `RBMoveActuator(...)` into the list `actuators=[]`."
        ),
        "speed": _(
            "The parameter `move_amount` is the speed, in metres a second, that the number 1 "
            "stands for."
        ),
        "turn": _(
            "The parameter `turn_amount` is the turning speed, in radians a second, that the "
            "number 1 stands for."
        ),
    },
)
def has_legs(agent: Any) -> Done:
    """Check that it drives at 2 m/s, and turns at 3 rad/s."""
    if not put_in(agent, plate(None, ASIDE), IDLE).agents[0].actuators:
        raise NotYet(_("Your agent has no actuator yet: it can't do anything."), hint="actuator")
    straight = _driven(agent, 1, 0, decisions=12)
    if not is_close(straight.moved, 2, 0.05):
        raise straight.not_yet(
            _(
                "In one second the robot drove {moved:.2f} m, not 2 ({where}).",
                moved=straight.moved,
                where=straight.where,
            ),
            "speed",
        )
    turning = _driven(agent, 0, 1, decisions=6)
    turned = -turning.agent.body.heading
    if not is_close(turned, 1.5, 0.05):
        raise turning.not_yet(
            _(
                "In half a second the robot turned {turned:.2f} rad to the right, not 1.5 "
                "({where}).",
                turned=turned,
                where=turning.where,
            ),
            "turn",
        )
    return Done(_("Two metres and three radians a second: it has its legs."), straight.picture())


def _driven(agent: Any, move: float, turn: float, decisions: int) -> Drive:
    names = [each.action_name for each in agent.actuators if isinstance(each, RBMoveActuator)]
    if not names:
        raise NotYet(_("Your agent has no RBMoveActuator."), hint="actuator")
    brain = LocalBrain(controller=lambda _: {names[0]: [move, turn, 0, 0]})
    sim = put_in(agent, plate(None, ASIDE), brain)
    return drive(sim, sim.agents[0], seed=3, limit=decisions)


@exercise(
    "03.2",
    _("Eyes and a bumper"),
    hints={
        "sensors": _(
            "Put two sensors into the list `sensors=[]`: one tells the direction of the box, "
            "the other one whether it is touched. `ai4u-edu blocks` lists all sensors."
        ),
        "bearing": _(
            "One reading has to tell left from right. That takes two numbers, the sine and "
            "the cosine of the angle to the box: `BearingSensor`."
        ),
        "touch": _(
            "One reading has to be 1 while the robot touches the box, and -1 otherwise: "
            "`TouchSensor`."
        ),
    },
)
def has_senses(agent: Any) -> Done:
    """Check that one reading is the box's bearing, and another one tells of its touch."""
    sim = put_in(agent, plate(), IDLE)
    if not sim.agents[0].sensors:
        raise NotYet(
            _("Your agent has no sensor yet: it knows nothing of the world."), hint="sensors"
        )
    for seed in seeds_of("03.2", 10):
        seen = drive(sim, sim.agents[0], seed, limit=1)
        if not _sees(seen):
            raise seen.not_yet(
                _("No reading tells where the box is ({where}).", where=seen.where), "bearing"
            )
    legs = RBMoveActuator(move_amount=2, turn_amount=3)  # whether or not it has legs of its own
    sim = put_in(agent.changed(actuators=[legs]), plate(None, None), forward())
    felt: list[dict[str, float]] = []
    bumped = drive(sim, sim.agents[0], 5, 30, watch=lambda done: felt.append(_single(done)))
    if not any(first == -1 and felt[-1].get(key) == 1 for key, first in felt[0].items()):
        raise bumped.not_yet(
            _("The robot touches the box, and no reading says so ({where}).", where=bumped.where),
            "touch",
        )
    return Done(_("It sees where the box is, and feels when it touches it."), bumped.picture())


def _sees(done: Drive) -> bool:
    """Return True if a reading is the true bearing of the box."""
    angle = done.agent.body.bearing(done.sim.world["box"])
    true = np.array([np.sin(angle), np.cos(angle)])
    return any(
        is_close(row, true, 0.01)
        for key, reading in done.agent.percept.items()
        if key not in STATUS and np.size(reading) % 2 == 0
        for row in np.reshape(reading, (-1, 2))  # several moments, where they are stacked
    )


def _single(done: Drive) -> dict[str, float]:
    """Return the readings of one number."""
    return {
        key: float(np.ravel(reading)[0])
        for key, reading in done.agent.percept.items()
        if key not in STATUS and np.size(reading) == 1
    }


@exercise(
    "03.3",
    _("Praise and blame"),
    hints={
        "rewards": _(
            "Put two reward functions into the list `rewards=[]`: a `TouchRewardFunc` for "
            "the box, and a `FallReward`."
        ),
        "amount": _("The parameter `reward` says how much the touch pays."),
        "end": _(
            "The episode goes on after the touch. Every reward function has a parameter "
            "`cause_episode_to_end`, which is False unless you say so."
        ),
        "fall": _("A fall should cost 1. That is what `FallReward()` pays."),
    },
)
def is_paid(agent: Any) -> Done:
    """Check for +10 for a touch, which ends the episode, and -1 for a fall."""
    sim = put_in(agent, plate(None, None), forward())
    if not sim.agents[0].rewards:
        raise NotYet(_("Your agent has no reward function yet."), hint="rewards")
    touched = drive(sim, sim.agents[0], seed=5, limit=24)
    paid = _paid(touched)
    if not is_close(paid, 10, 1e-6):
        raise touched.not_yet(
            _(
                "The robot touched the box and got {paid:g}, not 10 ({where}).",
                paid=paid,
                where=touched.where,
            ),
            "amount",
        )
    if not touched.agent.terminated:
        raise touched.not_yet(
            _("The robot touched the box, and it went on ({where}).", where=touched.where), "end"
        )
    sim = put_in(agent, plate(None, ASIDE), forward())
    fallen = drive(sim, sim.agents[0], seed=5, limit=120)
    paid = _paid(fallen)
    if not is_close(paid, -1, 1e-6):
        raise fallen.not_yet(
            _("The robot fell and got {paid:g}, not -1 ({where}).", paid=paid, where=fallen.where),
            "fall",
        )
    return Done(_("A touch pays 10 and ends the episode, a fall costs 1."), touched.picture())


def _paid(done: Drive) -> float:
    return float(done.agent.ledger.episode_total)


@exercise(
    "03.4",
    _("To the box, from anywhere"),
    hints={
        "look": _(
            'The first number of `percept["bearing"]` is above 0 where the box is to the '
            "left. Turn by it: the second number of the action has to follow from it."
        ),
        "mirrored": _(
            "Your robot turns away from the box. Above 0 the bearing means left, but in the "
            "action above 0 means right: a minus sign is missing."
        ),
        "stays": _(
            "It turns and never drives: the first number of the action is always 0. Drive "
            "where the box is ahead."
        ),
        "sideways": _(
            "It turns by the cosine. That is the same for a box on the left and on the "
            "right: the side is in the sine, the first of the two numbers."
        ),
        "behind": _(
            "Straight behind the robot the sine is 0 too. Look at the cosine: where it is "
            "below 0, turn on the spot, without driving."
        ),
    },
)
def reaches_the_box(agent: Any) -> Done:
    """Check that it touches the box in 20 worlds."""
    arrived = TouchRewardFunc(name="arrived", target="box", reward=1, cause_episode_to_end=True)
    put_in(agent, plate())
    seeds = seeds_of("03.4")
    for count, seed in enumerate(seeds):
        world = plate(None, BEHIND) if seed == seeds[-1] else plate()
        sim = put_in(agent.changed(rewards=[arrived]), world)
        turns: list[Turn] = []
        done = drive(sim, sim.agents[0], seed, 240, lambda done: turns.append(_turn(done)))  # noqa: B023
        if not is_close(_paid(done), 1, 1e-6):
            how = _("fell off the plate") if done.fell else _("did not get to the box")
            raise done.not_yet(
                _(
                    "The robot {how} ({where}). In {count} worlds before that it got there.",
                    how=how,
                    where=done.where,
                    count=count,
                ),
                "behind" if seed == seeds[-1] else _why(turns),
            )
    return Done(_("In {count} worlds the robot got to the box.", count=len(seeds)), done.picture())


def _turn(done: Drive) -> Turn:
    """Return sine and cosine of the box's bearing, and the robot's last speed and turn."""
    angle = done.agent.body.bearing(done.sim.world["box"])
    last = next(iter(done.agent.last_action.values()), (0.0, 0.0))
    speed, turn = (last[0], last[1]) if len(last) > 1 else (0.0, 0.0)
    return float(np.sin(angle)), float(np.cos(angle)), speed, turn


def _why(turns: list[Turn]) -> str:
    """Return the name of the hint that fits how a robot turned."""
    pairs = [(sine, cosine, turn) for (sine, cosine, *_), (*_, turn) in pairwise(turns)]
    if len({turn for *_, turn in pairs}) < 2:
        return "look"
    if not any(speed for *_, speed, _ in turns):
        return "stays"
    by_cosine = sum(abs(abs(turn) - abs(cosine)) < 0.01 for _, cosine, turn in pairs)
    by_sine = sum(abs(abs(turn) - abs(sine)) < 0.01 for sine, _, turn in pairs)
    if by_cosine > 0.8 * len(pairs) > by_sine:
        return "sideways"
    return "mirrored" if sum(sine * turn for sine, _, turn in pairs) > 0 else "behind"


@exercise(
    "03.5",
    _("Gold: the fewest decisions"),
    hints={
        "begin": _("Begin with your `steer` of 03.4: first it has to get there in every world."),
        "turns": _(
            "It gets there in every world. But where the box is behind, it turns round "
            "before it comes nearer. Does a robot have to face a box to touch it?"
        ),
        "mirrored": _(
            "When it drives backward, its back has to point to the box. The box is behind it "
            "on the left: to which side does the robot have to turn?"
        ),
        "gentle": _(
            "It drives both ways now. It still turns too gently: take a larger number times "
            "the sine."
        ),
    },
)
def is_quick_enough(quick_steer: Any) -> Done:
    """Check for few decisions on the way to the box, on average over 30 worlds."""
    arrived = TouchRewardFunc(name="arrived", target="box", reward=1, cause_episode_to_end=True)
    agent = BasicAgent(
        body="robot",
        sensors=[BearingSensor(target="box")],
        actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
        rewards=[arrived],
        brains=[as_brain(quick_steer)],
    )
    sim = ControlRequestor(plate(), [agent])
    steps: list[int] = []
    turns: list[Turn] = []
    for seed in seeds_of("03.5", 30):
        done = drive(sim, agent, seed, 240, lambda done: turns.append(_turn(done)))
        if not is_close(_paid(done), 1, 1e-6):
            raise done.not_yet(
                _(
                    "The robot did not get to the box ({where}). In {count} worlds before "
                    "that it got there.",
                    where=done.where,
                    count=len(steps),
                ),
                "mirrored" if _backward(turns) < 0 else "begin",
            )
        steps.append(done.steps)
    mean = sum(steps) / len(steps)
    if mean > GOLD_DECISIONS:
        raise done.not_yet(
            _(
                "On average it takes {mean:.1f} decisions, in 30 worlds; gold is "
                "{gold_decisions} or fewer.",
                mean=mean,
                gold_decisions=GOLD_DECISIONS,
            ),
            _slow_way(_backward(turns)),
        )
    return Done(
        _("Gold: {mean:.1f} decisions on average, in 30 worlds.", mean=mean), done.picture()
    )


def _backward(turns: list[Turn]) -> float:
    """Return how much a robot turned its back to the box as it drove backward; 0 if never."""
    return sum(sine * turn for (sine, *_), (*_, speed, turn) in pairwise(turns) if speed < 0)


def _slow_way(backward: float) -> str:
    """Return the diagnosis of a robot that gets to the box, but slowly."""
    if not backward:
        return "turns"
    return "gentle" if backward > 0 else "mirrored"


exit_ticket(
    "03.exit",
    Question(
        "a",
        {
            "b": _("A reward is a number about what happened. It moves nothing."),
            "c": _("Chance decides nothing here. With an empty action no actuator gets a number."),
        },
    ),
    Question(
        "c",
        {
            "a": _("The first number is the sine: below 0 means on the right."),
            "b": _("Look at both signs again: the second number is above 0 if the box is ahead."),
        },
    ),
    Question(
        "b",
        {
            "a": _("The reward is paid anyway. This parameter only says whether the episode ends."),
            "c": _(
                "It is the other way round: by default the parameter is False, and nothing ends."
            ),
        },
    ),
)

"""Drive: body, action, observation."""

import math
from collections.abc import Generator
from typing import Any

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import BearingSensor, LocalBrain, OrientationSensor, RBMoveActuator
from ai4u_edu.lessons.calls import Calls, function_exercise
from ai4u_edu.lessons.exercise import Done, NotYet, exercise
from ai4u_edu.lessons.exit_ticket import Question, exit_ticket
from ai4u_edu.lessons.numeric import difference, finite_number, is_close
from ai4u_edu.lessons.rollouts import Drive, as_brain, drive, seeds_of
from ai4u_edu.lessons.worlds import plate
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import Variation

DECISIONS_A_SECOND = 12
SECONDS_TO_STOP = 15
"""Time that a robot has to come to rest."""


def _is_count(found: float, exact: float) -> bool:
    """Return True for a number of decisions that is right, rounded up, down or not at all."""
    return is_close(found, exact, 0.55) or found in {math.floor(exact), math.ceil(exact)}


def _count(*given: float) -> Generator[tuple[float, ...], Any, float]:
    """Call the student's function, and return its number of decisions."""
    shown = ", ".join(f"{each:g}" for each in given)
    count = finite_number((yield given))
    if count < 0:
        raise NotYet(
            _(
                "With ({shown}) your function says {count:g}: that is below 0.",
                shown=shown,
                count=count,
            )
        )
    return count


def _robot(move: float, turn: float, brain: LocalBrain) -> BasicAgent:
    return BasicAgent(
        body="robot",
        sensors=[
            OrientationSensor(target="box", normalized=False),
            BearingSensor(target="box"),
        ],
        actuators=[RBMoveActuator(move_amount=move, turn_amount=turn)],
        brains=[brain],
    )


def runway() -> ControlRequestor:
    """Return a world whose robot faces a box, from another distance in each episode."""
    somewhere = Variation(x=(3, 7), y=(0, 0.01))
    agent = _robot(3, 2, LocalBrain(controller=lambda _: {}))
    return ControlRequestor(plate(None, somewhere, size=16), [agent])


def _repeated(count: int, action: list[float], *, move: float, turn: float, size: float) -> Drive:
    """Repeat one action a number of times, from the middle of a plate."""
    edge = size / 2 - 1
    away = Variation(x=(-edge, edge), y=(edge - 1, edge))
    agent = _robot(move, turn, LocalBrain(controller=lambda _: {"move": action}))
    sim = ControlRequestor(plate(None, away, size=size), [agent])
    return drive(sim, agent, seed=1, limit=count)


@function_exercise(
    "02.1",
    _("How far?"),
    hints={
        "time": _(
            "A decision lasts 1/12 of a second. At 3 m/s the robot covers 3/12 of a metre in "
            "one decision. How often does that fit into the distance?"
        ),
        "speed": _(
            "Your answer does not change with the speed. A faster robot needs fewer decisions."
        ),
        "seconds": _("That is how many seconds it takes. There are 12 decisions in a second."),
        "ticks": _(
            "That is how many ticks of the world's clock it takes: 60 a second. A decision "
            "lasts 5 of them."
        ),
        "inverted": _("A faster robot needs fewer decisions: divide by the speed."),
        "one-more": _("It is one decision too many."),
    },
)
def drives_so_far(chance: np.random.Generator) -> Calls:
    """Check ``decisions_for(distance, speed)``."""
    found = yield from _count(6, 2)
    if found == (yield from _count(6, 4)):
        raise NotYet(
            _("For 6 m your function says {found:g} decisions, at 2 m/s as at 4 m/s.", found=found),
            hint="speed" if found else "time",
        )
    for _number in range(8):
        distance = round(float(chance.uniform(2, 6.9)), 2)
        speed = round(float(chance.uniform(1, 4.5)), 2)
        exact = DECISIONS_A_SECOND * distance / speed
        found = yield from _count(distance, speed)
        if not _is_count(found, exact):
            slips = {
                "seconds": (_("the time in seconds"), distance / speed),
                "ticks": (_("the number of ticks"), 5 * exact),
                "inverted": (_("right for a division by the speed"), distance * speed * 12),
                "one-more": (_("one too many"), exact + 1),
            }
            slip = difference(found, slips, 0.05)
            raise NotYet(
                _(
                    "For {distance:g} m at {speed:g} m/s expected {exact:.1f} decisions, got "
                    "{found:.1f}{words}.",
                    distance=distance,
                    speed=speed,
                    exact=exact,
                    found=found,
                    words=slip.words,
                ),
                hint=slip.name or "time",
            )
        done = _repeated(round(found), [1, 0, 0, 0], move=speed, turn=1, size=16)
    return Done(
        _("Eight speeds, eight distances, and the robot stopped where it should."), done.picture()
    )


@function_exercise(
    "02.2",
    _("A quarter turn"),
    hints={
        "time": _(
            "A decision lasts 1/12 of a second. A robot that turns 120 degrees a second "
            "turns 120/12 = 10 degrees in one decision. How many are 90 degrees?"
        ),
        "other-speed": _(
            "It is right for one turning speed, but not for another. Compute with the number "
            "that your function gets."
        ),
        "seconds": _("That is how many seconds it takes. There are 12 decisions in a second."),
        "ticks": _(
            "That is how many ticks of the world's clock it takes: 60 a second. A decision "
            "lasts 5 of them."
        ),
        "inverted": _("It is upside down: a robot that turns faster needs fewer decisions."),
    },
)
def turns_a_quarter(chance: np.random.Generator) -> Calls:
    """Check ``decisions_for_quarter(degrees_per_second)``."""
    found = yield from _count(60)
    if found == (yield from _count(120)):
        raise NotYet(
            _(
                "Your function says {found:g} decisions, at 60 degrees a second as at 120.",
                found=found,
            ),
            hint="other-speed" if found else "time",
        )
    for _number in range(8):
        speed = round(float(chance.uniform(30, 200)), 1)
        exact = 90 / speed * DECISIONS_A_SECOND
        found = yield from _count(speed)
        if not _is_count(found, exact):
            slips = {
                "seconds": (_("the time in seconds"), 90 / speed),
                "ticks": (_("the number of ticks"), 5 * exact),
                "inverted": (_("upside down"), speed / 90 * 12),
            }
            slip = difference(found, slips, 0.02)
            raise NotYet(
                _(
                    "At {speed:g} degrees a second a quarter turn takes {exact:.1f} "
                    "decisions; your function says {found:.1f}{words}.",
                    speed=speed,
                    exact=exact,
                    found=found,
                    words=slip.words,
                ),
                hint=slip.name or "time",
            )
        turning = _repeated(round(found), [0, -1, 0, 0], move=1, turn=math.radians(speed), size=8)
    return Done(_("A quarter turn at eight turning speeds."), turning.picture())


@exercise(
    "02.3",
    _("Stop in time"),
    hints={
        "look": _(
            'The distance is `percept["orientation"][1]`, in metres. Write an `if`: if it is '
            "above 2, drive; otherwise stand still."
        ),
        "blind": _(
            "Your robot does the same whatever it senses. The box is at a different distance "
            "in each world: the robot has to look."
        ),
        "late": _(
            "It stopped too late. The number that you compare with is the distance to the "
            "middle of the box."
        ),
        "early": _("It stands still, but too far away: drive on while the distance is above 2."),
        "never": _(
            "It never stands still. A distance is hardly ever exactly 2: compare with `>` or "
            "`<`, and return an action with 0 where it has to stop."
        ),
        "spins": _(
            "It is near enough, but turns on the spot. To stand still, both numbers have to be 0."
        ),
        "empty": _(
            "`{}` leaves the motor as it is: it starts no robot, and one in motion rolls on. "
            "An action of zeros brakes."
        ),
        "once": _(
            "It looked once, and kept what it saw. Read the distance in the function, at "
            "every decision: it is called again each time."
        ),
        "reversed": _(
            "It drives away from the box. Drive where the distance is above 2, not below."
        ),
    },
)
def stops_in_time(drive_it: Any) -> Done:
    """Check that it drives up to 2 m from the box, and stops there."""
    sim = runway()
    agent = sim.agents[0]
    agent.use_brain(as_brain(drive_it))
    moved: set[float] = set()
    falls = 0
    reason: NotYet | None = None
    for seed in seeds_of("02.3", 8):
        headings = [0.0]

        def watch(done: Drive, headings: list[float] = headings) -> None:
            headings.append(done.agent.body.heading)

        last = drive(sim, agent, seed, SECONDS_TO_STOP * DECISIONS_A_SECOND, watch)
        moved.add(round(last.moved, 1))
        falls += last.fell
        reason = reason or _not_stopped(last, abs(headings[-1] - headings[-2]) > 0.01)
    if reason is not None:
        # a robot that pushes the box off the plate goes as far in each world, and may well look
        if len(moved) == 1 and not falls and reason.hint in {"late", "early"}:
            reason.hint = "blind"
        elif reason.hint == "look" and max(moved) > 0:
            reason.hint = "once"
        raise reason
    return Done(_("In 8 worlds the robot stopped about 2 m before the box."), last.picture())


def _not_stopped(last: Drive, spins: bool) -> NotYet | None:
    """Return the reason why a robot has not stopped where it should, if it has not."""
    away = float(last.agent.percept["orientation"][1])
    rests = math.dist(last.trail[-1], last.trail[-2]) < 0.02 if last.steps else True
    if not last.fell and rests and is_close(away, 2, 0.5):
        if not spins:
            return None
        return last.not_yet(
            _("The robot turns on the spot, and does not rest ({where}).", where=last.where),
            "spins",
        )
    if last.fell:
        how = _("The robot fell")
    elif away < 1.5:
        how = _("The robot came as near as {away:.1f} m to the box", away=away)
    elif not rests:
        how = _(
            "The robot was still moving after {seconds_to_stop} seconds",
            seconds_to_stop=SECONDS_TO_STOP,
        )
    else:
        how = _("At the end the box was {away:.1f} m away, not 2", away=away)
    return last.not_yet(_("{how} ({where}).", how=how, where=last.where), _why(last, away, rests))


def _why(last: Drive, away: float, rests: bool) -> str:
    """Return the diagnosis that fits how a robot did not stop."""
    if last.moved < 0.05:
        return "look" if last.agent.last_action else "empty"
    if last.trail[-1][0] < last.trail[0][0]:
        return "reversed"
    if not last.agent.last_action:
        return "empty"
    acts = any(next(iter(last.agent.last_action.values()), ()))
    if acts and (last.fell or away < 1.5 or not rests):
        return "never"
    return "late" if away < 2 else "early"


exit_ticket(
    "02.exit",
    Question(
        "b",
        {
            "a": _(
                "The heading grows when the robot turns left. A turn above 0 is a turn to "
                "the right."
            ),
            "c": _("The first number drives. The second one turns, and that changes the heading."),
        },
    ),
    Question(
        "a",
        {
            "b": _("24 decisions are not 24 seconds: each lasts a twelfth of a second."),
            "c": _(
                "6 is a quarter of 24, but decisions are not seconds. What is a quarter of 4 "
                "m/s, and how many seconds are 24 decisions?"
            ),
        },
    ),
    Question(
        "c",
        {
            "a": _(
                "The one that counts drives as far as before. It has no way to notice that "
                "the box has moved."
            ),
            "b": _("One of them senses the new distance at each decision."),
        },
    ),
)

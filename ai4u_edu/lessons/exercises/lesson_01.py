"""Drive: body, action, observation."""

import math
from typing import Any

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import BearingSensor, LocalBrain, OrientationSensor, RBMoveActuator
from ai4u_edu.lessons.exercise import Done, NotYet, a_function, exercise
from ai4u_edu.lessons.numeric import finite_number, is_close
from ai4u_edu.lessons.rollouts import Drive, as_brain, drive, seeds_of
from ai4u_edu.lessons.worlds import plate
from ai4u_edu.world import Variation

DECISIONS_A_SECOND = 12


def _number(made: Any, *given: float) -> int:
    """Return a student's function's result for some numbers."""
    a_function(made)
    found = made(*given)
    shown = ", ".join(f"{each:g}" for each in given)
    if found is None or found is ...:
        raise NotYet(f"With ({shown}) your function returned nothing yet.")
    count = round(finite_number(found))
    if not 0 <= count <= 500:
        raise NotYet(f"With ({shown}) expected 0 to 500 decisions, got {count}.", hint="time")
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


def _repeated(count: int, action: list[float], *, move: float, turn: float, size: float) -> Drive:
    """Repeat one action a number of times, from the middle of a plate."""
    edge = size / 2 - 1
    away = Variation(x=(-edge, edge), y=(edge - 1, edge))
    agent = _robot(move, turn, LocalBrain(controller=lambda _: {"move": action}))
    sim = ControlRequestor(plate(None, away, size=size), [agent])
    return drive(sim, agent, seed=1, limit=count)


@exercise(
    "01.1",
    "How far?",
    hints={
        "time": "A decision lasts 1/12 of a second. At 3 m/s the robot covers 3/12 of a metre in "
        "one decision. How often does that fit into the distance?",
        "speed": "Your answer does not change with the speed. A faster robot needs fewer "
        "decisions.",
    },
)
def drives_so_far(made: Any) -> Done:
    """Check ``decisions_for(distance, speed)``."""
    slow, fast = _number(made, 6, 2), _number(made, 6, 4)
    if slow == 0:
        raise NotYet("For 6 m at 2 m/s your function says 0 decisions.", hint="time")
    if slow == fast:
        raise NotYet(
            f"For 6 m your function says {slow} decisions, at 2 m/s as at 4 m/s.", hint="speed"
        )
    for distance, speed in ((6.0, 3.0), (4.0, 2.0), (5.0, 4.5), (2.0, 1.0), (6.5, 1.5)):
        done = _repeated(_number(made, distance, speed), [1, 0, 0, 0], move=speed, turn=1, size=16)
        if not is_close(done.moved, distance, 1.01 * speed / DECISIONS_A_SECOND):
            raise done.not_yet(
                f"At {speed:g} m/s the robot should drive {distance:g} m. It drove "
                f"{done.moved:.2f} m ({{where}}).",
                "time",
            )
    return Done(
        "Five speeds, five distances, and the robot stopped where it should.", done.picture()
    )


@exercise(
    "01.2",
    "A quarter turn",
    hints={
        "time": "A decision lasts 1/12 of a second. A robot that turns 120 degrees a second turns "
        "120/12 = 10 degrees in one decision. How many are 90 degrees?",
        "other-speed": "It fits one turning speed, but not another one. Compute with the number "
        "that your function gets.",
    },
)
def turns_a_quarter(made: Any) -> Done:
    """Check ``decisions_for_quarter(degrees_per_second)``."""
    for index, speed in enumerate((120.0, 60.0, 90.0, 180.0, 45.0)):
        count = _number(made, speed)
        done = _repeated(count, [0, -1, 0, 0], move=1, turn=math.radians(speed), size=8)
        turned = math.degrees(done.agent.body.heading)
        if not is_close(turned, 90, 1.01 * speed / DECISIONS_A_SECOND):
            raise done.not_yet(
                f"At {speed:g} degrees a second the robot turned {turned:.0f} degrees, not 90 "
                "({where}).",
                "other-speed" if index else "time",
            )
    return Done("A quarter turn at five turning speeds.", done.picture())


@exercise(
    "01.3",
    "Stop in time",
    hints={
        "look": 'The distance is `percept["orientation"][1]`, in metres. Write an `if`: while it '
        "is above 2, drive; else stand still.",
        "blind": "Your robot does the same whatever it senses. The box is at another distance in "
        "each world: the robot has to look.",
        "late": "It stopped too late. The number that you compare with is the distance to the "
        "middle of the box.",
    },
)
def stops_in_time(drive_it: Any) -> Done:
    """Check that it drives up to 2 m from the box, and stops there."""
    somewhere = Variation(x=(3, 7), y=(0, 0.01))
    agent = _robot(3, 2, LocalBrain(controller=lambda _: {}))
    sim = ControlRequestor(plate(None, somewhere, size=16), [agent])
    agent.use_brain(as_brain(drive_it))
    ends: list[Drive] = []
    for seed in seeds_of("01.3", 10):
        last = drive(sim, agent, seed, limit=80)
        away = float(agent.percept["orientation"][1])
        ends.append(last)
        if last.fell or away < 1.5:
            how = "fell" if last.fell else f"came as near as {away:.1f} m to the box"
            same = len({round(each.moved, 1) for each in ends}) == 1 and len(ends) > 1
            raise last.not_yet(f"The robot {how} ({{where}}).", "blind" if same else "late")
        if not is_close(away, 2, 0.5) or last.trail[-1] != last.trail[-2]:
            same = len({round(each.moved, 1) for each in ends}) == 1 and last.moved > 0.1
            raise last.not_yet(
                f"At the end the box was {away:.1f} m away, not 2 ({{where}}).",
                "blind" if same else "look",
            )
    return Done("In 10 worlds the robot stopped about 2 m before the box.", last.picture())

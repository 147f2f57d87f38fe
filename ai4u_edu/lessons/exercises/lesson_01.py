"""Python for robots."""

import math
from typing import Any

from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import LightSensor, LocalBrain, Percept
from ai4u_edu.lessons.exercise import Done, NotYet, a_function, exercise
from ai4u_edu.lessons.exercises import lesson_01_lists  # noqa: F401 - registers 01.4 and 01.5
from ai4u_edu.lessons.exercises.lesson_01_worlds import (
    DECISIONS_A_SECOND,
    EYES,
    LIGHT_REACH_M,
    has_arrived,
    race,
    robot_with,
    two_eyed,
    with_lamp,
)
from ai4u_edu.lessons.exit_ticket import Question, exit_ticket
from ai4u_edu.lessons.numeric import chance_for, difference, finite_number, is_close
from ai4u_edu.lessons.rollouts import Drive, as_brain, drive, seeds_of
from ai4u_edu.lessons.worlds import plate
from ai4u_edu.world import Variation

AHEAD_DEG = 10
"""Largest angle at which the box in 01.2 counts as ahead."""
TURNS = {"left": -1, "right": 1, "ahead": 0}
"""Answers that 01.2 asks for."""
DIM, BRIGHT = 0.2, 0.7
"""Brightness in 01.3 at which the moth slows down, and at which it stops."""
MOTH = {"dark": 1.0, "dim": 0.4, "bright": 0.0}
"""Speeds of the moth in 01.3."""


@exercise(
    "01.1",
    "How fast?",
    hints={
        "begin": "6 metres in 3 seconds: that is 2 metres in each second. What did you do with "
        "the two numbers?",
        "same": "Your answer does not change with the numbers. Use the names in the brackets, "
        "`distance` and `seconds`: they stand for other numbers in each call.",
        "inverted": "It is upside down. The longer the way, the faster the robot has to be: the "
        "distance comes first in the division.",
        "times": "More time means a lower speed: divide by the seconds, don't multiply.",
        "whole": "`//` throws away everything after the point. `/` keeps it.",
        "distance": "That is the distance. How much of it has to be done in each second?",
    },
)
def is_in_time(made: Any) -> Done:
    """Check ``speed_for(distance, seconds)``."""
    a_function(made)
    fixed = finite_number(made(6, 3))
    if fixed == finite_number(made(6, 2)) == finite_number(made(3, 3)):
        raise NotYet(
            f"For 6 m in 3 s your function says {fixed:g} m/s, for 6 m in 2 s and for 3 m in 3 s "
            "too.",
            hint="same" if fixed else "begin",
        )
    chance = chance_for("01.1", made)
    for _ in range(8):
        distance = round(float(chance.uniform(2.5, 6.5)), 1)
        seconds = int(chance.integers(2, 5))
        exact, found = distance / seconds, finite_number(made(distance, seconds))
        done = race(found, distance, seconds)
        if not is_close(found * seconds, distance, 0.05):
            slips = {
                "inverted": ("upside down", seconds / distance),
                "times": ("the product of the two", distance * seconds),
                "whole": ("without what comes after the point", distance // seconds),
                "distance": ("the distance itself", distance),
            }
            slip = difference(found, slips, 0.001)
            raise done.not_yet(
                f"{distance:g} m in {seconds} s: expected {exact:.2f} m/s, got {found:.2f}"
                f"{slip.words}. In the picture the robot drove {seconds} s at your speed; the "
                "dark line is where it should be.",
                slip.name or "begin",
            )
    return Done("Eight times the robot reached the line just in time.", done.picture())


@exercise(
    "01.2",
    "Left, right, ahead",
    hints={
        "begin": 'Three cases: `if side == "left":`, then `elif side == "right":`, then `else:`. '
        "Each of them returns another number.",
        "mirrored": "Left and right are swapped. Turning left is -1, turning right is 1.",
        "spins": "It turns although the box is ahead. For every other word the answer is 0.",
        "one-side": "One of the sides is not right yet. Does each of the two words have its own "
        "case, spelled as in the task, with its own number?",
    },
)
def turns_to_the_side(turn_for: Any) -> Done:
    """Check ``turn_for(side)`` by driving a robot to the box with it."""
    a_function(turn_for)
    said: dict[str, float] = {}

    def steer(_: Percept) -> dict[str, list[float]]:
        angle = math.degrees(agent.body.bearing(sim.world["box"]))
        side = "ahead" if abs(angle) <= AHEAD_DEG else "left" if angle > 0 else "right"
        said[side] = finite_number(turn_for(side))
        turn = max(-1.0, min(1.0, said[side]))
        return {"move": [1.0 if side == "ahead" else 0.0, turn, 0, 0]}

    agent = robot_with(LocalBrain(controller=steer), move=2, goal="box")
    sim = ControlRequestor(plate(), [agent])
    for seed in seeds_of("01.2", 12):
        done = drive(sim, agent, seed, 100)
        if not has_arrived(done):
            shown = ", ".join(f'"{side}": {turn:g}' for side, turn in said.items())
            raise done.not_yet(
                f"The robot did not get to the box ({{where}}). Your function said: {shown}.",
                _turning_mistake(said),
            )
        for side, turn in said.items():
            if not is_close(turn, TURNS[side], 0.01):
                raise done.not_yet(
                    f'For "{side}" expected {TURNS[side]}, got {turn:g} ({{where}}).',
                    "spins" if side == "ahead" else "one-side",
                )
    return Done("In 12 worlds your three answers took the robot to the box.", done.picture())


def _turning_mistake(said: dict[str, float]) -> str:
    """Return the diagnosis that fits the turns that were returned for the words."""
    left, right, ahead = (said.get(side, 0.0) for side in ("left", "right", "ahead"))
    if not any(said.values()):
        return "begin"
    if left > 0 >= right or right < 0 <= left:
        return "mirrored"
    return "spins" if ahead else "one-side"


@exercise(
    "01.3",
    "The moth",
    hints={
        "begin": "Begin with the brightest case: `if brightness > 0.7:`, then `elif brightness > "
        "0.2:`, then `else:`. Each returns an action with another first number.",
        "order": "Close to the lamp a brightness of 0.8 is above 0.2, too. The first question that "
        "fits decides: ask for the bright light first.",
        "overwritten": "In the dark it is slow. Two `if` are two questions: the second one is "
        "asked as well, and changes the speed again. `elif` is asked only if the one before did "
        "not fit.",
        "reversed": "It is fast in the light and slow in the dark: turn the comparisons round.",
        "number": "The cases are right, one of the numbers is not. Compare them with the table: "
        "the speeds, and the brightness at which one case ends and the next one begins.",
    },
)
def flies_like_a_moth(moth: Any) -> Done:
    """Check the speed in the dark, in dim light and close to the lamp."""
    agent = robot_with(
        as_brain(moth),
        move=3,
        eyes=[LightSensor(perception_key="light", group="lamp", reach=LIGHT_REACH_M)],
    )
    start = Variation(x=(-10.5, -3), y=(0, 0.01))
    sim = ControlRequestor(with_lamp((24, 6), random=start), [agent])
    speeds: dict[str, set[float]] = {}
    reason: NotYet | None = None
    for seed in seeds_of("01.3", 8):
        light: list[float] = []

        def watch(done: Drive, light: list[float] = light) -> None:
            nonlocal reason
            if light:
                case = _case(light[-1])
                speed, turn = (*next(iter(done.agent.last_action.values()), ()), 0.0, 0.0)[:2]
                speeds.setdefault(case, set()).add(speed)
                if reason is None and not is_close([speed, turn], [MOTH[case], 0], 0.01):
                    reason = done.not_yet(
                        f"At a brightness of {light[-1]:.2f} expected the numbers {MOTH[case]:g} "
                        f"and 0, got {speed:g} and {turn:g} ({{where}})."
                    )
            light.append(float(done.agent.percept["light"][0]))

        done = drive(sim, agent, seed, 12 * DECISIONS_A_SECOND, watch)
    if reason is not None:
        reason.hint = _moth_mistake(speeds, moth)
        raise reason
    return Done(
        "In 8 worlds: fast in the dark, slow in dim light, at rest close to the lamp.",
        done.picture(),
    )


def _case(brightness: float) -> str:
    """Return the row of the task's table for a brightness."""
    return "bright" if brightness > BRIGHT else "dim" if brightness > DIM else "dark"


def _stops_in_glare(moth: Any) -> bool:
    """Return True for a function that stops at a brightness which no lamp has here."""
    if isinstance(moth, type) or not callable(moth):
        return False
    answers = [moth({"light": [brightness]}) for brightness in (0.99, 1000.0)]
    speeds = [next(iter(each.values()), [0])[0] for each in answers if isinstance(each, dict)]
    return len(speeds) == len(answers) and speeds[0] != 0 == speeds[1]


def _moth_mistake(speeds: dict[str, set[float]], moth: Any) -> str:
    """Return the diagnosis that fits the speeds in the three cases."""
    if not any(speed for case in speeds.values() for speed in case):
        return "begin"
    if any(len(case) > 1 for case in speeds.values()) or _stops_in_glare(moth):
        return "number"  # a case begins or ends at another brightness
    dark, dim, bright = (min(speeds.get(case, {MOTH[case]})) for case in MOTH)
    if dark < bright or (dark < dim and not bright):
        return "reversed"
    if bright == dim:
        return "order"
    return "overwritten" if dark == dim else "number"


@exercise(
    "01.6",
    "To the lamp",
    hints={
        "last": "There is no error any more, but the robot does not get to the lamp. Look at the "
        'last line: an action is `{"move": [forward, turn, 0, 0]}`, in this order.',
        "away": "It turns away from the lamp. Where `left` is larger the lamp is on the left, and "
        "-0.5 turns to the left.",
        "one-side": "It can't turn to both sides. Look at the numbers in `turns`: which one "
        "belongs to the left, and which to the right?",
    },
)
def is_without_errors(to_the_lamp: Any) -> Done:
    """Check that the function runs, and takes the robot to the lamp."""
    brain = as_brain(to_the_lamp)
    for seed in seeds_of("01.6", 10):
        sim = two_eyed(brain, seed)
        actions: list[tuple[float, float]] = []
        towards: list[float] = []  # turns times the difference of the eyes before

        def watch(
            done: Drive,
            actions: list[tuple[float, float]] = actions,
            towards: list[float] = towards,
        ) -> None:
            left, right = (float(done.agent.percept[f"{side} eye"][0]) for side in EYES)
            if done.steps:
                speed, turn = (*next(iter(done.agent.last_action.values()), ()), 0.0, 0.0)[:2]
                actions.append((speed, turn))
                towards[-1] *= turn
            towards.append(right - left)

        done = drive(sim, sim.agents[0], seed, 15 * DECISIONS_A_SECOND, watch)
        if not has_arrived(done):
            how = "fell off the plate" if done.fell else "did not get to the lamp"
            raise done.not_yet(
                f"The robot {how} ({{where}}).", _lamp_mistake(actions, sum(towards[:-1]))
            )
    return Done("No error any more: in 10 worlds the robot got to the lamp.", done.picture())


def _lamp_mistake(actions: list[tuple[float, float]], towards: float) -> str:
    """Return the diagnosis that fits how a robot missed the lamp."""
    speeds, turns = ({each[place] for each in actions} for place in (0, 1))
    if len(turns) == 1 < len(speeds):
        return "last"
    return "away" if towards < 0 else "one-side"


exit_ticket(
    "01.exit",
    Question(
        "b",
        {
            "a": "You can read the speed on the page, but the robot can't. Only `return` gives a "
            "value back to the program.",
            "c": "`print` writes a text on the page; it gives nothing back to the program, not "
            "even a text.",
        },
    ),
    Question(
        "c",
        {
            "a": "90 is above 80, but that question is never asked: the first one that fits, "
            "`points > 30`, decides.",
            "b": "A function returns once. The first `return` ends it.",
        },
    ),
    Question(
        "a",
        {
            "b": "That is the sum of the numbers above 2. But `n = n + 1` adds 1, whatever the "
            "number is.",
            "c": "That is the length of the list. The `if` lets only some of the numbers count.",
        },
    ),
)

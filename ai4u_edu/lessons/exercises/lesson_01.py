"""Python for robots."""

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import (
    Brain,
    LightSensor,
    LocalBrain,
    Percept,
    RBMoveActuator,
    RewardFunc,
    TouchRewardFunc,
)
from ai4u_edu.lessons.calls import Calls, function_exercise
from ai4u_edu.lessons.exercise import Done, NotYet, a_function, exercise, named
from ai4u_edu.lessons.exit_ticket import Question, exit_ticket
from ai4u_edu.lessons.numeric import difference, finite_number, is_close
from ai4u_edu.lessons.pictures import picture
from ai4u_edu.lessons.rollouts import Drive, as_brain, drive, seeds_of
from ai4u_edu.lessons.student_errors import NOTHING_RETURNED
from ai4u_edu.lessons.worlds import plate
from ai4u_edu.locale import gettext as _
from ai4u_edu.snapshot import capture_snapshot
from ai4u_edu.world import BoxShape, CircleShape, Variation, World

_TOP_SPEED = 8.0
"""Speed of the robot in 01.1 for an action of 1, m/s."""
_DECISIONS_A_SECOND = 12
_NEAR_M = 2.0
"""Distance below which a post in 01.4 is near."""
_STEP_DECISIONS = 6
"""Decisions for a word of a plan in 01.5: a metre, or a quarter turn."""
_LIGHT_REACH_M = 4.0
_EYES = {"left": 60.0, "right": -60.0}
"""Directions of the eyes in 01.6, degrees."""
_WORDS = {
    "forward": [1.0, 0.0, 0.0, 0.0],
    "left": [0.0, -1.0, 0.0, 0.0],
    "right": [0.0, 1.0, 0.0, 0.0],
}
"""Actions for the words of a plan."""


def race(speed: float, distance: float, seconds: int) -> Drive:
    """Drive at a speed for a time, on a plate with a line at a distance."""
    share = max(-1.0, min(1.0, speed / _TOP_SPEED))
    world = World()
    world.add_floor("plate", BoxShape(size=(10, 4)), position=(4, 0))
    line = BoxShape(size=(0.15, 3))
    world.add_area("line", line, position=(distance, 0), colour="black", paint=True)
    world.add_body("robot", CircleShape(radius=0.5), tags=("agent",))
    agent = _robot_with(
        LocalBrain(controller=lambda _: {"move": [share, 0, 0, 0]}), move=_TOP_SPEED
    )
    return drive(ControlRequestor(world, [agent]), agent, 1, seconds * _DECISIONS_A_SECOND)


def _robot_with(
    brain: Brain,
    *,
    move: float,
    turn: float = 3.0,
    eyes: Sequence[LightSensor] = (),
    goal: str = "",
) -> BasicAgent:
    """Return a robot.

    Args:
        brain: its brain.
        move: speed for an action of 1, m/s.
        turn: turning speed for an action of 1, rad/s.
        eyes: its sensors.
        goal: the body at whose touch it is paid 1, and the episode ends; none if empty.
    """
    rewards: list[RewardFunc] = []
    if goal:
        rewards = [
            TouchRewardFunc(name="arrived", target=goal, reward=1, cause_episode_to_end=True)
        ]
    return BasicAgent(
        body="robot",
        sensors=list(eyes),
        actuators=[RBMoveActuator(move_amount=move, turn_amount=turn)],
        rewards=rewards,
        brains=[brain],
    )


def _has_arrived(done: Drive) -> bool:
    """Return True if a robot touched its goal."""
    return is_close(done.agent.ledger.episode_total, 1, 1e-6)


def _with_lamp(size: tuple[float, float], **robot: Any) -> World:
    """Return a plate with a lamp in the middle, and a robot."""
    world = World()
    world.add_floor("plate", BoxShape(size=size))
    world.add_body("robot", CircleShape(radius=0.5), tags=("agent",), **robot)
    world.add_body("lamp", CircleShape(radius=0.4), kind="static", tags=("lamp",), colour="yellow")
    return world


def _posts_around(distances: list[float]) -> bytes:
    """Return a picture of a robot with posts around it."""
    world = World()
    world.add_floor("plate", BoxShape(size=(10, 10)))
    world.add_body("robot", CircleShape(radius=0.5), tags=("agent",))
    for number, away in enumerate(distances):
        angle = math.tau * number / len(distances)
        place = (away * math.cos(angle), away * math.sin(angle))
        colour = "orange" if away < _NEAR_M else "grey"
        shape = CircleShape(radius=0.25)
        world.add_body(f"post {number}", shape, kind="static", position=place, colour=colour)
    agent = _robot_with(LocalBrain(controller=lambda _: {}), move=1)
    sim = ControlRequestor(world, [agent])
    sim.reset(1)
    return picture(capture_snapshot(sim))


def _carry_out(words: list[str], ahead: int, left: int) -> Drive:
    """Carry out a plan in a world with a flag."""
    world = World()
    world.add_floor("plate", BoxShape(size=(14, 14)))
    flag = BoxShape(size=(0.8, 0.8))
    world.add_area("flag", flag, position=(ahead, left), colour="green", paint=True)
    world.add_body("robot", CircleShape(radius=0.4), tags=("agent",))
    actions = [_WORDS[word] for word in words for _ in range(_STEP_DECISIONS)]
    queue = iter(actions)
    brain = LocalBrain(controller=lambda _: {"move": next(queue)})
    metres, quarter = 1.0, math.pi / 2
    a_second = _DECISIONS_A_SECOND / _STEP_DECISIONS
    agent = _robot_with(brain, move=metres * a_second, turn=quarter * a_second)
    return drive(ControlRequestor(world, [agent]), agent, 1, len(actions))


def _two_eyed(brain: Brain, seed: int) -> ControlRequestor:
    """Return a world with a robot that sees a lamp in front of it or beside it."""
    chance = np.random.default_rng(seed)
    around, away = chance.uniform(-math.pi, math.pi), chance.uniform(3, 5)
    aside = chance.uniform(20, 90) * chance.choice([-1.0, 1.0])
    world = _with_lamp(
        (12, 12),
        position=(away * math.cos(around), away * math.sin(around)),
        heading_deg=math.degrees(around) + 180 + aside,
    )
    eyes = [
        LightSensor(
            perception_key=f"{side} eye", group="lamp", angle_deg=angle, reach=_LIGHT_REACH_M
        )
        for side, angle in _EYES.items()
    ]
    return ControlRequestor(world, [_robot_with(brain, move=2, eyes=eyes, goal="lamp")])


AHEAD_DEG = 10
"""Largest angle at which the box in 01.2 counts as ahead."""
TURNS = {"left": -1, "right": 1, "ahead": 0}
"""Answers that 01.2 asks for."""
DIM, BRIGHT = 0.2, 0.7
"""Brightness in 01.3 at which the moth slows down, and at which it stops."""
MOTH = {"dark": 1.0, "dim": 0.4, "bright": 0.0}
"""Speeds of the moth in 01.3."""
MAX_WORDS = 40
"""Longest plan in 01.5."""


@function_exercise(
    "01.1",
    _("How fast?"),
    hints={
        "begin": _(
            "6 metres in 3 seconds: that is 2 metres in each second. What did you do with "
            "the two numbers?"
        ),
        "same": _(
            "Your answer does not change with the numbers. Use the names in the brackets, "
            "`distance` and `seconds`: they stand for other numbers in each call."
        ),
        "inverted": _(
            "It is upside down. The longer the way, the faster the robot has to be: the "
            "distance comes first in the division."
        ),
        "times": _("More time means a lower speed: divide by the seconds, don't multiply."),
        "whole": _("`//` throws away everything after the point. `/` keeps it."),
        "distance": _("That is the distance. How much of it has to be done in each second?"),
    },
)
def is_in_time(chance: np.random.Generator) -> Calls:
    """Check ``speed_for(distance, seconds)``."""
    fixed = finite_number((yield 6, 3))
    if fixed == finite_number((yield 6, 2)) == finite_number((yield 3, 3)):
        raise NotYet(
            _(
                "For 6 m in 3 s your function says {fixed:g} m/s, for 6 m in 2 s and for 3 m "
                "in 3 s too.",
                fixed=fixed,
            ),
            hint="same" if fixed else "begin",
        )
    for _number in range(8):
        distance = round(float(chance.uniform(2.5, 6.5)), 1)
        seconds = int(chance.integers(2, 5))
        exact, found = distance / seconds, finite_number((yield distance, seconds))
        done = race(found, distance, seconds)
        if not is_close(found * seconds, distance, 0.05):
            slips = {
                "inverted": (_("upside down"), seconds / distance),
                "times": (_("the product of the two"), distance * seconds),
                "whole": (_("without what comes after the point"), distance // seconds),
                "distance": (_("the distance itself"), distance),
            }
            slip = difference(found, slips, 0.001)
            raise done.not_yet(
                _(
                    "{distance:g} m in {seconds} s: expected {exact:.2f} m/s, got "
                    "{found:.2f}{words}. In the picture the robot drove {seconds} s at your "
                    "speed; the dark line is where it should be.",
                    distance=distance,
                    seconds=seconds,
                    exact=exact,
                    found=found,
                    words=slip.words,
                ),
                slip.name or "begin",
            )
    return Done(_("Eight times the robot reached the line just in time."), done.picture())


@exercise(
    "01.2",
    _("Left, right, ahead"),
    hints={
        "begin": _(
            'Three cases: `if side == "left":`, then `elif side == "right":`, then `else:`. '
            "Each of them returns another number."
        ),
        "mirrored": _("Left and right are swapped. Turning left is -1, turning right is 1."),
        "spins": _("It turns although the box is ahead. For every other word the answer is 0."),
        "one-side": _(
            "One of the sides is not right yet. Does each of the two words have its own "
            "case, spelled as in the task, with its own number?"
        ),
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

    agent = _robot_with(LocalBrain(controller=steer), move=2, goal="box")
    sim = ControlRequestor(plate(), [agent])
    for seed in seeds_of("01.2", 12):
        done = drive(sim, agent, seed, 100)
        if not _has_arrived(done):
            shown = ", ".join(f'"{side}": {turn:g}' for side, turn in said.items())
            raise done.not_yet(
                _(
                    "The robot did not get to the box ({where}). Your function said: {shown}.",
                    where=done.where,
                    shown=shown,
                ),
                _turning_mistake(said),
            )
        for side, turn in said.items():
            if not is_close(turn, TURNS[side], 0.01):
                raise done.not_yet(
                    _(
                        'For "{side}" expected {turns}, got {turn:g} ({where}).',
                        side=side,
                        turns=TURNS[side],
                        turn=turn,
                        where=done.where,
                    ),
                    "spins" if side == "ahead" else "one-side",
                )
    return Done(_("In 12 worlds your three answers took the robot to the box."), done.picture())


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
    _("The moth"),
    hints={
        "begin": _(
            "Begin with the brightest case: `if brightness > 0.7:`, then `elif brightness > "
            "0.2:`, then `else:`. Each returns an action with another first number."
        ),
        "order": _(
            "Close to the lamp a brightness of 0.8 is above 0.2, too. The first question "
            "that fits decides: ask for the bright light first."
        ),
        "overwritten": _(
            "In the dark it is slow. Two `if` are two questions: the second one is asked as "
            "well, and changes the speed again. `elif` is asked only if the one before did "
            "not fit."
        ),
        "reversed": _("It is fast in the light and slow in the dark: turn the comparisons round."),
        "number": _(
            "The cases are right, one of the numbers is not. Compare them with the table: "
            "the speeds, and the brightness at which one case ends and the next one begins."
        ),
    },
)
def flies_like_a_moth(moth: Any) -> Done:
    """Check the speed in the dark, in dim light and close to the lamp."""
    agent = _robot_with(
        as_brain(moth),
        move=3,
        eyes=[LightSensor(perception_key="light", group="lamp", reach=_LIGHT_REACH_M)],
    )
    start = Variation(x=(-10.5, -3), y=(0, 0.01))
    sim = ControlRequestor(_with_lamp((24, 6), random=start), [agent])
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
                        _(
                            "At a brightness of {light:.2f} expected the numbers {moth:g} "
                            "and 0, got {speed:g} and {turn:g} ({where}).",
                            light=light[-1],
                            moth=MOTH[case],
                            speed=speed,
                            turn=turn,
                            where=done.where,
                        )
                    )
            light.append(float(done.agent.percept["light"][0]))

        done = drive(sim, agent, seed, 12 * _DECISIONS_A_SECOND, watch)
    if reason is not None:
        reason.hint = _moth_mistake(speeds, moth)
        raise reason
    return Done(
        _("In 8 worlds: fast in the dark, slow in dim light, at rest close to the lamp."),
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
    _("To the lamp"),
    hints={
        "last": _(
            "There is no error any more, but the robot does not get to the lamp. Look at the "
            'last line: an action is `{"move": [forward, turn, 0, 0]}`, in this order.'
        ),
        "away": _(
            "It turns away from the lamp. Where `left` is larger the lamp is on the left, "
            "and -0.5 turns to the left."
        ),
        "one-side": _(
            "It can't turn to both sides. Look at the numbers in `turns`: which one belongs "
            "to the left, and which to the right?"
        ),
    },
)
def is_without_errors(to_the_lamp: Any) -> Done:
    """Check that the function runs, and takes the robot to the lamp."""
    brain = as_brain(to_the_lamp)
    for seed in seeds_of("01.6", 10):
        sim = _two_eyed(brain, seed)
        actions: list[tuple[float, float]] = []
        towards: list[float] = []  # turns times the difference of the eyes before

        def watch(
            done: Drive,
            actions: list[tuple[float, float]] = actions,
            towards: list[float] = towards,
        ) -> None:
            left, right = (float(done.agent.percept[f"{side} eye"][0]) for side in _EYES)
            if done.steps:
                speed, turn = (*next(iter(done.agent.last_action.values()), ()), 0.0, 0.0)[:2]
                actions.append((speed, turn))
                towards[-1] *= turn
            towards.append(right - left)

        done = drive(sim, sim.agents[0], seed, 15 * _DECISIONS_A_SECOND, watch)
        if not _has_arrived(done):
            how = _("fell off the plate") if done.fell else _("did not get to the lamp")
            raise done.not_yet(
                _("The robot {how} ({where}).", how=how, where=done.where),
                _lamp_mistake(actions, sum(towards[:-1])),
            )
    return Done(_("No error any more: in 10 worlds the robot got to the lamp."), done.picture())


def _lamp_mistake(actions: list[tuple[float, float]], towards: float) -> str:
    """Return the diagnosis that fits how a robot missed the lamp."""
    speeds, turns = ({each[place] for each in actions} for place in (0, 1))
    if len(turns) == 1 < len(speeds):
        return "last"
    return "away" if towards < 0 else "one-side"


@function_exercise(
    "01.4",
    _("How many are near?"),
    hints={
        "begin": _(
            "Three steps: before the loop `count = 0`; in the loop, if the distance is below "
            "2, `count = count + 1`; after the loop `return count`."
        ),
        "early": _(
            "Your loop ends at the first distance: a `return` ends the whole function. Move "
            "it to the left, below the `for`, so that it comes after the loop."
        ),
        "reset": _(
            "The count starts again for each distance. `count = 0` has to stand before the "
            "`for`, not in it."
        ),
        "all": _("That is the number of all posts. Count only if the distance is below 2."),
        "limit": _("A post at exactly 2 m is not nearer than 2 m: compare with `<`."),
        "far": _("You counted the posts that are far away: turn the comparison round."),
        "sum": _("You added up distances. Here each near post counts as 1, whatever its distance."),
    },
)
def counts_the_near_ones(chance: np.random.Generator) -> Calls:
    """Check ``count_near(distances)`` for posts around a robot."""
    asked: list[tuple[list[float], float]] = []
    # near ones and far ones, of which neither the first nor the last says how many there are
    for near, far in ((2, 3), (0, 4), (5, 0), (1, 2), (3, 4), (4, 1), (2, 1), (1, 5)):
        away = [*chance.uniform(1.2, 1.9, near), *chance.uniform(2.1, 4.2, far)]
        if far:
            away[-1] = _NEAR_M  # just not near
        distances = [round(float(each), 1) for each in chance.permutation(away)]
        asked.append((distances, finite_number((yield (list(distances),)))))
    for distances, found in asked:
        exact = sum(each < _NEAR_M for each in distances)
        if not is_close(found, exact, 1e-6):
            raise NotYet(
                _(
                    "For {distances} expected {exact}, got {found:g}.",
                    distances=str(distances),
                    exact=exact,
                    found=found,
                ),
                hint=_counting_mistake(asked),
                picture=_posts_around(distances),
            )
    return Done(_("Eight places, and every count was right."), _posts_around(asked[-1][0]))


def _counting_mistake(asked: list[tuple[list[float], float]]) -> str:
    """Return the diagnosis that explains all counts."""
    mistakes: dict[str, Callable[[list[float]], float]] = {
        "early": lambda given: float(given[0] < _NEAR_M),
        "reset": lambda given: float(given[-1] < _NEAR_M),
        "all": lambda given: float(len(given)),
        "limit": lambda given: float(sum(each <= _NEAR_M for each in given)),
        "far": lambda given: float(sum(each > _NEAR_M for each in given)),
        "far ": lambda given: float(sum(each >= _NEAR_M for each in given)),
        "sum": lambda given: float(sum(each for each in given if each < _NEAR_M)),
    }
    for name, wrong in mistakes.items():
        if all(is_close(found, wrong(given), 1e-6) for given, found in asked):
            return name.strip()
    return "begin"


@function_exercise(
    "01.5",
    _("A plan"),
    hints={
        "begin": _(
            "Begin with an empty list: `steps = []`. Then `for _ in range(ahead):`, and in "
            'the loop `steps.append("forward")`. Then one "left", then a second loop.'
        ),
        "early": _(
            "Your loop ends after its first step: a `return` ends the whole function. Move "
            "it to the left, so that it comes after the loops."
        ),
        "reset": _("The list starts again in the loop. `steps = []` has to stand before it."),
        "turn": _("It drives straight on. Between the two loops the robot has to turn: once."),
        "turns": _(
            "It turns at each step. The turn has to stand after the first loop, not in it: "
            "further to the left."
        ),
        "mirrored": _("It turns to the wrong side."),
        "swapped": _("The two numbers are swapped: first `ahead` metres, then `left` metres."),
        "count": _(
            "It stops beside the flag. Count the steps in the picture: `range(3)` gives "
            "three numbers: 0, 1, 2."
        ),
        "words": _('A plan is a list of the words "forward", "left" and "right".'),
    },
)
def plans_the_way(chance: np.random.Generator) -> Calls:
    """Check that a robot that carries out ``plan(ahead, left)`` gets to the flag."""
    drawn = [tuple(int(each) for each in chance.integers(1, 6, 2)) for _ in range(4)]
    for ahead, left in ((3, 1), (1, 4), (5, 2), *drawn):
        words = _words_of((yield ahead, left))
        done = _carry_out(words, ahead, left)
        x, y = done.agent.body.position
        if not math.hypot(x - ahead, y - left) < 0.3:
            shown = ", ".join(words[:8]) + (" ..." if len(words) > 8 else "")
            raise done.not_yet(
                _(
                    "The flag is {ahead} m ahead and {left} m to the left; the robot ends "
                    "{x:.0f} m ahead and {y:.0f} m to the left. Your plan: {plan}.",
                    ahead=ahead,
                    left=left,
                    x=x,
                    y=y,
                    plan=shown or _("nothing"),
                ),
                _planning_mistake(words, ahead, left),
            )
    return Done(
        _("{count} flags, and each of your plans led to its flag.", count=3 + len(drawn)),
        done.picture(),
    )


def _words_of(given: Any) -> list[str]:
    """Return a student's plan.

    Raises:
        NotYet: it is no list of the three words.
    """
    if given is None:
        raise NotYet(NOTHING_RETURNED, hint="no-return")
    if isinstance(given, str) or not isinstance(given, list | tuple):
        raise NotYet(_("Expected a list of words, got {got}.", got=named(given)), hint="list")
    if len(given) > MAX_WORDS:
        raise NotYet(
            _(
                "Your plan has {count} words; {max_words} are enough.",
                count=len(given),
                max_words=MAX_WORDS,
            ),
            hint="count",
        )
    for each in given:
        if not isinstance(each, str) or each not in _WORDS:
            raise NotYet(
                _(
                    "The robot knows {listed}; got {got}.",
                    listed=", ".join(_WORDS),
                    got=named(each),
                ),
                hint="words",
            )
    return list(given)


def _planning_mistake(words: list[str], ahead: int, left: int) -> str:
    """Return the diagnosis that fits a plan that leads elsewhere."""

    def way(first: int, turn: list[str], then: int) -> list[str]:
        return [*["forward"] * first, *turn, *["forward"] * then]

    if not words:
        return "begin"
    if words == ["forward"]:
        return "early"
    if words == way(ahead, ["left"], 1):
        return "early"
    if words.count("left") > 1:
        return "turns"
    if words == way(ahead, [], left):
        return "turn"
    if words == way(ahead, ["right"], left):
        return "mirrored"
    if words == way(left, ["left"], ahead):
        return "swapped"
    if words in (["left", *["forward"] * left], ["forward", "left", "forward"], ["forward"] * left):
        return "reset"
    return "count"


exit_ticket(
    "01.exit",
    Question(
        "b",
        {
            "a": _(
                "You can read the speed on the page, but the robot can't. Only `return` "
                "gives a value back to the program."
            ),
            "c": _(
                "`print` writes a text on the page; it gives nothing back to the program, "
                "not even a text."
            ),
        },
    ),
    Question(
        "c",
        {
            "a": _(
                "90 is above 80, but that question is never asked: the first one that fits, "
                "`points > 30`, decides."
            ),
            "b": _("A function returns once. The first `return` ends it."),
        },
    ),
    Question(
        "a",
        {
            "b": _(
                "That is the sum of the numbers above 2. But `n = n + 1` adds 1, whatever "
                "the number is."
            ),
            "c": _("That is the length of the list. The `if` lets only some of the numbers count."),
        },
    ),
)

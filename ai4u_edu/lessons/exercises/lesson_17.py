"""Soccer: behind the ball, and then through it."""

import math
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from json import dumps
from typing import Any

import numpy as np
import numpy.typing as npt

from ai4u_edu.lessons.calls import Calls, function_exercise
from ai4u_edu.lessons.exercise import Done, NotYet, a_function, exercise, named
from ai4u_edu.lessons.exit_ticket import Question, exit_ticket
from ai4u_edu.lessons.numeric import finite_numbers, is_close
from ai4u_edu.lessons.rollouts import Drive, drives, seeds_of
from ai4u_edu.lessons.student_errors import NOTHING_RETURNED
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene

METRE = 1 / (math.hypot(16.2, 9.2) + 5)
"""A metre, in the unit of the pitch's position sensors."""
_SAME_WAY_RAD = 0.5
"""Largest angle between two directions that count as the same."""
_GAP = 1.4 * METRE
"""Distance from the ball of the place behind it."""
_Place = Sequence[float] | npt.NDArray[np.float64]
GOAL_OF_BLUE_X_M = -7
DECISIONS_A_SECOND = 12
PRACTICE_DECISIONS = 150
GAMES, QUICK_GOALS, QUICK_DECISIONS = 24, 16, 120
"""Games for gold, quick goals among them, and decisions of a quick one."""
MAX_BALL_MOVE_M, MAX_BALL_DISTANCE_M = 0.3, 2.5
"""Limits of how far the ball has moved, and the robot is from it, once it is behind it."""


def go_to(forward: float, left: float) -> dict[str, list[float]]:
    """Return the action that drives towards a place: so far ahead of the robot, so far left."""
    angle = math.atan2(left, forward)
    return {"move": [float(abs(angle) < 0.5), max(-1.0, min(1.0, -2 * angle)), 0, 0]}


def lined_up(ball: _Place, goal: _Place) -> bool:
    """Return True if ball and goal lie in the same direction, seen from the robot."""
    angle = math.atan2(ball[1], ball[0]) - math.atan2(goal[1], goal[0])
    return abs(math.remainder(angle, math.tau)) < _SAME_WAY_RAD


def behind(ball: _Place, goal: _Place, gap: float = _GAP) -> tuple[float, float]:
    """Return the place behind the ball, seen from the goal: (ahead, left) of the robot."""
    x, y = goal[0] - ball[0], goal[1] - ball[1]
    length = math.hypot(x, y)
    return float(ball[0] - gap * x / length), float(ball[1] - gap * y / length)


def practice() -> Scene:
    """Return the soccer scene with nobody in it but you and the ball."""
    plain = Scene.load("soccer").plain()
    plain["agents"] = plain["agents"][:1]
    others = {"blue keeper", "orange striker", "orange keeper"}
    plain["bodies"] = [each for each in plain["bodies"] if each["name"] not in others]
    return Scene.loads(dumps(plain), name="practice")  # JSON is YAML as well


def in_front(done: Drive) -> None:
    """Put the striker between the ball and the goal, at the beginning."""
    if done.steps == 0:
        chance = np.random.default_rng(done.seed)
        x, y, heading = chance.uniform(1.5, 5), chance.uniform(-3.5, 3.5), chance.uniform(-3, 3)
        done.agent.body.move_to(float(x), float(y), heading=float(heading))


def goals(strike: Any, games: int = 12) -> int:
    """Return in how many games a striker scores that begins in front of the ball."""
    return sum(each.won for each in drives("soccer", strike, list(range(games)), watch=in_front))


def _angle(place: _Place) -> float:
    return math.atan2(place[1], place[0])


def _steep(place: _Place) -> float:
    return math.atan(place[1] / place[0])


ALMOST: Mapping[str, Callable[[_Place, _Place], bool]] = {
    "wrap": lambda ball, goal: abs(_angle(ball) - _angle(goal)) < _SAME_WAY_RAD,
    "wrap ": lambda ball, goal: abs(_angle(ball[::-1]) - _angle(goal[::-1])) < _SAME_WAY_RAD,
    "sign": lambda ball, goal: math.remainder(_angle(ball) - _angle(goal), math.tau) < 0.5,
    "sign ": lambda ball, goal: math.remainder(_angle(goal) - _angle(ball), math.tau) < 0.5,
    "atan": lambda ball, goal: abs(_steep(ball) - _steep(goal)) < _SAME_WAY_RAD,
    "side": lambda ball, goal: (ball[1] > 0) == (goal[1] > 0),
    "near": lambda ball, goal: math.dist(ball[:2], goal[:2]) < _SAME_WAY_RAD,
    "begin": lambda *_: False,
    "begin ": lambda *_: True,
}
"""Functions that students write in place of the right one, by the diagnosis."""


@function_exercise(
    "17.1",
    _("The same direction"),
    hints={
        "begin": _(
            "It gives the same answer to everything. `math.atan2(ball[1], ball[0])` is the "
            "direction to the ball, in radians; the goal's is computed in the same way."
        ),
        "wrap": _(
            "Two directions that are hardly different can have numbers such as 3.1 and -3.1, "
            "which are 6.2 apart. `math.remainder(a - b, math.tau)` brings a difference of "
            "angles back to the range from -3.14 to 3.14."
        ),
        "sign": _("A difference can be below 0, too: then it is always less than 0.5. Take `abs`."),
        "atan": _(
            "`math.atan` can't tell ahead from behind. `math.atan2(left, ahead)` can: left "
            "is the first of its two numbers."
        ),
        "side": _(
            "You ask whether both are on the same side. That is not enough: one may be on "
            "the left, the other almost behind. Compare the directions."
        ),
        "near": _(
            "Ball and goal may be far from each other, and lie in the same direction all the "
            "same. Compare directions, not places."
        ),
    },
)
def same_direction(chance: np.random.Generator) -> Calls:
    """Check whether ball and goal lie in the same direction."""
    cases = _directions(chance)
    said = []
    for ball, goal in cases:
        said.append(_truth((yield _places(ball, goal))))
    for (ball, goal), got in zip(cases, said, strict=True):
        if got is not lined_up(ball, goal):
            fits = (
                name.strip()
                for name, almost in ALMOST.items()
                if said == [almost(*each) for each in cases]
            )
            apart = math.degrees(abs(math.remainder(_angle(ball) - _angle(goal), math.tau)))
            raise NotYet(
                _(
                    "The ball at {shown}, the goal at {shown2}: they are {apart:.0f} degrees "
                    "apart, and your function says {got}.",
                    shown=_shown(ball),
                    shown2=_shown(goal),
                    apart=apart,
                    got=got,
                ),
                hint=next(fits, ""),
            )
    return _("{count} pairs of directions, all of them right.", count=len(cases))


def _directions(chance: np.random.Generator) -> list[tuple[_Place, _Place]]:
    """Return places of a ball and a goal, none of them at the limit of what counts as the same."""
    cases: list[tuple[_Place, _Place]] = []
    axes = (0.0, math.pi / 2, math.pi, -math.pi / 2)
    for number in range(60):
        towards = chance.uniform(-math.pi, math.pi) if number % 3 else math.pi + 0.01
        small, large = chance.uniform(0, 0.4), chance.uniform(0.65, math.pi)
        apart = (small if number % 2 else large) * chance.choice([-1, 1])
        if number < 2 * len(axes):  # across each axis: at one of them every formula jumps
            side = 1 if number % 2 else -1
            towards = axes[number // 2] - side * chance.uniform(0.03, 0.15)
            apart = side * chance.uniform(0.2, 0.4)
        places = []
        for angle, away in ((towards, chance.uniform(0.05, 0.3)), (towards + apart, 0.4)):
            places.append((round(away * math.cos(angle), 3), round(away * math.sin(angle), 3)))
        cases.append((places[0], places[1]))
    return cases


def _places(*places: _Place) -> tuple[Any, ...]:
    """Return places as a percept has them: arrays of three numbers."""
    return tuple(np.array([*each, 0.0]) for each in places)


def _truth(given: Any) -> bool:
    if given is None:
        raise NotYet(NOTHING_RETURNED, hint="no-return")
    if not isinstance(given, bool | np.bool_):
        raise NotYet(_("Expected True or False, got {got}.", got=named(given)), hint="begin")
    return bool(given)


def _shown(place: _Place) -> str:
    return _("({place:g} ahead, {place2:g} left)", place=place[0], place2=place[1])


@function_exercise(
    "17.2",
    _("Behind the ball"),
    hints={
        "begin": _(
            "Begin with the way from the ball to the goal: `x = goal[0] - ball[0]`, and the "
            "same for left. From the ball, go that way backwards."
        ),
        "front": _("That is before the ball, on the side of the goal. Subtract."),
        "long": _(
            "The way from the ball to the goal has its own length. Divide it by its length "
            "first, `math.hypot(x, y)`; then `gap` times that is as long as `gap`."
        ),
        "robot": _(
            "That is behind the ball as the robot sees it. It should be behind the ball as "
            "the goal sees it: on the line from the goal through the ball."
        ),
        "goal": _("That is a place near the goal. Begin at the ball."),
        "swapped": _("Ahead comes first, then left."),
    },
)
def is_behind(chance: np.random.Generator) -> Calls:
    """Check the place behind the ball."""
    for _number in range(8):
        ball, goal = chance.uniform(-0.3, 0.3, 2).round(2), chance.uniform(-0.4, 0.4, 2).round(2)
        gap = round(float(chance.uniform(0.05, 0.12)), 2)
        got = finite_numbers((yield *_places(ball, goal), gap), 2)
        x, y = behind(ball, goal, gap)
        if not is_close(got, [x, y], 1e-4):
            way, length = goal - ball, math.dist(goal, ball)
            slips: dict[str, _Place] = {
                "begin": (0.0, 0.0),
                "front": ball + gap * way / length,
                "long": ball - gap * way,
                "robot": ball + gap * ball / math.hypot(*ball),
                "goal": goal - gap * way / length,
                "swapped": (y, x),
            }
            fits = (name for name, each in slips.items() if is_close(got, list(each), 1e-4))
            raise NotYet(
                _(
                    "The ball at {shown}, the goal at {shown2}, a gap of {gap:g}: expected "
                    "{shown3}, got {shown4}.",
                    shown=_shown(ball),
                    shown2=_shown(goal),
                    gap=gap,
                    shown3=_shown((round(x, 3), round(y, 3))),
                    shown4=_shown([round(each, 3) for each in got]),
                ),
                hint=next(fits, ""),
            )
    return _("Eight balls, and each time the place behind it.")


@exercise(
    "17.3",
    _("Around the ball"),
    hints={
        "pushes": _(
            "It runs into the ball on its way. Where ball and place lie in the same "
            "direction and the ball is nearer, go past the ball first: towards a direction "
            "that is 70 degrees (1.2 radians) to its side."
        ),
        "elsewhere": _("It does not get behind the ball. Go to `behind(ball, goal)`."),
        "crawls": _("The way is right. Drive faster: there are 150 decisions, 12.5 seconds."),
    },
)
def goes_around(get_behind: Any) -> Done:
    """Check that it gets behind the ball without a push, in 8 of 10 worlds."""
    worlds, needed, won = 10, 8, 0
    reasons: list[NotYet] = []
    steer = a_function(get_behind)
    for seed in seeds_of("17.3", worlds):
        watch = _Practice()
        (done,) = drives(practice(), steer, [seed], limit=PRACTICE_DECISIONS, watch=watch)
        won += watch.is_there
        if not watch.is_there:
            if watch.ball_moved > MAX_BALL_MOVE_M:
                how, hint = (
                    _("It pushed the ball {metres:.1f} m away", metres=watch.ball_moved),
                    "pushes",
                )
            elif watch.is_on_its_way:
                how, hint = _("It was still on its way when the time was up"), "crawls"
            else:
                how, hint = _("It did not get behind the ball"), "elsewhere"
            reasons.append(done.not_yet(_("{how} ({where}).", how=how, where=done.where), hint))
    if won < needed:
        (frequent, _count), *_others = Counter(each.hint for each in reasons).most_common(1)
        reason = next(each for each in reasons if each.hint == frequent)
        reason.text = _(
            "Behind the ball in {won} of {worlds} worlds. {text}",
            won=won,
            worlds=worlds,
            text=reason.text,
        )
        raise reason
    return Done(
        _("Behind the ball in {won} of {worlds} worlds.", won=won, worlds=worlds), done.picture()
    )


class _Practice:
    """Watches one drive: whether the robot gets behind a ball that stays where it is."""

    def __init__(self) -> None:
        self.is_there = False
        self.ball_moved = 0.0
        self._away: list[float] = []
        self._ball: tuple[float, float] | None = None

    @property
    def is_on_its_way(self) -> bool:
        """True if it is nearer to the place than at the beginning, and still comes nearer."""
        before, last = self._away[-DECISIONS_A_SECOND:][0], self._away[-1]
        return last < self._away[0] and before - last > 0.1 * METRE

    def __call__(self, done: Drive) -> None:
        """Look once, at the beginning and after each decision."""
        in_front(done)
        if done.steps == 0:
            return
        now = done.sim.world["ball"].position
        self._ball = self._ball or now
        moved = math.dist(now, self._ball)
        percept = done.agent.percept
        ball, goal = percept["ball"], percept["goal"]
        self._away.append(math.hypot(*behind(ball, goal)))
        if not self.is_there:
            self.ball_moved = max(self.ball_moved, moved)
            near = math.hypot(ball[0], ball[1]) < MAX_BALL_DISTANCE_M * METRE
            self.is_there = moved <= MAX_BALL_MOVE_M and near and _in_line(ball, goal)


def _in_line(ball: _Place, goal: _Place) -> bool:
    """Return True if the robot is behind the ball, seen from the goal."""
    return lined_up(ball, goal) and math.hypot(*ball[:2]) < math.hypot(*goal[:2])


@exercise(
    "17.4",
    _("The striker"),
    hints={
        "begin": _(
            "Running at the ball is not enough: it flies off the way you were running. First "
            "get behind it, as in exercise 17.3."
        ),
        "through": _(
            "It gets behind the ball, and then? When ball and goal lie in the same "
            "direction, `lined_up(ball, goal)`, run through the ball."
        ),
        "around": _(
            "It scores sometimes. On its way to the place behind the ball it runs into the "
            "ball: go around it, as in exercise 17.3."
        ),
    },
)
def scores(strike: Any) -> Done:
    """Check for 9 goals in 12 games that begin in front of the ball."""
    games, needed, won = 12, 9, 0
    reason: NotYet | None = None
    for played, done in enumerate(
        drives("soccer", strike, seeds_of("17.4", games), watch=in_front), 1
    ):
        won += done.won
        if not done.won and reason is None:
            own = done.sim.world["ball"].position[0] < GOAL_OF_BLUE_X_M
            how = _("An own goal") if own else _("No goal")
            reason = done.not_yet(
                _("{how} ({where}).", how=how, where=done.where), _striker_mistake(strike, done)
            )
        if played - won > games - needed:
            break
    if won < needed and reason is not None:
        reason.text = _(
            "{won} goals in {played} games; {needed} in {games} needed. {text}",
            won=won,
            played=played,
            needed=needed,
            games=games,
            text=reason.text,
        )
        raise reason
    return Done(_("{won} goals in {played} games.", won=won, played=played), done.picture())


def _striker_mistake(strike: Any, done: Drive) -> str:
    """Return the diagnosis that fits how a striker answers in three situations."""
    if isinstance(strike, type) or not callable(strike):
        return ""  # a controller: it may remember what it saw
    situations = {
        "through": ((0.1, 0.0), (0.4, 0.0)),  # ball and goal straight ahead
        "begin": ((0.1, 0.0), (0.1, -0.3)),  # the goal is on the right
        "around": ((0.1, 0.0), (-0.3, 0.0)),  # the ball is in the way
    }
    runs_straight_on = {}
    for name, places in situations.items():
        ball, goal = _places(*places)
        answer = strike({**done.agent.percept, "ball": ball, "goal": goal, "home": -goal})
        move: Sequence[float] = answer.get("move", ()) if isinstance(answer, dict) else ()
        runs_straight_on[name] = len(move) == 4 and move[0] > 0.2 and abs(move[1]) < 0.2
    if not runs_straight_on["through"]:
        return "through"
    return next((name for name in ("begin", "around") if runs_straight_on[name]), "")


@exercise(
    "17.5",
    _("Gold: quick goals"),
    hints={
        "begin": _("First it has to score at all: begin with your `strike` of 17.4."),
        "turns": _(
            "Where a place is 45 degrees to its side, it stops and turns. Write a `go_to` of "
            "your own that turns faster, and drives on while it turns."
        ),
        "far": _(
            "It turns well. Where are decisions lost now? Try a place nearer behind the "
            'ball, and pass the ball more closely. Watch it: `film("soccer", quick_strike, '
            "seed=3)`."
        ),
    },
)
def scores_quickly(quick_strike: Any) -> Done:
    """Check for goals within ten seconds, in 16 of 24 games."""
    quick = won = 0
    games = drives("soccer", quick_strike, seeds_of("17.5", GAMES), limit=300, watch=in_front)
    for played, done in enumerate(games, 1):
        won += done.won
        quick += done.won and done.steps <= QUICK_DECISIONS
        if played - won > GAMES - QUICK_GOALS:
            break
    told = _(
        "{won} goals in {played} games, {quick} of them within {quick_decisions} "
        "decisions (10 seconds)",
        won=won,
        played=played,
        quick=quick,
        quick_decisions=QUICK_DECISIONS,
    )
    if quick < QUICK_GOALS:
        hint = "begin"
        if won >= 0.6 * played:
            hint = "turns" if _stops_to_turn(quick_strike, done) else "far"
        raise NotYet(
            _(
                "{told}; gold is {quick_goals} of {games}.",
                told=told,
                quick_goals=QUICK_GOALS,
                games=GAMES,
            ),
            hint=hint,
            picture=done.picture(),
        )
    return Done(_("Gold: {told}.", told=told), done.picture())


def _stops_to_turn(strike: Any, done: Drive) -> bool:
    """Return True if it does not drive towards a ball that is 45 degrees to its left."""
    if isinstance(strike, type) or not callable(strike):
        return False
    ball, goal = _places((0.07, 0.07), (0.3, 0.3))
    answer = strike({**done.agent.percept, "ball": ball, "goal": goal, "home": -goal})
    move = answer.get("move", ()) if isinstance(answer, dict) else ()
    return not any(move[:1])


exit_ticket(
    "17.exit",
    Question(
        "a",
        {
            "b": _("The ball flies off the way the robot was running. Which way is that?"),
            "c": _("A ball that is hit straight on flies off straight ahead of the robot."),
        },
    ),
    Question(
        "c",
        {
            "a": _("3.14 and -3.14 are both straight behind."),
            "b": _("Far on the left is 1.57, a quarter turn. 3.1 is nearly a half turn."),
        },
    ),
    Question(
        "b",
        {
            "a": _("The computer has the same to compute. It is for you, not for the computer."),
            "c": _("A controller may be as long as you like."),
        },
    ),
)

"""Python for robots: lists and loops."""

import math
from collections.abc import Callable
from typing import Any

from ai4u_edu.lessons.exercise import Done, NotYet, a_function, exercise, named
from ai4u_edu.lessons.exercises.lesson_01_worlds import NEAR_M, WORDS, carry_out, posts_around
from ai4u_edu.lessons.numeric import chance_for, finite_number, is_close
from ai4u_edu.lessons.student_errors import NOTHING_RETURNED

MAX_WORDS = 40


@exercise(
    "01.4",
    "How many are near?",
    hints={
        "begin": "Three steps: before the loop `count = 0`; in the loop, if the distance is below "
        "2, `count = count + 1`; after the loop `return count`.",
        "early": "Your loop ends at the first distance: a `return` ends the whole function. Move "
        "it to the left, below the `for`, so that it comes after the loop.",
        "reset": "The count begins anew for each distance. `count = 0` has to stand before the "
        "`for`, not in it.",
        "all": "That is the number of all posts. Count only if the distance is below 2.",
        "limit": "A post at exactly 2 m is not nearer than 2 m: compare with `<`.",
        "far": "You counted the posts that are far away: turn the comparison round.",
        "sum": "You added up distances. Here each near post counts as 1, whatever its distance.",
    },
)
def counts_the_near_ones(count_near: Any) -> Done:
    """Check ``count_near(distances)`` for posts around a robot."""
    a_function(count_near)
    chance = chance_for("01.4", count_near)
    asked: list[tuple[list[float], float]] = []
    # near ones and far ones, of which neither the first nor the last says how many there are
    for near, far in ((2, 3), (0, 4), (5, 0), (1, 2), (3, 4), (4, 1), (2, 1), (1, 5)):
        away = [*chance.uniform(1.2, 1.9, near), *chance.uniform(2.1, 4.2, far)]
        if far:
            away[-1] = NEAR_M  # just not near
        distances = [round(float(each), 1) for each in chance.permutation(away)]
        asked.append((distances, finite_number(count_near(list(distances)))))
    for distances, found in asked:
        exact = sum(each < NEAR_M for each in distances)
        if not is_close(found, exact, 1e-6):
            raise NotYet(
                f"For {distances} expected {exact}, got {found:g}.",
                hint=_counting_mistake(asked),
                picture=posts_around(distances),
            )
    return Done("Eight places, and every count was right.", posts_around(asked[-1][0]))


def _counting_mistake(asked: list[tuple[list[float], float]]) -> str:
    """Return the diagnosis that explains all counts."""
    mistakes: dict[str, Callable[[list[float]], float]] = {
        "early": lambda given: float(given[0] < NEAR_M),
        "reset": lambda given: float(given[-1] < NEAR_M),
        "all": lambda given: float(len(given)),
        "limit": lambda given: float(sum(each <= NEAR_M for each in given)),
        "far": lambda given: float(sum(each > NEAR_M for each in given)),
        "far ": lambda given: float(sum(each >= NEAR_M for each in given)),
        "sum": lambda given: float(sum(each for each in given if each < NEAR_M)),
    }
    for name, wrong in mistakes.items():
        if all(is_close(found, wrong(given), 1e-6) for given, found in asked):
            return name.strip()
    return "begin"


@exercise(
    "01.5",
    "A plan",
    hints={
        "begin": "Begin with an empty list: `steps = []`. Then `for _ in range(ahead):`, and in "
        'the loop `steps.append("forward")`. Then one "left", then a second loop.',
        "early": "Your loop ends after its first step: a `return` ends the whole function. Move it "
        "to the left, so that it comes after the loops.",
        "reset": "The list begins anew in the loop. `steps = []` has to stand before it.",
        "turn": "It drives straight on. Between the two loops the robot has to turn: once.",
        "turns": "It turns at each step. The turn has to stand after the first loop, not in it: "
        "further to the left.",
        "mirrored": "It turns to the wrong side.",
        "swapped": "The two numbers are swapped: first `ahead` metres, then `left` metres.",
        "count": "It stops beside the flag. Count the steps in the picture: `range(3)` gives three "
        "numbers: 0, 1, 2.",
        "words": 'A plan is a list of the words "forward", "left" and "right".',
    },
)
def plans_the_way(plan: Any) -> Done:
    """Check that a robot that carries out ``plan(ahead, left)`` gets to the flag."""
    a_function(plan)
    chance = chance_for("01.5", plan)
    drawn = [tuple(int(each) for each in chance.integers(1, 6, 2)) for _ in range(4)]
    for ahead, left in ((3, 1), (1, 4), (5, 2), *drawn):
        words = _words_of(plan(ahead, left))
        done = carry_out(words, ahead, left)
        x, y = done.agent.body.position
        if not math.hypot(x - ahead, y - left) < 0.3:
            shown = ", ".join(words[:8]) + (" ..." if len(words) > 8 else "")
            raise done.not_yet(
                f"The flag is {ahead} m ahead and {left} m to the left; the robot ends {x:.0f} m "
                f"ahead and {y:.0f} m to the left. Your plan: {shown or 'nothing'}.",
                _planning_mistake(words, ahead, left),
            )
    return Done(f"{3 + len(drawn)} flags, and each of your plans led to its flag.", done.picture())


def _words_of(given: Any) -> list[str]:
    """Return a student's plan.

    Raises:
        NotYet: it is no list of the three words.
    """
    if given is None:
        raise NotYet(NOTHING_RETURNED, hint="no-return")
    if isinstance(given, str) or not isinstance(given, list | tuple):
        raise NotYet(f"Expected a list of words, got {named(given)}.", hint="list")
    if len(given) > MAX_WORDS:
        raise NotYet(f"Your plan has {len(given)} words; {MAX_WORDS} are enough.", hint="count")
    for each in given:
        if not isinstance(each, str) or each not in WORDS:
            raise NotYet(f"The robot knows {', '.join(WORDS)}; got {named(each)}.", hint="words")
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

"""Several agents: tag, sumo, soccer."""

from typing import Any

import numpy as np

from ai4u_edu.lessons.exercise import Done, NotYet, exercise
from ai4u_edu.lessons.rollouts import Drive, drives, seeds_of


@exercise(
    "12.1",
    "The chaser",
    hints={
        "begin": "It chases the first runner only. Go through all three, and take the nearest one "
        "that is still free.",
        "caught": "It drives to where it caught somebody. Whom you caught still has a place: "
        '`percept["free"]` says who is free.',
        "none": "It caught nobody. `go_to` gets how far ahead and how far to the left a runner is.",
    },
)
def catches_all(chase: Any) -> Done:
    """Check that it catches all three runners in nearly all rounds."""
    rounds, needed, won = 6, 5, 0
    reason: NotYet | None = None
    for played, done in enumerate(drives("tag", chase, seeds_of("12.1", rounds)), 1):
        won += done.won
        if not done.won and reason is None:
            free = sum(done.agent.percept["free"])
            hint = "none" if free == 3 else "caught" if _looks_around(chase, done) else "begin"
            reason = done.not_yet(
                f"{3 - free:.0f} of three were caught when the time was up ({{where}}).", hint
            )
        if played - won > rounds - needed:
            break
    if won < needed and reason is not None:
        reason.text = (
            f"All three caught in {won} of {played} rounds; {needed} of {rounds} are needed. "
            f"{reason.text}"
        )
        raise reason
    return Done(f"All three caught, in {won} of {rounds} rounds.", done.picture())


def _looks_around(chase: Any, done: Drive) -> bool:
    """Return True if its actions depend on the other runners at all."""
    percept = dict(done.agent.percept)
    moved = {**percept, "runner 2": [0.1, 0.2, 0.0], "runner 3": [-0.1, -0.2, 0.0]}
    answers = [chase(each) for each in (percept, moved)] if callable(chase) else []
    return bool(answers) and repr(answers[0]) != repr(answers[1])


@exercise(
    "12.2",
    "Stay in the ring",
    hints={
        "edge": "It falls out by itself. Turn to the opponent before you drive: `go_to` with the "
        "first two numbers of `opponent`.",
        "away": "It turns away from the opponent. `go_to` gets how far ahead, then how far to the "
        "left: in that order.",
        "careful": "It wins more often than not, and loses fights by being careful: while it turns "
        "to the middle, the other one pushes. Try what happens if it just attacks.",
        "shy": "It does not attack: nobody wins by waiting. Drive at the opponent.",
    },
)
def wins_fights(fight: Any) -> Done:
    """Check that it wins 17 of 20 fights."""
    fights, needed, won = 20, 17, 0
    reason: NotYet | None = None
    for played, done in enumerate(drives("sumo", fight, seeds_of("12.2", fights)), 1):
        won += done.won
        if not done.won and reason is None:
            how = "fell out of the ring" if done.fell else "did not win"
            reason = done.not_yet(f"Your robot {how} ({{where}}).", _fight_mistake(fight, done))
        if played - won > fights - needed:
            break
    if won < needed and reason is not None:
        if won > 6 and reason.hint == "edge":
            reason.hint = "careful"
        reason.text = (
            f"{won} of {played} fights won; {needed} of {fights} are needed. {reason.text}"
        )
        raise reason
    return Done(f"{won} of {fights} fights won.", done.picture())


def _fight_mistake(fight: Any, done: Drive) -> str:
    """Return the diagnosis that fits a lost fight."""
    if callable(fight) and not isinstance(fight, type):
        percept = dict(done.agent.percept)
        turns = []
        for left in (0.3, -0.3):
            there = {"opponent": np.array([0.1, left, 0.0]), "position": [0, 0, 0]}
            answer = fight({**percept, **there})
            turns.append(float(answer["move"][1]) if isinstance(answer, dict) else 0.0)
        if turns[0] > turns[1]:
            return "away"
    return "edge" if done.moved > 0.5 and any(done.agent.last_action.get("move", ())[:1]) else "shy"


@exercise(
    "12.3",
    "The striker",
    hints={
        "begin": "Running at the ball is not enough: it flies off the way you were running. First "
        "go to a place behind it, seen from the goal: `behind(ball, goal)`.",
        "through": "You get behind the ball, and then? When you are there, run through the ball: "
        "go to `ball`, or to `goal`.",
        "when": "How do you know that you are behind it? Seen from there, ball and goal lie in the "
        "same direction: `math.atan2(ball[1], ball[0])` and the same for the goal differ by less "
        "than 0.5, say.",
    },
)
def scores(strike: Any) -> Done:
    """Check for 6 goals in 12 games that begin in front of the ball."""
    games, needed, won = 12, 6, 0
    reason: NotYet | None = None
    for played, done in enumerate(
        drives("soccer", strike, seeds_of("12.3", games), watch=_in_front), 1
    ):
        won += done.won
        if not done.won and reason is None:
            own = done.sim.world["ball"].position[0] < -7
            reason = done.not_yet(f"{'An own goal' if own else 'No goal'} ({{where}}).", "begin")
        if played - won > games - needed:
            break
    if won < needed and reason is not None:
        if won > needed / 2:
            reason.hint = "when"
        reason.text = f"{won} goals in {played} games; {needed} in {games} needed. {reason.text}"
        raise reason
    return Done(f"{won} goals in {played} games.", done.picture())


def _in_front(done: Drive) -> None:
    """Put the striker between the ball and the goal, at the beginning."""
    if done.steps == 0:
        chance = np.random.default_rng(done.seed)
        x, y, heading = chance.uniform(1.5, 5), chance.uniform(-3.5, 3.5), chance.uniform(-3, 3)
        done.agent.body.move_to(float(x), float(y), heading=float(heading))

"""Several agents: tag and sumo."""

import math
from typing import Any

import numpy as np

from ai4u_edu.blocks import Percept
from ai4u_edu.lessons.exercise import Done, NotYet, a_function, exercise, named
from ai4u_edu.lessons.exit_ticket import Question, exit_ticket
from ai4u_edu.lessons.rollouts import Drive, drives, seeds_of
from ai4u_edu.lessons.student_errors import NOTHING_RETURNED
from ai4u_edu.locale import gettext as _

CHASE_DECISIONS = 450
"""Decisions of a round in 16.1; one that takes the nearest runner needs at most 300 or so."""
NEAR_M, MAX_LINGER_DECISIONS = 1.5, 30
"""Distance from the place of a catch, and the decisions that a chaser may stay within it."""
FACES_RAD, FACES = 0.6, 0.5
"""Angle within which a chaser faces a runner, and the least share of the decisions in which it does
while one runner is left."""
PAIRS = 30
"""Pairs of players, one of whom is better."""
REVERSED_PAIRS = 24
"""Wrong choices above which the worse player is chosen on purpose, and not by bad luck."""
MIN_GAMES = 20
"""Fewest games of each player in a contest."""
RING = 4 / 9
"""Radius of sumo's ring, in the unit of ``position``."""


def fights_won(plan: str, fights: int = 20) -> int:
    """Return how many of the first fights of sumo a plan wins.

    Args:
        plan: ``"attack"``: at the opponent; ``"careful"``: near the edge to the middle first.
        fights: number of fights, with the seeds 0, 1, 2 and so on.
    """

    def fight(percept: Percept) -> dict[str, list[float]]:
        (x, y), (sine, cosine) = percept["position"][:2], percept["heading"]
        ahead, left = percept["opponent"][:2]
        if plan == "careful" and math.hypot(x, y) > 0.5 * RING:
            ahead, left = -x * cosine - y * sine, x * sine - y * cosine
        angle = math.atan2(left, ahead)
        return {"move": [float(abs(angle) < 0.5), max(-1.0, min(1.0, -2 * angle)), 0, 0]}

    return sum(each.won for each in drives("sumo", fight, list(range(fights))))


@exercise(
    "16.1",
    _("The chaser"),
    hints={
        "begin": _(
            "It chases the first runner only. Go through all three, and take the nearest one "
            "that is still free."
        ),
        "caught": _(
            "It drives to where it caught somebody. Whom you caught still has a place: "
            '`percept["free"]` says who is free.'
        ),
        "luck": _("Turn to a runner that is free, at every decision: `go_to` does that."),
        "none": _(
            "It caught nobody. `go_to` gets how far ahead and how far to the left a runner is."
        ),
    },
)
def catches_all(chase: Any) -> Done:
    """Check that it catches all three runners in nearly all rounds."""
    rounds, needed, won = 6, 5, 0
    reason: NotYet | None = None
    lingers: list[_Lingering] = []

    def linger(done: Drive) -> None:
        if done.steps == 0:
            lingers.append(_Lingering())
        lingers[-1].watch(done)

    chases = drives("tag", chase, seeds_of("16.1", rounds), limit=CHASE_DECISIONS, watch=linger)
    for played, done in enumerate(chases, 1):
        is_won = done.won and lingers[-1].longest <= MAX_LINGER_DECISIONS
        won += is_won
        if not is_won and reason is None:
            free = sum(done.agent.percept["free"])
            hint = "none" if free == 3 else "caught" if _looks_around(chase, done) else "begin"
            how = _("{free:.0f} of three were caught when the time was up", free=3 - free)
            if done.won:
                how = _("It stayed for more than two seconds where it had caught somebody")
                hint = "caught"
            reason = done.not_yet(_("{how} ({where}).", how=how, where=done.where), hint)
        if played - won > rounds - needed:
            break
    faces = [is_facing for each in lingers for is_facing in each.faces]
    if won >= needed and sum(faces) < FACES * len(faces):
        raise done.not_yet(
            _(
                "It caught them all, but by driving about: when one was left, it faced that "
                "one in {faces} of {count} decisions ({where}).",
                faces=sum(faces),
                count=len(faces),
                where=done.where,
            ),
            "luck",
        )
    if won < needed and reason is not None:
        reason.text = _(
            "{won} of {played} rounds won; {needed} of {rounds} are needed. {text}",
            won=won,
            played=played,
            needed=needed,
            rounds=rounds,
            text=reason.text,
        )
        raise reason
    return Done(
        _("All three caught, in {won} of {rounds} rounds.", won=won, rounds=rounds), done.picture()
    )


class _Lingering:
    """Stays of a chaser where it caught somebody, and its looks at the last runner."""

    def __init__(self) -> None:
        self.longest = 0
        """Decisions of the longest stay."""
        self.faces: list[bool] = []
        """True for each decision in which it faced the last free runner."""
        self._stay, self._free = 0, 3.0
        self._place: tuple[float, float] | None = None

    def watch(self, done: Drive) -> None:
        """Look after a decision."""
        angle = _angle_to_last(done.agent.percept)
        if angle is not None:
            self.faces.append(abs(angle) < FACES_RAD)
        free, here = float(sum(done.agent.percept["free"])), done.agent.body.position
        if free < self._free:
            self._free, self._place, self._stay = free, here, 0
        if self._place is not None and math.dist(here, self._place) < NEAR_M:
            self._stay += 1
            self.longest = max(self.longest, self._stay)
        else:
            self._place = None


def _angle_to_last(percept: Percept) -> float | None:
    """Return the angle (rad) to the last runner that is free; None if more or none are."""
    free = [number for number, is_free in enumerate(percept["free"], 1) if is_free == 1]
    if len(free) != 1:
        return None
    ahead, left = percept[f"runner {free[0]}"][:2]
    return math.atan2(left, ahead)


def _looks_around(chase: Any, done: Drive) -> bool:
    """Return True if its actions depend on the other runners at all."""
    percept = dict(done.agent.percept)
    moved = {**percept, "runner 2": [0.1, 0.2, 0.0], "runner 3": [-0.1, -0.2, 0.0]}
    answers = [chase(each) for each in (percept, moved)] if callable(chase) else []
    return bool(answers) and repr(answers[0]) != repr(answers[1])


@exercise(
    "16.2",
    _("Stay in the ring"),
    hints={
        "edge": _(
            "It falls out by itself. Turn to the opponent before you drive: `go_to` with the "
            "first two numbers of `opponent`."
        ),
        "away": _(
            "It turns away from the opponent. `go_to` gets how far ahead, then how far to "
            "the left: in that order."
        ),
        "careful": _(
            "It wins more often than not, and loses fights by being careful: while it turns "
            "to the middle, the other one pushes. Try what happens if it just attacks."
        ),
        "shy": _("It does not attack: nobody wins by waiting. Drive at the opponent."),
    },
)
def wins_fights(fight: Any) -> Done:
    """Check that it wins 17 of 20 fights."""
    fights, needed, won = 20, 17, 0
    reason: NotYet | None = None
    for played, done in enumerate(drives("sumo", fight, seeds_of("16.2", fights)), 1):
        won += done.won
        if not done.won and reason is None:
            words = _("Your robot did not win ({where}).", where=done.where)
            if done.fell:
                words = _("Your robot fell out of the ring ({where}).", where=done.where)
            reason = done.not_yet(
                words,
                _fight_mistake(fight, done),
            )
        if played - won > fights - needed:
            break
    if won < needed and reason is not None:
        if won > 6 and reason.hint == "edge":
            reason.hint = "careful"
        reason.text = _(
            "{won} of {played} fights won; {needed} of {fights} are needed. {text}",
            won=won,
            played=played,
            needed=needed,
            fights=fights,
            text=reason.text,
        )
        raise reason
    return Done(_("{won} of {fights} fights won.", won=won, fights=fights), done.picture())


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
    "16.3",
    _("A fair contest"),
    hints={
        "few": _(
            "One game says little: the worse player may be lucky in it. Let both play twenty "
            "games: `sum(play(one, seed) for seed in range(20))`."
        ),
        "seeds": _(
            "They did not play the same games. Some seeds are easier than others, and then "
            "the one with the easy seeds looks better. Use the same seeds for both."
        ),
        "reversed": _("That is the one with fewer points."),
        "best": _(
            "The best game of each is compared. That is luck as well: compare all points, added up."
        ),
        "name": _("Return the player itself, without quotes: `return one`."),
    },
)
def judges_a_contest(better: Any) -> str:
    """Check that the better one of two players is found, in thirty pairs."""
    judge = a_function(better)
    chance = np.random.default_rng(seeds_of("16.3", 1)[0])
    reasons: list[NotYet] = []
    for pair in range(PAIRS):
        ahead = 0.7 if chance.random() < 0.5 else -0.7
        players = PlayedPair(pair, ahead)
        got = judge(players.play, players.one, players.other)
        if got is None:
            raise NotYet(NOTHING_RETURNED, hint="no-return")
        if not (got is players.one or got is players.other):
            raise NotYet(
                _("Expected one of the two players, `one` or `other`, got {got}.", got=named(got)),
                hint="name",
            )
        players.look_at_games()
        right = players.one if ahead > 0 else players.other
        if got is not right:
            reason = NotYet(
                _(
                    "In pair {pair} `{name}` is better: it has 0.7 points more on average. "
                    "You chose the other one.",
                    pair=pair + 1,
                    name=right.__name__,
                ),
                hint=players.mistake(got),
            )
            reasons.append(reason)
    if len(reasons) > REVERSED_PAIRS:
        reasons[0].hint = "reversed"
    if reasons:
        raise reasons[0]
    return _("You found the better one of {pairs} pairs.", pairs=PAIRS)


class PlayedPair:
    """Two players of a game in which chance and the seed decide too.

    Args:
        pair: number of the pair.
        ahead: points by which the first one is better on average.
    """

    def __init__(self, pair: int, ahead: float) -> None:
        self._pair, self._ahead = pair, ahead
        self.games: dict[str, dict[int, float]] = {"one": {}, "other": {}}

        def one() -> None: ...

        def other() -> None: ...

        self.one, self.other = one, other

    def play(self, player: Any, seed: Any) -> float:
        """Return a player's points in a game: the same each time."""
        name = getattr(player, "__name__", "")
        if name not in self.games or not isinstance(seed, int | np.integer) or seed < 0:
            raise NotYet(
                _("`play` takes one of the two players, and a seed: a whole number from 0 on."),
                hint="few",
            )
        numbers = [self._pair, int(seed)]
        difficulty = np.random.default_rng(numbers).normal(0, 2)
        luck = np.random.default_rng([*numbers, len(name)]).normal(0, 0.6)
        skill = 5 + self._ahead * (name == "one")
        points = float(skill + difficulty + luck)
        self.games[name][int(seed)] = points
        return points

    def look_at_games(self) -> None:
        """Raise NotYet if the players' games were few, or not the same."""
        one, other = self.games["one"], self.games["other"]
        if min(len(one), len(other)) < MIN_GAMES:
            raise NotYet(
                _(
                    "Your contest had {count} and {count2} games; at least {min_games} each "
                    "are needed.",
                    count=len(one),
                    count2=len(other),
                    min_games=MIN_GAMES,
                ),
                hint="few",
            )
        if set(one) != set(other):
            raise NotYet(_("The two players did not play the same games."), hint="seeds")

    def mistake(self, chosen: Any) -> str:
        """Return the diagnosis that fits a wrong choice."""
        one, other = (list(each.values()) for each in self.games.values())
        by_best = self.one if max(one) > max(other) else self.other
        by_sum = self.one if sum(one) > sum(other) else self.other
        if chosen.__name__ != by_sum.__name__ and chosen.__name__ == by_best.__name__:
            return "best"
        return "reversed"


exit_ticket(
    "16.exit",
    Question(
        "b",
        {
            "a": _("They win or lose together. In a zero-sum game one wins what the other loses."),
            "c": _("Your marks take nothing away from the others'."),
        },
    ),
    Question(
        "c",
        {
            "a": _("Ben's games may have been easier, and five games are few."),
            "b": _("Different seeds and few games can hide a large difference, too."),
        },
    ),
    Question(
        "a",
        {
            "b": _("It was counted against one opponent only. Another one may be different."),
            "c": _("Both plans fought the same twenty fights. What sounds wise has to win, too."),
        },
    ),
)
